/// The page of `zwang sweep --report`: how sure each expectation is, and what its margin goes with.
#pragma once

#include <string>
#include <vector>

#include "study/study_report.hpp"

namespace zwang::cli {

/// Writes the page. `command`: what runs one of the study's cells again, before its number. The path of the
/// page. Throws Impossible where it cannot be written.
std::string write_sweep_page(const lang::Study& study, const study::StudyReport& report,
                             const std::vector<study::CellRecord>& records, const std::string& command,
                             const std::string& path);

}  // namespace zwang::cli
