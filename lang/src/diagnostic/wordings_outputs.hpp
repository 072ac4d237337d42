/// What is said about outputs.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

Diagnostic output_without_stop(const Span& span, const std::string& name);
/// Neither `true` nor `false`. `example`: the line with a value that would do.
Diagnostic output_needs_truth(const Span& span, const std::string& what);
/// A dock's `held_while` names something else than a bool output of the task file.
Diagnostic held_by_no_output(const Span& span, const std::string& name, const std::string& meant);

}  // namespace zwang::lang::wording
