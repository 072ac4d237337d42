// The verbs that read the log of a run.
#include <memory>

#include "command_line/command_line.hpp"

namespace zwang::cli {

namespace {

void add_log(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<LogArguments>();
  CLI::App* verb = app.add_subcommand("log", "Write the records of a log as CSV");
  verb->add_option("run", arguments->run, "the folder of the run, or its .mcap file")->required();
  verb->add_flag("--csv")->description("as it does anyway");
  verb->add_option("-o,--out", arguments->out, "the file to write (default the standard output)");
  verb->callback([=, &chosen] { chosen = [=] { return zwang::cli::log(*arguments); }; });
}

void add_info(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* verb = app.add_subcommand("info", "Tell what is in the log of a run");
  verb->add_option("log", arguments->file, "the folder of the run, or its .mcap file")->required();
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] { chosen = [=] { return info(*arguments); }; });
}

void add_report(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* verb = app.add_subcommand("report", "Make a page of a run, or of two: one file, for any browser");
  verb->add_option("run", arguments->run, "the folder of the run, or its .mcap file")->required();
  verb->add_option("--compare", arguments->compare,
                   "another run: the page shows where the two part, with both in each curve and view");
  verb->add_option("-o,--out", arguments->out,
                   "the page to write (default report.html beside the log, or compare.html)");
  verb->callback([=, &chosen] { chosen = [=] { return report(*arguments); }; });
}

void add_replay(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* verb = app.add_subcommand("replay", "Compute the torques of a logged run again and compare");
  verb->add_option("log", arguments->file, "the folder of the run, or its .mcap file")->required();
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] { chosen = [=] { return replay(*arguments); }; });
}

}  // namespace

void add_log_verbs(CLI::App& app, Chosen& chosen) {
  add_log(app, chosen);
  add_info(app, chosen);
  add_report(app, chosen);
  add_replay(app, chosen);
}

}  // namespace zwang::cli
