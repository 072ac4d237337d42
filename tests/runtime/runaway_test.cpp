// A base that gets away from its motors: what is one, what is none, and how the stop brakes it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "constants.hpp"
#include "guard/contact_depth.hpp"
#include "guard/runaway_watch.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::runtime {
namespace {

lang::Program load(const std::string& robot) {
  return zwang::test::shipped_program("wall_align.yaml", robot, "wall_far");
}

/// One mass on one wheel, told to stay between two speeds. v(t) and the commanded force F are given. The rest
/// of the acceleration comes from outside: p = sqrt(m) (dv/dt - F/m).
class OneMass {
 public:
  OneMass(double low, double high) : robot_(load("mecanum").robot), model_(robot_.model), state_(model_) {
    solver::AxisConstraint limit;
    limit.move = limit.in = {.body = 0};
    limit.velocity = solver::Range{low, high};
    set_.add(limit);
  }
  /// Where the driver has no force range, it yields.
  void drive(const solver::Driver& driver) {
    solver::AxisConstraint driven;
    driven.move = driven.in = {.body = 0};
    driven.driver = driver;
    set_.add(driven);
  }
  /// [s] of the event; -1: none.
  template <typename Speed, typename Force>
  double found(double until, const Speed& speed, const Force& force) {
    RunawayWatch watch(1, mass, period);
    ContactDepth contact(robot_, RunawayWatch::look_every);
    const solver::FreeMotions motions(model_);
    Eigen::VectorXd rate(1), told(1);
    Eigen::VectorXd outside(1);
    for (int i = 0; i * period < until; ++i) {
      const double t = i * period;
      told(0) = force(t);
      rate(0) = speed(t);
      const bool is_due = watch.follow(told, rate);
      state_.base_twist.linear.x() = speed(t);
      set_.fill(model_, state_);
      const double a = (speed(t) - speed(t - 0.01)) / 0.01;
      outside(0) = std::sqrt(mass) * (a - told(0) / mass);
      if (!is_due) continue;
      const double v = watch.rates()(0);
      contact.follow(motions, outside, outside(0) * std::sqrt(mass) * v, 0.5 * mass * v * v);
      if (watch.look(set_, 0.5 * mass * v * v, outside, contact, false)) return t;
    }
    return -1.0;
  }
  static constexpr double mass = 50.0;  // [kg]

