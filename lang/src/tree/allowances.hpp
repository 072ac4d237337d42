/// Comments that speak to zwang: `# zwang: allow W503 the reason`.
#pragma once

#include <string_view>
#include <vector>

#include "tree/prescan.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// Hands every readable instruction among the comments of `text` to the diagnostics; writes E118, E119.
void read_allowances(const std::vector<Comment>& comments, std::string_view text, Diagnostics& diagnostics);

}  // namespace zwang::lang
