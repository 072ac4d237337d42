// Outputs: their values at the start and at a stop.
#include "check/context.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_outputs.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

namespace {

/// `start` or `stop`, SI; nullopt for a bad one.
std::optional<double> plain_value(CheckContext& context, const ValueText& value, const OutputSymbol& symbol,
                                  const std::string& what, bool is_stop) {
  if (!symbol.output.is_number) {
    if (const auto truth = truth_of(value)) return *truth ? 1.0 : 0.0;
    context.diagnostics.add(wording::output_needs_truth(value.span, what, is_stop));
    return std::nullopt;
  }
  if (!require_quantity(value, symbol.dimension, what, context.diagnostics)) return std::nullopt;
  return value.quantity.value;
}

OutputSymbol check_output(CheckContext& context, const OutputText& text) {
  OutputSymbol symbol;
  symbol.output.name = text.name.text;
  symbol.output.span = text.name.span;
  symbol.output.is_number = text.is_number;
  symbol.is_bad = text.is_bad;
  if (text.unit) {
    symbol.dimension = text.unit->dimension;
    symbol.output.unit_scale = text.unit->scale;
    symbol.output.unit = usual_unit(text.unit->dimension);
  }
  if (text.is_bad) return symbol;
  const std::string what = "output `" + text.name.text + "`";
  if (text.unit && !text.is_number) {
    context.diagnostics.add(wording::unit_of_a_truth(text.name.span, text.name.text));
    symbol.is_bad = true;
  }
  if (text.start) {
    symbol.output.start = plain_value(context, *text.start, symbol, what + "'s `start`", false).value_or(0.0);
  }
  if (text.stop) symbol.output.stop = plain_value(context, *text.stop, symbol, what + "'s `stop`", true);
  return symbol;
}

void check_dock(CheckContext& context, const std::optional<Dock>& dock) {
  if (!dock || dock->held_while.empty()) return;
  std::vector<std::string> truths;
  for (OutputSymbol& symbol : context.symbols.outputs) {
    const bool is_it = symbol.output.name == dock->held_while;
    if (is_it) symbol.is_used = true;
    if (is_it && (symbol.is_bad || !symbol.output.is_number)) return;
    if (!symbol.output.is_number) truths.push_back(symbol.output.name);
  }
  context.diagnostics.add(
      wording::held_by_no_output(dock->held_while_span, dock->held_while, nearest(dock->held_while, truths)));
}

}  // namespace

void check_held_docks(CheckContext& context, const Scene& scene) {
  for (const SceneObject& object : scene.objects) check_dock(context, object.dock);
  for (const SceneRobot& robot : scene.robots) check_dock(context, robot.dock);
}

void check_outputs(CheckContext& context) {
  for (const OutputText& text : context.file.outputs) {
    if (!text.name.exists()) continue;
    const Symbols& symbols = context.symbols;
    const bool is_taken = symbols.find_signal(text.name.text) || symbols.find_feature(text.name.text);
    if (is_taken)
      context.diagnostics.add(wording::name_taken(
          text.name.span, text.name.text, symbols.find_signal(text.name.text) ? "a signal" : "a feature"));
    check_is_no_word(context, text.name);
    context.symbols.outputs.push_back(check_output(context, text));
  }
}

}  // namespace zwang::lang
