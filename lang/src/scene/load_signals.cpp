#include "scene/load_signals.hpp"

#include <algorithm>
#include <tuple>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_guides.hpp"

namespace zwang::lang {

namespace {

/// One step of a script.
struct StepValue {
  ScriptStep step;
  std::optional<Dimension> dimension;  ///< of a number; none: true or false
};

/// nullopt where it cannot be read, and was complained of.
std::optional<StepValue> parse_step_value(const Node& node, const Node& step, double time,
                                          const std::string& what, Diagnostics& diagnostics) {
  if (node.text == "true" || node.text == "false" || node.text == "lost")
    return StepValue{{time, node.text == "true" ? 1.0 : 0.0, node.text != "lost"}, std::nullopt};
  const ValueText number = parse_value(node, what, diagnostics);
  if (number.kind == ValueKind::quantity)
    return StepValue{{time, number.quantity.value, true}, number.quantity.dimension};
  if (number.kind != ValueKind::bad) diagnostics.add(wording::script_step(step.span));
  return std::nullopt;
}

/// The first value of a script gives the type and the dimension of all its values.
void describe_script(const StepValue& first, const Span& span, SceneSignal& signal) {
  signal.source_span = span;
  signal.script_kind = first.dimension ? ScriptKind::number : ScriptKind::truth;
  const Dimension d = first.dimension.value_or(dimension::none);
  signal.powers = {d.length, d.mass, d.time, d.angle};
}

/// `[[0 s, false], [5 s, true]]`: what the signal is from each time on.
void parse_script(const Node& node, SceneSignal& signal, Diagnostics& diagnostics) {
  const std::string what = "signal `" + signal.name + "`'s script";
  if (!require_sequence(node, what, diagnostics)) return;
  if (node.items.empty()) diagnostics.add(wording::empty_script(node.span, what));
  const auto is_scalar = [](const Node& step) { return step.is_scalar(); };
  if (!node.items.empty() && std::all_of(node.items.begin(), node.items.end(), is_scalar)) {
    diagnostics.add(wording::script_step(node.span));
    return;
  }
  double last = -1.0;
  std::optional<StepValue> first;  // that says what the signal measures
  const Node* first_value = nullptr;
  for (const Node& step : node.items) {
    if (!step.is_sequence() || step.items.size() != 2) {
      diagnostics.add(wording::script_step(step.span));
      continue;
    }
    const auto time =
        parse_plain(step.items[0], dimension::time, "the first of each step of " + what, diagnostics);
    if (time && *time <= last) diagnostics.add(wording::times_not_rising(step.items[0].span, what));
    last = time.value_or(last);
    const Node& value = step.items[1];
    const auto parsed = parse_step_value(value, step, last, what, diagnostics);
    if (!parsed) continue;
    signal.script.push_back(parsed->step);
    if (!parsed->step.valid) continue;
    if (!first) {
      first = parsed;
      first_value = &value;
      describe_script(*parsed, value.span, signal);
    } else if (first->dimension.has_value() != parsed->dimension.has_value()) {
      diagnostics.add(
          wording::mixed_script(value.span, what, first->dimension.has_value(), first_value->span));
      return;
    } else if (first->dimension != parsed->dimension) {
      // The one without a unit lacks that of the other.
      const bool is_first = *first->dimension == dimension::none;
      const ValueText number = parse_value(is_first ? *first_value : value, what, diagnostics);
      require_quantity(number, is_first ? *parsed->dimension : *first->dimension,
                       "the second of each step of " + what, diagnostics);
    }
  }
}

/// What the travel measures.
void describe_travel(const Word& object, TravelOf travel, SceneSignal& signal, Diagnostics& diagnostics) {
  if (travel == TravelOf::nothing) diagnostics.add(wording::nothing_travels(object.span, object.text));
  const Dimension measured = travel == TravelOf::turning ? dimension::angle : dimension::length;
  signal.powers = {measured.length, measured.mass, measured.time, measured.angle};
}

void parse_object_name(const Node& node, SceneSignal& signal, const std::vector<Seen>& seen, bool is_first,
                       Diagnostics& diagnostics) {
  const Word word = parse_word(node, "signal `" + signal.name + "`", diagnostics);
  if (!word.exists()) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    names.push_back(seen[i].name);
    if (seen[i].name == word.text) signal.object = static_cast<int>(i);
  }
  const bool may_be_unread =
      std::any_of(seen.begin(), seen.end(), [](const Seen& other) { return other.name.empty(); });
  if (signal.object < 0 && may_be_unread) return;
  if (signal.object < 0) {
    diagnostics.add(wording::unknown_name(word.span, "object", word.text, names));
  } else if (signal.kind == SceneSignalKind::latch &&
             !seen[static_cast<std::size_t>(signal.object)].has_dock) {
    diagnostics.add(wording::nothing_latches(word.span, word.text));
  } else if (signal.kind == SceneSignalKind::travel) {
    describe_travel(word, seen[static_cast<std::size_t>(signal.object)].travel, signal, diagnostics);
  } else if (signal.kind == SceneSignalKind::force && (!is_first || word.text == "base")) {
    diagnostics.add(wording::not_felt(word.span, word.text));
  }
}

/// `beyond` of a travel, which has a sign, and of the magnitude of a force: a switch.
void parse_threshold(MapReader& map, SceneSignal& signal, Diagnostics& diagnostics) {
  const Node* beyond = map.optional("beyond");
  if (beyond == nullptr) return;
  const std::string what = map.what() + "'s `beyond`";
  if (signal.kind != SceneSignalKind::travel) {
    signal.beyond = parse_positive(*beyond, dimension::force, what, false, diagnostics);
  } else if (signal.object >= 0) {
    const Dimension measured = signal.powers[3] != 0 ? dimension::angle : dimension::length;
    signal.beyond = parse_plain(*beyond, measured, what, diagnostics);
  }
}

/// The quantities of a signal that noise applies to. A script's values are given, and a latch is true or
/// false.
struct Noises {
  bool of_number = false, of_angle = false;
};

Noises noises_of(const SceneSignal& signal) {
  switch (signal.kind) {
    case SceneSignalKind::script:
    case SceneSignalKind::latch:
      return {};
    case SceneSignalKind::pose:
      return {.of_number = true, .of_angle = true};
    case SceneSignalKind::travel:
      return {.of_number = signal.powers[3] == 0, .of_angle = signal.powers[3] != 0 || signal.object < 0};
    default:
      return {.of_number = true};
  }
}

void parse_noises(MapReader& map, SceneSignal& signal, Diagnostics& diagnostics) {
  const Noises noises = noises_of(signal);
  for (const auto& [key, is_measured, other] : {std::tuple{"noise", noises.of_number, "angle_noise"},
                                                std::tuple{"angle_noise", noises.of_angle, "noise"}}) {
    const Node* node = map.optional(key);
    const bool has_other = noises.of_number || noises.of_angle;
    if (node != nullptr && !is_measured)
      diagnostics.add(wording::idle_noise(node->span, map.what(), key, has_other ? other : ""));
  }
  const bool is_force = signal.kind == SceneSignalKind::force || signal.kind == SceneSignalKind::wrench;
  if (noises.of_number)
    signal.noise = not_negative(map, "noise", is_force ? dimension::force : dimension::length, diagnostics);
  if (noises.of_angle) signal.angle_noise = not_negative(map, "angle_noise", dimension::angle, diagnostics);
}

/// `bias`, `delay`, `rate`, `dropouts`.
void parse_quality(MapReader& map, SceneSignal& signal, double most_delay, Diagnostics& diagnostics) {
  const bool is_force = signal.kind == SceneSignalKind::force;
  const bool is_wrench = signal.kind == SceneSignalKind::wrench;
  if (const Node* node = is_wrench ? map.optional("bias") : nullptr) {
    const auto bias = parse_vector(*node, dimension::force, 3, 3, map.what() + "'s `bias`", diagnostics);
    if (bias) signal.force_bias = {(*bias)[0], (*bias)[1], (*bias)[2]};
  }
  if (const Node* node = is_force ? map.optional("bias") : nullptr)
    signal.bias = parse_plain(*node, dimension::force, map.what() + "'s `bias`", diagnostics).value_or(0.0);
  signal.delay = not_negative(map, "delay", dimension::time, diagnostics);
  if (signal.delay > most_delay)
    diagnostics.add(wording::delayed_too_long(map.optional("delay")->span, map.what(), most_delay));
  if (const Node* node = map.optional("rate")) {
    const std::string what = map.what() + "'s `rate`";
    const auto rate = parse_positive(*node, dimension::frequency, what, false, diagnostics);
    if (rate) signal.period = 1.0 / *rate;
  }
  signal.dropouts = not_negative(map, "dropouts", dimension::none, diagnostics);
  if (signal.dropouts >= 1.0) diagnostics.add(wording::all_dropped(map.optional("dropouts")->span));
}

SceneSignal parse_signal(const Entry& entry, const std::vector<Seen>& seen, bool is_first,
                         Diagnostics& diagnostics) {
  SceneSignal signal;
  signal.name = parse_name(entry.key, "a signal's name", diagnostics).text;
  signal.span = entry.key.span;
  const std::string stays = entry.value.is_scalar() ? entry.value.text : "true";
  MapReader map(entry.value, "signal `" + entry.key.text + "`", diagnostics,
                "{script: [[0 s, " + stays + "]]}");
  if (!map.is_mapping()) return signal;
  struct Source {
    const char* key;
    SceneSignalKind kind;
  };
  const Node* given = nullptr;
  int found = 0;
  for (const Source& source :
       {Source{"script", SceneSignalKind::script}, Source{"pose_of", SceneSignalKind::pose},
        Source{"distance_to", SceneSignalKind::distance}, Source{"latch", SceneSignalKind::latch},
        Source{"force_of", SceneSignalKind::force}, Source{"travel_of", SceneSignalKind::travel},
        Source{"wrench_at", SceneSignalKind::wrench}}) {
    const Node* node = map.optional(source.key);
    if (node == nullptr) continue;
    ++found;
    given = node;
    signal.kind = source.kind;
  }
  if (found == 1) signal.source_span = given->span;
  if (found == 1 && signal.kind == SceneSignalKind::script) {
    parse_script(*given, signal, diagnostics);
  } else if (found == 1 && signal.kind == SceneSignalKind::wrench) {
    signal.frame = parse_word(*given, "`wrench_at`", diagnostics).text;
  } else if (found == 1) {
    parse_object_name(*given, signal, seen, is_first, diagnostics);
  }
  if (signal.kind == SceneSignalKind::travel || signal.kind == SceneSignalKind::force ||
      signal.kind == SceneSignalKind::wrench)
    parse_threshold(map, signal, diagnostics);
  if (found == 1) {
    parse_noises(map, signal, diagnostics);
  } else {  // the signal is refused, and nothing is known of its noise
    for (const char* key : {"noise", "angle_noise"}) map.optional(key);
  }
  parse_quality(map, signal, longest_delay, diagnostics);
  // An unknown key may have been the source's.
  if (found > 1 || (found == 0 && !map.has_unread_keys()))
    diagnostics.add(wording::one_signal_source(entry.key.span, entry.key.text));
  map.finish();
  return signal;
}

}  // namespace

