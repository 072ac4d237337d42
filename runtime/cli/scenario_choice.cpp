#include "scenario_choice.hpp"

#include <algorithm>
#include <charconv>

#include "file_kind.hpp"
#include "output.hpp"
#include "zwang/lang/nearest.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::cli {

namespace {

constexpr std::size_t most_names = 8;  // that a message lists

/// Options that say what a scenario or a study says.
void refuse_overrides(const RunArguments& arguments, const std::string& whose) {
  if (arguments.overrides.any() || arguments.start_yaw || arguments.start_at || arguments.seed ||
      arguments.watch)
    throw Impossible(arguments.file + ": " + whose +
                     " says how it runs; of the options that say the same, and "
                     "--watch, it takes none");
}

/// Replaces statements of the task file by those of a cell.
void take_cell(const lang::Scenario& scenario, const lang::ScenarioCell& cell, RunArguments& arguments) {
  arguments.file = scenario.task.string();
  if (cell.robot) arguments.overrides.robot = cell.robot->string();
  if (cell.scene) arguments.overrides.scene = cell.scene->string();
  arguments.overrides.parameters = cell.parameters;
  arguments.start_at = cell.start_at;
  arguments.start_yaw = cell.start_yaw;
  arguments.seed = scenario.seed;
}

std::size_t number_of_cell(const lang::Study& study, const std::optional<std::string>& text) {
  std::size_t number = 0;
  const char* end = text ? text->data() + text->size() : nullptr;
  const auto read = text ? std::from_chars(text->data(), end, number) : std::from_chars_result{};
  const bool is_number = text && !text->empty() && read.ptr == end && read.ec == std::errc();
  if (!is_number || number >= lang::most_cells_of_a_study)
    throw Impossible(study.path + ": a study of " + count(study.runs, "cell") +
                     "; choose one by its number, as --cell 0");
  return number;
}

RunArguments with_study(RunArguments arguments, lang::Diagnostics& diagnostics) {
  std::optional<lang::Study> loaded = lang::load_study(arguments.file, diagnostics);
  if (!loaded) return arguments;
  const auto study = std::make_shared<const lang::Study>(std::move(*loaded));
  refuse_overrides(arguments, "a study");
  const std::size_t number = number_of_cell(*study, arguments.cell);
  lang::StudyCell drawn = lang::draw_cell(*study, number);
  arguments.choice = {
      arguments.file, number, drawn.cell().faults, {}, drawn.scenario.blend, drawn.scenario.time_limit,
      study};
  take_cell(drawn.scenario, drawn.cell(), arguments);
  // The effect of the draws on the simulated robot is known with its task.
  lang::Diagnostics of_study, of_task;
  if (lang::load_run(*study, drawn, of_study, of_task)) {
    arguments.choice->deviation = drawn.cell().deviation;
  } else {
    diagnostics = of_study;
  }
  return arguments;
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
  require_file(arguments.file);
  refuse_urdf(arguments.file);
  const std::optional<FileKind> kind = kind_of_file(arguments.file);
  if (kind == FileKind::study) return with_study(std::move(arguments), diagnostics);
  if (kind != FileKind::scenario) {
    if (arguments.cell) throw Impossible(arguments.file + ": is no scenario, which --cell needs");
    return arguments;
  }
  const std::optional<lang::Scenario> scenario = lang::load_scenario(arguments.file, diagnostics);
  if (!scenario) return arguments;
  refuse_overrides(arguments, "a scenario");
  const std::size_t index = index_of(*scenario, arguments.cell);
  const lang::ScenarioCell& cell = scenario->cells[index];
  arguments.choice = {arguments.file, index, cell.faults, {}, scenario->blend, scenario->time_limit, nullptr};
  take_cell(*scenario, cell, arguments);
  return arguments;
}

std::optional<lang::Program> load_choice(const ScenarioChoice& choice, lang::Diagnostics& diagnostics) {
  lang::Diagnostics of_scenario;
  std::optional<lang::ScenarioRun> run;
  if (choice.study) {
    lang::StudyCell drawn = lang::draw_cell(*choice.study, choice.cell);
    run = lang::load_run(*choice.study, drawn, of_scenario, diagnostics);
  } else {
    run = lang::load_run(choice.scenario, choice.cell, of_scenario, diagnostics);
  }
  if (run) return std::move(run->program);
  diagnostics = std::move(of_scenario);
  return std::nullopt;
}

std::string argument_of_shell(const std::string& text) {
  return is_plain(text) ? text : quoted(text);
}

std::string command_of(const std::string& scenario, const std::string& cell) {
  return "zwang run " + argument_of_shell(scenario) + " --cell " + quoted(cell) + " --report";
}

}  // namespace zwang::cli
