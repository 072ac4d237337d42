/// `inertias` of a first robot file: links whose inertia the URDF does not give, or gives as no body has it.
#pragma once

#include <optional>

#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"

namespace zwang::lang {

struct DraftBody {
  std::string link;
  bool lacks_mass = false;
  double radius = 0.0;  ///< [m] of a solid ball; 0: of a wheel, which counts as a disc of its own radius
  std::optional<double> beside;       ///< [kg] of the base's body: all that is fixed to it
  std::optional<solver::Vector3> at;  ///< [m] proposed for the centre of its mass, in the link's axes
};

/// `open`: links behind moving joints without an inertia. `held`: joints that do not move. `outline`: of the
/// base, from above [m].
std::vector<DraftBody> find_draft_bodies(const Urdf& urdf, const FoundWheels& found,
                                         const std::vector<std::string>& open,
                                         const std::vector<std::string>& held,
                                         const std::vector<Eigen::Vector2d>& outline);

/// Whether all wheels with a motor lack a mass. It stands once in `each_wheel` then, and not at their links.
bool share_mass(std::vector<DraftBody>& bodies, const std::vector<DraftWheel>& wheels);

/// Whether the mass of the base's body is one of those that are missing.
bool lacks_body(const std::vector<DraftBody>& bodies);

/// Lines of `missing`.
std::vector<std::string> missing_of_bodies(const std::vector<DraftBody>& bodies);

/// The section. Masses that the URDF does not give stand as `base_mass` of the base, else as `mass`.
std::string inertias_entry(const std::vector<DraftBody>& bodies, const std::string& base_mass,
                           const std::string& mass);

}  // namespace zwang::lang
