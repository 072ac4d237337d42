// Shares of a cell: by its number and that of the draw alone, so that cells may be computed in any order.
//
// `halton` is the radical inverse of the cell's number in the draw's prime base b, its digits permuted:
//
//   u = sum_k perm(d_k) b^-k,    n = sum_k d_k b^(k-1),    n = cell + 1
//
// The number 0 has zeros alone. In base 2 they make it an end of the unit interval: 8 deviations of a normal
// distribution.
// Without the permutation, shares of large bases rise together for the first b cells
// (Braaten, Weller 1979).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "zwang/lang/study.hpp"

namespace zwang::lang {

namespace {

/// The bases of the draws and, behind the 32 that a study may have, of its matrix.
constexpr std::array<unsigned, 33> primes{2,  3,  5,  7,   11,  13,  17,  19,  23,  29,  31,
                                          37, 41, 43, 47,  53,  59,  61,  67,  71,  73,  79,
                                          83, 89, 97, 101, 103, 107, 109, 113, 127, 131, 137};

/// SplitMix64 (Steele, Lea, Flood 2014), of which each number can be asked for alone.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t z = seed + (number + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

/// In (0, 1), never an end of it.
double share_of(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

std::vector<unsigned> permutation(unsigned base, std::uint64_t seed) {
  std::vector<unsigned> digits(base);
  std::iota(digits.begin(), digits.end(), 0U);
  for (unsigned i = base - 1; i > 0; --i) std::swap(digits[i], digits[mixed(seed, i) % (i + 1)]);
  return digits;
}

double radical_inverse(unsigned base, std::uint64_t number, std::uint64_t seed) {
  const std::vector<unsigned> digits = permutation(base, seed);
  double u = 0.0, weight = 1.0;
  // The zeros ahead of the number are permuted, too: as far as a double has digits.
  while (weight > 0x1p-53) {
    weight /= base;
    u += weight * digits[number % base];
    number /= base;
  }
  return std::clamp(u, 0x1p-53, 1.0 - 0x1p-53);
}

/// The inverse of the normal distribution by P. Acklam's rational approximation (relative error 1.15e-9), and
/// one step of Halley's method by erfc, which takes it to the precision of a double.
double normal_quantile(double u) {
  constexpr std::array a{-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                         1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr std::array b{-5.447609879822406e+01, 1.615858368580409e+02, -1.556989798598866e+02,
                         6.680131188771972e+01, -1.328068155288572e+01};
  constexpr std::array c{-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                         -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr std::array d{7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                         3.754408661907416e+00};
  constexpr double tail = 0.02425;
  double x = 0.0;
  if (u < tail || u > 1.0 - tail) {
    const double q = std::sqrt(-2.0 * std::log(std::min(u, 1.0 - u)));
    x = (((((c[0] * q + c[1]) * q + c[2]) * q + c[3]) * q + c[4]) * q + c[5]) /
        ((((d[0] * q + d[1]) * q + d[2]) * q + d[3]) * q + 1.0);
    if (u > 0.5) x = -x;
  } else {
    const double q = u - 0.5, r = q * q;
    x = (((((a[0] * r + a[1]) * r + a[2]) * r + a[3]) * r + a[4]) * r + a[5]) * q /
        (((((b[0] * r + b[1]) * r + b[2]) * r + b[3]) * r + b[4]) * r + 1.0);
  }
  const double e = 0.5 * std::erfc(-x / std::numbers::sqrt2) - u;
  const double step = e * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * x * x);
  return x - step / (1.0 + 0.5 * x * step);
}

}  // namespace

double Distribution::quantile(double u) const {
  switch (spread) {
    case Spread::uniform:
      return first + (second - first) * u;
    case Spread::log_uniform:
      return first * std::exp(u * std::log(second / first));
    case Spread::normal:
      return first + second * normal_quantile(u);
    case Spread::choice:
      break;
  }
  const auto count = static_cast<double>(values.size());
  return values[static_cast<std::size_t>(std::min(std::floor(u * count), count - 1.0))];
}

double drawn_share(Sequence sequence, std::uint64_t seed, std::size_t cell, std::size_t draw) {
  const std::uint64_t of_draw = mixed(seed, draw);
  if (sequence == Sequence::random) return share_of(mixed(of_draw, cell));
  return radical_inverse(primes.at(draw), cell + 1, of_draw);
}

std::uint64_t seed_of_cell(std::uint64_t seed, std::size_t cell) {
  constexpr std::uint64_t behind_the_draws = 1U << 20U;
  return mixed(mixed(seed, behind_the_draws), cell);
}

std::size_t clean_runs_for(double probability, double confidence) {
  // probability^n <= 1 - confidence
  return static_cast<std::size_t>(std::ceil(std::log1p(-confidence) / std::log(probability)));
}

}  // namespace zwang::lang
