// A base that gets away from its motors: what is one, what is none, and how the stop brakes it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "constants.hpp"
#include "guard/contact_depth.hpp"
#include "guard/runaway_watch.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

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
      contact.follow(motions, outside, outside(0) * std::sqrt(mass) * v);
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
  for (int i = 0; i < 10'000; ++i) contact.follow(motions, p, -2.0);
  const ContactDepth::Mark mark = contact.now();
  const double enough =
      ContactDepth::unexplained * ContactDepth::deepest * std::sqrt(robot.model.total_mass());
  EXPECT_NEAR(mark.depth, ContactDepth::deepest * std::sqrt(robot.model.total_mass()), 1e-9);
  while (contact.now().way - mark.way < enough - 1e-3) {
    contact.follow(motions, p, 2.0);
    ASSERT_FALSE(contact.is_no_spring(mark));
  }
  for (int i = 0; i < 3; ++i) contact.follow(motions, p, 2.0);
  EXPECT_TRUE(contact.is_no_spring(mark));
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
    contact.follow(motions, Eigen::VectorXd::Constant(1, force), -force * rate);
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

struct Flipped {
  const char* robot;
  const char* wheel;
};

void PrintTo(const Flipped& flipped, std::ostream* out) {
  *out << flipped.robot << " " << flipped.wheel;
}

class MotorInContact : public testing::TestWithParam<Flipped> {};

/// At rest against the wall, 20 N and every speed told to be 0, a motor turns around. The guard has to find a
/// speed of `margin`. Until then each axis gains at most
///   a (dwell + 2) look_every = 0.07 m/s more, a = 1 m/s^2 the limit of a row's demand
TEST_P(MotorInContact, ThatFlipsIsNamedAndTheBaseStands) {
  const lang::Program program = load(GetParam().robot);
  const double at = 15.0;
  ScenePlantOptions options;
  options.simulation.start_yaw = 0.0;
  options.faults.push_back(
      lang::Fault{.kind = lang::FaultKind::torque_flipped, .at = at, .joint = GetParam().wheel});
  lang::Program pressing = program;  // for ever, and square
  pressing.tasks[1].exits.clear();
  ScenePlant plant(pressing, options);
  Runner runner(pressing, {.period = period});
  Sensed sensed(program.robot.model, program.signals.size());
  double fastest = 0.0, hardest = 0.0, stopped_at = -1.0;
  while (!runner.finished() && plant.truth().time < at + 3.0) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    if (plant.truth().time < at) continue;
    fastest = std::max(fastest, plant.truth().velocity.head<2>().norm());
    hardest = std::max(hardest, plant.truth().objects[0].force);
    if (runner.guard().stopped() && stopped_at < 0.0) stopped_at = plant.truth().time - at;
  }
  ASSERT_TRUE(runner.guard().stopped());
  const Event& event = runner.guard().stop_event();
  std::printf("%s, %s: %s after %.0f ms; %.3f m/s and %.1f N at most; stands %.0f ms later\n",
              GetParam().robot, GetParam().wheel, to_string(event.code), 1e3 * stopped_at, fastest, hardest,
              1e3 * (plant.truth().time - at - stopped_at));
  // By its own torque, or by the energy; either names the motor.
  EXPECT_TRUE(event.code == EventCode::runaway || event.code == EventCode::torque_flipped)
      << to_string(event.code);
  EXPECT_EQ(runner.event_signal(event).substr(0, std::string(GetParam().wheel).size() + 1),
            std::string(GetParam().wheel) + ".");
  EXPECT_LE(fastest, RunawayWatch::margin + 0.07);
  EXPECT_LE(hardest, 22.0) << "the bound and 10 %";
  EXPECT_TRUE(runner.finished());
  EXPECT_LE(plant.truth().time - at - stopped_at, 1.0) << "stands, and not because the time is up";
}

INSTANTIATE_TEST_SUITE_P(
    Wheels, MotorInContact,
    testing::Values(Flipped{"mecanum", "front_left_wheel"}, Flipped{"mecanum", "front_right_wheel"},
                    Flipped{"mecanum", "rear_left_wheel"}, Flipped{"mecanum", "rear_right_wheel"},
                    Flipped{"omni", "front_left_wheel"}, Flipped{"omni", "front_right_wheel"},
                    Flipped{"diff", "left_wheel"}, Flipped{"diff", "right_wheel"}),
    [](const auto& tested) { return std::string(tested.param.robot) + "_" + tested.param.wheel; });

