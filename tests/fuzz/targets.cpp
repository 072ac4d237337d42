#include "targets.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "check/check.hpp"
#include "check/context.hpp"
#include "check_task_file.hpp"
#include "format/tokens.hpp"
#include "lower/lower.hpp"
#include "robot/load_robot.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/load_scene.hpp"
#include "study/study_file.hpp"
#include "tree/file.hpp"
#include "tree/read.hpp"

namespace zwang::fuzz {

namespace {

using namespace lang;

const std::filesystem::path root = ZWANG_SOURCE_DIR;

void require(bool law, const char* words) {
  if (law) return;
  std::fprintf(stderr, "broken law: %s\n", words);
  std::abort();
}

/// Larger files are refused before anything reads them.
bool is_readable(std::string_view bytes, const SizeLimit& limit) {
  return bytes.size() <= limit.bytes;
}

int add(std::string_view bytes, Diagnostics& diagnostics) {
  return diagnostics.add_source({"input", std::string(bytes)});
}

/// Positions lie in the text, and every form of the report can be written.
void judge(Diagnostics& diagnostics, bool is_good) {
  diagnostics.settle();
  require(is_good == !diagnostics.has_errors(), "a file is good when and only when nothing is wrong with it");
  for (const Diagnostic& d : diagnostics.all()) {
    require(!d.message.empty(), "a diagnostic says something");
    require(d.span.exists(), "a diagnostic has a place");
    require(d.span.begin.line >= 1 && d.span.begin.column >= 1, "a place counts from 1");
    const bool is_ordered = d.span.end.line > d.span.begin.line || (d.span.end.line == d.span.begin.line &&
                                                                    d.span.end.column >= d.span.begin.column);
    require(is_ordered, "a place does not end before it begins");
  }
  std::ostringstream out;
  render_human(diagnostics, out, {.notes = true});
  render_short(diagnostics, out, {.notes = true});
  render_json(diagnostics, {.notes = true});
  render_sarif({&diagnostics}, "1", {.notes = true});
}

void judge_layout(std::string_view bytes) {
  Diagnostics diagnostics;
  const std::optional<std::string> once = format_source(add(bytes, diagnostics), diagnostics);
  if (!once) return require(diagnostics.has_errors(), "what is not laid out is complained of");
  const std::optional<std::string> twice = format_source(add(*once, diagnostics), diagnostics);
  require(twice == once, "laying out twice is laying out once");
}

const Robot& small_robot() {
  static const Robot robot = [] {
    Diagnostics diagnostics;
    const auto loaded = load_robot(root / "tests/conformance/robots/mini.yaml", diagnostics);
    require(loaded.has_value(), "the robot of the golden suite is good");
    return *loaded;
  }();
  return robot;
}

std::optional<Program> program_of(TaskFile file, Diagnostics& diagnostics) {
  double budget = whole_budget;
  std::optional<CheckedFile> checked =
      check(std::move(file), small_robot(), std::nullopt, {}, true, budget, diagnostics);
  if (!checked) return std::nullopt;
  return lower(std::move(*checked));
}

/// A file whose names conditions speak of, checked once: an input pays for its own condition only.
struct ConditionHost {
  Diagnostics diagnostics;
  TaskFile file;
  std::optional<Robot> robot = small_robot();
  LoadOptions options;
  Symbols symbols;

  ConditionHost() {
    const auto source = read_file(root / "tests/fuzz/condition_host.yaml", yaml_size_limit, {}, diagnostics);
    const auto document = source ? read(*source, diagnostics) : std::nullopt;
    const auto parsed = document ? parse(*document, diagnostics) : std::nullopt;
    require(parsed.has_value(), "the host of the conditions is good");
    file = *parsed;
    CheckContext context = context_for(diagnostics);
    check_parameters(context);
    declare_signals(context);
    check_frames(context);
    check_world(context);
    check_groups(context, file.tasks[0].groups);
    require(!diagnostics.has_errors(), "the host of the conditions is good");
  }

