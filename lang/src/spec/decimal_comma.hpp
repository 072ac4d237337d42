/// Numbers with a decimal comma, which a list in brackets takes for two items.
#pragma once

#include <cstddef>

#include "tree/node.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// Whether a list of quantities, `fewest` to `most` of them, was written with decimal commas; E104. A number
/// without a unit and right behind its comma, without a blank, one that has it: `[0,2 m]`. Where there are
/// too many and blanks behind other commas, none needs a unit: `[0,2, 0,5]`. Where there are too many, and
/// the right number when such numbers are joined, there may be a blank: `[0, 2 m, 0, 5 m]`.
bool complain_of_decimal_comma(const Node& list, std::size_t fewest, std::size_t most,
                               Diagnostics& diagnostics);

}  // namespace zwang::lang
