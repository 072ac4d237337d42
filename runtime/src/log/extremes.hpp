/// A column of a log in buckets that hold its least, its largest and its first value.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace zwang::runtime {

struct Bucket {
  float first = std::numeric_limits<float>::quiet_NaN();  ///< of its first record
  float least = std::numeric_limits<float>::quiet_NaN();  ///< NaN: blank in every record
  float largest = std::numeric_limits<float>::quiet_NaN();
  bool least_came_first = true;

  void take(float value) {
    if (std::isnan(value)) return;
    if (std::isnan(least)) {
      least = largest = value;
    } else if (value < least) {
      least = value;
      least_came_first = false;
    } else if (value > largest) {
      largest = value;
      least_came_first = true;
    }
  }

  /// Itself and the one behind it.
  Bucket with(const Bucket& next) const {
    if (std::isnan(least)) return {first, next.least, next.largest, next.least_came_first};
    if (std::isnan(next.least)) return *this;
    const bool least_is_here = least <= next.least, largest_is_here = largest >= next.largest;
    Bucket both;
    both.first = first;
    both.least = least_is_here ? least : next.least;
    both.largest = largest_is_here ? largest : next.largest;
    both.least_came_first = least_is_here && largest_is_here     ? least_came_first
                            : !least_is_here && !largest_is_here ? next.least_came_first
                                                                 : least_is_here;
    return both;
  }
};

/// Halves the number of buckets: each becomes one with its neighbour.
inline void merge_pairs(std::vector<Bucket>& buckets) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < buckets.size(); i += 2)
    buckets[kept++] = i + 1 < buckets.size() ? buckets[i].with(buckets[i + 1]) : buckets[i];
  buckets.resize(kept);
}

}  // namespace zwang::runtime
