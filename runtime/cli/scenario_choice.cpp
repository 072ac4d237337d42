#include "scenario_choice.hpp"

#include <algorithm>

#include "file_kind.hpp"
#include "output.hpp"
#include "zwang/lang/nearest.hpp"
#include "zwang/lang/scenario.hpp"

namespace zwang::cli {

namespace {

constexpr std::size_t most_names = 8;  // that a message lists

bool is_scenario(const std::string& file) {
  require_file(file);
  return kind_of_file(file) == FileKind::scenario;
}

std::vector<std::string> names_of(const lang::Scenario& scenario) {
  std::vector<std::string> names;
  for (const lang::ScenarioCell& cell : scenario.cells) names.push_back(cell.name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < most_names; ++i) text += "\n  --cell '" + names[i] + "'";
  if (names.size() > most_names) text += "\n  and " + count(names.size() - most_names, "more cell");
  return text;
}

std::size_t index_of(const lang::Scenario& scenario, const std::optional<std::string>& name) {
  const std::vector<std::string> names = names_of(scenario);
  if (!name) {
    if (names.size() == 1) return 0;
    throw Impossible(scenario.path + ": a scenario of " + count(names.size(), "run") +
                     "; choose one:" + listed(names));
  }
  const auto found = std::ranges::find(names, *name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string meant = lang::nearest(*name, names);
  throw Impossible(scenario.path + ": no cell `" + *name + "`" +
                   (meant.empty() ? ", but" + listed(names) : "; did you mean `" + meant + "`?"));
}

/// In single quotes, within which a shell takes everything as it is.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

bool is_plain(const std::string& text) {
  return !text.empty() && text.front() != '-' && std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-./").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

}  // namespace

RunArguments with_choice(RunArguments arguments, lang::Diagnostics& diagnostics) {
  if (!is_scenario(arguments.file)) {
    if (arguments.cell) throw Impossible(arguments.file + ": is no scenario, which --cell needs");
    return arguments;
  }
  const std::optional<lang::Scenario> scenario = lang::load_scenario(arguments.file, diagnostics);
  if (!scenario) return arguments;
  const TaskOverrides& overrides = arguments.overrides;
  if (overrides.any() || arguments.start_yaw || arguments.start_at || arguments.seed != 0 || arguments.watch)
    throw Impossible(arguments.file +
                     ": a scenario says how it runs; of the options that say the same, and "
                     "--watch, it takes none");
  const std::size_t index = index_of(*scenario, arguments.cell);
  const lang::ScenarioCell& cell = scenario->cells[index];
  arguments.choice = {arguments.file, index, cell.faults, scenario->blend, scenario->time_limit};
  arguments.file = scenario->task.string();
  if (cell.robot) arguments.overrides.robot = cell.robot->string();
  if (cell.scene) arguments.overrides.scene = cell.scene->string();
  arguments.overrides.parameters = cell.parameters;
  arguments.start_at = cell.start_at;
  arguments.start_yaw = cell.start_yaw;
  arguments.seed = scenario->seed;
  return arguments;
}

std::optional<lang::Program> load_choice(const ScenarioChoice& choice, lang::Diagnostics& diagnostics) {
  lang::Diagnostics of_scenario;
  auto run = lang::load_run(choice.scenario, choice.cell, of_scenario, diagnostics);
  if (run) return std::move(run->program);
  diagnostics = std::move(of_scenario);
  return std::nullopt;
}

std::string command_of(const std::string& scenario, const std::string& cell) {
  return "zwang run " + (is_plain(scenario) ? scenario : quoted(scenario)) + " --cell " + quoted(cell) +
         " --report";
}

}  // namespace zwang::cli
