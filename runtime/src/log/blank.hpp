#pragma once

#include <limits>

namespace zwang::runtime::log_column {

/// A column's value in a record that says nothing of it.
inline constexpr double blank = std::numeric_limits<double>::quiet_NaN();

}  // namespace zwang::runtime::log_column
