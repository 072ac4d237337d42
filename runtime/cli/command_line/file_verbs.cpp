// The verbs that read files; they move nothing.
#include <memory>

#include "command_line/command_line.hpp"
#include "shipped.hpp"

namespace zwang::cli {

namespace {

/// Each verb adds its options and, when it is the one, says what to do.
void add_validate(CLI::App& app, Chosen& chosen) {
  static const std::map<std::string, ReportFormat> report_formats = {{"human", ReportFormat::human},
                                                                     {"short", ReportFormat::one_line},
                                                                     {"json", ReportFormat::json},
                                                                     {"sarif", ReportFormat::sarif}};
  const auto arguments = std::make_shared<ValidateArguments>();
  const auto deny = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand(
      "validate", "Check task, robot, scene, scenario, connection and study files without running them");
  verb->add_option(
          "files", arguments->files,
          "files, whose first key tells what they are, or folders of such files; `-`: the standard input")
      ->required();
  verb->add_option("--stdin-path", arguments->stdin_path, "the file that the text of `-` belongs to");
  takes(verb->add_option("--format", arguments->format,
                         "human (default), short (a line each), json (one object) or sarif (2.1.0)"),
        report_formats);
  verb->add_option("--deny", *deny, "warnings: refuse files with warnings, too")
      ->check(CLI::IsMember({"warnings"}));
  verb->add_flag("--notes", arguments->notes, "show notes as well");
  verb->add_option("--task", arguments->task, "check connection files against this task and its robot");
  add_overrides(*verb, arguments->overrides);
  verb->callback([=, &chosen] {
    arguments->deny_warnings = !deny->empty();
    for (std::string& file : arguments->files) file = file_or_shipped(file);
    if (arguments->task) arguments->task = file_or_shipped(*arguments->task);
    chosen = [=] { return validate(*arguments); };
  });
}

void add_explain(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<ExplainArguments>();
  CLI::App* verb = app.add_subcommand("explain", "Say what a diagnostic means and what to do about it");
  verb->add_option("codes", arguments->codes, "codes, as E201");
  verb->add_flag("--all", arguments->all, "list all codes; with --markdown all pages");
  verb->add_flag("--markdown", arguments->markdown, "the pages of docs/errors");
  verb->callback([=, &chosen] { chosen = [=] { return explain(*arguments); }; });
}

void add_fmt(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<FmtArguments>();
  CLI::App* verb = app.add_subcommand("fmt", "Lay files out anew; comments, order and meaning stay");
  verb->add_option("files", arguments->files, "files of any kind of zwang's")->required();
  verb->add_flag("--check", arguments->check, "change nothing; tell which files would change");
  verb->add_flag("--upgrade", arguments->upgrade, "write task files in the newest version of the language");
  verb->callback([=, &chosen] { chosen = [=] { return fmt(*arguments); }; });
}

void add_schema(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<SchemaArguments>();
  CLI::App* verb = app.add_subcommand("schema", "Print the JSON Schema of a kind of file, for editors");
  takes(verb->add_option("kind", arguments->kind,
                         "task (default), robot, scene, scenario, connection or study"),
        schema_kinds);
  verb->callback([=, &chosen] { chosen = [=] { return schema(*arguments); }; });
}

void add_graph(CLI::App& app, Chosen& chosen) {
  static const std::map<std::string, GraphFormat> graph_formats = {{"dot", GraphFormat::dot},
                                                                   {"mermaid", GraphFormat::mermaid}};
  const auto arguments = std::make_shared<GraphArguments>();
  CLI::App* verb = app.add_subcommand("graph", "Draw the tasks of a file and the ways between them");
  verb->add_option("file", arguments->file, "the task file")->required();
  add_overrides(*verb, arguments->overrides);
  takes(verb->add_option("--format", arguments->format, "dot (default, for Graphviz) or mermaid"),
        graph_formats);
  verb->callback([=, &chosen] {
    arguments->file = file_or_shipped(arguments->file);
    chosen = [=] { return graph(*arguments); };
  });
}

void add_plan(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<PlanArguments>();
  CLI::App* verb = app.add_subcommand("plan", "Show the rows of each task and what the robot makes of them");
  verb->add_option("file", arguments->file, "the task file")->required();
  verb->add_option("--task", arguments->task, "this task only");
  add_overrides(*verb, arguments->overrides);
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] {
    arguments->file = file_or_shipped(arguments->file);
    chosen = [=] { return plan(*arguments); };
  });
}

void add_init(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<InitArguments>();
  CLI::App* verb = app.add_subcommand("init", "Make a folder with a task, its robot, scene and scenario");
  verb->add_option("folder", arguments->folder, "a folder that is new or empty")->required();
  verb->callback([=, &chosen] { chosen = [=] { return init(*arguments); }; });
}

}  // namespace

void add_file_verbs(CLI::App& app, Chosen& chosen) {
  add_validate(app, chosen);
  add_explain(app, chosen);
  add_fmt(app, chosen);
  add_schema(app, chosen);
  add_graph(app, chosen);
  add_plan(app, chosen);
  add_init(app, chosen);
}

}  // namespace zwang::cli
