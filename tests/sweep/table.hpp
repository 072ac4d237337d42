/// A table counts the outcomes of many runs.
#pragma once

#include <iosfwd>
#include <vector>

#include "trial.hpp"

namespace zwang::sweep {

/// In the order of their numbers, by as many threads as given.
std::vector<Result> run_all(std::uint64_t seed, int first, int count, Which which, int threads);

/// Prints a row for healthy runs with encoders up to 5e-5 rad, one for coarser encoders and one for faults. A
/// row has the number of runs, and of those that were stopped, out of bounds, or untrue. It has the delays,
/// and the worst speed and force as shares of their bounds. The errors of each run follow.
void print(std::uint64_t seed, int first, Which which, const std::vector<Result>& results, std::ostream& out);

}  // namespace zwang::sweep
