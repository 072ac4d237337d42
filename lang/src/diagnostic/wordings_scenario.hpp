/// Diagnostics of the cells of a scenario.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `task` is the file's name, `known` are its parameters.
Diagnostic unknown_task_parameter(const Span& span, const std::string& name, const std::string& meant,
                                  const std::vector<std::string>& known, const std::string& task);
/// The task of this cell is refused for the reason `code`, and nothing expects it. `spans`: what makes it so,
/// in this cell and in others that are refused for the same reason.
Diagnostic refused_cell(const std::vector<Span>& spans, const std::string& cell, const std::string& code,
                        const std::string& reason, const std::string& place);
/// Checking the cells from this one on would take too long.
Diagnostic unasked_cells(const Span& span, const std::string& cell);

}  // namespace zwang::lang::wording
