/// The room that a number takes as text.
#pragma once

#include <cstddef>

namespace zwang::runtime {

inline constexpr std::size_t longest_number = 32;  ///< [bytes] std::to_chars of a double writes 24 at most

}  // namespace zwang::runtime
