#include "study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace zwang::study {

namespace {

/// The continued fraction of I_x(a, b), by the method of Lentz (DLMF 8.17.22). It converges fast for
/// x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  constexpr int most_steps = 100'000;
  const auto above_zero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
  double c = 1.0, d = 1.0 / above_zero(1.0 - (a + b) * x / (a + 1.0)), sum = d;
  for (int m = 1; m <= most_steps; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / above_zero(1.0 + even * d);
    c = above_zero(1.0 + even / c);
    sum *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / above_zero(1.0 + odd * d);
    c = above_zero(1.0 + odd / c);
    sum *= c * d;
    if (std::abs(c * d - 1.0) < std::numeric_limits<double>::epsilon()) break;
  }
  return sum;
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    const double mean = 0.5 * static_cast<double>(begin + end - 1);
    for (std::size_t i = begin; i < end; ++i) rank[order[i]] = mean;
  }
  return rank;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
  return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

double beta_quantile(double p, double a, double b) {
  double low = 0.0, high = 1.0;
  // Halves the interval to the last bit: I_x rises with x, and nothing waits for it.
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (incomplete_beta(a, b, middle) < p ? low : high) = middle;
  }
}

double surely_at_least(std::size_t held, std::size_t runs, double confidence) {
  if (held == 0) return 0.0;
  const auto k = static_cast<double>(held), n = static_cast<double>(runs);
  if (held == runs) return std::exp(std::log1p(-confidence) / n);
  return beta_quantile(1.0 - confidence, k, n - k + 1.0);
}

double surely_at_most(std::size_t held, std::size_t runs, double confidence) {
  return 1.0 - surely_at_least(runs - held, runs, confidence);
}

Interval clopper_pearson(std::size_t held, std::size_t runs, double confidence) {
  const double each_side = 0.5 * (1.0 + confidence);
  return {surely_at_least(held, runs, each_side), surely_at_most(held, runs, each_side)};
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return "held";
    case Verdict::broken:
      return "broken";
    case Verdict::too_few_runs:
      break;
  }
  return "too few runs";
}

Verdict judge(std::size_t held, std::size_t runs, const std::optional<double>& probability,
              double confidence) {
  if (runs == 0) return Verdict::too_few_runs;
  if (!probability) return held == runs ? Verdict::held : Verdict::broken;
  if (surely_at_least(held, runs, confidence) >= *probability) return Verdict::held;
  if (surely_at_most(held, runs, confidence) < *probability) return Verdict::broken;
  return Verdict::too_few_runs;
}

double quantile_of(const std::vector<double>& sorted, double p) {
  const double count = std::ceil(p * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(1.0, count)) - 1];
}

std::optional<double> rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  return rank_correlation_within(x, y, std::vector<std::size_t>(x.size(), 0));
}

std::optional<double> rank_correlation_within(const std::vector<double>& x, const std::vector<double>& y,
                                              const std::vector<std::size_t>& group) {
  std::map<std::size_t, std::pair<std::vector<double>, std::vector<double>>> groups;
  for (std::size_t i = 0; i < x.size(); ++i) {
    groups[group[i]].first.push_back(x[i]);
    groups[group[i]].second.push_back(y[i]);
  }
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (const auto& [number, values] : groups) {
    const std::vector<double> a = ranks(values.first), b = ranks(values.second);
    const double count = static_cast<double>(a.size());
    const double mean = 0.5 * (count - 1.0);
    // As shares of the group: else a group of twice as many cells counts eight times as much.
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double da = (a[i] - mean) / count, db = (b[i] - mean) / count;
      ab += da * db;
      aa += da * da;
      bb += db * db;
    }
  }
  if (!(aa > 0.0) || !(bb > 0.0)) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

}  // namespace zwang::study
