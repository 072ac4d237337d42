// A motor that does the opposite of what it is told, seen by its work: what is one, what is none. The work of
// each is that of a closed form or of one mass that is integrated here.
#include "guard/reversed_motor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "guard/runaway_watch.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::runtime {
namespace {

constexpr double look = RunawayWatch::look_every;
constexpr double fast = 1e-5;  // [s] that the mass is integrated with
constexpr double F = 20.0;     // [N] that the left motor is told

/// The commanded force and the speed of one driven wheel at its rim.
struct Rim {
  double force = 0.0;  ///< [N]
  double speed = 0.0;  ///< [m/s]
};

/// The first wheels of a base, told and turning as the test has it.
class Wheels {
 public:
  explicit Wheels(const char* robot = "diff")
      : robot_(zwang::test::shipped_program("wall_align.yaml", robot, "wall_far").robot),
        watch_(robot_, look),
        contact_(robot_, look),
        motions_(robot_.model) {
    told_ = rates_ = Eigen::VectorXd::Zero(robot_.model.joint_count());
  }
  /// `power` is what nobody commanded [W], `force` what does it [N].
  std::optional<Event> see(std::initializer_list<Rim> rims, double power, double force = 2.0 * F) {
    std::size_t i = 0;
    for (const Rim& rim : rims) {
      const solver::Wheel& wheel = robot_.model.wheels()[i++];
      told_(wheel.body - 1) = rim.force * wheel.radius;
      rates_(wheel.body - 1) = rim.speed / wheel.radius;
    }
    contact_.follow(motions_, Eigen::VectorXd::Constant(1, force), power, 0.0);
    return watch_.look(power, told_, rates_, contact_);
  }
  int first() const { return robot_.model.wheels()[0].body - 1; }

 private:
  lang::Robot robot_;
  ReversedMotor watch_;
  ContactDepth contact_;
  solver::FreeMotions motions_;
  Eigen::VectorXd told_, rates_;
};

constexpr double mass = 50.0;  // [kg]

/// The time [s] until a flipped motor is found; -1: never. Another motor brings the base back from v0. The
/// left motor gives `gives` of F, and standing contacts do no work.
double found_after(double gives, double v0) {
  Wheels wheels;
  for (double t = look; t < 1.0; t += look) {
    const double v = v0 + gives * F / mass * t;
    if (const auto event = wheels.see({{F, v}}, (gives - 1.0) * F * v)) {
      EXPECT_EQ(event->code, EventCode::torque_flipped);
      EXPECT_EQ(event->signal, event_signal::of_joint(wheels.first(), event_signal::tau));
      return t;
    }
  }
  return -1.0;
}

TEST(ReversedMotor, BesideAContactThatStandsIsFoundAfterItsDwellAndItsWay) {
  // P = -2 F v: at v0 < 0 the wheel has its way within the dwell; from rest it takes sqrt(2 s m / F).
  EXPECT_NEAR(found_after(-1.0, -0.05), ReversedMotor::dwell, 1e-9);
  const double way = std::sqrt(2.0 * ReversedMotor::travel * mass / F);
  ASSERT_GT(way, ReversedMotor::dwell);
  EXPECT_NEAR(found_after(-1.0, 0.0), way, look);
}

TEST(ReversedMotor, IsNoneThatGivesNothingOrIsTold) {
  EXPECT_EQ(found_after(0.0, -0.05), -1.0);  // lost
  EXPECT_EQ(found_after(1.0, -0.3), -1.0);   // sound
}

class Spring : public testing::TestWithParam<double> {};

/// A mass runs into a spring of K while it is told to push F on, and is thrown back. The spring gives then
///   P = K x v,   and with x there is one where it gives 2 F v.
TEST_P(Spring, ThatGivesBackIsNoMotor) {
  const double K = GetParam();
  Wheels wheels;
  double x = 0.0, v = 0.3, t = 0.0, next = look;  // x into the spring
  bool passed = false;
  while (x >= 0.0) {
    const double force = K * x;
    v += fast * (F - force) / mass;
    x += fast * v;
    t += fast;
    if (t < next) continue;
    next += look;
    passed = passed || (v < 0.0 && force < 2.0 * F);
    EXPECT_FALSE(wheels.see({{F, v}}, -force * v, force)) << t;
  }
  EXPECT_TRUE(passed || v * look * K < -2.0 * F)
      << "the size of the command is gone through, within a look at most";
}
INSTANTIATE_TEST_SUITE_P(Stiffness, Spring, testing::Values(300.0, 1e3, 2.1e3, 5e3, 20e3, 100e3, 400e3));

TEST(ReversedMotor, IsNobodyWhoPushesEvenly) {
  // In line with one wheel, and so fast as it is: P = -W.
  Wheels one, both;
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(one.see({{F, -0.06}}, F * 0.06));
    // Against both wheels, P = -W is -2 F v of either.
    EXPECT_FALSE(both.see({{F, -0.06}, {F, -0.06}}, 2.0 * F * 0.06));
  }
}

TEST(ReversedMotor, IsNobodyWhoPushesEvenlyWhereOneWheelBearsHalfOfIt) {
  // P = -W = 2 F v is the first wheel's, -2 F v of it, and twice that of each other one.
  Wheels wheels("mecanum");
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(wheels.see({{F, -0.06}, {0.5 * F, -0.06}, {0.5 * F, -0.06}}, 2.0 * F * 0.06));
  }
}

TEST(ReversedMotor, IsNothingThatSlackensInTheDwell) {
  // P / P_j falls through the size of the command, by twice `steadily` in a dwell.
  Wheels wheels;
  for (double share = ReversedMotor::most; share > ReversedMotor::least;
       share -= 2.0 * ReversedMotor::steadily * look / ReversedMotor::dwell) {
    EXPECT_FALSE(wheels.see({{F, -0.06}}, share * 2.0 * F * 0.06)) << share;
  }
}

TEST(ReversedMotor, IsNoMassThatIsHalfOfTheModels) {
  // Nothing touches it. One wheel drives with 3 F v, the other is told to brake with F v: W = 2 F v. The
  // power that the model does not know is as much again: P = 2 F v.
  Wheels wheels;
  for (int i = 0; i < 200; ++i) EXPECT_FALSE(wheels.see({{F, -0.06}, {3.0 * F, 0.06}}, 2.0 * F * 0.06));
}

TEST(ReversedMotor, IsNotToldOfTwoThatMayBeIt) {
  // Two wheels of four turn alike; with one of them at rest it is the other.
  Wheels one("mecanum"), two("mecanum");
  bool found = false;
  for (int i = 0; i < 200; ++i) {
    EXPECT_FALSE(two.see({{F, -0.06}, {F, -0.06}, {F, 0.04}}, 2.0 * F * 0.06));
    found = found || one.see({{F, -0.06}, {F, 0.0}, {F, 0.04}}, 2.0 * F * 0.06);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace zwang::runtime
