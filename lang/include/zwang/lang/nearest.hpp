/// The known name that an author most likely meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace zwang::lang {

/// The candidate near enough to be worth suggesting; empty when there is none.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace zwang::lang
