/// Measured friction, written into a robot file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

struct MeasuredFriction {
  std::string joint;     ///< that turns
  double coulomb = 0.0;  ///< [N m]
  double viscous = 0.0;  ///< [N m s/rad]
};

/// The text of `robot_file` with these values under `friction`. All other text stays, `presliding` and
/// `compensate` too. nullopt where the file is no YAML map.
ZWANG_EXPORT std::optional<std::string> with_friction(const std::filesystem::path& robot_file,
                                                      const std::vector<MeasuredFriction>& frictions,
                                                      Diagnostics& diagnostics);

}  // namespace zwang::lang
