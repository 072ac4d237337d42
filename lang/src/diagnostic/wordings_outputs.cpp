#include "diagnostic/wordings_outputs.hpp"

#include "diagnostic/make.hpp"
#include "words/text.hpp"

namespace zwang::lang::wording {

Diagnostic output_without_stop(const Span& span, const std::string& name) {
  return error("E418", span, "say what `" + name + "` does when the robot stops",
               "add `stop: keep`, or the value that is safe");
}

Diagnostic output_needs_truth(const Span& span, const std::string& what, bool is_stop) {
  return error("E105", span, what + " is true or false",
               is_stop ? "write `true`, `false` or `keep`" : "write `true` or `false`");
}

Diagnostic unit_of_a_truth(const Span& span, const std::string& output) {
  return error("E104", span, "output `" + output + "` has a unit, but is no number");
}

Diagnostic held_by_no_output(const Span& span, const std::string& name, const std::string& meant) {
  return with_suggestion(
      error("E301", span, "the task file has no output " + in_ticks(name) + " of the type `bool`",
            "declare it: `outputs: {" + name + ": {type: bool, stop: keep}}`"),
      meant);
}

Diagnostic output_decides(const Span& span, const KnownOutput& output, bool is_true, const Span& declared) {
  const std::string when = is_true ? "this is true at once: " : "this is never true: ";
  return with_related(
      warning("W511", span,
              when + (output.is_set ? "tasks set " + in_ticks(output.name) + " to nothing else"
                                    : "no task sets " + in_ticks(output.name)),
              "set it where this is waited for: `enter: {set: {outputs." + output.name + ": " +
                  output.example + "}}`, or take the exit out"),
      declared, "it is declared here");
}

}  // namespace zwang::lang::wording
