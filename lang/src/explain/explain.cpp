#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "explain/pages.hpp"
#include "words/text.hpp"
#include "zwang/lang/explanation.hpp"

namespace zwang::lang {

namespace {

/// The words in the heading of an example that name the part of a file it shows.
struct Whereabouts {
  ExcerptOf part;
  std::string_view words;
};
constexpr std::array all_whereabouts{
    Whereabouts{ExcerptOf::whole, ""},
    Whereabouts{ExcerptOf::task_file, " (from a task file)"},
    Whereabouts{ExcerptOf::task, " (from a task)"},
    Whereabouts{ExcerptOf::group, " (from a constraint group)"},
    Whereabouts{ExcerptOf::robot, " (from a robot file)"},
    Whereabouts{ExcerptOf::urdf, " (from a URDF)"},
    Whereabouts{ExcerptOf::scene, " (from a scene file)"},
};

std::string_view whereabouts(ExcerptOf part) {
  for (const Whereabouts& known : all_whereabouts) {
    if (known.part == part) return known.words;
  }
  return "";
}

ExcerptOf part_of(std::string_view words) {
  for (const Whereabouts& known : all_whereabouts) {
    if (known.words == words) return known.part;
  }
  return ExcerptOf::nothing;
}

/// Returns the text before `mark`, and removes it and the mark from `text`. Without a mark it returns all of
/// `text`.
std::string_view take_before(std::string_view& text, std::string_view mark) {
  const std::size_t end = text.find(mark);
  const std::string_view before = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + mark.size());
  return before;
}

/// The parts of a page, as `explanation_page` puts them together.
Explanation read_page(std::string_view page) {
  Explanation e;
  take_before(page, "# ");
  e.code = take_before(page, ": ");
  e.title = take_before(page, "\n");
  take_before(page, "*\n\n");  // the severity
  if (page.find("\n## For example") == page.npos) {
    e.why = take_before(page, "\n\n## What to do\n\n");
    e.fix = page.substr(0, page.find_last_not_of('\n') + 1);
    return e;
  }
  e.why = take_before(page, "\n\n## For example");
  e.part = part_of(take_before(page, "\n"));
  take_before(page, "```");
  take_before(page, "\n");  // the language of the block
  e.example = take_before(page, "\n```\n\n## What to do\n\n");
  e.fix = take_before(page, "\n\n```");
  take_before(page, "\n");
  e.instead = take_before(page, "\n```\n");
  return e;
}

/// E and W of one number stand together: the number tells what a code is about.
std::vector<Explanation> sorted_by_number() {
  std::vector<Explanation> all;
  for (const std::string_view page : catalogue::pages()) all.push_back(read_page(page));
  const auto key = [](const Explanation& e) { return std::pair(e.code.substr(1), e.code); };
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

}  // namespace

std::span<const Explanation> explanations() {
  static const std::vector<Explanation> all = sorted_by_number();
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
    text += "\nFor example" + std::string(whereabouts(e.part)) + ":\n\n" + indented(e.example);
  }
  text += "\n" + std::string(e.fix) + "\n";
  if (!e.instead.empty()) text += "\nInstead:\n\n" + indented(e.instead);
  return text;
}

std::string explanation_page(const Explanation& e) {
  std::string page = "# " + std::string(e.code) + ": " + std::string(e.title) + "\n\n" + "*" +
                     severity_of(e.code) + "*\n\n" + std::string(e.why) + "\n";
  if (!e.example.empty()) {
    page += "\n## For example" + std::string(whereabouts(e.part)) + "\n\n" + fenced(e, e.example);
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
      "`validate --notes` show. `zwang explain CODE` prints these pages: the build puts them into the "
      "program.\n\n"
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
