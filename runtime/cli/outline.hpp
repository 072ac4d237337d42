/// The verbs and options of the program, as data: completions of three shells and the manual page are printed
/// from it.
#pragma once

#include <string>
#include <vector>

namespace zwang::cli {

struct OptionOutline {
  std::vector<std::string> names;  ///< `-o`, `--out`; of a positional argument its one name
  std::string help;
  bool takes_value = false;
};

struct VerbOutline {
  std::string name, help;
  std::vector<OptionOutline> arguments, options;
  std::vector<VerbOutline> verbs;
};

enum class OutlineForm { bash, zsh, fish, man };

/// The outline as a completion script, or as a manual page in roff.
std::string render(const VerbOutline& program, OutlineForm form);

}  // namespace zwang::cli
