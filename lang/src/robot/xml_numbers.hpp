/// Numbers in the attributes of a URDF.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace zwang::lang {

/// Exactly `count` finite decimal numbers with white space between them.
std::optional<std::vector<double>> read_numbers(const std::string& text, std::size_t count);

}  // namespace zwang::lang
