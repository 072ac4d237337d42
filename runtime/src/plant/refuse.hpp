#pragma once

#include <stdexcept>
#include <string>

namespace zwang::runtime {

/// The plant cannot be made: `what` says why, as a clause.
[[noreturn]] inline void refuse(const std::string& what) {
  throw std::invalid_argument("plant: " + what);
}

}  // namespace zwang::runtime
