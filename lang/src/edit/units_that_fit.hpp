/// Units for the value at a place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace zwang::lang {

/// Units of what the key measures, the usual one first; all units where that is not known.
std::vector<std::string> units_that_fit(const std::vector<std::string>& keys);
/// Behind the number at the end of a condition: those of what it is compared with.
std::vector<std::string> units_in_condition(std::string_view condition);

}  // namespace zwang::lang
