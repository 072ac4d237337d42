/// A table counts the outcomes of many runs.
#pragma once

#include <iosfwd>
#include <vector>

#include "trial.hpp"

namespace zwang::sweep {

/// In the order of their numbers, by as many threads as given.
std::vector<Result> run_all(std::uint64_t seed, int first, int count, Which which, int threads);

/// A row for healthy runs with encoders up to 5e-5 rad, one for coarser ones, one for faults: how many runs,
/// of them stopped, out of bounds, untrue; delays, worst speed and force as shares of their bounds. Then, run
/// by run, what is wrong.
void print(std::uint64_t seed, int first, Which which, const std::vector<Result>& results, std::ostream& out);

}  // namespace zwang::sweep
