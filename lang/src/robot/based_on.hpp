/// The key `based_on` of a robot file: another one that says the rest.
#pragma once

#include <filesystem>
#include <optional>

#include "tree/read.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

inline constexpr int longest_chain = 8;  ///< files, each of which is based on the next

/// Adds to the robot file `document`, of `path`, the keys at the top of those that it is based on. A key that
/// a nearer file says goes first, with all of its value; places stay those of the file that says them. The
/// file that says `urdf`, or `path`: that path is seen from there. nullopt where a file cannot be read, or
/// leads back (E816).
std::optional<std::filesystem::path> add_based_on(Document& document, const std::filesystem::path& path,
                                                  const std::filesystem::path& root,
                                                  Diagnostics& diagnostics);

}  // namespace zwang::lang
