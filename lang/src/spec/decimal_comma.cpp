#include "spec/decimal_comma.hpp"

#include <algorithm>

#include "diagnostic/wordings_slips.hpp"
#include "spec/units.hpp"
#include "tree/text.hpp"

namespace zwang::lang {

namespace {

/// Only a comma stands between them: `0,2 m`, and not `0, 2 m`.
bool touch(const Node& before, const Node& behind) {
  return before.span.end.line == behind.span.begin.line &&
         before.span.end.column + 1 == behind.span.begin.column;
}

bool has_unit(const Node& node) {
  const QuantityResult result = parse_quantity(trimmed(node.text));
  return result.error == QuantityError::none && result.quantity.has_unit;
}

}  // namespace

bool complain_of_decimal_comma(const Node& list, std::size_t fewest, std::size_t most,
                               Diagnostics& diagnostics) {
  const bool is_counted_right = list.items.size() >= fewest && list.items.size() <= most;
  const auto behind_is_apart = [](const Node& a, const Node& b) { return !touch(a, b); };
  const bool has_blanks =
      std::adjacent_find(list.items.begin(), list.items.end(), behind_is_apart) != list.items.end();
  for (std::size_t i = 0; i + 1 < list.items.size(); ++i) {
    const Node &before = list.items[i], &behind = list.items[i + 1];
    if (before.is_bad || behind.is_bad || !before.is_scalar() || !behind.is_scalar()) continue;
    const std::string meant = joined_at_decimal_comma(before.text, behind.text);
    if (meant.empty() || !touch(before, behind)) continue;
    if (!has_unit(behind) && (is_counted_right || !has_blanks)) continue;
    diagnostics.add(wording::decimal_comma({list.span.source, before.span.begin, behind.span.end}, meant));
    return true;
  }
  return false;
}

}  // namespace zwang::lang
