// docs/language.md is true. Each block of it is accepted, or is refused in the words of the page. No key of
// the schemas is missing. A block names its part of a file after its language. The rest of the file is
// supplied here.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "../page_blocks.hpp"
#include "support.hpp"
#include "words/units.hpp"
#include "zwang/lang/condition_function.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/lang/schema.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

using zwang::test::PageBlock;

std::vector<PageBlock> blocks(const std::string& page) {
  return zwang::test::page_blocks(test::source_dir / page);
}

std::string indented(const std::string& text, std::size_t by) {
  std::string result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result += std::string(by, ' ') + line + "\n";
  return result;
}

bool has_key(const std::string& text, const std::string& key) {
  return text.starts_with(key + ":") || text.find("\n" + key + ":") != std::string::npos;
}

/// The names that excerpts may use without declaring them.
std::string task_file(std::string text) {
  std::string before;
  if (!has_key(text, "zwang")) before += "zwang: 1\n";
  if (!has_key(text, "robot")) before += "robot: robots/mecanum_base.yaml\n";
  if (!has_key(text, "frames")) before += "frames: {goal: {parent: world, at: [2 m, 0 m]}}\n";
  if (!has_key(text, "regions"))
    before += "regions: {corridor: {polygon: [[-1 m, -2 m], [8 m, -2 m], [8 m, 2 m], [-1 m, 2 m]]}}\n";
  if (!has_key(text, "tasks")) text += "tasks:\n  go:\n    timeout: {after: 1 s, goto: done}\n";
  std::smatch first;
  if (!has_key(text, "start") && std::regex_search(text, first, std::regex("tasks:\n  (\\w+):")))
    before += "start: " + first[1].str() + "\n";
  return before + text;
}

std::string task(std::string text) {
  if (!has_key(text, "exits") && !has_key(text, "timeout")) text += "timeout: {after: 10 s, goto: failed}\n";
  return task_file("tasks:\n  go:\n" + indented(text, 4));
}

std::string group(const std::string& text) {
  return task("constraints:\n  contact:\n    move: base_link\n    in: base_link\n" + indented(text, 4));
}

/// The diagnostics of a block that stands where the shipped files stand.
Diagnostics said_about(const PageBlock& block, const test::Folder& folder) {
  const std::string part = block.kind.substr(block.kind.rfind(' ') + 1);
  Diagnostics diagnostics;
  if (part == "robot") {
    const bool is_whole = has_key(block.text, "zwang_robot");
    const std::string rest = is_whole ? "" : test::slurp(folder.path() / "robots/mecanum_base.yaml");
    load_robot(folder.write("robots/mine.yaml", rest + block.text), diagnostics);
  } else if (part == "scene") {
    const std::string version = has_key(block.text, "zwang_scene") ? "" : "zwang_scene: 1\n";
    load_scene(folder.write("mine.yaml", version + block.text), diagnostics);
  } else if (part == "study") {
    load_study(folder.write("mine.yaml", block.text), diagnostics);
  } else if (part == "scenario") {
    check_scenario(folder.write("mine.yaml", block.text), diagnostics);
  } else {
    std::string text = task_file(block.text);
    if (part == "tasks") text = task_file("tasks:\n" + block.text);
    if (part == "task") text = task(block.text);
    if (part == "group") text = group(block.text);
    load(folder.write("mine.yaml", text), {}, diagnostics);
  }
  return diagnostics;
}

class LanguagePage : public testing::Test {
 protected:
  void SetUp() override {
    fs::copy(test::source_dir / "specs", folder_.path(),
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }
  test::Folder folder_;
};

/// An excerpt may leave a name unused (W302), and is good otherwise.
TEST_F(LanguagePage, each_block_is_good) {
  int tried = 0;
  for (const std::string page : {"docs/language.md", "docs/concepts.md", "docs/tutorial_4.md"}) {
    for (const PageBlock& block : blocks(page)) {
      if (!block.kind.starts_with("yaml") || block.kind.find("mistake") != std::string::npos) continue;
      const Diagnostics diagnostics = said_about(block, folder_);
      const int unused = test::count(diagnostics, "W302");
      EXPECT_EQ(diagnostics.all().size(), static_cast<std::size_t>(unused))
          << page << ":" << block.line << "\n"
          << test::rendered(diagnostics);
      ++tried;
    }
  }
  EXPECT_GT(tried, 20);
}

/// The block after a mistake holds the words of the diagnostic, a line each.
TEST_F(LanguagePage, each_mistake_is_refused_in_these_words) {
  const std::vector<PageBlock> all = blocks("docs/language.md");
  int tried = 0;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i].kind.find("mistake") == std::string::npos) continue;
    const std::string said = test::rendered(said_about(all[i], folder_));
    std::istringstream words(all[i + 1].text);
    for (std::string line; std::getline(words, line);)
      EXPECT_NE(said.find(line), std::string::npos) << "docs/language.md:" << all[i + 1].line << " " << said;
    ++tried;
  }
  EXPECT_GT(tried, 0);
}

void gather_keys(const nlohmann::json& node, std::set<std::string>& keys) {
  if (node.is_object() && node.contains("properties") && node["properties"].is_object()) {
    for (const auto& [key, value] : node["properties"].items()) keys.insert(key);
  }
  if (node.is_object() && node.contains("enum")) {
    for (const auto& word : node["enum"]) {
      if (word.is_string()) keys.insert(word.get<std::string>());
    }
  }
  for (const auto& child : node) {
    if (child.is_structured()) gather_keys(child, keys);
  }
}

