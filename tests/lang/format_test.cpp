// The layout: what it looks like, that it changes nothing else, and that laying out twice is laying out once.
#include "zwang/lang/format.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "program_text.hpp"
#include "support.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> formatted(const std::string& text) {
  const test::Folder folder;
  Diagnostics diagnostics;
  return format_file(folder.write("file.yaml", text), diagnostics);
}

void expect_layout(const std::string& before, const std::string& after) {
  EXPECT_EQ(formatted(before).value_or("refused"), after);
  EXPECT_EQ(formatted(after).value_or("refused"), after) << "not stable";
}

TEST(Format, indents_by_two) {
  expect_layout("a:\n    b:\n       c: 1\n    d: 2\n", "a:\n  b:\n    c: 1\n  d: 2\n");
}

TEST(Format, indents_items_of_lists) {
  expect_layout("exits:\n- when: a\n  goto: b\n-   {when: c}\n-\n     when: d\n",
                "exits:\n  - when: a\n    goto: b\n  - {when: c}\n  -\n    when: d\n");
  expect_layout("a:\n- - 1\n  - 2\n- 3\n", "a:\n  - - 1\n    - 2\n  - 3\n");
}

TEST(Format, puts_one_space_where_one_belongs) {
  expect_layout("a:   { b : [ 1 m,2 m ] ,c:  'x: {y' }\n", "a: {b: [1 m, 2 m], c: 'x: {y'}\n");
  expect_layout("a: {}\nb: [ ]\n", "a: {}\nb: []\n");
}

TEST(Format, leaves_values_as_they_are) {
  expect_layout("when: a  <  2 s   and b\nq: \"x  \\\" # y\"\n",
                "when: a  <  2 s   and b\nq: \"x  \\\" # y\"\n");
}

TEST(Format, keeps_a_written_null) {
  expect_layout("null x: 1\na:   null\nb:   [ ~,Null ]\nc:\n-   NULL\n-\ne: # of e\n    ~\n",
                "null x: 1\na: null\nb: [~, Null]\nc:\n  - NULL\n  -\ne:  # of e\n    ~\n");
}

TEST(Format, keeps_blank_lines_inside_a_text) {
  expect_layout("about: one\n\n\n\n    two\n\n\n\nb: 1\n", "about: one\n\n\n\n    two\n\nb: 1\n");
}

TEST(Format, keeps_comments_and_where_they_belong) {
  expect_layout(
      "# head\n\n\n\na:   # of a\n      # of b\n      b: 1\n      c: 22   # of c\n      d: 3 # of d\n      # "
      "the end of a\n# of e\ne: 1\n  # last\n",
      "# head\n\na:  # of a\n  # of b\n  b: 1\n  c: 22  # of c\n  d: 3   # of d\n  # the end of a\n# of "
      "e\ne: 1\n# last\n");
}

TEST(Format, keeps_columns_that_the_author_aligned) {
  expect_layout("a:\n    x:   {force: 1 N}\n    y:   {velocity: 0 m/s}\n    rz:  free\n",
                "a:\n  x:  {force: 1 N}\n  y:  {velocity: 0 m/s}\n  rz: free\n");
  expect_layout("a:\n  x:   1\n  rz: 2\n", "a:\n  x: 1\n  rz: 2\n");
}

TEST(Format, moves_what_goes_on_in_the_next_line_with_its_first) {
  expect_layout("a:\n    when: x > 1 s\n        and y   # why\n    p: [[1, 2],\n        [3, 4]]\n",
                "a:\n  when: x > 1 s\n      and y  # why\n  p: [[1, 2],\n      [3, 4]]\n");
  expect_layout("a:\n      p: {x: 1,\n  y: 2}\n", "a:\n  p: {x: 1,\n    y: 2}\n");
}

TEST(Format, ends_with_one_line_end) {
  expect_layout("\n\na: 1\r\nb: 2  \n\n\n", "a: 1\nb: 2\n");
  expect_layout("---\na: 1", "---\na: 1\n");
}

