// The edits that diagnostics offer to programs: with each of them the file is better.
#include "zwang/lang/mending.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

const fs::path conformance = test::source_dir / "tests/conformance";

bool offers_an_edit(const Diagnostic& d) {
  return d.replacement || !d.choices.empty();
}

/// What is told about the file, with all edits and with those that mend.
struct Told {
  Diagnostics all, mending;
};

Told told_about(const fs::path& path) {
  const FileKind kind = kind_of_file(path).value_or(FileKind::task);
  const CheckOptions options{.load = {}, .with_notes = true, .task = {}};
  Told told;
  check_file(kind, path, options, told.all);
  told.mending = with_mending_edits(kind, path, options, told.all);
  return told;
}

/// Golden inputs whose edit does not mend: the guess is wrong, or a second mistake stands on the line.
std::set<std::string> withheld() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(conformance)) {
    if (entry.path().extension() != ".yaml") continue;
    const Told told = told_about(entry.path());
    EXPECT_EQ(told.all.all().size(), told.mending.all().size()) << entry.path();
    EXPECT_EQ(told.all.silenced().size(), told.mending.silenced().size()) << entry.path();
    for (const Diagnostic& d : told.all.all()) {
      if (!offers_an_edit(d)) continue;
      const auto kept = std::ranges::find_if(told.mending.all(), [&](const Diagnostic& other) {
        return other.code == d.code && other.message == d.message &&
               other.span.begin.line == d.span.begin.line;
      });
      const bool is_kept = kept != told.mending.all().end() && offers_an_edit(*kept);
      if (!is_kept) names.insert(entry.path().stem().string() + " " + d.code);
    }
  }
  return names;
}

TEST(Mending, GoldenInputsHaveTheirEditsButForThese) {
  // A second mistake stands on the line, or what is written there is no file, no parameter's value.
  EXPECT_EQ(withheld(), (std::set<std::string>{
                            "E201_spring_without_units E201", "robot_E104_plain_actuators E104",
                            "robot_E104_wheels_by_names E104", "robot_E202_friction_of_another_joint E301",
                            "scenario_E20x_parameter E203", "scene_E104_motion_in_lists E104",
                            "scene_E104_plain_robot E104", "scene_E301_params_of_a_robot E301"}));
}

class MendingOf : public testing::Test {
 protected:
  /// The edit that the file's first diagnostic of this code has.
  std::optional<std::string> edit(const std::string& name, const std::string& text, const std::string& code) {
    const fs::path path = folder_.write(name, text);
    const Told told = told_about(path);
    EXPECT_GT(test::count(told.all, code), 0) << test::rendered(told.all);
    for (const Diagnostic& d : told.mending.all()) {
      if (d.code == code) return d.replacement;
    }
    return std::nullopt;
  }
  test::Folder folder_;
};

constexpr const char* box = "zwang_scene: 1\nobjects:\n  crate: {box: [0.4 m, ";

TEST_F(MendingOf, AUnitOfAnotherDimensionIsNotOffered) {
  EXPECT_EQ(edit("a.yaml", std::string(box) + "2 °, 0.6 m], at: [1 m, 0 m]}\n", "E105"), std::nullopt);
  EXPECT_EQ(edit("b.yaml", std::string(box) + "2 N, 0.6 m], at: [1 m, 0 m]}\n", "E202"), std::nullopt);
  EXPECT_EQ(edit("c.yaml", std::string(box) + "0.5 meters, 0.6 m], at: [1 m, 0 m]}\n", "E203"), "0.5 m");
}

/// The help holds the whole value, and the file with it is good.
TEST_F(MendingOf, NewtonMetresOfAForceBecomeNewtons) {
  const std::string task =
      "zwang: 1\nrobot: robots/mecanum_base.yaml\nstart: go\ntasks:\n  go:\n    constraints:\n"
      "      press: {move: base, in: base, x: {force: 20 N, velocity: +-0.1 m/s}}\n"
      "    timeout: {after: 9 s, goto: done}\n";
  fs::copy(test::source_dir / "specs/robots", folder_.path() / "robots", fs::copy_options::recursive);
  struct Case {
    const char *wrong, *right;
  };
  for (const Case& one : {Case{"20 Nm", "20 N"}, {"20Nm", "20 N"}, {"-20 Nm", "-20 N"}}) {
    EXPECT_EQ(edit("press.yaml", test::replaced(task, "20 N", one.wrong), "E203"), one.right) << one.wrong;
    const Told wrong = told_about(folder_.path() / "press.yaml");
    EXPECT_TRUE(wrong.all.all().front().help.find("`" + std::string(one.right) + "`") != std::string::npos)
        << test::rendered(wrong.all);
    const Told mended = told_about(folder_.write("press.yaml", test::replaced(task, "20 N", one.right)));
    EXPECT_FALSE(mended.all.has_errors()) << test::rendered(mended.all);
  }
}

TEST_F(MendingOf, AKeyThatTakesAnotherValueIsNotOffered) {
  const std::string rest = "0.5 m, 0.6 m], at: [1 m, 0 m], ";
  EXPECT_EQ(edit("a.yaml", std::string(box) + rest + "locked: 0.1}\n", "E101"), std::nullopt);
  EXPECT_EQ(edit("b.yaml", std::string(box) + rest + "frction: 0.1}\n", "E101"), "friction");
}

TEST_F(MendingOf, AllPlacesOfANameAreEditedAtOnce) {
  const std::string task =
      "zwang: 2\nstart: fast-lane\ntasks:\n  fast-lane:\n    exits: [{when: elapsed > 1 s, goto: done}]\n";
  EXPECT_EQ(edit("task.yaml", task, "E105"), "fast_lane");
}

}  // namespace
}  // namespace zwang::lang
