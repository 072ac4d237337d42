/// The events of a run, at the times at which they happened.
#pragma once

#include <vector>

#include "zwang/runtime/series.hpp"

namespace zwang::cli {

/// The events as the run's report told them. While samples stay away, records repeat the time of the last
/// one. Two events of one tick have one record. A run that was cut off has no report: then those
/// `of_records`.
std::vector<runtime::LoggedEvent> told_events(const runtime::LogContents& log,
                                              const std::vector<runtime::LoggedEvent>& of_records);

}  // namespace zwang::cli
