// Every file of tests/conformance with the exact text that it makes zwang say. To write the expectations anew
// after a deliberate change, run this test with ZWANG_WRITE_EXPECTED=1 and read the difference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "support.hpp"
#include "zwang/lang/program.hpp"

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

/// What the command line would print; `ok` for a file without remarks.
std::string said_about(const std::string& name) {
  // Relative, so that the expectations hold in any folder.
  const std::filesystem::path path = folder / (name + ".yaml");
  Diagnostics diagnostics;
  bool is_good = false;
  if (name.starts_with("robot_")) {
    is_good = load_robot(path, diagnostics).has_value();
  } else if (name.starts_with("scene_")) {
    is_good = load_scene(path, diagnostics).has_value();
  } else {
    LoadOptions options;
    options.notes = name.find("N6") != std::string::npos;
    is_good = load(path, options, diagnostics).has_value();
  }
  EXPECT_EQ(is_good, !diagnostics.has_errors());
  const std::string text = test::rendered(diagnostics);
  return text.empty() ? "ok\n" : text;
}

class Conformance : public testing::TestWithParam<std::string> {};

TEST_P(Conformance, says_exactly_what_is_expected) {
  std::filesystem::current_path(test::source_dir);
  const std::filesystem::path expected = folder / (GetParam() + ".expected");
  const std::string said = said_about(GetParam());
  if (std::getenv("ZWANG_WRITE_EXPECTED") != nullptr) std::ofstream(expected) << said;
  ASSERT_TRUE(std::filesystem::exists(expected));
  EXPECT_EQ(said, test::slurp(expected));
}

INSTANTIATE_TEST_SUITE_P(Files, Conformance, testing::ValuesIn(cases()),
                         [](const auto& test_case) { return test_case.param; });

}  // namespace
}  // namespace zwang::lang
