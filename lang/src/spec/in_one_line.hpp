/// A part of a file as it may be written in its place, in one line.
#pragma once

#include <string>

#include "tree/node.hpp"
#include "words/dimension.hpp"

namespace zwang::lang {

/// How many numbers in it stand without a unit.
int count_bare_numbers(const Node& node);

/// Its text with brackets and braces; numbers without a unit get the one that quantities of `expected`
/// usually have. `dimension::none`: as they are.
std::string in_one_line(const Node& node, const Dimension& expected);

}  // namespace zwang::lang
