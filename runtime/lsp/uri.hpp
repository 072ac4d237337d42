/// `file:` addresses and paths (RFC 8089).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace zwang::lsp {

/// nullopt for another scheme, another host, and what is no address.
std::optional<std::filesystem::path> path_of(std::string_view uri);
std::string uri_of(const std::filesystem::path& path);

}  // namespace zwang::lsp
