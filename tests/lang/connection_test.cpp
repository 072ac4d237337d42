// A connection that knows its task is told of times that its robot cannot keep.
#include "zwang/lang/connection.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "../temporary_folder.hpp"
#include "support.hpp"

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

TEST(ConnectionTimes, CommandsLeaveBetweenOnceATickAndOnceInStaleAfter) {
  EXPECT_EQ(code_of_times("", ", rate: 1000 Hz"), "");  // ticks of 1 ms
  EXPECT_EQ(code_of_times("", ", rate: 1001 Hz"), "E928");
  EXPECT_EQ(code_of_times("", ", rate: 10 Hz"), "");  // 100 ms, the default of `stale_after`
  EXPECT_EQ(code_of_times("", ", rate: 9.9 Hz"), "E928");
  EXPECT_EQ(code_of_times(", stale_after: 50 ms", ", rate: 19 Hz"), "E928");
}

}  // namespace
}  // namespace zwang::lang
