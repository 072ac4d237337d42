#pragma once

#include <limits>

namespace zwang::runtime {

inline constexpr double blank =
    std::numeric_limits<double>::quiet_NaN();  ///< a cell of a log without a number

}  // namespace zwang::runtime
