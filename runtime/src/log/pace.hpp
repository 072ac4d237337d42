/// Tells when something is due that happens so often in the time of a run.
#pragma once

namespace zwang::runtime {

class Pace {
 public:
  explicit Pace(double every) : every_(every) {}  ///< [s]

  /// The first time, and whenever so long has passed since it was due. A clock that jumps back is due, too.
  bool is_due(double time) {
    constexpr double rounding = 1e-9;  // [s]
    if (has_begun_ && time < last_ + every_ - rounding && time >= last_) return false;
    has_begun_ = true;
    last_ = time;
    return true;
  }

 private:
  double every_, last_ = 0.0;
  bool has_begun_ = false;
};

}  // namespace zwang::runtime
