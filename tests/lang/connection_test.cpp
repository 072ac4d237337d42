// A connection that knows its task is told of times that its robot cannot keep.
#include "zwang/lang/connection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "../temporary_folder.hpp"
#include "support.hpp"
#include "zwang/lang/check_file.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

/// The first code that a connection has on a base that takes twists at 50 Hz, with ticks of 1 ms.
std::string code_of_times(const std::string& joints, const std::string& twist) {
  const zwang::test::TemporaryFolder folder;
  const fs::path path = folder.path() / "connection.yaml";
  std::ofstream(path) << "zwang_connection: 1\nstate:\n  joints: {topic: /joint_states" << joints
                      << "}\ncommand:\n  twist: {topic: /cmd_vel, type: geometry_msgs/Twist, timeout: 2 s"
                      << twist << "}\n";
  Diagnostics diagnostics;
  LoadOptions options;
  options.robot = test::source_dir / "specs/robots/blind/mecanum_twist.yaml";
  const auto program = load(test::source_dir / "specs/laws/speed_limit.yaml", options, diagnostics);
  const auto connection = load_connection(path, diagnostics);
  if (program && connection) check_connection(*connection, *program, diagnostics);
  for (const Diagnostic& d : diagnostics.sorted()) {
    if (d.severity == Severity::error) return d.code;
  }
  return "";
}

TEST(ConnectionTimes, TheRobotsPeriodBoundsStaleAfter) {
  EXPECT_EQ(code_of_times(", stale_after: 19 ms", ""), "E928");  // 50 Hz: a sample each 20 ms
  EXPECT_EQ(code_of_times(", stale_after: 21 ms", ""), "");
  EXPECT_EQ(code_of_times(", stale_after: 2 s", ""), "");
  EXPECT_EQ(code_of_times(", stale_after: 2.001 s", ""), "E928");
}

/// The drive counts on commands at 50 Hz: E631 and the stop reckon with that.
TEST(ConnectionTimes, CommandsLeaveBetweenOnceATickAndAsOftenAsTheDriveCountsOn) {
  EXPECT_EQ(code_of_times("", ", rate: 1000 Hz"), "");  // ticks of 1 ms
  EXPECT_EQ(code_of_times("", ", rate: 1001 Hz"), "E928");
  EXPECT_EQ(code_of_times("", ", rate: 50 Hz"), "");
  EXPECT_EQ(code_of_times("", ", rate: 49 Hz"), "E928");
  EXPECT_EQ(code_of_times(", stale_after: 50 ms", ", rate: 19 Hz"), "E928");
}

/// The warnings of W929 that the mecanum base on torques is told of its receiver.
int warnings_of_timeout(double timeout) {
  const zwang::test::TemporaryFolder folder;
  const fs::path path = folder.path() / "connection.yaml";
  std::ofstream(path)
      << "zwang_connection: 1\nstate:\n  joints: {topic: /joint_states}\ncommand:\n  joints:\n"
         "    topic: /c\n    what: effort\n    order: [front_left_wheel, front_right_wheel, "
         "rear_left_wheel, rear_right_wheel]\n    timeout: "
      << timeout << " s\n";
  Diagnostics diagnostics;
  check_file(FileKind::connection, path, {.task = test::source_dir / "specs/wall_align.yaml"}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << test::rendered(diagnostics);
  return static_cast<int>(std::count_if(diagnostics.all().begin(), diagnostics.all().end(),
                                        [](const Diagnostic& d) { return d.code == "W929"; }));
}

/// Four motors of tau, wheels of radius r: F = 4 tau / r, and v = r w as fast as the wheels turn. From rest
/// that takes m v / F = m r^2 w / (4 tau); m counts the wheels' spin.
TEST(ConnectionTimes, ATorqueThatIsHeldRunsAway) {
  Diagnostics diagnostics;
  const auto robot = load_robot(test::source_dir / "specs/robots/mecanum_base.yaml", diagnostics);
  ASSERT_TRUE(robot);
  const solver::Joint& motor = robot->model.joint(robot->model.wheels().front().body - 1);
  const double r = robot->model.wheels().front().radius;
  const double spin =
      0.5 * 2.3 * r * r + motor.rotor_inertia;  // [kg m^2] a cylinder of 2.3 kg, and its rotor
  const double mass = robot->model.total_mass() + 4.0 * spin / (r * r);
  const double within = mass * r * r * motor.max_velocity / (4.0 * motor.max_effort);
  EXPECT_EQ(warnings_of_timeout(0.95 * within), 0);
  EXPECT_EQ(warnings_of_timeout(1.05 * within), 1);
}

}  // namespace
}  // namespace zwang::lang
