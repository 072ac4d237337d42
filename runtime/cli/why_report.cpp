#include "why_report.hpp"

#include "output.hpp"
#include "table.hpp"

namespace zwang::cli {

namespace {

using runtime::WaitedExit;
using runtime::WaitedSignal;
using runtime::WaitedTerm;

std::string reading(const WaitedTerm& term) {
  std::string text;
  if (term.value) text = with_unit(*term.value, term.unit);
  if (term.stood > 0.0) text += " for at least " + with_unit(term.stood, "s", 2);
  for (const WaitedSignal& signal : term.signals) text += (text.empty() ? "" : ", ") + in_words(signal);
  return text + term.because;
}

}  // namespace

std::string why_table(const runtime::Why& why, const lang::Diagnostics& diagnostics) {
  if (why.waited.exits.empty()) return "";
  Table table({false, false, false, false});
  for (const WaitedExit& exit : why.waited.exits) {
    table.add({exit.column, to_string(exit.verdict), "-> " + exit.target,
               "true " + (exit.times > 1 ? std::to_string(exit.times) + " times, " : std::string()) + "for " +
                   with_unit(exit.longest, "s") + " at most, needed " + with_unit(exit.needed, "s") + "  (" +
                   place(diagnostics, exit.span) + ")"});
    for (const WaitedTerm& term : exit.terms)
      table.add({"  " + term.text, to_string(term.verdict), "", reading(term)});
  }
  return "waited for, in `" + why.waited.task + "`\n" + table.text() + "\n";
}

}  // namespace zwang::cli
