// The catalogue of explanations, docs/errors, the golden texts and the code that emits: all speak of the same
// codes. The examples are run: each shows its code and nothing else, and mended it shows nothing at all.
// To write the list of codes, docs/errors/README.md, anew, run this test with ZWANG_WRITE_EXPECTED=1.
#include "zwang/lang/explanation.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <set>

#include "limits.hpp"
#include "support.hpp"
#include "zwang/lang/notes.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

const fs::path pages = test::source_dir / "docs/errors";

std::set<std::string> explained_codes() {
  std::set<std::string> codes;
  for (const Explanation& e : explanations()) codes.emplace(e.code);
  return codes;
}

/// Codes that stand as literals in the sources that emit.
std::set<std::string> emitted_codes() {
  const std::regex code("\"([EWN][0-9]{3})\"");
  std::set<std::string> codes;
  for (const char* room : {"lang", "runtime"}) {
    for (const auto& file : fs::recursive_directory_iterator(test::source_dir / room)) {
      const bool is_source = file.path().extension() == ".cpp" || file.path().extension() == ".hpp";
      if (!is_source || file.path().parent_path().filename() == "explain") continue;
      const std::string text = test::slurp(file.path());
      for (std::sregex_iterator at(text.begin(), text.end(), code), end; at != end; ++at)
        codes.insert((*at)[1]);
    }
  }
  return codes;
}

TEST(Explanations, are_sorted_and_whole) {
  std::set<std::string> seen;
  for (const Explanation& e : explanations()) {
    EXPECT_TRUE(seen.emplace(e.code).second) << e.code << " is explained twice";
    EXPECT_TRUE(std::regex_match(std::string(e.code), std::regex("[EWN][0-9]{3}"))) << e.code;
    EXPECT_FALSE(e.title.empty() || e.why.empty() || e.fix.empty()) << e.code;
    EXPECT_FALSE(e.title.ends_with(".")) << e.code;
    EXPECT_EQ(e.example.empty(), e.instead.empty()) << e.code;
    EXPECT_EQ(e.example.empty(), e.part == ExcerptOf::nothing) << e.code;
  }
}

TEST(Explanations, are_found_by_code) {
  ASSERT_NE(find_explanation("E201"), nullptr);
  EXPECT_EQ(find_explanation("e201"), find_explanation("E201"));
  EXPECT_EQ(find_explanation("E999"), nullptr);
  EXPECT_EQ(find_explanation(""), nullptr);
}

TEST(Explanations, cover_exactly_what_the_program_can_say) {
  const std::set<std::string> emitted = emitted_codes();
  ASSERT_GT(emitted.size(), 50u);
  EXPECT_EQ(explained_codes(), emitted);
}

TEST(Explanations, are_the_pages_of_the_documentation) {
  for (const Explanation& e : explanations()) {
    const fs::path page = pages / (std::string(e.code) + ".md");
    EXPECT_EQ(explanation_page(e), test::slurp(page)) << page << " has other parts, or another order";
  }
  if (std::getenv("ZWANG_WRITE_EXPECTED") != nullptr)
    std::ofstream(pages / "README.md") << explanation_index();
  EXPECT_EQ(explanation_index(), test::slurp(pages / "README.md"));
  std::set<std::string> found;
  for (const auto& file : fs::directory_iterator(pages)) found.insert(file.path().stem().string());
  found.erase("README");
  EXPECT_EQ(found, explained_codes());
}

/// Read from the documentation: whatever it promises to say is shown by a file in tests/conformance.
TEST(Explanations, each_page_has_a_golden_text) {
  std::map<std::string, int> shown;
  for (const auto& file : fs::directory_iterator(test::source_dir / "tests/conformance")) {
    if (file.path().extension() != ".expected") continue;
    const std::string text = test::slurp(file.path());
    const std::regex code("(error|warning|note) ([EWN][0-9]{3}): ");
    for (std::sregex_iterator at(text.begin(), text.end(), code), end; at != end; ++at) ++shown[(*at)[2]];
  }
  for (const auto& file : fs::directory_iterator(pages)) {
    const std::string code = file.path().stem().string();
    if (code == "README") continue;
    EXPECT_GT(shown[code], 0) << "no golden text shows " << code;
  }
}

/// A near miss is a file that nearly shows the code and must not. It is the fixed example, a file at the
/// limit, or a good file in tests/conformance with the code in its name.
TEST(Explanations, each_page_has_a_near_miss) {
  std::string names;
  for (const auto& file : fs::directory_iterator(test::source_dir / "tests/conformance")) {
    if (file.path().extension() != ".expected" || test::slurp(file.path()) != "ok\n") continue;
    names += file.path().stem().string() + "\n";
  }
  std::set<std::string> limits;
  for (const test::Limit& limit : test::limits()) limits.insert(limit.code);
  for (const Explanation& e : explanations()) {
    const std::string code(e.code);
    const bool has_one =
        !e.instead.empty() || limits.contains(code) || names.find("ok_" + code) != std::string::npos;
    EXPECT_TRUE(has_one) << "no near miss of " << code;
  }
}

struct Key {
  std::string name;
  std::string text;
};

/// The excerpt, and for every key that it leaves out the smallest text that works.
std::string completed(std::string_view excerpt, const std::vector<Key>& keys) {
  std::string text(excerpt);
  text += "\n";
  std::string before;
  for (const Key& key : keys) {
    const bool is_given =
        text.starts_with(key.name + ":") || text.find("\n" + key.name + ":") != std::string::npos;
    if (!is_given) before += key.text + "\n";
  }
  return before + text;
}

std::string indented(std::string_view text, std::size_t by) {
  std::string result;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) result += std::string(by, ' ') + line + "\n";
  return result;
}

