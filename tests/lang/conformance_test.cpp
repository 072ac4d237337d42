// Every file of tests/conformance with the exact text that it makes zwang say. To write the expectations anew
// after a deliberate change, run this test with ZWANG_WRITE_EXPECTED=1 and read the difference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "../many_axes.hpp"
#include "limits.hpp"
#include "support.hpp"
#include "zwang/lang/connection.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::lang {
namespace {

const std::filesystem::path folder = "tests/conformance";

std::vector<std::string> cases() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(test::source_dir / folder)) {
    if (file.path().extension() == ".yaml") names.push_back(file.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void load_as_named(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const std::string name = path.filename().string();
  bool is_good = false;
  if (name.starts_with("robot_")) {
    is_good = load_robot(path, diagnostics).has_value();
  } else if (name.starts_with("scene_")) {
    is_good = load_scene(path, diagnostics).has_value();
  } else if (name.starts_with("connection_")) {
    is_good = load_connection(path, diagnostics).has_value();
  } else if (name.starts_with("study_")) {
    is_good = load_study(path, diagnostics).has_value();
  } else if (name.starts_with("scenario_")) {
    is_good = check_scenario(path, diagnostics).has_value();
  } else {
    const bool with_notes = name.find("N6") != std::string::npos;
    is_good = (with_notes ? load_with_notes : load)(path, {}, diagnostics).has_value();
  }
  EXPECT_EQ(is_good, !diagnostics.has_errors());
}

/// The output of the command line with --notes; `ok` for a file without remarks.
std::string said_about(const std::string& name) {
  Diagnostics diagnostics;
  // Relative, so that the expectations hold in any folder.
  load_as_named(folder / (name + ".yaml"), diagnostics);
  std::ostringstream out;
  render_human(diagnostics, out, {.notes = true});
  return out.str().empty() ? "ok\n" : out.str();
}

void expect_golden(const std::string& name, const std::string& said) {
  const std::filesystem::path expected = test::source_dir / folder / (name + ".expected");
  if (std::getenv("ZWANG_WRITE_EXPECTED") != nullptr) std::ofstream(expected) << said;
  ASSERT_TRUE(std::filesystem::exists(expected));
  EXPECT_EQ(said, test::slurp(expected));
}

class Conformance : public testing::TestWithParam<std::string> {};

TEST_P(Conformance, says_exactly_what_is_expected) {
  std::filesystem::current_path(test::source_dir);
  expect_golden(GetParam(), said_about(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Files, Conformance, testing::ValuesIn(cases()),
                         [](const auto& test_case) { return test_case.param; });

/// Files that are too large to be kept are made here; what is said about them is kept all the same.
class Limits : public testing::TestWithParam<test::Limit> {
 protected:
  void make(int size) {
    std::filesystem::current_path(workplace_.path());
    for (const auto& [path, text] : GetParam().make(GetParam().name, size)) {
      workplace_.write((folder / path).string(), text);
    }
  }
  void TearDown() override { std::filesystem::current_path(test::source_dir); }

 private:
  test::Folder workplace_;
};

TEST_P(Limits, hold_what_they_allow) {
  make(GetParam().most);
  Diagnostics diagnostics;
  load_as_named(folder / (GetParam().name + ".yaml"), diagnostics);
  EXPECT_EQ(test::count(diagnostics, GetParam().code), 0) << test::rendered(diagnostics);
  EXPECT_EQ(diagnostics.has_errors(), !GetParam().is_meaningful) << test::rendered(diagnostics);
}

TEST_P(Limits, refuse_one_more) {
  make(GetParam().most + 1);
  expect_golden(GetParam().name, said_about(GetParam().name));
}

INSTANTIATE_TEST_SUITE_P(OfText, Limits, testing::ValuesIn(test::limits()),
                         [](const auto& test_case) { return test_case.param.name; });

/// A base with an arm of so many joints, and as many tasks that each move it along another axis.
class ManyAxes : public testing::Test {
 protected:
  std::string said(int joints, int count) {
    const std::filesystem::path robots = test::source_dir / folder / "robots";
    std::filesystem::current_path(workplace_.path());
    workplace_.write((folder / "robots/made.yaml").string(),
                     test::replaced(test::slurp(robots / "mini.yaml"), "mini.urdf", "made.urdf"));
    workplace_.write((folder / "robots/made.urdf").string(),
                     test::replaced(test::slurp(robots / "mini.urdf"), "</robot>",
                                    zwang::test::long_arm(joints) + "</robot>"));
    workplace_.write((folder / "N608_axes.yaml").string(),
                     zwang::test::tasks_along_axes("robots/made.yaml", count));
    return said_about("N608_axes");
  }
  void TearDown() override { std::filesystem::current_path(test::source_dir); }

 private:
  test::Folder workplace_;
};

TEST_F(ManyAxes, that_take_too_long_are_not_asked_about) {
  expect_golden("N608_axes", said(200, 250));
}

TEST_F(ManyAxes, of_a_base_are_all_asked_about) {
  expect_golden("ok_N608_axes_of_a_base", said(0, 250));
}

}  // namespace
}  // namespace zwang::lang
