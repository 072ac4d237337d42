/// The known name that an author most likely meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "zwang/export.hpp"

namespace zwang::lang {

/// The candidate near enough to be worth suggesting; empty when there is none.
ZWANG_EXPORT std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace zwang::lang
