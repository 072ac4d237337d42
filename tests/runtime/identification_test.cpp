// Friction, torque constants, mass: the plant's own, from the motion of specs/identify.yaml.
#include "zwang/runtime/identification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <random>

#include "shipped_program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

constexpr double coulomb = 0.25, viscous = 0.05;  // [N m], [N m s/rad] of the first motor
constexpr double bound = 0.05;                    // the share of the truth that an estimate may be off

/// Each motor has more friction than the one before it; nobody makes up for it.
lang::Program rough(const std::string& robot) {
  lang::Program program = test::shipped_program("identify.yaml", robot);
  double more = 1.0;
  for (int j = 0; j < program.robot.model.joint_count(); ++j) {
    if (!program.robot.model.joint(j).actuated) continue;
    program.robot.friction[static_cast<std::size_t>(j)] = {more * coulomb, 1e-3, more * viscous, 0.0};
    more += 0.25;
  }
  return program;
}

constexpr double encoder_noise = 0.1;   // [rad/s] of a rate, one sample: encoders that are differentiated
constexpr double encoder_count = 1e-3;  // [rad]

/// Drives the task on its plant, and lets `identification` see what a log holds, and `noisy` what one of
/// such encoders holds. The motors give `factor` of what they are told.
void drive(lang::Program program, DriveIdentification& identification, double load, double factor,
           DriveIdentification* noisy = nullptr) {
  Runner runner(program);
  if (load > 0.0) {
    lang::Fault payload;
    payload.kind = lang::FaultKind::payload;
    payload.value = load;
    program.scene->faults.push_back(payload);
  }
  ScenePlant plant(program);
  identification.begin_run(load);
  if (noisy != nullptr) noisy->begin_run(load);
  std::mt19937 dice(7);
  std::normal_distribution<double> error(0.0, encoder_noise);
  Sensed sensed(program);
  while (!runner.finished()) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    const Eigen::VectorXd tau = runner.step(sensed);
    identification.add(sensed.time, sensed.state.q, sensed.state.qd, tau / factor);
    if (noisy != nullptr)
      noisy->add(sensed.time, encoder_count * (sensed.state.q / encoder_count).array().round(),
                 sensed.state.qd.unaryExpr([&](double rate) { return rate + error(dice); }), tau / factor);
    ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
  }
}

void expect_true(const Identification& found, const lang::Robot& robot, double factor) {
  for (const IdentifiedMotor& motor : found.motors) {
    const lang::JointFriction& truth =
        robot.friction[static_cast<std::size_t>(*robot.model.find_joint(motor.joint))];
    EXPECT_NEAR(motor.torque_factor.value, factor, bound * factor) << motor.joint;
    EXPECT_NEAR(motor.coulomb.value, truth.coulomb, bound * truth.coulomb) << motor.joint;
    EXPECT_NEAR(motor.viscous.value, truth.viscous, bound * truth.viscous) << motor.joint;
    // The error that is told is of the size of the error.
    EXPECT_LT(motor.coulomb.error, bound * truth.coulomb);
    EXPECT_LT(motor.viscous.error, bound * truth.viscous);
  }
}

TEST(DriveIdentification, FindsFrictionAndTorqueConstantsOfAKnownMass) {
  for (const char* robot : {"diff", "mecanum"}) {
    const lang::Program program = rough(robot);
    DriveIdentification identification(program.robot, program.robot.model.total_mass());
    drive(program, identification, 0.0, 0.9);
    expect_true(identification.solve(), program.robot, 0.9);
  }
}

/// Least squares estimate a tenth of the torque constants from such encoders, and a negative mass: a column
/// with noise is estimated too small.
TEST(DriveIdentification, FindsTheMassTooFromTwoRunsWithAKnownLoad) {
  const lang::Program program = rough("mecanum");
  const double mass = program.robot.model.total_mass();
  DriveIdentification identification(program.robot, std::nullopt), noisy(program.robot, std::nullopt);
  drive(program, identification, 0.0, 1.0, &noisy);
  drive(program, identification, 15.0, 1.0, &noisy);
  for (const Identification& found : {identification.solve(), noisy.solve()}) {
    expect_true(found, program.robot, 1.0);
    EXPECT_NEAR(found.mass.value, mass, bound * mass);
    EXPECT_LT(found.mass.error, bound * mass);
  }
  // Noise is told: a standard error that is neither none nor of another size than the estimate is off.
  const Estimate found = noisy.solve().mass;
  EXPECT_LT(std::abs(found.value - mass), 4.0 * found.error);
  EXPECT_GT(found.error, 1e-3 * mass);
}

