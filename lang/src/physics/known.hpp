/// What is known of a number before anything runs.
#pragma once

#include <string>

#include "check/cases.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

/// Where the number lies, and why.
struct Known {
  Bounds bounds;
  std::string by;  ///< path of the range, `timeout`
  Span span;
  bool holds_whatever_pushes = false;
  int output = -1;  ///< whose values they are
  bool is_unknown = false;
  bool is_entered_anywhere = false;  ///< nobody knows where the task begins
  std::string parameter;             ///< that an end of the range is; empty: none
  double speed = solver::infinity;   ///< of a way: how fast it goes. [m/s] or [rad/s]
  double time = solver::infinity;    ///< [s] of a way: for so long it goes at most
};

}  // namespace zwang::lang