std::vector<SceneSignal> parse_scene_signals(const Node& node, const std::vector<Seen>& seen, bool is_first,
                                             Diagnostics& diagnostics) {
  std::vector<SceneSignal> signals;
  if (!require_mapping(node, "`signals`", diagnostics)) return signals;
  for (const Entry& entry : node.entries) {
    if (!entry.key.is_bad) signals.push_back(parse_signal(entry, seen, is_first, diagnostics));
  }
  return signals;
}

std::vector<Waypoint> parse_motion(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  std::vector<Waypoint> points;
  if (!require_sequence(node, what, diagnostics)) return points;
  if (node.items.empty()) diagnostics.add(wording::empty_motion(node.span, what));
  double last = -1.0;
  for (const Node& item : node.items) {
    MapReader map(item, what, diagnostics, "{time: 1 s, at: [0 m, 0 m]}");
    // An author who writes one point as a list writes all so. One diagnostic is enough.
    if (!map.is_mapping()) return points;
    Waypoint point;
    if (const Node* when = map.required("time")) {
      const auto time = parse_plain(*when, dimension::time, what + "'s `time`", diagnostics);
      if (time && *time <= last) diagnostics.add(wording::times_not_rising(when->span, what));
      point.time = last = time.value_or(last);
    }
    if (const Node* at = map.required("at")) {
      point.at = parse_place(*at, what + "'s `at`", "yaw", diagnostics).value_or(point.at);
    }
    if (const Node* yaw = map.optional("yaw"))
      point.yaw = parse_plain(*yaw, dimension::angle, what + "'s `yaw`", diagnostics).value_or(0.0);
    map.finish();
    points.push_back(point);
  }
  return points;
}

