// The joints' state, from messages that hold a part of them each.
#include "joints_merger.hpp"

#include <gtest/gtest.h>

namespace zwang::connect {
namespace {

lang::Robot robot_of(const char* file) {
  lang::Diagnostics diagnostics;
  return lang::load_robot(std::string(ZWANG_SOURCE_DIR "/specs/robots/") + file, diagnostics).value();
}

/// Every joint stands, with `effort` [N m] at each motor.
JointState message_of(const lang::Robot& robot, double effort) {
  JointState message;
  for (int j = 0; j < robot.model.joint_count(); ++j) message.names.push_back(robot.model.joint(j).name);
  message.positions.assign(message.names.size(), 0.0);
  message.velocities = message.positions;
  message.efforts.assign(message.names.size(), effort);
  return message;
}

TEST(JointsMerger, ARobotThatFeelsByEffortHasToTellIt) {
  const lang::Robot robot = robot_of("feels/mecanum_effort_50_hz.yaml");
  JointsMerger merger({}, robot);
  JointState silent = message_of(robot, 0.0);
  silent.efforts.clear();
  EXPECT_TRUE(merger.take(silent));
  EXPECT_FALSE(merger.is_whole());
  EXPECT_TRUE(merger.take(message_of(robot, 1.5)));
  EXPECT_TRUE(merger.is_whole());
  EXPECT_EQ(merger.effort(), Eigen::VectorXd::Constant(robot.model.joint_count(), 1.5));
}

TEST(JointsMerger, EffortsOfAnotherNumberAreNoGood) {
  const lang::Robot robot = robot_of("feels/mecanum_effort_50_hz.yaml");
  JointsMerger merger({}, robot);
  JointState message = message_of(robot, 1.5);
  message.efforts.pop_back();
  EXPECT_FALSE(merger.take(message));
  message = message_of(robot, 1.5);
  message.efforts[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(merger.take(message));
}

TEST(JointsMerger, AnyOtherRobotNeedsNone) {
  const lang::Robot robot = robot_of("mecanum_base.yaml");
  JointsMerger merger({}, robot);
  JointState message = message_of(robot, 0.0);
  message.efforts.clear();
  EXPECT_TRUE(merger.take(message));
  EXPECT_TRUE(merger.is_whole());
}

}  // namespace
}  // namespace zwang::connect
