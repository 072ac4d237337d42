// The program `zwang`.
#include <algorithm>
#include <csignal>
#include <exception>
#include <sstream>

#include "colour.hpp"
#include "command_line/command_line.hpp"
#include "commit.hpp"
#include "output.hpp"
#include "zwang/lang/nearest.hpp"
#include "zwang/version.hpp"

namespace {

using namespace zwang::cli;

/// `runn` is answered with `run`, `robot inpsect` with `robot inspect`. Empty when the words are verbs, or
/// where an option stands.
std::string unknown_verb(const CLI::App& app, int argc, char** argv) {
  const CLI::App* within = &app;
  std::string known = "zwang";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    std::vector<std::string> verbs;
    for (const CLI::App* verb : within->get_subcommands({})) verbs.push_back(verb->get_name());
    if (verbs.empty() || word.empty() || word.front() == '-') return "";
    if (std::find(verbs.begin(), verbs.end(), word) == verbs.end()) {
      const std::string meant = zwang::lang::nearest(word, verbs);
      return "no verb `" + word + "`" + (within == &app ? "" : " of `" + known + "`") +
             (meant.empty() ? "" : "; did you mean `" + known + " " + meant + "`?");
    }
    within = within->get_subcommand(word);
    known += " " + word;
  }
  return "";
}

int parse_and_do(int argc, char** argv) {
  CLI::App app("Checks and runs task files for robots that touch the world.", "zwang");
  const std::string built_from = *commit == '\0' ? "" : std::string(", commit ") + commit;
  app.set_version_flag("--version", "zwang " ZWANG_VERSION + built_from);
  app.require_subcommand(1);

  Chosen chosen;
  add_file_verbs(app, chosen);
  add_robot_verbs(app, chosen);
  add_run_verbs(app, chosen);
  add_log_verbs(app, chosen);
  add_tool_verbs(app, chosen);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    std::ostringstream text, error;
    app.exit(wanted, text, error);
    print(text.str());
    return exit_good;
  } catch (const CLI::ParseError& mistake) {
    const std::string unknown = unknown_verb(app, argc, argv);
    // CLI11's own exit codes say nothing that ours do not.
    std::string verb;  // the innermost that was named
    for (auto below = app.get_subcommands(); !below.empty(); below = below.front()->get_subcommands())
      verb += " " + below.front()->get_name();
    if (!unknown.empty()) throw Impossible(unknown + "\nTry `zwang" + verb + " --help`.");
    throw Impossible(std::string(mistake.what()) + "\nTry `zwang" + verb + " --help`.");
  }
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that went away is an error that `print` sees, not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
  // The same holds for a file that `ulimit -f` does not let grow.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    secure_standard_streams();
    return parse_and_do(argc, argv);
  } catch (const std::exception& e) {
    print_error(marked(Hue::bad, "zwang:") + " " + e.what() + "\n");
  } catch (...) {
    print_error(marked(Hue::bad, "zwang:") + " an unknown error\n");
  }
  return exit_impossible;
}
