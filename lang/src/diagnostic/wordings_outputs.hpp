/// What is said about outputs.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

Diagnostic output_without_stop(const Span& span, const std::string& name);
/// Neither `true` nor `false`. `is_stop`: `keep` would do, too.
Diagnostic output_needs_truth(const Span& span, const std::string& what, bool is_stop);
Diagnostic unit_of_a_truth(const Span& span, const std::string& output);
/// An output of which all values are known, as an exit asks for it.
struct KnownOutput {
  std::string name;
  bool is_set = false;  ///< by some task
  std::string example;  ///< a value that may be set: `true`
};
/// It decides the condition: never true, or true at once.
Diagnostic output_decides(const Span& span, const KnownOutput& output, bool is_true, const Span& declared);
/// A dock's `held_while` names something else than a bool output of the task file.
Diagnostic held_by_no_output(const Span& span, const std::string& name, const std::string& meant);

}  // namespace zwang::lang::wording
