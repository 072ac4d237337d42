/// A robot file that is there, with what is new in its URDF.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

struct UpdateNote {
  int line = 0;  ///< of the updated text, from 1
  std::string text;
};

struct RobotUpdate {
  std::string text;
  std::vector<UpdateNote> added;     ///< entries that are new in the URDF, and places that it fills now
  std::vector<UpdateNote> vanished;  ///< entries whose joint or link the URDF does not have
  std::vector<UpdateNote> differ;    ///< values that were kept though the URDF says another
};

/// The options of the draft from which an existing robot file was made. nullopt where the file is no YAML.
ZWANG_EXPORT std::optional<DraftOptions> options_of(const std::filesystem::path& robot_file,
                                                    Diagnostics& diagnostics);

/// Every line of `robot_file` stays as it is. Names that it holds nowhere, not even in a comment, are added.
/// nullopt where the file is no YAML, or the URDF is refused.
ZWANG_EXPORT std::optional<RobotUpdate> update_robot_file(const std::filesystem::path& robot_file,
                                                          const std::filesystem::path& urdf,
                                                          const RobotDraft& draft, Diagnostics& diagnostics);

}  // namespace zwang::lang