/// A driver with a delay of 20 ms that low-passes its rates, and encoders of 1 mrad. Speeds that come 5 ms
/// late alone put 13 % into the viscous friction of a differential base.
TEST(DriveIdentification, ReckonsWithSamplesThatComeLate) {
  constexpr std::size_t late = 20;   // samples of 1 ms
  constexpr double low_pass = 0.02;  // [s]
  const lang::Program program = rough("diff");
  DriveIdentification identification(program.robot, program.robot.model.total_mass());
  Runner runner(program);
  ScenePlant plant(program);
  identification.begin_run(0.0);
  Sensed sensed(program);
  Eigen::VectorXd rates = sensed.state.qd;
  std::deque<Eigen::VectorXd> positions_on_the_way, rates_on_the_way;
  while (!runner.finished()) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    rates += 1e-3 / low_pass * (sensed.state.qd - rates);
    positions_on_the_way.push_back(encoder_count * (sensed.state.q / encoder_count).array().round());
    rates_on_the_way.push_back(rates);
    const Eigen::VectorXd tau = runner.step(sensed);
    if (rates_on_the_way.size() > late) {
      identification.add(sensed.time, positions_on_the_way.front(), rates_on_the_way.front(), tau);
      positions_on_the_way.pop_front();
      rates_on_the_way.pop_front();
    }
    ASSERT_EQ(plant.follow(runner.command()), PlantStatus::ok);
  }
  const Identification found = identification.solve();
  expect_true(found, program.robot, 1.0);
  // The plant steps speeds before positions, so half a step is missing.
  EXPECT_NEAR(found.lag, 0.02, 1e-3);
}

/// A wheel that slides without friction, and a torque that turns: nothing but an oracle's numbers.
void add_straight(DriveIdentification& identification, const lang::Robot& robot, double seconds,
                  double rate) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(robot.model.joint_count()), qd = q, tau = q;
  for (const solver::Wheel& wheel : robot.model.wheels()) qd(wheel.body - 1) = rate;
  for (double time = 0.0; time < seconds; time += 1e-3) {
    identification.add(time, q, qd, tau);
    q += 1e-3 * qd;
  }
}

TEST(DriveIdentification, TellsWhatIsMissing) {
  const lang::Robot robot = test::shipped_program("identify.yaml", "mecanum").robot;
  const auto why = [](const DriveIdentification& identification) -> std::string {
    try {
      identification.solve();
    } catch (const NotIdentified& error) {
      return error.what();
    }
    return "";
  };
  DriveIdentification still(robot, 40.0);
  still.begin_run(0.0);
  add_straight(still, robot, 5.0, 0.0);
  EXPECT_NE(why(still).find("0 windows"), std::string::npos) << why(still);
  DriveIdentification one_way(robot, 40.0);
  one_way.begin_run(0.0);
  add_straight(one_way, robot, 5.0, 2.0);
  EXPECT_NE(why(one_way).find("too little"), std::string::npos) << why(one_way);
}

TEST(DriveIdentification, RefusesDrivesWhoseMotorsItCannotTell) {
  const auto refusal = [](const char* robot, bool takes_velocity) -> std::string {
    lang::Diagnostics diagnostics;
    const std::string file = test::specs("robots/" + std::string(robot) + "_base.yaml");
    lang::Robot drawn = *lang::load_robot(file, diagnostics);
    drawn.drive.takes_velocity = takes_velocity;
    try {
      const DriveIdentification identification(drawn, 40.0);
    } catch (const NotIdentified& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal("mecanum", true).find("takes velocities"), std::string::npos);
  EXPECT_NE(refusal("swerve", false).find("steered"), std::string::npos);
  EXPECT_NE(refusal("skid", false).find("slides sideways"), std::string::npos);
}

}  // namespace
}  // namespace zwang::runtime
