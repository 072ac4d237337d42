/// A file of any kind, read and checked.
#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "zwang/export.hpp"
#include "zwang/lang/connection.hpp"
#include "zwang/lang/file_kind.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::lang {

/// The content of a file. std::monostate: the file has errors, and the diagnostics name them.
using FileContent = std::variant<std::monostate, Program, Robot, Scene, Scenario, Connection, Study>;

struct CheckOptions {
  LoadOptions load;         ///< of a task file; a scene is checked against `robot` where that is given
  bool with_notes = false;  ///< of a task file: `load_with_notes` in the place of `load`
  /// A connection file is checked against this task, loaded with `load`.
  std::optional<std::filesystem::path> task{};
};

/// Reads and checks the file with the reader of its kind. A file that cannot be read has an error, too.
ZWANG_EXPORT FileContent check_file(FileKind kind, const std::filesystem::path& path,
                                    const CheckOptions& options, Diagnostics& diagnostics);

}  // namespace zwang::lang
