/// The parts of a connection file.
#pragma once

#include <filesystem>
#include <optional>

#include "tree/read.hpp"
#include "zwang/lang/connection.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// `folder`: from where it names task files.
std::optional<Connection> parse_connection(const Document& document, const std::filesystem::path& folder,
                                           Diagnostics& diagnostics);

}  // namespace zwang::lang
