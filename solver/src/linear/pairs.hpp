/// Loops over a few neighbouring numbers, two at a time as every x86-64 and arm64 processor can. For the
/// short vectors of the solver they cost less than the set-up of Eigen's loops for vectors of any size.
#pragma once

#include <Eigen/Core>

namespace zwang::solver {

using Pair = Eigen::Map<Eigen::Array2d>;
using ConstPair = Eigen::Map<const Eigen::Array2d>;

/// Two numbers in one register. (An Eigen::Array2d of which single numbers are wanted goes through memory for
/// them.)
typedef double Two __attribute__((vector_size(16), may_alias));
typedef double UnalignedTwo __attribute__((vector_size(16), aligned(8), may_alias));
inline Two two(const double* x) {
  return *static_cast<const UnalignedTwo*>(static_cast<const void*>(x));
}
inline void put_two(const Two& pair, double* x) {
  *static_cast<UnalignedTwo*>(static_cast<void*>(x)) = pair;
}
inline Two* aligned_two(double* x) {
  return static_cast<Two*>(static_cast<void*>(x));
}
inline const Two* aligned_two(const double* x) {
  return static_cast<const Two*>(static_cast<const void*>(x));
}

/// More than `columns`, and an odd multiple of 8: lines of that length start on different sets of the cache.
constexpr int spaced(int columns) {
  return 8 * ((columns + 8) / 8 | 1);
}

/// Number by number, for an even `count` of them.
template <int count>
bool are_same(const double* x, const double* y) noexcept {
  auto differs = two(x) != two(y);
  for (int k = 2; k < count; k += 2) differs |= two(x + k) != two(y + k);
  return (differs[0] | differs[1]) == 0;
}

/// x = 0, for `count` numbers.
inline void set_zero(int count, double* x) {
  int k = 0;
  for (; k + 2 <= count; k += 2) Pair(x + k).setZero();
  if (k < count) x[k] = 0.0;
}

/// y = x, for `count` numbers.
inline void copy(int count, const double* x, double* y) {
  int k = 0;
  for (; k + 2 <= count; k += 2) Pair(y + k) = ConstPair(x + k);
  if (k < count) y[k] = x[k];
}

/// y = s x, for `count` numbers.
inline void scaled_copy(int count, double s, const double* x, double* y) {
  int k = 0;
  for (; k + 2 <= count; k += 2) Pair(y + k) = s * ConstPair(x + k);
  if (k < count) y[k] = s * x[k];
}

/// y += s x, for `count` numbers.
inline void add_multiple(int count, double s, const double* x, double* y) {
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    Pair(y + k) += s * ConstPair(x + k);
    Pair(y + k + 2) += s * ConstPair(x + k + 2);
  }
  if (k + 2 <= count) {
    Pair(y + k) += s * ConstPair(x + k);
    k += 2;
  }
  if (k < count) y[k] += s * x[k];
}

/// Two lines of numbers += upper x and lower x, in columns [first, last). Of an odd number of columns one
/// more.
inline void add_to_two_lines(double upper, double lower, const double* x, int first, int last, double* line,
                             double* next) {
  for (int l = first; l < last; l += 2) {
    const Eigen::Array2d pair = ConstPair(x + l);
    Pair(line + l) += upper * pair;
    Pair(next + l) += lower * pair;
  }
}

/// A line of numbers += factor x, in columns [first, last). Of an odd number of columns one more.
inline void add_to_line(double factor, const double* x, int first, int last, double* line) {
  for (int l = first; l < last; l += 2) Pair(line + l) += factor * ConstPair(x + l);
}

/// matrix += s x x' in lines and columns [first, last), the lower triangle: two lines and two columns at a
/// time. The numbers that it writes above the diagonal are never read. `stride`: from line to line.
inline void add_square(int first, int last, double s, const double* x, double* matrix, Eigen::Index stride) {
  double* line = matrix + first * stride;
  int k = first;
  for (; k + 2 <= last; k += 2) {
    add_to_two_lines(s * x[k], s * x[k + 1], x, first, k + 2, line, line + stride);
    line += 2 * stride;
  }
  if (k < last) add_to_line(s * x[k], x, first, last, line);
}

/// y = sum x_i line_i over `count` lines, up to four sums at a time, in registers: in memory each addition
/// would wait for the one before. Of an odd number of columns one more.
inline void combine_lines(int count, const double* x, const double* lines, Eigen::Index stride, int columns,
                          double* y) {
  int c = 0;
  for (; c + 2 < columns; c += 4) {
    Two sum = {}, next = {};
    const double* line = lines + c;
    for (int i = 0; i < count; ++i, line += stride) {
      sum += x[i] * two(line);
      next += x[i] * two(line + 2);
    }
    put_two(sum, y + c);
    put_two(next, y + c + 2);
  }
  if (c >= columns) return;
  Two sum = {};
  const double* line = lines + c;
  for (int i = 0; i < count; ++i, line += stride) sum += x[i] * two(line);
  put_two(sum, y + c);
}

/// x . y, for an even number of numbers that the compiler knows.
template <int count>
double dot(const double* x, const double* y) {
  Two sum = two(x) * two(y);
  for (int k = 2; k < count; k += 2) sum += two(x + k) * two(y + k);
  return sum[0] + sum[1];
}

/// out = { x . y, x . z }, for `count` numbers.
inline void dot_two(int count, const double* x, const double* y, const double* z, double* out) {
  Two sum = {}, other = {};
  int k = 0;
  for (; k + 2 <= count; k += 2) {
    const Two pair = two(x + k);
    sum += pair * two(y + k);
    other += pair * two(z + k);
  }
  const double rest = k < count ? x[k] * y[k] : 0.0, other_rest = k < count ? x[k] * z[k] : 0.0;
  out[0] = sum[0] + sum[1] + rest;
  out[1] = other[0] + other[1] + other_rest;
}

/// x . y, for `count` numbers.
inline double dot_any(int count, const double* x, const double* y) {
  Two sum = {}, other = {};  // neither waits for the other
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    sum += two(x + k) * two(y + k);
    other += two(x + k + 2) * two(y + k + 2);
  }
  sum += other;
  if (k + 2 <= count) {
    sum += two(x + k) * two(y + k);
    k += 2;
  }
  const double rest = k < count ? x[k] * y[k] : 0.0;
  return sum[0] + sum[1] + rest;
}

/// The same. Mostly these are the three motions of a base that goes everywhere: without loops, and to the
/// same last bit. (0.0 + -0.0 is 0.0.)
inline double dot(int count, const double* x, const double* y) {
  if (count == 3) return (0.0 + x[0] * y[0]) + x[1] * y[1] + x[2] * y[2];
  return dot_any(count, x, y);
}

}  // namespace zwang::solver