/// A stop for another reason, on a base of which nobody knows that a motor is flipped: the brake finds it.
TEST(ProtectiveStop, BrakesWithAMotorThatTurnsTheWrongWay) {
  for (const auto& [robot, wheel] : {Flipped{"mecanum", "rear_left_wheel"},
                                     Flipped{"omni", "front_left_wheel"}, Flipped{"diff", "right_wheel"}}) {
    const lang::Program program = load(robot);
    ScenePlantOptions options;
    options.simulation.start_yaw = 0.0;
    options.faults.push_back(lang::Fault{.kind = lang::FaultKind::torque_flipped, .at = 3.0, .joint = wheel});
    ScenePlant plant(program, options);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    double rest_since = -1.0;
    while (plant.truth().time < 6.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      if (plant.truth().time >= 3.0) runner.guard().stop(EventCode::requested);
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
      const bool rests = plant.truth().velocity.head<2>().norm() < 0.01;
      if (!rests) rest_since = -1.0;
      if (rests && rest_since < 0.0) rest_since = plant.truth().time;
    }
    std::printf("%s, %s: stands %.2f s after the stop, x %.3f m\n", robot, wheel, rest_since - 3.0,
                plant.truth().x);
    EXPECT_EQ(runner.guard().reason(), EventCode::requested);
    EXPECT_GT(rest_since, 0.0) << robot;
    EXPECT_LT(rest_since, 4.0) << robot;
  }
}

/// Three omni wheels, or two of a differential base, do not brake every motion without one of them. A motor
/// that is taken for reversed, and is not, is found by its torque, and brakes again. The base stands then,
/// and the event tells it. A motor that really gives nothing, or the reverse, is never said to obey.
TEST(ProtectiveStop, BrakesAgainWithAMotorThatIsTakenForReversed) {
  struct Case {
    const char *robot, *wheel;
    std::optional<lang::FaultKind> fault;
  };
  const Case cases[] = {{"omni", "front_left_wheel", {}},
                        {"omni", "rear_wheel", {}},
                        {"diff", "right_wheel", {}},
                        {"mecanum", "rear_left_wheel", {}},
                        {"omni", "front_left_wheel", lang::FaultKind::torque_flipped},
                        {"omni", "front_left_wheel", lang::FaultKind::torque_lost},
                        {"diff", "right_wheel", lang::FaultKind::torque_flipped}};
  for (const Case& one : cases) {
    const lang::Program program = zwang::test::shipped_program("laws/circle.yaml", one.robot);
    ScenePlantOptions options;
    if (one.fault) options.faults.push_back({.kind = *one.fault, .at = 3.0, .joint = one.wheel});
    ScenePlant plant(program, options);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    const int joint = *program.robot.model.find_joint(one.wheel);
    while (!runner.finished() && plant.truth().time < 14.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      if (plant.truth().time >= 3.0) {
        runner.guard().stop(EventCode::torque_flipped, event_signal::of_joint(joint, event_signal::tau), 0.1);
      }
      ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    }
    const auto obeyed = std::ranges::count(runner.events(), EventCode::motor_obeyed, &Event::code);
    const double speed = plant.truth().velocity.head<2>().norm();
    std::printf("%s, %s: stands %.2f s after the stop, %.4f m/s, obeyed %d\n", one.robot, one.wheel,
                plant.truth().time - 3.0, speed, static_cast<int>(obeyed));
    EXPECT_EQ(obeyed > 0, runner.guard().motor_obeyed());
    if (one.fault) {
      EXPECT_EQ(obeyed, 0) << one.robot;
      continue;
    }
    EXPECT_LT(speed, 0.02) << one.robot << " " << one.wheel;
    EXPECT_FALSE(runner.may_still_move()) << one.robot << " " << one.wheel;
    EXPECT_LE(obeyed, 1) << one.robot;
    if (obeyed > 0) {
      EXPECT_NE(runner.because().find("obeyed"), std::string::npos) << runner.because();
    }
  }
}

/// All of them from the same moment on, or all encoders: no single one that is left out makes it better.
TEST(ProtectiveStop, BrakesWithAllMotorsThatTurnTheWrongWay) {
  for (const char* robot : {"mecanum", "omni", "diff", "kelo"}) {
    const lang::Program program = load(robot);
    ScenePlantOptions options;
    options.simulation.start_yaw = 0.0;
    ScenePlant plant(program, options);
    Runner runner(program, {.period = period});
    Sensed sensed(program.robot.model, program.signals.size());
    double fastest = 0.0;
    while (!runner.finished() && plant.truth().time < 10.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      const bool is_broken = plant.truth().time >= 3.0;
      if (is_broken) runner.guard().stop(EventCode::requested);
      const Eigen::VectorXd& tau = runner.step(sensed);
      ASSERT_EQ(plant.apply(is_broken ? Eigen::VectorXd(-tau) : tau), PlantStatus::ok);
      fastest = std::max(fastest, plant.truth().velocity.head<2>().norm());
    }
    std::printf("%s: stands %.2f s after the stop, %.3f m/s at most\n", robot, plant.truth().time - 3.0,
                fastest);
    EXPECT_LT(plant.truth().velocity.head<2>().norm(), 0.02) << robot;
    EXPECT_LT(plant.truth().time, 6.0) << robot;
    // One look finds it, and each motor is left out for one, while the others speed the base up with the
    // stop's force. A motion that begins between two looks is seen by the next but one.
    const double looks = static_cast<double>(program.robot.model.wheels().size()) + 3.0;
    const double a = program.robot.stop.force / program.robot.model.total_mass();
    EXPECT_LT(fastest, 0.08 + a * looks * 0.02) << robot;
  }
}

}  // namespace
}  // namespace zwang::runtime
