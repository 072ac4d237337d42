/// Bodies that a URDF lets move, and that cannot be as it has them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"

namespace zwang::lang {

/// Links behind moving joints that have no mass, or no inertia about some axis through their centre of mass.
std::vector<std::string> without_inertia(const Urdf& urdf);

/// A link, with all that is fixed to it, that no model can move.
struct ImpossibleBody {
  std::string link;    ///< the base, or the one below a joint that moves
  std::string reason;  ///< "the mass of `L` is not positive", of the first part
  /// Links to give another inertia: those whose own is that of no body, in the URDF's order; else `link`.
  std::vector<std::string> parts;
};
/// Of the base and of what moves below it, in the URDF's order.
std::vector<ImpossibleBody> impossible_bodies(const Urdf& urdf, const std::string& base);

/// The drawn body of the base, where the URDF gives it no mass and nothing fixed to it has that mass instead.
struct BareBody {
  std::string link;
  double beside = 0.0;  ///< [kg] of all that is fixed to it
};
/// `wheels`: links of the wheels.
std::optional<BareBody> find_bare_body(const Urdf& urdf, const std::string& base,
                                       const std::vector<std::string>& wheels);

/// E808, of every part at once.
void check_bodies(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics);

}  // namespace zwang::lang