  CheckContext context_for(Diagnostics& into) { return {file, robot, options, symbols, into}; }
};

ConditionHost& host_of_conditions() {
  static ConditionHost host;
  return host;
}

/// What scenarios expect something of.
const Program& host_of_expectations() {
  static const Program program = [] {
    Diagnostics diagnostics;
    LoadOptions options;
    options.robot = root / "tests/conformance/robots/mini.yaml";
    options.scene = root / "tests/conformance/scene_ok.yaml";
    const auto loaded = load(root / "tests/fuzz/condition_host.yaml", options, diagnostics);
    require(loaded.has_value(), "the host of the expectations is good");
    return *loaded;
  }();
  return program;
}

std::optional<Robot> robot_of(std::string_view yaml, std::string_view xml, Diagnostics& diagnostics) {
  const std::optional<Document> document = read(add(yaml, diagnostics), diagnostics);
  if (!document) return std::nullopt;
  const std::optional<RobotFile> file = parse_robot_file(*document, diagnostics);
  if (!file || !file->urdf.exists()) return std::nullopt;
  std::optional<Urdf> urdf = read_urdf(add(xml, diagnostics), diagnostics);
  if (!urdf) return std::nullopt;
  return build_robot(*file, std::move(*urdf), 0, diagnostics);
}

}  // namespace

void task(std::string_view bytes) {
  if (!is_readable(bytes, yaml_size_limit)) return;
  Diagnostics diagnostics;
  const std::optional<Document> document = read(add(bytes, diagnostics), diagnostics);
  std::optional<TaskFile> file = document ? parse(*document, diagnostics) : std::nullopt;
  const std::optional<Program> program = file ? program_of(std::move(*file), diagnostics) : std::nullopt;
  judge(diagnostics, program.has_value());
  judge_layout(bytes);
}

void condition(std::string_view bytes) {
  if (bytes.size() > longest_scalar) return;
  ConditionHost& host = host_of_conditions();
  Diagnostics diagnostics;
  Node node;
  node.kind = NodeKind::scalar;
  node.text = std::string(bytes);
  node.span = {add(bytes, diagnostics), {1, 1}, {1, 1}};
  const ConditionText text = parse_condition(node, diagnostics);
  require(text.is_bad == diagnostics.has_errors(), "a condition is read or complained of");
  if (!text.is_bad) {
    CheckContext context = host.context_for(diagnostics);
    const auto checked = check_condition(context, text, host.file.tasks[0].groups);
    require(checked.has_value() == !diagnostics.has_errors(), "a condition is good or complained of");
    if (checked) check_is_open(context, *checked, host.file.tasks[0].groups);
  }
  judge(diagnostics, !diagnostics.has_errors());
}

void robot(std::string_view bytes) {
  constexpr std::string_view mark = "\n=== URDF\n";
  const std::size_t at = bytes.find(mark);
  const std::string_view yaml = at == std::string_view::npos ? std::string_view() : bytes.substr(0, at);
  const std::string_view xml = at == std::string_view::npos ? bytes : bytes.substr(at + mark.size());
  if (!is_readable(yaml, yaml_size_limit) || !is_readable(xml, urdf_size_limit)) return;
  Diagnostics diagnostics;
  if (at == std::string_view::npos) {
    const bool is_good = read_urdf(add(xml, diagnostics), diagnostics).has_value();
    return judge(diagnostics, is_good);
  }
  const bool is_good = robot_of(yaml, xml, diagnostics).has_value();
  judge(diagnostics, is_good);
}

void scene(std::string_view bytes) {
  if (!is_readable(bytes, yaml_size_limit)) return;
  Diagnostics diagnostics;
  const bool is_good = read_scene(add(bytes, diagnostics), diagnostics).has_value();
  judge(diagnostics, is_good);
}

void scenario(std::string_view bytes) {
  if (!is_readable(bytes, yaml_size_limit)) return;
  Diagnostics diagnostics;
  const std::optional<Document> document = read(add(bytes, diagnostics), diagnostics);
  const std::optional<ScenarioFile> file =
      document ? parse_scenario_file(*document, diagnostics) : std::nullopt;
  bool is_good = false;
  if (file && !diagnostics.has_errors()) {
    is_good = scenario_of(*file, root / "tests/conformance/input.yaml", diagnostics).has_value() &&
              check_expectations(*file, host_of_expectations(), diagnostics).has_value();
  }
  judge(diagnostics, is_good);
}

void study(std::string_view bytes) {
  if (!is_readable(bytes, yaml_size_limit)) return;
  Diagnostics diagnostics;
  const std::optional<Document> document = read(add(bytes, diagnostics), diagnostics);
  const std::optional<StudyFile> file = document ? parse_study_file(*document, diagnostics) : std::nullopt;
  require(file.has_value() || diagnostics.has_errors(), "a study is read or complained of");
  if (file) {
    for (const DrawText& draw : file->draws)
      static_cast<void>(distribution_of(draw, dimension::force, diagnostics));
  }
  judge(diagnostics, !diagnostics.has_errors());
}

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {{"task", task},   {"condition", condition}, {"robot", robot},
                                          {"scene", scene}, {"scenario", scenario},   {"study", study}};
  return all;
}

}  // namespace zwang::fuzz
