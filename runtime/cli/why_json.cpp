#include "json_parts.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;
using runtime::WaitedExit;
using runtime::WaitedSignal;
using runtime::WaitedTerm;

ordered_json json_of(const WaitedTerm& term) {
  ordered_json json = {{"text", term.text},
                       {"is", to_string(term.verdict)},
                       {"holds_back", term.holds_back},
                       {"value", term.value ? ordered_json(*term.value) : ordered_json(nullptr)},
                       {"unit", term.unit}};
  if (term.bound) json["bound"] = *term.bound;
  if (term.stood > 0.0) json["stood"] = term.stood;
  if (term.left) json["left"] = *term.left;
  if (!term.because.empty()) json["because"] = term.because;
  for (const WaitedSignal& s : term.signals) {
    json["signals"].push_back({{"name", s.name},
                               {"received", s.received},
                               {"refused", s.refused},
                               {"age", s.age},
                               {"stale_after", s.stale_after},
                               {"words", in_words(s)}});
  }
  return json;
}

ordered_json json_of(const WaitedExit& exit) {
  ordered_json terms = ordered_json::array();
  for (const WaitedTerm& term : exit.terms) terms.push_back(json_of(term));
  return {{"column", exit.column},
          {"when", exit.when},
          {"line", exit.span.exists() ? ordered_json(exit.span.begin.line) : ordered_json(nullptr)},
          {"to", exit.target},
          {"is", to_string(exit.verdict)},
          {"true_for", exit.true_for},
          {"longest", exit.longest},
          {"times", exit.times},
          {"for", exit.needed},
          {"terms", terms}};
}

}  // namespace

ordered_json json_of(const runtime::Why& why) {
  ordered_json exits = ordered_json::array();
  for (const WaitedExit& exit : why.waited.exits) exits.push_back(json_of(exit));
  ordered_json json = {{"sentence", why.sentence}, {"cause", to_string(why.cause)}, {"time", why.time},
                       {"task", why.waited.task},  {"elapsed", why.waited.elapsed}, {"exits", exits}};
  if (why.met) json["met"] = json_of(*why.met);
  if (!why.limit.empty()) json["limit"] = why.limit;
  return json;
}

}  // namespace zwang::cli
