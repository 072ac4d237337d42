/// What is said about paths.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

Diagnostic path_of_one_point(const Span& span, const std::string& what);
Diagnostic point_twice(const Span& span, const std::string& what);
/// The last point of a closed path stands at the first one.
Diagnostic closed_by_hand(const Span& span, const std::string& what);
Diagnostic path_turns_back(const Span& span, const std::string& what);
/// [m] `most`: the largest radius that fits.
Diagnostic fillet_too_large(const Span& span, const std::string& what, double radius, double most);
/// `word`: rx, ry, speed or plane.
Diagnostic no_axis_of_a_path(const Span& span, const std::string& group, const std::string& word,
                             const std::string& move, const std::string& path);
/// One link carries the frame and the path.
Diagnostic rigid_path(const Span& span, const std::string& move, const std::string& path);

struct Fillet {
  std::string path;
  double radius = 0.0;  ///< [m]
  double speed = 0.0;   ///< [m/s] along it
  std::string norm;     ///< "always.calm.plane"
  double most = 0.0;    ///< [m/s^2] or [N]
};
Diagnostic fillet_beyond_norm(const Span& span, const Fillet& fillet, const Span& norm, const Span& declared);
/// What a norm of the force makes of a fillet, and what would fit.
struct FilletPush {
  double mass = 0.0;                            ///< [kg] the most that the base weighs across its way
  double off = 0.0;                             ///< [m] off the path while casters swivel; 0: for good
  double slow = 0.0, wide = 0.0, strong = 0.0;  ///< [m/s], [m], [N]
};
Diagnostic fillet_beyond_push(const Span& span, const Fillet& fillet, const FilletPush& push,
                              const Span& norm, const Span& declared);

/// `length`: from the axle to the frame that is driven, in which the heading decays to a third [m]; 0: not
/// known.
Diagnostic heading_left_over(const Span& span, const std::string& axis, const std::string& move,
                             double length);

}  // namespace zwang::lang::wording
