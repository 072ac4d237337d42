// The program `zwang`. The only file that knows CLI11.
#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <exception>

#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/quantity.hpp"

namespace {

using namespace zwang::cli;

const std::map<std::string, Format> formats = {{"human", Format::human}, {"json", Format::json}};

double angle(const std::string& text) {
  const auto value = zwang::lang::read_angle(text);
  if (!value) throw Impossible("--start-yaw: `" + text + "` is not an angle; write it as `20 deg`");
  return *value;
}

std::array<double, 2> point(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto x = zwang::lang::read_length(text.substr(0, comma));
  const auto y = comma == std::string::npos ? std::nullopt : zwang::lang::read_length(text.substr(comma + 1));
  if (!x || !y) throw Impossible("--start-at: `" + text + "` is not a point; write it as `0 m, 0.5 m`");
  return {*x, *y};
}

std::uint64_t seed(const std::string& text) {
  // CLI11 would wrap a negative number around.
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw Impossible("--seed: `" + text + "` is not a whole number from 0 to 2^64 - 1");
  }
  return value;
}

std::map<std::string, std::string> parameters(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> values;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Impossible("-p: `" + text + "` does not set a parameter; write it as `name=20 N`");
    }
    values[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return values;
}

int parse_and_do(int argc, char** argv) {
  CLI::App app("Checks and runs task files for robots that touch the world.", "zwang");
  app.set_version_flag("--version", "zwang " ZWANG_VERSION);
  app.require_subcommand(1);

  ValidateArguments to_validate;
  CLI::App* validate_verb =
      app.add_subcommand("validate", "Check task, robot and scene files without running them");
  validate_verb->add_option("files", to_validate.files, "the files; their first key tells what they are")
      ->required();
  validate_verb->add_option("--format", to_validate.format, "human (default) or json: one object on stdout")
      ->transform(CLI::CheckedTransformer(formats, CLI::ignore_case));

  RunArguments to_run;
  std::vector<std::string> parameter_texts;
  std::optional<std::string> yaw_text, at_text, seed_text;
  CLI::App* run_verb = app.add_subcommand("run", "Run a task on the simulated robot");
  run_verb->add_option("file", to_run.file, "the task file")->required();
  run_verb->add_option("--robot", to_run.robot, "robot file, in the place of the task's own");
  run_verb->add_option("--scene", to_run.scene, "scene file, in the place of the task's own");
  run_verb
      ->add_option("-p,--param", parameter_texts, "set a parameter: name=value, as push=30N; may be repeated")
      ->allow_extra_args(false);
  run_verb->add_option("--log", to_run.log, "folder for the log (default runs/<task>-NNN)");
  run_verb->add_option("--seed", seed_text, "seed of everything random in the run (default 0)");
  run_verb->add_option("--start-yaw", yaw_text,
                       "heading at the start, in the place of the scene's: `20 deg`");
  run_verb->add_option("--start-at", at_text,
                       "position at the start, in the place of the scene's: `0 m, 0 m`");
  run_verb->add_flag("--quiet", to_run.quiet, "no live line, only the report");
  run_verb->add_option("--format", to_run.format, "human (default) or json: one object on stdout")
      ->transform(CLI::CheckedTransformer(formats, CLI::ignore_case));

  InfoArguments to_tell;
  CLI::App* info_verb = app.add_subcommand("info", "Tell what is in the log of a run");
  info_verb->add_option("log", to_tell.file, "the .mcap file")->required();
  info_verb->add_option("--format", to_tell.format, "human (default) or json: one object on stdout")
      ->transform(CLI::CheckedTransformer(formats, CLI::ignore_case));

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    std::ostringstream text, error;
    app.exit(wanted, text, error);
    print(text.str());
    return exit_good;
  } catch (const CLI::ParseError& mistake) {
    // CLI11's own exit codes say nothing that ours do not.
    throw Impossible(std::string(mistake.what()) + "\nTry `zwang --help`.");
  }
  if (validate_verb->parsed()) return validate(to_validate);
  if (info_verb->parsed()) return info(to_tell);
  to_run.parameters = parameters(parameter_texts);
  if (seed_text) to_run.seed = seed(*seed_text);
  if (yaw_text) to_run.start_yaw = angle(*yaw_text);
  if (at_text) to_run.start_at = point(*at_text);
  return run(to_run);
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that went away is an error that `print` sees, not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    secure_standard_streams();
    return parse_and_do(argc, argv);
  } catch (const std::exception& e) {
    print_error(std::string("zwang: ") + e.what() + "\n");
  } catch (...) {
    print_error("zwang: an unknown error\n");
  }
  return exit_impossible;
}
