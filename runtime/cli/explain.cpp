#include "output.hpp"
#include "verbs.hpp"
#include "zwang/lang/explanation.hpp"

namespace zwang::cli {

namespace {

void explain_all(bool as_markdown) {
  std::string text;
  if (as_markdown) text = lang::explanation_index();
  for (const lang::Explanation& explanation : lang::explanations()) {
    if (as_markdown) {
      text += "\n" + lang::explanation_page(explanation);
    } else {
      text += std::string(explanation.code) + "  " + std::string(explanation.title) + "\n";
    }
  }
  print(text);
}

}  // namespace

int explain(const ExplainArguments& arguments) {
  if (arguments.all) {
    explain_all(arguments.markdown);
    return exit_good;
  }
  std::string text;
  for (const std::string& code : arguments.codes) {
    const lang::Explanation* explanation = lang::find_explanation(code);
    if (explanation == nullptr) {
      throw Impossible("there is no code `" + code + "`; `zwang explain --all` lists the codes");
    }
    if (!text.empty()) text += "\n";
    text += arguments.markdown ? lang::explanation_page(*explanation) : lang::explanation_text(*explanation);
  }
  if (text.empty()) throw Impossible("explain what? Give a code, as E201, or --all");
  print(text);
  return exit_good;
}

}  // namespace zwang::cli
