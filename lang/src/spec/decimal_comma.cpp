#include "spec/decimal_comma.hpp"

#include <algorithm>

#include "diagnostic/wordings_slips.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

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

/// How many values there are when each number without a unit goes with the one behind it that has a unit.
std::size_t count_joined(const Node& list) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < list.items.size(); ++i, ++count) {
    const bool is_last = i + 1 == list.items.size();
    if (!is_last && !joined_at_decimal_comma(list.items[i].text, list.items[i + 1].text).empty() &&
        has_unit(list.items[i + 1]))
      ++i;
  }
  return count;
}

}  // namespace

bool complain_of_decimal_comma(const Node& list, std::size_t fewest, std::size_t most,
                               Diagnostics& diagnostics) {
  const bool is_counted_right = list.items.size() >= fewest && list.items.size() <= most;
  const auto behind_is_apart = [](const Node& a, const Node& b) { return !touch(a, b); };
  const bool has_blanks =
      std::adjacent_find(list.items.begin(), list.items.end(), behind_is_apart) != list.items.end();
  const std::size_t whole = count_joined(list);
  const bool is_cut = !is_counted_right && whole >= fewest && whole <= most;
  for (std::size_t i = 0; i + 1 < list.items.size(); ++i) {
    const Node &before = list.items[i], &behind = list.items[i + 1];
    if (before.is_bad || behind.is_bad || !before.is_scalar() || !behind.is_scalar()) continue;
    const std::string meant = joined_at_decimal_comma(before.text, behind.text);
    if (meant.empty() || !(touch(before, behind) || is_cut)) continue;
    if (!has_unit(behind) && (is_counted_right || !has_blanks)) continue;
    diagnostics.add(wording::decimal_comma({list.span.source, before.span.begin, behind.span.end}, meant));
    return true;
  }
  return false;
}

}  // namespace zwang::lang
