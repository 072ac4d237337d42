/// How near a name is to known ones, and what keys other programs have for ours.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "zwang/lang/nearest.hpp"

namespace zwang::lang {

/// Number of single-letter changes, swaps of neighbours counted as one, between two words.
int edit_distance(std::string_view a, std::string_view b);

/// The key that an author most likely meant: one that other programs call so, the nearest, or one that begins
/// so. Empty when there is none.
std::string meant_key(std::string_view word, const std::vector<std::string>& keys);

}  // namespace zwang::lang