std::string task_file(std::string_view excerpt) {
  return completed(excerpt,
                   {{"zwang", "zwang: 1"},
                    {"robot", "robot: robots/mini.yaml"},
                    {"start", "start: go"},
                    {"tasks",
                     "tasks:\n  go:\n    constraints:\n      contact: {move: base_link, in: base_link, x: "
                     "{velocity: 0.1 m/s}}\n    timeout: {after: 10 s, goto: failed}"}});
}

std::string task(std::string_view excerpt) {
  const std::string keys = completed(
      excerpt,
      {{"constraints", "constraints:\n  contact: {move: base_link, in: base_link, x: {velocity: 0.1 m/s}}"}});
  const bool ends = keys.find("exits:") != std::string::npos || keys.find("timeout:") != std::string::npos;
  return task_file("tasks:\n  go:\n" +
                   indented(keys + (ends ? "" : "timeout: {after: 10 s, goto: failed}\n"), 4));
}

std::string group(std::string_view excerpt) {
  std::string keys = completed(excerpt, {{"move", "move: base_link"}, {"in", "in: base_link"}});
  if (keys.find("x:") == std::string::npos && keys.find("y:") == std::string::npos &&
      keys.find("z:") == std::string::npos) {
    keys += "x: {velocity: 0.1 m/s}\n";
  }
  return task("constraints:\n  contact:\n" + indented(keys, 4));
}

std::string robot(std::string_view excerpt, const std::string& urdf) {
  return completed(excerpt,
                   {{"zwang_robot", "zwang_robot: 1"},
                    {"urdf", "urdf: " + urdf},
                    {"base", "base: base_link"},
                    {"wheels", "wheels: [{joint: left, radius: 0.1 m}, {joint: right, radius: 0.1 m}]"},
                    {"actuated", "actuated: {left: {}, right: {}}"},
                    {"stop", "stop: {deceleration: 1 m/s^2, force: 50 N}"},
                    {"footprint", "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0 m], [0.3 m, -0.2 m]]}"}});
}

/// The link or joint of the excerpt in the place of the one of that name.
std::string urdf(std::string_view excerpt) {
  std::string text = test::slurp(test::source_dir / "tests/conformance/robots/mini.urdf");
  const std::string element(excerpt.substr(1, excerpt.find(' ') - 1));
  const std::string opening(excerpt.substr(0, excerpt.find('"', excerpt.find('"') + 1)));
  const std::size_t begin = text.find(opening);
  const std::string closing = "</" + element + ">";
  const std::size_t end = text.find(closing, begin) + closing.size();
  return text.replace(begin, end - begin, excerpt);
}

/// The diagnostics of an excerpt.
Diagnostics said_about(ExcerptOf part, std::string_view excerpt, bool with_notes) {
  const auto load_as_wanted = with_notes ? load_with_notes : load;
  const test::Folder folder;
  const fs::path robots = test::source_dir / "tests/conformance/robots";
  folder.write("robots/mini.yaml", test::slurp(robots / "mini.yaml"));
  folder.write("robots/mini_rubs.yaml", test::slurp(robots / "mini_rubs.yaml"));
  folder.write("robots/mini.urdf", test::slurp(robots / "mini.urdf"));
  Diagnostics diagnostics;
  switch (part) {
    case ExcerptOf::nothing:
      break;
    case ExcerptOf::whole:
      load_as_wanted(folder.write("task.yaml", std::string(excerpt)), {}, diagnostics);
      break;
    case ExcerptOf::task_file:
      load_as_wanted(folder.write("task.yaml", task_file(excerpt)), {}, diagnostics);
      break;
    case ExcerptOf::task:
      load_as_wanted(folder.write("task.yaml", task(excerpt)), {}, diagnostics);
      break;
    case ExcerptOf::group:
      load_as_wanted(folder.write("task.yaml", group(excerpt)), {}, diagnostics);
      break;
    case ExcerptOf::robot:
      load_robot(folder.write("robot.yaml", robot(excerpt, "robots/mini.urdf")), diagnostics);
      break;
    case ExcerptOf::urdf:
      folder.write("made.urdf", urdf(excerpt));
      load_robot(folder.write("robot.yaml", robot("", "made.urdf")), diagnostics);
      break;
    case ExcerptOf::scene:
      load_scene(folder.write("scene.yaml", "zwang_scene: 1\n" + std::string(excerpt) + "\n"), diagnostics);
      break;
  }
  return diagnostics;
}

std::vector<Explanation> with_examples() {
  std::vector<Explanation> result;
  for (const Explanation& e : explanations()) {
    if (!e.example.empty()) result.push_back(e);
  }
  return result;
}

class Example : public testing::TestWithParam<Explanation> {};

TEST_P(Example, shows_its_code_and_nothing_else) {
  const Diagnostics diagnostics = said_about(GetParam().part, GetParam().example, GetParam().code[0] == 'N');
  EXPECT_EQ(test::count(diagnostics, std::string(GetParam().code)), 1) << test::rendered(diagnostics);
  EXPECT_EQ(diagnostics.all().size(), 1u) << test::rendered(diagnostics);
}

TEST_P(Example, is_good_once_mended) {
  const Diagnostics diagnostics = said_about(GetParam().part, GetParam().instead, GetParam().code[0] == 'N');
  EXPECT_TRUE(diagnostics.all().empty()) << test::rendered(diagnostics);
}

INSTANTIATE_TEST_SUITE_P(Of, Example, testing::ValuesIn(with_examples()),
                         [](const auto& example) { return std::string(example.param.code); });

}  // namespace
}  // namespace zwang::lang
