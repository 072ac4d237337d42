#include "check/cases.hpp"
#include "check/context.hpp"
#include "diagnostic/wordings.hpp"
#include "scenario/scenario_file.hpp"
#include "words/units.hpp"

namespace zwang::lang {

namespace {

struct TruthQuantity {
  const char* name;
  Dimension dimension;
};

// In the order of TruthOfBase, TruthOfObject and TruthOfRobot.
constexpr TruthQuantity of_base[] = {{"truth.base.x", dimension::length},
                                     {"truth.base.y", dimension::length},
                                     {"truth.base.yaw", dimension::angle},
                                     {"truth.base.vx", dimension::velocity},
                                     {"truth.base.vy", dimension::velocity},
                                     {"truth.base.speed", dimension::velocity},
                                     {"truth.base.turn", dimension::angular_velocity},
                                     {"truth.base.torque", dimension::none},
                                     {"truth.base.switch", dimension::torque},
                                     {"truth.base.roll", dimension::angle},
                                     {"truth.base.pitch", dimension::angle},
                                     {"truth.base.acceleration", dimension::acceleration},
                                     {"truth.base.push", dimension::force},
                                     {"truth.base.slip", dimension::velocity},
                                     {"truth.base.hand", dimension::force},
                                     {"truth.base.astray", dimension::length},
                                     {"truth.base.mass", dimension::mass},
                                     {"truth.base.drift", dimension::length},
                                     {"run.done", dimension::time},
                                     {"run.fault", dimension::time},
                                     {"run.stopped", dimension::time},
                                     {"run.slipped", dimension::time}};
constexpr TruthQuantity of_object[] = {
    {"force", dimension::force},  {"peak", dimension::force},         {"steady", dimension::force},
    {"touched", dimension::time}, {"x", dimension::length},           {"y", dimension::length},
    {"yaw", dimension::angle},    {"latched", dimension::time},       {"pull", dimension::force},
    {"hand", dimension::force},   {"stiffness", dimension::stiffness}};
constexpr TruthQuantity of_robot[] = {{"speed", dimension::velocity},
                                      {"turn", dimension::angular_velocity},
                                      {"torque", dimension::none},
                                      {"stopped", dimension::time}};
static_assert(std::size(of_base) == truth_base_count && std::size(of_object) == truth_object_count &&
              std::size(of_object) + std::size(of_robot) == truth_robot_count);

void declare(Symbols& symbols, const std::string& prefix, const TruthQuantity& quantity) {
  SignalSymbol symbol;
  symbol.signal.name = prefix + quantity.name;
  symbol.signal.type = SignalType::number;
  symbol.dimension = quantity.dimension;
  symbols.signals.push_back(std::move(symbol));
}

Symbols truth_symbols(const Program& program) {
  const Scene scene = program.scene.value_or(Scene{});
  Symbols symbols;
  for (const TruthQuantity& quantity : of_base) declare(symbols, "", quantity);
  for (const SceneObject& object : scene.objects) {
    const std::string prefix = "truth." + object.name + ".";
    for (const TruthQuantity& quantity : of_object) declare(symbols, prefix, quantity);
  }
  for (const SceneRobot& robot : scene.robots) {
    const std::string prefix = "truth." + robot.name + ".";
    for (const TruthQuantity& quantity : of_object) declare(symbols, prefix, quantity);
    for (const TruthQuantity& quantity : of_robot) declare(symbols, prefix, quantity);
  }
  for (const SceneObject& object : scene.objects) {
    const std::string prefix = "truth." + object.name + ".";
    if (object.guide && object.guide->turns) declare(symbols, prefix, {"angle", dimension::angle});
    if (object.guide && !object.guide->turns) declare(symbols, prefix, {"travel", dimension::length});
  }
  for (const SceneSignal& signal : scene.signals) {
    if (signal.kind != SceneSignalKind::wrench) continue;
    const std::string prefix = "truth.signal." + signal.name + ".";
    for (const char* force : {"x", "y", "z"}) declare(symbols, prefix, {force, dimension::force});
    for (const char* torque : {"rx", "ry", "rz"}) declare(symbols, prefix, {torque, dimension::torque});
  }
  for (const Output& output : program.outputs) {
    std::string unknown;
    const auto unit = parse_unit(output.unit, unknown);
    declare(symbols, "truth.output.", {output.name.c_str(), unit ? unit->dimension : dimension::none});
    if (!output.is_number) symbols.signals.back().signal.type = SignalType::boolean;
  }
  for (const Region& region : program.regions)
    declare(symbols, "truth.base.inside.", {region.name.c_str(), dimension::length});
  for (const Task& task : program.tasks)
    declare(symbols, "run.entered.", {task.name.c_str(), dimension::time});
  return symbols;
}

void declare_program(const Program& program, Symbols& symbols) {
  for (const Task& task : program.tasks) symbols.tasks.push_back(task.name);
  for (const Parameter& parameter : program.parameters) {
    ParameterSymbol symbol;
    symbol.parameter = parameter;
    std::string unknown;
    if (const auto unit = parse_unit(parameter.unit, unknown)) symbol.dimension = unit->dimension;
    symbols.parameters.push_back(std::move(symbol));
  }
  for (const FrameDeclaration& frame : program.frames) {
    FrameSymbol symbol;
    symbol.declaration = frame;
    symbols.frames.push_back(std::move(symbol));
  }
}

/// The index of a time of the truth.
int find_time(const Word& name, const Symbols& symbols, Diagnostics& diagnostics) {
  const auto index = symbols.find_signal(name.text);
  if (!index) {
    diagnostics.add(wording::unknown_name(name.span, "quantity", name.text, symbols.signal_names()));
    return -1;
  }
  if (symbols.signals[static_cast<std::size_t>(*index)].dimension != dimension::time)
    diagnostics.add(wording::not_a_time(name.span, name.text));
  return *index;
}

/// Whose outcome is meant.
int find_robot(const Word& name, const Scene& scene, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    if (scene.robots[i].name == name.text) return static_cast<int>(i);
    names.push_back(scene.robots[i].name);
  }
  diagnostics.add(wording::unknown_name(name.span, "robot in the scene", name.text, names));
  return -1;
}

/// E505: an expectation that no run can decide.
void check_is_possible(CheckContext& context, const Condition& that) {
  const int before = context.diagnostics.error_count();
  check_is_open(context, that, {});
  if (context.diagnostics.error_count() > before) return;
  for (const bool is_negated : {false, true}) {
    const auto cases = cases_of(context, that, {}, is_negated);
    if (cases && cases->empty())
      context.diagnostics.add(wording::decided_condition(that.span, is_negated, false));
  }
}

std::vector<std::string> units_of(const Condition& condition, const std::vector<Dimension>& dimensions) {
  std::vector<std::string> units;
  for (std::size_t i = 0; i < condition.nodes.size(); ++i) {
    const Op op = condition.nodes[i].op;
    const bool compares =
        op == Op::less || op == Op::less_equal || op == Op::greater || op == Op::greater_equal;
    units.push_back(usual_unit(dimensions[compares ? static_cast<std::size_t>(condition.nodes[i].left) : i]));
  }
  return units;
}

}  // namespace