 private:
  const lang::Robot robot_;
  const solver::Model model_;
  solver::State state_;
  solver::ConstraintSet set_;
};

constexpr auto brake = [](double v) { return v > 0.0 ? -20.0 : 20.0; };  // [N]

TEST(Runaway, OfASteadyForceIsFoundHalfAMarginBeyondTheSpeed) {
  // From rest with 0.5 m/s^2 against its brake. The low pass is late by its time constant.
  OneMass mass(-0.1, 0.1);
  const auto speed = [](double t) { return 0.5 * std::max(0.0, t); };
  const double at = mass.found(1.0, speed, [&](double t) { return brake(speed(t)); });
  const double passed = (0.1 + RunawayWatch::driven * RunawayWatch::margin) / 0.5;
  EXPECT_GE(at, passed - period);
  EXPECT_LT(at, passed + 2 * RunawayWatch::look_every + RunawayWatch::quick);
}

TEST(Runaway, OfAnyForceIsFoundOneDwellAfterTheMarginIsPassed) {
  // The same, but by a force that changes its size all the time. One look finds the speed, `dwell` more see
  // it grow.
  OneMass mass(-0.1, 0.1);
  const auto speed = [](double t) {
    return t > 0.0 ? 0.5 * t + 0.4 / 80.0 * (1.0 - std::cos(80.0 * t)) : 0.0;
  };
  const double at = mass.found(1.0, speed, [&](double t) { return brake(speed(t)); });
  double passed = 0.0;
  while (speed(passed) < 0.1 + RunawayWatch::margin) passed += period;
  EXPECT_GT(at, passed + RunawayWatch::dwell * RunawayWatch::look_every);
  EXPECT_LT(at, passed + (RunawayWatch::dwell + 4) * RunawayWatch::look_every + RunawayWatch::quick);
}

constexpr solver::Driver yields{.quantity = solver::Quantity::acceleration};

TEST(Runaway, OfABaseThatYieldsIsFoundFarBeyondTheSpeed) {
  OneMass mass(-0.1, 0.1);
  mass.drive(yields);
  const auto speed = [](double t) { return 0.5 * std::max(0.0, t); };
  const double at = mass.found(2.0, speed, [&](double t) { return brake(speed(t)); });
  const double passed = (0.1 + RunawayWatch::far) / 0.5;
  EXPECT_GT(at, passed + (RunawayWatch::dwell - 1) * RunawayWatch::look_every);
  EXPECT_LT(at, passed + (RunawayWatch::dwell + 4) * RunawayWatch::look_every + RunawayWatch::quick);
}

/// Somebody pushes with `push` [N] a base that yields beside a driver of 0.2 m/s with 40 N and T = 0.5 s.
double found_beside_a_driver(double push) {
  constexpr double target = 0.2, most = 40.0, time_constant = 0.5;
  OneMass mass(-10.0, 10.0);
  mass.drive(yields);
  mass.drive({.target = target, .time_constant = time_constant, .force = {-most, most}});
  constexpr int steps = 5000;
  std::vector<double> v{target}, told{0.0};
  for (int i = 0; i < steps; ++i) {
    told.push_back(std::clamp(OneMass::mass * (target - v.back()) / time_constant, -most, most));
    v.push_back(v.back() + period * (push + told.back()) / OneMass::mass);
  }
  const auto at = [](const std::vector<double>& of) {
    return [&of](double t) { return of[static_cast<std::size_t>(std::max(0.0, t) / period + 0.5)]; };
  };
  return mass.found(4.9, at(v), at(told));
}

TEST(Runaway, IsNoneWhereSomebodyPushesWithLessThanADriversForce) {
  // It ends at 0.2 m/s + 35 N 0.5 s/m = 0.55 m/s, where 0.6 m/s take all of the driver's force.
  EXPECT_EQ(found_beside_a_driver(35.0), -1.0);
  EXPECT_GT(found_beside_a_driver(60.0), 0.0);
}

TEST(Runaway, IsNoneAsLongAsTheMotorsDoTheWork) {
  OneMass mass(-0.1, 0.1);
  EXPECT_EQ(mass.found(
                2.0, [](double t) { return 0.5 * t; }, [](double) { return 20.0; }),
            -1.0);
}

TEST(Runaway, IsNoneWhileTheSpeedIsAllowed) {
  // Somebody pushes it, as slowly as it may move.
  OneMass mass(-0.1, 0.1);
  const auto speed = [](double t) { return 0.104 * (1.0 - std::exp(-t)); };
  EXPECT_EQ(mass.found(3.0, speed, [&](double t) { return brake(speed(t)); }), -1.0);
}

TEST(Runaway, IsNoBounce) {
  // The mass meets a spring of half a period of 0.2 s at 0.3 m/s. It comes back with 0.25 m/s where 0.05 m/s
  // are allowed. The speed rises for 0.1 s against the motors, to less than before.
  OneMass mass(-0.05, 0.4);
  const auto speed = [](double t) {
    if (t < 1.0) return 0.3;
    const double phase = std::min((t - 1.0) / 0.2, 1.0) * M_PI;
    return phase < 0.5 * M_PI ? 0.3 * std::cos(phase) : 0.25 * std::cos(phase);
  };
  EXPECT_EQ(mass.found(2.0, speed, [](double) { return 20.0; }), -1.0);
}

/// Pressed into a spring of 1 kN/m by 20 N, quasi-statically, for 1 s; from 1.3 s on something else.
constexpr double bumper_stiffness = 1e3;  // [N/m]
constexpr double depth = 0.02;            // [m]
double pressing_in(double t) {
  return t < 1.0 ? depth : 0.0;
}

TEST(Runaway, IsNoSoftSpringThatGivesBack) {
  // The mass is told to brake with 12 N and goes back by m v' = K (x0 - s) - 12 N. Its speed reaches 0.036
  // m/s where 0.02 m/s are allowed. The force takes 35 ms to fall by a tenth.
  OneMass mass(-0.02, 0.02);
  const double rate = std::sqrt(bumper_stiffness / OneMass::mass), swing = depth - 12.0 / bumper_stiffness;
  const auto speed = [&](double t) {
    return t < 1.3 ? pressing_in(t) : -swing * rate * std::sin(rate * (t - 1.3));
  };
  const auto told = [](double t) { return t < 1.3 ? bumper_stiffness * std::min(t, 1.0) * depth : 12.0; };
  EXPECT_EQ(mass.found(1.3 + 0.5 * M_PI / rate, speed, told), -1.0);
}

TEST(Runaway, IsFoundBesideASoftSpring) {
  // The force that drives the mass on does not slacken: 0.2 m/s^2 back against 12 N.
  OneMass mass(-0.02, 0.02);
  const auto speed = [](double t) { return t < 1.3 ? pressing_in(t) : -0.2 * (t - 1.3); };
  const auto told = [](double t) { return t < 1.3 ? bumper_stiffness * std::min(t, 1.0) * depth : 12.0; };
  const double at = mass.found(3.0, speed, told);
  const double passed = 1.3 + (0.02 + RunawayWatch::driven * RunawayWatch::margin) / 0.2;
  EXPECT_GE(at, passed - period);
  EXPECT_LT(at, passed + 2 * RunawayWatch::look_every + RunawayWatch::quick);
}

TEST(ContactDepth, OfWhatSlidesEndsAtTheDeepestContact) {
  // 100 m along a wall that takes 2 N of a force of 20 N: 10 m of depth, if it were a spring's.
  const lang::Robot robot = load("mecanum").robot;
  const solver::FreeMotions motions(robot.model);
  ContactDepth contact(robot, RunawayWatch::look_every);
  const Eigen::VectorXd p = Eigen::VectorXd::Constant(1, 20.0);
  for (int i = 0; i < 10'000; ++i) contact.follow(motions, p, -2.0, 0.0);
  const ContactDepth::Mark mark = contact.now();
  const double enough =
      ContactDepth::unexplained * ContactDepth::deepest * std::sqrt(robot.model.total_mass());
  EXPECT_NEAR(mark.depth, ContactDepth::deepest * std::sqrt(robot.model.total_mass()), 1e-9);
  while (contact.now().way - mark.way < enough - 1e-3) {
    contact.follow(motions, p, 2.0, 0.0);
    ASSERT_FALSE(contact.is_no_spring(mark));
  }
  for (int i = 0; i < 3; ++i) contact.follow(motions, p, 2.0, 0.0);
  EXPECT_TRUE(contact.is_no_spring(mark));
}

/// With |yd| = 1 the share is the cosine between p and the robot's way.
TEST(ContactDepth, TellsWhetherTheRobotGoesAlongTheForce) {
  const lang::Robot robot = load("mecanum").robot;
  const solver::FreeMotions motions(robot.model);
  constexpr double force = 20.0, share = 0.35;
  for (const double cosine : {0.3, 0.4, -0.4}) {
    ContactDepth contact(robot, RunawayWatch::look_every);
    const ContactDepth::Mark mark = contact.now();
    for (int i = 0; i < 10; ++i)
      contact.follow(motions, Eigen::VectorXd::Constant(1, force), force * cosine, 0.5);
    EXPECT_EQ(contact.goes_along(mark, share), std::abs(cosine) > share) << cosine;
  }
}

TEST(ContactDepth, OfAHitThatIsAllDampingIsKeptUntilItsSpringIsQuiet) {
  // A unit mass runs into K s + c v at 0.5, K = 30 and c = 25. At first it feels 12.5, at the deepest 0.47.
  // Then it is let out slowly. A tenth of 12.5 is more than the spring ever has.
  constexpr double k = 30.0, c = 25.0, dt = 1e-3;
  const solver::FreeMotions motions(load("mecanum").robot.model);
  ContactDepth contact(load("mecanum").robot, dt);
  double s = 0.0, v = 0.5;
  const auto follow = [&](double rate) {
    const double force = k * s + c * rate;
    s += dt * rate;
    contact.follow(motions, Eigen::VectorXd::Constant(1, force), -force * rate, 0.5 * rate * rate);
    return force;
  };
  while (v > 1e-4) v -= dt * follow(v);
  const double deepest = s;
  EXPECT_NEAR(contact.now().depth, deepest, 0.05 * deepest);
  while (s > 0.5 * deepest) follow(-1e-3);
  EXPECT_NEAR(contact.now().depth, s, 0.05 * deepest);
  while (s > 0.05 * deepest) follow(-1e-4);
  EXPECT_EQ(contact.now().depth, 0.0);
}

/// A unit mass leans on a soft wall, 10 of 1000. Then it hits a hundred times stiffer one beside it with 200,
/// and comes off it. The soft wall presses on: it is still F/k deep, and gives back F^2/2k. That is also what
/// is known of a soft wall if the hit throws the mass off it by a tenth.
TEST(ContactDepth, OfAWallThatPressesOnBesideAHitIsKept) {
  constexpr double k = 1e3, stiff = 1e5, push = 10.0, hit = 200.0, dt = 1e-3;
  const solver::FreeMotions motions(load("mecanum").robot.model);
  for (const double thrown_off : {0.0, 0.1}) {
    ContactDepth contact(load("mecanum").robot, dt);
    Eigen::Vector2d s = Eigen::Vector2d::Zero();
    const auto move_to = [&](double soft_depth, double stiff_depth) {
      const Eigen::Vector2d to(soft_depth, stiff_depth), rate = (to - s) / dt;
      const Eigen::Vector2d middle = 0.5 * (s + to), force(k * middle.x(), stiff * middle.y());
      s = to;
      contact.follow(motions, force, -force.dot(rate), 0.5 * rate.squaredNorm());
    };
    constexpr int steps = 100;
    const double deep = push / k;
    for (int i = 1; i <= steps; ++i) move_to(deep * i / steps, 0.0);
    for (int i = 1; i <= steps; ++i)
      move_to(deep * (1.0 - thrown_off * i / steps), hit / stiff * std::sin(M_PI * i / steps));
    move_to(deep * (1.0 - thrown_off), 0.0);
    const ContactDepth::Mark now = contact.now();
    EXPECT_GT(now.depth, 0.95 * deep * (1.0 - thrown_off));
    EXPECT_LT(now.depth, 1.05 * deep);
    EXPECT_GT(now.work, 0.95 * 0.5 * push * push / k * (1.0 - thrown_off) * (1.0 - thrown_off));
    EXPECT_LT(now.work, 1.05 * 0.5 * push * push / k);
    // All the way back: that is a spring.
    for (int i = 1; i <= steps / 2; ++i) {
      move_to(deep * (1.0 - thrown_off) * (1.0 - 1.0 * i / steps), 0.0);
      ASSERT_FALSE(contact.is_no_spring(now)) << i;
    }
  }
}

TEST(Runaway, IsNoHitOfSomebodyElse) {
  // Another robot hits one that stands: within 35 ms it has 0.2 m/s, and brakes from there.
  OneMass mass(-0.05, 0.05);
  const auto speed = [](double t) {
    return 0.2 * std::clamp((t - 0.5) / 0.035, 0.0, 1.0) * std::exp(-std::max(0.0, t - 0.535) / 0.5);
  };
  EXPECT_EQ(mass.found(2.0, speed, [&](double t) { return brake(speed(t)); }), -1.0);
}

TEST(Runaway, OfWhateverCauseIsFoundFarBeyondTheSpeed) {
  // Told to brake so little that no motor explains it, from rest with 0.5 m/s^2. Twice the speed is far.
  for (const double limit : {0.1, 0.6}) {
    OneMass mass(-limit, limit);
    const auto speed = [](double t) { return 0.5 * std::max(0.0, t); };
    const double at = mass.found(5.0, speed, [](double) { return -0.5; });
    const double passed = (limit + std::max(RunawayWatch::far, RunawayWatch::share_far * limit)) / 0.5;
    EXPECT_GT(at, passed);
    EXPECT_LT(at, passed + (RunawayWatch::dwell + 3) * RunawayWatch::look_every + RunawayWatch::quick);
  }
}

TEST(Runaway, IsNoTightenedLimit) {
  OneMass mass(-0.1, 0.1);
  const auto speed = [](double t) { return std::max(0.0, 0.6 - 0.4 * t); };
  EXPECT_EQ(mass.found(1.5, speed, [&](double t) { return brake(speed(t)); }), -1.0);
}

}  // namespace
}  // namespace zwang::runtime
