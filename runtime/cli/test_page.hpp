/// The page of `zwang test --report`: every run of every scenario, the worst first.
#pragma once

#include <string>
#include <vector>

#include "test_report.hpp"

namespace zwang::cli {

/// The path of the page. Throws Impossible where it cannot be written.
std::string write_test_page(const std::vector<ScenarioReport>& reports, double seconds,
                            const std::string& path);

}  // namespace zwang::cli