std::string text_of(const ExpectationText& text) {
  switch (text.kind) {
    case ExpectationKind::outcome:
      return "outcome: " + text.word.text + (text.of.exists() ? " of " + text.of.text : std::string());
    case ExpectationKind::diagnostic:
      return "diagnostic: " + text.word.text;
    case ExpectationKind::at_end:
      return "at end: " + text.that.text;
    case ExpectationKind::within:
      return "within " + format_number(text.within) + " s" +
             (text.of.exists() ? " of " + text.of.text : std::string()) + ": " + text.that.text;
    case ExpectationKind::always:
      break;
  }
  return "always: " + text.that.text;
}

std::vector<std::string> truth_names(const Program& program) {
  return truth_symbols(program).signal_names();
}

std::optional<std::vector<Expectation>> check_expectations(const ScenarioFile& file, const Program& program,
                                                           Diagnostics& diagnostics) {
  Symbols symbols = truth_symbols(program);
  declare_program(program, symbols);
  const TaskFile no_task;
  const std::optional<Robot> robot;
  const LoadOptions options;
  CheckContext context{no_task, robot, options, symbols, diagnostics};
  context.of_truth = true;
  std::vector<Expectation> expectations;
  for (const ExpectationText& text : file.expectations) {
    Expectation expected;
    expected.kind = text.kind;
    expected.word = text.word.text;
    expected.within = text.within;
    expected.text = text_of(text);
    expected.span = text.span;
    const bool has_condition =
        text.kind != ExpectationKind::outcome && text.kind != ExpectationKind::diagnostic;
    if (text.of.exists() && text.kind == ExpectationKind::outcome) {
      expected.of_robot = find_robot(text.of, program.scene.value_or(Scene{}), diagnostics);
    } else if (text.of.exists()) {
      expected.of = find_time(text.of, symbols, diagnostics);
    }
    if (has_condition && !text.that.is_bad) {
      std::vector<Dimension> dimensions;
      if (auto that = check_condition(context, text.that, {}, nullptr, &dimensions)) {
        check_is_possible(context, *that);
        expected.units = units_of(*that, dimensions);
        expected.that = std::move(*that);
      }
    }
    expectations.push_back(std::move(expected));
  }
  if (diagnostics.has_errors()) return std::nullopt;
  return expectations;
}

}  // namespace zwang::lang
