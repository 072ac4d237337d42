// The clock that stamps go by: the computer's, or one that is told.
#include "robot_clock.hpp"

#include <gtest/gtest.h>

namespace zwang::connect {
namespace {

constexpr double patience = 0.1;  // [s]

TEST(RobotClock, IsTheComputersWhereNobodyTells) {
  const RobotClock clock(false, patience);
  EXPECT_TRUE(clock.has_come());
  const double before = now(), time = clock.time();
  EXPECT_GE(time, before);
  EXPECT_LE(time, now());
  EXPECT_EQ(clock.time_at(123.0), 123.0);
  EXPECT_FALSE(clock.stands(1e12));
  EXPECT_EQ(clock.silence(10.0, 9.5, 3.0), 0.5) << "stamps do not count: another computer may have made them";
}

TEST(RobotClock, ThatIsToldStandsBetweenTwoMessages) {
  RobotClock clock(true, patience);
  EXPECT_FALSE(clock.has_come());
  clock.tell(7.0, 1000.0);
  EXPECT_FALSE(clock.has_come()) << "a simulation that is paused tells one time again and again";
  clock.tell(7.0, 1000.01);
  EXPECT_FALSE(clock.has_come());
  EXPECT_EQ(clock.time(), 7.0);
  EXPECT_EQ(clock.time_at(1000.05), 7.0);
  clock.tell(7.01, 1000.1);
  EXPECT_TRUE(clock.has_come());
  EXPECT_EQ(clock.time(), 7.01);
}

TEST(RobotClock, StepsAsTheShortestStepThatWasTold) {
  RobotClock clock(true, patience);
  for (const double time : {7.0, 7.1, 7.3, 7.4, 0.0, 0.1}) clock.tell(time, 1000.0 + time);
  EXPECT_NEAR(clock.step(), 0.1, 1e-12) << "a message was lost, and the simulation began anew";
}

// A simulation at a tenth of real time: its samples are fresh, although they come seldom.
TEST(RobotClock, ThatIsSlowMakesNoSilence) {
  RobotClock clock(true, patience);
  clock.tell(7.02, 1000.0);
  EXPECT_NEAR(clock.silence(1000.09, 999.5, 7.0), 0.02, 1e-12);
  EXPECT_EQ(clock.silence(1000.09, 999.5, 7.03), 0.0) << "a sample may overtake the clock";
}

TEST(RobotClock, ThatIsToldNoMoreStands) {
  RobotClock clock(true, patience);
  clock.tell(7.0, 1000.0);
  EXPECT_FALSE(clock.stands(1000.0 + 0.99 * patience));
  EXPECT_TRUE(clock.stands(1000.0 + 1.01 * patience));
  EXPECT_NEAR(clock.silence(1000.5, 1000.0, 7.0), 0.5, 1e-9) << "a simulator that has died is silence";
}

}  // namespace
}  // namespace zwang::connect
