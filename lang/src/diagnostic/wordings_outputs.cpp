#include "diagnostic/wordings_outputs.hpp"

#include "diagnostic/make.hpp"
#include "tree/text.hpp"

namespace zwang::lang::wording {

Diagnostic output_without_stop(const Span& span, const std::string& name) {
  return error("E418", span, "say what `" + name + "` does when the robot stops",
               "add `stop: keep`, or the value that is safe");
}

Diagnostic output_needs_truth(const Span& span, const std::string& what) {
  return error("E105", span, what + " is true or false", "write `true` or `false`");
}

Diagnostic held_by_no_output(const Span& span, const std::string& name, const std::string& meant) {
  return with_suggestion(
      error("E301", span, "the task file has no output " + in_ticks(name) + " of the type `bool`",
            "declare it: `outputs: {" + name + ": {type: bool, stop: keep}}`"),
      meant);
}

}  // namespace zwang::lang::wording
