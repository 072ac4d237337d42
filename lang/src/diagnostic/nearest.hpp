/// The known name that an author most likely meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace zwang::lang {

/// Number of single-letter changes, swaps of neighbours counted as one, between two words.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate near enough to be worth suggesting; empty when there is none.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The key that an author most likely meant: one that other programs call so, the nearest, or one that begins
/// so. Empty when there is none.
std::string meant_key(std::string_view word, const std::vector<std::string>& keys);

}  // namespace zwang::lang
