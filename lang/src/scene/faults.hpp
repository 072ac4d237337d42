/// Faults, as scene and scenario files write them.
#pragma once

#include <vector>

#include "tree/node.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// `[{at: 2 s, wheel: left_wheel, torque: lost}, ..]`. `of_run`: they may count from a time of the run.
std::vector<Fault> parse_faults(const Node& node, bool of_run, Diagnostics& diagnostics);

}  // namespace zwang::lang
