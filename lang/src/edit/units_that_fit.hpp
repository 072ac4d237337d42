/// Units for the value at a place.
#pragma once

#include <string>
#include <vector>

namespace zwang::lang {

/// Units of what the key measures, the usual one first; all units where that is not known.
std::vector<std::string> units_that_fit(const std::vector<std::string>& keys);

}  // namespace zwang::lang
