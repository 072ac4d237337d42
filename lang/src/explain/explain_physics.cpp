#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

/// What needs the robot's model to be found.
std::span<const Explanation> physics() {
  return {};
}

}  // namespace zwang::lang::catalogue
