/// The explanations by hundreds, one file each. A new code is one more entry in its hundred's list.
#pragma once

#include <span>

#include "zwang/lang/explanation.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> text();         ///< E1xx
std::span<const Explanation> quantities();   ///< E2xx
std::span<const Explanation> names();        ///< E3xx
std::span<const Explanation> constraints();  ///< E4xx
std::span<const Explanation> order();        ///< E5xx
std::span<const Explanation> physics();      ///< E6xx
std::span<const Explanation> reach();        ///< W416, W51x, W61x and more: what reads well and cannot work
std::span<const Explanation> robots();       ///< E80x
std::span<const Explanation> urdfs();        ///< E85x
std::span<const Explanation> scenes();       ///< E9xx
std::span<const Explanation> connections();  ///< E92x
std::span<const Explanation> studies();      ///< E93x

}  // namespace zwang::lang::catalogue
