// `base` and `lead`: names that every robot has, so that one task file fits all of them.
#include <gtest/gtest.h>

#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

using test::rendered;

const std::filesystem::path robots = test::source_dir / "specs/robots";

constexpr const char* ahead = R"(
zwang: 1
robot: SOME_ROBOT
start: go
tasks:
  go:
    constraints:
      on: {move: lead, in: base, x: {velocity: 0.1 m/s}}
    exits:
      - {when: moved(lead) > 1 m, goto: done}
    timeout: {after: 20 s, goto: failed}
)";

class Lead : public testing::Test {
 protected:
  /// With the robot file `robot`, whose text starts with `zwang_robot` below the test's folder or is shipped.
  std::optional<Program> load_with(const std::string& task, const std::filesystem::path& robot) {
    LoadOptions options;
    options.robot = robot;
    options.root = "/";
    return load(folder_.write("task.yaml", task), options, diagnostics_);
  }
  std::filesystem::path diff_with(const std::string& from, const std::string& to) {
    folder_.write("diff_base.urdf", test::slurp(robots / "diff_base.urdf"));
    return folder_.write("robot.yaml", test::replaced(test::slurp(robots / "diff_base.yaml"), from, to));
  }
  test::Folder folder_;
  Diagnostics diagnostics_;
};

/// The origin of the frame `name` in its parent [m].
solver::Vector3 origin_of(const Program& program, const std::string& name) {
  for (const FrameDeclaration& frame : program.frames) {
    if (frame.name == name) return frame.pose.position;
  }
  throw std::runtime_error("no frame " + name);
}

TEST_F(Lead, one_task_fits_every_robot_that_ships) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(robots)) {
    if (file.path().extension() != ".yaml") continue;
    const auto program = load_with(ahead, file.path());
    EXPECT_TRUE(program) << file.path() << rendered(diagnostics_);
    EXPECT_EQ(diagnostics_.error_count(), 0) << rendered(diagnostics_);
    ++count;
  }
  EXPECT_GE(count, 10);
}

/// The axle of diff_base passes its origin: `lead` is its nose.
TEST_F(Lead, is_the_frame_that_the_robot_file_names) {
  const auto program = load_with(ahead, robots / "diff_base.yaml");
  ASSERT_TRUE(program) << rendered(diagnostics_);
  EXPECT_GT(origin_of(*program, "lead").x(), 0.1);
  EXPECT_EQ(origin_of(*program, "lead"), origin_of(*program, "nose"));
  EXPECT_EQ(origin_of(*program, "base"), solver::Vector3::Zero());
}

TEST_F(Lead, is_the_base_where_the_robot_file_names_none) {
  const auto program = load_with(ahead, robots / "mecanum_base.yaml");
  ASSERT_TRUE(program) << rendered(diagnostics_);
  EXPECT_EQ(origin_of(*program, "lead"), solver::Vector3::Zero());
}

TEST_F(Lead, yields_to_a_frame_of_the_robot_file) {
  const auto robot = diff_with("lead: nose\n", "");
  const std::string text = test::slurp(robot);
  folder_.write("robot.yaml", text + "  lead: {parent: base_link, at: [0.7 m, 0 m, 0.1 m]}\n");
  const auto program = load_with(ahead, robot);
  ASSERT_TRUE(program) << rendered(diagnostics_);
  EXPECT_EQ(origin_of(*program, "lead").x(), 0.7);
}

/// Files that were written before robots had these names keep their meaning.
TEST_F(Lead, yields_to_a_frame_and_a_signal_of_the_task) {
  const auto framed = load_with(
      test::replaced(ahead, "start: go", "frames:\n  lead: {parent: base_link, at: [0.4 m, 0 m]}\nstart: go"),
      robots / "diff_base.yaml");
  ASSERT_TRUE(framed) << rendered(diagnostics_);
  EXPECT_EQ(origin_of(*framed, "lead").x(), 0.4);

  std::string text = test::replaced(
      ahead, "start: go", "signals:\n  lead: {type: number, unit: m, stale_after: 0.5 s}\nstart: go");
  text = test::replaced(text, "move: lead", "move: nose");
  text = test::replaced(text, "moved(lead) > 1 m", "lead > 1 m");
  const auto signalled = load_with(text, robots / "diff_base.yaml");
  ASSERT_TRUE(signalled) << rendered(diagnostics_);
  EXPECT_EQ(signalled->signals.size(), 1u);
}

TEST_F(Lead, that_no_robot_has_is_told) {
  EXPECT_FALSE(load_with(ahead, diff_with("lead: nose", "lead: nise")));
  EXPECT_NE(rendered(diagnostics_).find("did you mean `nose`?"), std::string::npos) << rendered(diagnostics_);
}

}  // namespace
}  // namespace zwang::lang
