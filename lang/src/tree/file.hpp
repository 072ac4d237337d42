/// The one way from a path to a text: every file that the front end reads goes through here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// Largest text of a kind of file, and the code of the message about one that is larger.
struct SizeLimit {
  std::size_t bytes = 256 * 1024;
  const char* code = "E110";
};
inline constexpr SizeLimit yaml_size_limit{};
inline constexpr SizeLimit urdf_size_limit{4 * 1024 * 1024, "E850"};

/// The folder that a command-line file may read from: the nearest parent with a `.zwang-root` file, else its
/// own folder.
std::filesystem::path root_of(const std::filesystem::path& file);

/// Reads a regular file once and registers it as a source; the index of that source. `cause` is where the
/// path was written; no span when it came from the command line.
std::optional<int> read_file(const std::filesystem::path& path, const SizeLimit& limit, const Span& cause,
                             Diagnostics& diagnostics);

/// The file that `written` names, seen from the folder of `base`: it must lie below `root`, links followed.
std::optional<std::filesystem::path> resolve_path(const std::string& written,
                                                  const std::filesystem::path& base,
                                                  const std::filesystem::path& root, const Span& cause,
                                                  Diagnostics& diagnostics);

}  // namespace zwang::lang
