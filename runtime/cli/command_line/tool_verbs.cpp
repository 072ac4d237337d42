// The verbs around the files: the machine, editors, shells.
#include <memory>

#include "command_line/command_line.hpp"
#include "outline.hpp"
#include "output.hpp"

namespace zwang::cli {

namespace {

/// A verb that takes nothing.
CLI::App* add_plain(CLI::App& app, Chosen& chosen, const char* name, const char* words, int (*verb)()) {
  CLI::App* added = app.add_subcommand(name, words);
  added->callback([&chosen, verb] { chosen = verb; });
  return added;
}

OptionOutline outline_of(const CLI::Option& option) {
  OptionOutline outline{{}, option.get_description(), option.get_items_expected_max() > 0};
  for (const std::string& name : option.get_snames()) outline.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) outline.names.push_back("--" + name);
  if (outline.names.empty()) outline.names.push_back(option.get_name(true));
  return outline;
}

VerbOutline outline_of(const CLI::App& verb) {
  VerbOutline outline{verb.get_name(), verb.get_description(), {}, {}, {}};
  for (const CLI::Option* option : verb.get_options()) {
    (option->get_positional() ? outline.arguments : outline.options).push_back(outline_of(*option));
  }
  for (const CLI::App* inner : verb.get_subcommands({})) outline.verbs.push_back(outline_of(*inner));
  return outline;
}

void add_completion(CLI::App& app, Chosen& chosen) {
  static const std::map<std::string, OutlineForm> forms = {{"bash", OutlineForm::bash},
                                                           {"zsh", OutlineForm::zsh},
                                                           {"fish", OutlineForm::fish},
                                                           {"man", OutlineForm::man}};
  const auto form = std::make_shared<OutlineForm>();
  CLI::App* verb = app.add_subcommand("completion", "Print the completions of a shell, or the manual page");
  takes(verb->add_option("form", *form, "bash, zsh, fish or man")->required(), forms);
  verb->callback([=, &app, &chosen] {
    chosen = [=, &app] {
      print(render(outline_of(app), *form));
      return exit_good;
    };
  });
}

}  // namespace

void add_tool_verbs(CLI::App& app, Chosen& chosen) {
  add_plain(app, chosen, "doctor", "Say what this machine offers, and how to get what is missing", doctor);
  add_plain(app, chosen, "lsp", "Be a language server, which an editor starts and speaks with over stdio",
            lsp)
      ->add_flag("--stdio")
      ->description("as it does anyway; some editors say it");
  add_completion(app, chosen);
}

}  // namespace zwang::cli