std::optional<Dock> parse_dock(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  MapReader map(node, what, diagnostics);
  if (!map.is_mapping()) return std::nullopt;
  Dock dock;
  if (const Node* at = map.required("at")) {
    dock.at = parse_place(*at, what + "'s `at`", "", diagnostics).value_or(dock.at);
  }
  if (const Node* reach = map.optional("reach")) {
    dock.reach = parse_positive(*reach, dimension::length, what + "'s `reach`", false, diagnostics)
                     .value_or(dock.reach);
  }
  if (const Node* hook = map.required("hook")) {
    dock.hook = parse_word(*hook, "`hook`", diagnostics).text;
    dock.hook_span = hook->span;
  }
  if (const Node* held = map.optional("held_while")) {
    dock.held_while = parse_word(*held, "`held_while`", diagnostics).text;
    dock.held_while_span = held->span;
  }
  if (const Node* press = map.optional("press"))
    dock.press =
        parse_positive(*press, dimension::force, what + "'s `press`", false, diagnostics).value_or(0.0);
  map.finish();
  return dock;
}

StateNoise parse_state_noise(const Node& node, Diagnostics& diagnostics) {
  StateNoise noise;
  if (node.is_scalar() && node.text == "perfect") return noise;
  if (node.is_scalar() && node.text == "wheels") {
    noise.wheels_only = true;
    return noise;
  }
  MapReader map(node, "`state`", diagnostics);
  if (!map.is_mapping()) return noise;
  noise.position = not_negative(map, "position", dimension::length, diagnostics);
  noise.yaw = not_negative(map, "yaw", dimension::angle, diagnostics);
  noise.velocity = not_negative(map, "velocity", dimension::velocity, diagnostics);
  noise.turn = not_negative(map, "turn", dimension::angular_velocity, diagnostics);
  noise.delay = not_negative(map, "delay", dimension::time, diagnostics);
  if (noise.delay > longest_state_delay)
    diagnostics.add(wording::delayed_too_long(map.optional("delay")->span, map.what(), longest_state_delay));
  if (const Node* fix = map.optional("fix")) {
    for (const char* key : {"position", "yaw", "velocity", "turn", "delay"}) {
      const Node* measured = map.optional(key);
      if (measured != nullptr) diagnostics.add(wording::fix_of_measured(fix->span, key, measured->span));
    }
    MapReader quality(*fix, "`state.fix`", diagnostics);
    noise.wheels_only = true;
    noise.fix.emplace();
    noise.fix->kind = SceneSignalKind::pose;
    if (quality.is_mapping()) {
      parse_noises(quality, *noise.fix, diagnostics);
      parse_quality(quality, *noise.fix, longest_fix_delay, diagnostics);
    }
    quality.finish();
  }
  map.finish();
  return noise;
}

}  // namespace zwang::lang
