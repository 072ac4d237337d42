/// Keys of other programs for which zwang has no key, but another way to say it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

/// How it is said here. `what` names the mapping in which the key stands, as messages do: "axis `contact.x`".
/// Empty: nothing is known of it.
std::string way_out(std::string_view what, std::string_view key);

/// An axis and its quantity in one word, as in a twist or a wrench: `vx`, `wz`, `fy`.
struct AxisInOneWord {
  std::string axis;
  solver::Quantity quantity;
};
std::optional<AxisInOneWord> axis_in_one_word(std::string_view key);

}  // namespace zwang::lang