TEST(Format, refuses_what_it_cannot_read) {
  EXPECT_FALSE(formatted("a: [1\n"));
  EXPECT_FALSE(formatted("a: 'x\n"));
  EXPECT_FALSE(formatted("a: 1\na: 2\n"));
  EXPECT_FALSE(formatted(""));
}

/// Whatever ships, the drafts beside the checkout where they are, and every file of the golden suite.
std::vector<std::string> files() {
  std::vector<std::string> found;
  for (const char* folder : {"specs", "tests/conformance", "../shared/cases"}) {
    if (!fs::exists(test::source_dir / folder)) continue;
    for (const auto& file : fs::recursive_directory_iterator(test::source_dir / folder)) {
      if (file.path().extension() == ".yaml") found.push_back(file.path().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

class FormatFile : public testing::TestWithParam<std::string> {};

/// The program of a task file, read as if it lay beside `original`; empty when it is none.
std::string program_of(const std::string& text, const fs::path& original) {
  const test::Folder folder;
  const bool is_draft = original.string().find("shared/cases") != std::string::npos;
  const fs::path robots = is_draft ? test::source_dir / "specs/robots" : original.parent_path() / "robots";
  if (fs::exists(robots)) fs::copy(robots, folder.path() / "robots", fs::copy_options::recursive);
  for (const char* beside : {"scenes", "partners"}) {
    const fs::path of_it = original.parent_path() / beside;
    if (fs::exists(of_it)) fs::copy(of_it, folder.path() / beside, fs::copy_options::recursive);
  }
  Diagnostics diagnostics;
  const auto program = load(folder.write("file.yaml", text), {}, diagnostics);
  return program ? test::ProgramText(*program).text() : std::string();
}

TEST_P(FormatFile, means_the_same_and_stays) {
  Diagnostics diagnostics;
  const std::optional<std::string> once = format_file(GetParam(), diagnostics);
  if (!once) {
    EXPECT_TRUE(diagnostics.has_errors());
    return;
  }
  EXPECT_EQ(formatted(*once), once) << "not stable";
  const std::string text = test::slurp(GetParam());
  if (*once != text) {
    EXPECT_EQ(program_of(*once, GetParam()), program_of(text, GetParam()));
  }
}

std::string name_of(const std::string& path) {
  std::string name = fs::relative(path, test::source_dir).string();
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Files, FormatFile, testing::ValuesIn(files()),
                         [](const auto& file) { return name_of(file.param); });

TEST(Format, leaves_shipped_files_as_they_are) {
  int count = 0;
  for (const auto& file : fs::recursive_directory_iterator(test::source_dir / "specs")) {
    if (file.path().extension() != ".yaml") continue;
    Diagnostics diagnostics;
    EXPECT_EQ(format_file(file.path(), diagnostics).value_or("refused"), test::slurp(file.path()))
        << file.path();
    ++count;
  }
  EXPECT_GE(count, 3);
}

/// Lines as far again from the left: YAML means the same by them.
std::string indented_twice(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indentation = std::min(line.find_first_not_of(' '), line.size());
    const bool is_item = line.compare(indentation, 2, "- ") == 0;
    if (is_item) line.insert(indentation + 1, "  ");
    result += std::string(indentation, ' ') + line + '\n';
  }
  return result;
}

TEST(Format, gives_shipped_tasks_their_program_back) {
  int tasks = 0;
  for (const auto& file : fs::directory_iterator(test::source_dir / "specs")) {
    if (file.path().extension() != ".yaml") continue;
    const std::string text = test::slurp(file.path()), deformed = indented_twice(text);
    const std::optional<std::string> laid_out = formatted(deformed);
    ASSERT_TRUE(laid_out) << file.path();
    EXPECT_LT(laid_out->size(), deformed.size());
    const std::string program = program_of(*laid_out, file.path());
    EXPECT_FALSE(program.empty()) << file.path();
    EXPECT_EQ(program, program_of(text, file.path()));
    ++tasks;
  }
  EXPECT_GE(tasks, 10);
}

}  // namespace
}  // namespace zwang::lang
