#include "check/context.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_forces.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

namespace {

SignalType type_named(const std::string& word) {
  if (word == "number") return SignalType::number;
  if (word == "pose") return SignalType::pose;
  if (word == "wrench") return SignalType::wrench;
  return SignalType::boolean;
}

/// Whether two frames are carried alike: then nothing between them ever moves.
bool is_rigid(const CheckContext& context, const std::optional<int>& a, const std::optional<int>& b) {
  if (!a || !b) return false;
  const FrameSymbol& first = context.symbols.frames[static_cast<std::size_t>(*a)];
  const FrameSymbol& second = context.symbols.frames[static_cast<std::size_t>(*b)];
  return first.body >= 0 && first.body == second.body;
}

/// A latch tells that something holds the base by a frame of its own.
void check_latch(CheckContext& context, const SignalText& text, SignalSymbol& symbol) {
  if (!text.type.exists()) return;
  if (symbol.signal.type != SignalType::boolean) {
    context.diagnostics.add(wording::latch_is_not_bool(text.holds.span, text.name.text, text.type.text));
    return;
  }
  const std::optional<int> frame = check_frame(context, text.holds);
  if (!frame) return;
  symbol.signal.holds = *frame;
  if (context.symbols.frames[static_cast<std::size_t>(*frame)].body != 0)
    context.diagnostics.add(wording::latch_off_the_base(text.holds.span, text.holds.text, base_of(context)));
}

void check_signal(CheckContext& context, const SignalText& text, SignalSymbol& symbol) {
  if (text.in.exists()) {
    const std::optional<int> in = check_frame(context, text.in);
    symbol.is_bad = symbol.is_bad || !in;
    symbol.signal.in = in.value_or(0);
  }
  if (text.holds.exists()) check_latch(context, text, symbol);
  symbol.signal.twist = text.twist;
  symbol.signal.twist_window = text.twist_window;
  if (text.twist_span.exists() && text.type.exists() && symbol.signal.type != SignalType::pose)
    context.diagnostics.add(wording::twist_without_pose(text.twist_span, text.name.text));
  if (text.stale_after) {
    check_time(context, *text.stale_after, "signal `" + text.name.text + "`'s `stale_after`", false);
  }
}

void check_region(CheckContext& context, const RegionText& text) {
  RegionSymbol symbol;
  symbol.region.name = text.name.text;
  symbol.region.polygon = text.polygon;
  symbol.region.centre = text.centre;
  symbol.region.radius = text.radius;
  symbol.region.span = text.name.span;
  if (text.parent.exists()) {
    const std::optional<int> parent = check_frame(context, text.parent);
    symbol.is_bad = !parent;
    symbol.region.parent = parent.value_or(0);
  }
  context.symbols.regions.push_back(std::move(symbol));
}

void check_feature(CheckContext& context, const FeatureText& text) {
  FeatureSymbol symbol;
  symbol.feature.name = text.name.text;
  symbol.feature.kind = text.kind;
  symbol.feature.span = text.name.span;
  symbol.feature.direction = text.direction;
  symbol.feature.first_axis = text.first_axis.value_or(solver::Axis::x);
  symbol.feature.second_axis = text.second_axis.value_or(solver::Axis::x);
  const auto& d = text.direction;
  const bool shifts = d[0] != 0.0 || d[1] != 0.0 || d[2] != 0.0;
  const bool rotates = d[3] != 0.0 || d[4] != 0.0 || d[5] != 0.0;
  symbol.feature.turns =
      text.kind == FeatureKind::angle || text.kind == FeatureKind::bearing || (rotates && !shifts);
  const std::optional<int> first = check_frame(context, text.first);
  const std::optional<int> second = check_frame(context, text.second);
  symbol.is_bad = text.is_bad || !first || !second;
  symbol.feature.first = first.value_or(0);
  symbol.feature.second = second.value_or(0);
  if (!symbol.is_bad && text.kind != FeatureKind::direction && is_rigid(context, first, second)) {
    context.diagnostics.add(wording::rigid_feature(text.name.span, text.name.text));
  }
  context.symbols.features.push_back(std::move(symbol));
}

/// `group.x.position`-like names win over nothing: a signal and a feature of one name cannot be told apart.
void check_distinct(CheckContext& context, const Word& name) {
  if (context.symbols.find_signal(name.text)) {
    context.diagnostics.add(wording::name_taken(name.span, name.text, "a signal"));
  }
}

}  // namespace

void check_is_no_word(CheckContext& context, const Word& name) {
  const std::string& text = name.text;
  if (text == "elapsed")
    context.diagnostics.add(wording::name_taken(name.span, text, "the time since the task was entered"));
  if (text == "and" || text == "or" || text == "not" || text == "here")
    context.diagnostics.add(wording::word_for_a_name(name.span, text));
}

void declare_signals(CheckContext& context) {
  for (const SignalText& text : context.file.signals) {
    SignalSymbol symbol;
    symbol.signal.name = text.name.text;
    symbol.signal.type = type_named(text.type.text);
    symbol.signal.span = text.name.span;
    symbol.is_bad = text.is_bad;
    if (text.unit) {
      symbol.dimension = text.unit->dimension;
      symbol.signal.unit_scale = text.unit->scale;
      symbol.signal.measures_force = text.unit->dimension == dimension::force;
    }
    if (text.unit && symbol.signal.type != SignalType::number && !text.is_bad) {
      context.diagnostics.add(wording::unit_without_number(text.name.span, text.name.text));
    }
    context.symbols.signals.push_back(std::move(symbol));
  }
}

void check_world(CheckContext& context) {
  for (std::size_t i = 0; i < context.file.signals.size(); ++i) {
    check_signal(context, context.file.signals[i], context.symbols.signals[i]);
  }
  for (const SignalText& text : context.file.signals) check_is_no_word(context, text.name);
  for (const FeatureText& text : context.file.features) check_is_no_word(context, text.name);
  for (const RegionText& text : context.file.regions) check_region(context, text);
  for (const FeatureText& text : context.file.features) {
    check_distinct(context, text.name);
    check_feature(context, text);
  }
}

}  // namespace zwang::lang