/// The words of the page's code: every second piece between backquotes, of one or of three.
std::set<std::string> words_of_code() {
  std::set<std::string> words;
  std::istringstream page(test::slurp(test::source_dir / "docs/language.md"));
  const std::regex word("[A-Za-z_]+");
  bool is_code = false;
  for (std::string piece; std::getline(page, piece, '`'); is_code = !is_code) {
    if (!is_code) continue;
    for (std::sregex_iterator at(piece.begin(), piece.end(), word), end; at != end; ++at)
      words.insert(at->str());
  }
  return words;
}

TEST(LanguageOfThePage, has_every_key_and_word_of_the_schemas) {
  const std::set<std::string> written = words_of_code();
  for (const FileKind kind :
       {FileKind::task, FileKind::robot, FileKind::scene, FileKind::scenario, FileKind::study}) {
    std::set<std::string> keys;
    gather_keys(nlohmann::json::parse(json_schema(kind)), keys);
    EXPECT_GT(keys.size(), 10u);
    for (const std::string& key : keys) {
      const std::size_t word = key.find_first_not_of('-');  // of `-x`
      EXPECT_TRUE(written.contains(key.substr(word))) << key;
    }
  }
}

/// The keys of a schema, without the words that are values.
void gather_properties(const nlohmann::json& schema, std::set<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties")) {
    for (const auto& [key, value] : schema["properties"].items()) keys.insert(key);
  }
  for (const auto& part : schema) {
    if (part.is_structured()) gather_properties(part, keys);
  }
}

/// `#the-base's-own-pose` of `### The base's own pose`, as pages of repositories make it.
std::set<std::string> headings_of(const std::string& page) {
  std::set<std::string> anchors;
  std::istringstream lines(page);
  bool is_code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (is_code || !line.starts_with("##")) continue;
    std::string anchor = "#";
    for (const char c : line.substr(line.find(' ') + 1)) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0)
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      if (c == ' ' || c == '-' || c == '_') anchor += c == ' ' ? '-' : c;
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(LanguageOfThePage, has_an_index_of_every_key_whose_links_lead_to_sections) {
  const std::string page = test::slurp(test::source_dir / "docs/language.md");
  std::string index = page.substr(page.find("\n## Index\n"));
  std::replace(index.begin(), index.end(), '\n', ' ');
  std::set<std::string> keys;
  for (const FileKind kind :
       {FileKind::task, FileKind::robot, FileKind::scene, FileKind::scenario, FileKind::study})
    gather_properties(nlohmann::json::parse(json_schema(kind)), keys);
  EXPECT_GT(keys.size(), 150u);
  for (const std::string& key : keys)
    EXPECT_NE(index.find("`" + key + "` ["), std::string::npos) << key << " is not in the index";
  const std::set<std::string> headings = headings_of(page);
  const std::regex link("\\]\\((#[^)]*)\\)");
  for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at)
    EXPECT_TRUE(headings.contains((*at)[1])) << (*at)[1] << " is no section";
}

/// The line of the page's table, as the table of the functions has it.
std::string row_of(const ConditionFunction& function) {
  static constexpr std::array arguments{"x", "signal", "frame", "task", "path"};
  const std::string argument = arguments[static_cast<std::size_t>(function.argument)];
  const auto& p = function.powers;
  const std::string what = describe(Dimension{p[0], p[1], p[2], p[3]});
  std::string measures = what.substr(what.find(' ') + 1);
  if (function.is_truth) measures = "true or false";
  if (function.argument == FunctionArgument::number) measures = "as `x`";
  return "| `" + std::string(function.name) + "(" + argument + ")` | " + measures + " | " +
         std::string(function.of) + " |\n";
}

TEST(LanguageOfThePage, has_the_line_of_each_function) {
  const std::string page = test::slurp(test::source_dir / "docs/language.md");
  for (const ConditionFunction& function : condition_functions())
    EXPECT_NE(page.find(row_of(function)), std::string::npos) << "the page lacks\n" << row_of(function);
}

TEST(ConditionFunctions, are_all_in_the_list_that_an_unknown_one_is_answered_with) {
  const std::string list = list_of_functions();
  for (const ConditionFunction& function : condition_functions())
    EXPECT_NE(list.find(std::string(function.name) + "("), std::string::npos) << list;
}

TEST(LanguageOfThePage, has_exactly_the_units_that_are_known) {
  const std::string page = test::slurp(test::source_dir / "docs/language.md");
  const std::string table = page.substr(page.find("| dimension | units |"));
  std::istringstream rows(table.substr(0, table.find("\n\n")));
  std::set<std::string> on_page;
  for (std::string row; std::getline(rows, row);) {
    const std::size_t begin = row.find('`');
    if (begin == std::string::npos) continue;
    std::istringstream words(row.substr(begin + 1, row.find('`', begin + 1) - begin - 1));
    for (std::string unit; words >> unit;) on_page.insert(unit);
  }
  const std::vector<std::string> known = unit_names();
  EXPECT_EQ(on_page, std::set<std::string>(known.begin(), known.end()));
}

}  // namespace
}  // namespace zwang::lang
