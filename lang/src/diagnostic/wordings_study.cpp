#include "diagnostic/wordings_study.hpp"

#include "diagnostic/make.hpp"
#include "diagnostic/wordings_scenario.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::lang::wording {

Diagnostic unknown_draw(const Span& span, const std::string& name, const std::optional<std::string>& missing,
                        const std::string& meant, const std::vector<std::string>& known) {
  std::string help;
  for (const std::string& one : known) help += (help.empty() ? "can be drawn here: " : ", ") + one;
  if (missing) return error("E931", span, *missing, help);
  Diagnostic diagnostic = error("E931", span, "nothing named `" + name + "` can be drawn", help);
  return with_suggestion(std::move(diagnostic), meant);
}

Diagnostic refused_draw(const std::vector<Span>& spans, const std::string& cell, const std::string& code,
                        const std::string& reason, const std::string& place) {
  Diagnostic diagnostic = refused_cell(spans, cell, code, reason, place);
  diagnostic.help = "draw from a range that leaves this out, or write `- diagnostic: " + code + "`";
  return diagnostic;
}

Diagnostic bad_draw(const Span& span, const std::string& why, const std::string& help) {
  return error("E931", span, why, help);
}

Diagnostic one_distribution(const Span& span, const std::string& name) {
  return error("E932", span, "`" + name + "` has one distribution",
               "write one of `uniform: [low, high]`, `log_uniform: [low, high]`, `normal: [mean, deviation]` "
               "and `choice: [one, another]`");
}

Diagnostic bad_distribution(const Span& span, const std::string& why, const std::string& help) {
  return error("E932", span, why, help);
}

Diagnostic no_certainty(const Span& span, const std::string& what, const std::string& text) {
  const bool is_without_sign = !text.empty() && text.find_first_not_of("0123456789.") == std::string::npos;
  return error("E933", span, what + " is between 0 and 100 %, and `" + text + "` is not",
               is_without_sign ? "write `" + text + " %`" : "write a share that runs can show, as `99.9 %`");
}

Diagnostic too_few_runs(const Span& span, const std::string& probability, const std::string& confidence,
                        std::size_t runs, std::size_t needed) {
  const std::string count = std::to_string(runs);
  return warning("W934", span,
                 count + " runs cannot show " + probability + " at a confidence of " + confidence +
                     ": that takes " + std::to_string(needed) + " without a miss",
                 needed > most_cells_of_a_study
                     ? "ask for less: a study has " + std::to_string(most_cells_of_a_study) + " runs at most"
                     : "write `runs: " + std::to_string(needed) + "` or more, or ask for less");
}

}  // namespace zwang::lang::wording
