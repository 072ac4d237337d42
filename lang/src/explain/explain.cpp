#include <algorithm>
#include <utility>
#include <vector>

#include "explain/catalogue.hpp"
#include "tree/text.hpp"

namespace zwang::lang {

namespace {

/// E and W of one number stand together: the number tells what a code is about.
std::string_view number_of(const Explanation& explanation) {
  return explanation.code.substr(1);
}

std::vector<Explanation> gathered() {
  std::vector<Explanation> all;
  for (const std::span<const Explanation> part :
       {catalogue::text(), catalogue::quantities(), catalogue::names(), catalogue::constraints(),
        catalogue::order(), catalogue::physics(), catalogue::reach(), catalogue::robots(), catalogue::urdfs(),
        catalogue::scenes(), catalogue::connections(), catalogue::studies()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  const auto key = [](const Explanation& e) { return std::pair(number_of(e), e.code); };
  std::sort(all.begin(), all.end(),
            [&key](const Explanation& a, const Explanation& b) { return key(a) < key(b); });
  return all;
}

const char* severity_of(std::string_view code) {
  return code[0] == 'E' ? "error" : code[0] == 'W' ? "warning" : "note";
}

std::string indented(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) result += "    ";
    result.append(text.substr(at, end - at)) += '\n';
    at = end + 1;
  }
  return result;
}

std::string fenced(const Explanation& explanation, std::string_view text) {
  const char* language = explanation.part == ExcerptOf::urdf ? "xml" : "yaml";
  return std::string("```") + language + "\n" + std::string(text) + "\n```\n";
}

const char* whereabouts(ExcerptOf part) {
  switch (part) {
    case ExcerptOf::nothing:
    case ExcerptOf::whole:
      return "";
    case ExcerptOf::task_file:
      return " (from a task file)";
    case ExcerptOf::task:
      return " (from a task)";
    case ExcerptOf::group:
      return " (from a constraint group)";
    case ExcerptOf::robot:
      return " (from a robot file)";
    case ExcerptOf::urdf:
      return " (from a URDF)";
    case ExcerptOf::scene:
      break;
  }
  return " (from a scene file)";
}

}  // namespace

std::span<const Explanation> explanations() {
  static const std::vector<Explanation> all = gathered();
  return all;
}

const Explanation* find_explanation(std::string_view code) {
  const std::string wanted = lower_case(code);
  for (const Explanation& explanation : explanations()) {
    if (lower_case(explanation.code) == wanted) return &explanation;
  }
  return nullptr;
}

std::string explanation_text(const Explanation& e) {
  std::string text = std::string(severity_of(e.code)) + " " + std::string(e.code) + ": " +
                     std::string(e.title) + "\n\n" + std::string(e.why) + "\n";
  if (!e.example.empty()) {
    text += std::string("\nFor example") + whereabouts(e.part) + ":\n\n" + indented(e.example);
  }
  text += "\n" + std::string(e.fix) + "\n";
  if (!e.instead.empty()) text += "\nInstead:\n\n" + indented(e.instead);
  return text;
}

std::string explanation_page(const Explanation& e) {
  std::string page = "# " + std::string(e.code) + ": " + std::string(e.title) + "\n\n" + "*" +
                     severity_of(e.code) + "*\n\n" + std::string(e.why) + "\n";
  if (!e.example.empty()) {
    page += std::string("\n## For example") + whereabouts(e.part) + "\n\n" + fenced(e, e.example);
  }
  page += "\n## What to do\n\n" + std::string(e.fix) + "\n";
  if (!e.instead.empty()) page += "\n" + fenced(e, e.instead);
  return page;
}

std::string explanation_index() {
  std::string page =
      "# Diagnostics\n\n"
      "Every message has a code that does not change. E refuses the file, W warns, N is a note that `plan` "
      "and\n"
      "`validate --notes` show. `zwang explain CODE` prints these pages; they are written by the program "
      "itself.\n\n"
      "A warning that is understood can be silenced on its line, with a reason: `# zwang: allow W503 it "
      "waits for\n"
      "the operator`. Errors cannot.\n\n"
      "| code | |\n|---|---|\n";
  for (const Explanation& e : explanations()) {
    const std::string code(e.code);
    page += "| [" + code + "](" + code + ".md) | " + std::string(e.title) + " |\n";
  }
  return page;
}

}  // namespace zwang::lang
