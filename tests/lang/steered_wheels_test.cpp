// Steered wheels that do not point exactly where they should: by the error of their motors, or by a trail
// that a tyre does not feel. The oracle is the same robot, steered and drawn exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "support.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/base_analysis.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::lang {
namespace {

using solver::Axis;
using solver::AxisConstraint;
using solver::Driver;
using solver::Quantity;

constexpr double one_degree = std::numbers::pi / 180.0;

struct RoverDrawing {
  double ahead = 0.0;         // [m] of the front wheels before their swivels
  bool swings_round = false;  // the steering is a swivel without end
};

/// Six wheels of 80 mm, the four at the corners steered, as on rovers with a rocker.
std::string rover_urdf(const RoverDrawing& drawing) {
  const auto inertial = [](double mass, double inertia) {
    std::ostringstream text;
    text << "<inertial><mass value=\"" << mass << "\"/><inertia ixx=\"" << inertia
         << "\" ixy=\"0\" ixz=\"0\" iyy=\"" << inertia << "\" iyz=\"0\" izz=\"" << inertia
         << "\"/></inertial>";
    return text.str();
  };
  std::ostringstream urdf;
  urdf << "<robot name=\"rover\"><link name=\"base_link\">" << inertial(20.0, 0.8) << "</link>";
  const auto wheel = [&](const std::string& name, const std::string& parent, double x, double y, double z) {
    urdf << "<link name=\"" << name << "_link\">" << inertial(0.8, 0.003) << "</link><joint name=\"" << name
         << "\" type=\"continuous\"><parent link=\"" << parent << "\"/><child link=\"" << name
         << "_link\"/><origin xyz=\"" << x << ' ' << y << ' ' << z
         << "\"/><axis xyz=\"0 1 0\"/><limit effort=\"5\" velocity=\"10\"/></joint>";
  };
  for (const int side : {1, -1}) {
    const std::string suffix = side > 0 ? "_left" : "_right";
    wheel("middle" + suffix, "base_link", 0.02, 0.28 * side, 0.08);
    for (const int end : {1, -1}) {
      const std::string name = (end > 0 ? "front" : "rear") + suffix;
      urdf << "<link name=\"" << name << "_fork\">" << inertial(0.8, 0.003) << "</link><joint name=\"" << name
           << "_steering\" type=\"" << (drawing.swings_round ? "continuous" : "revolute")
           << "\"><parent link=\"base_link\"/><child link=\"" << name << "_fork\"/><origin xyz=\""
           << 0.3 * end << ' ' << 0.25 * side
           << " 0.2\"/><axis xyz=\"0 0 1\"/><limit effort=\"20\" velocity=\"3\" lower=\"-0.52\""
           << " upper=\"0.52\"/></joint>";
      wheel(name, name + "_fork", end > 0 ? drawing.ahead : 0.0, 0.02 * side, -0.12);
    }
  }
  urdf << "</robot>";
  return urdf.str();
}

Robot loaded_rover(const RoverDrawing& drawing) {
  std::ostringstream file;
  file << "zwang_robot: 1\nurdf: rover.urdf\nbase: base_link\nwheels:\n";
  for (const char* wheel :
       {"front_left", "front_right", "middle_left", "middle_right", "rear_left", "rear_right"})
    file << "  - {joint: " << wheel << ", radius: 80 mm}\n";
  file << "actuated:\n";
  for (const char* wheel :
       {"front_left", "front_right", "middle_left", "middle_right", "rear_left", "rear_right"})
    file << "  " << wheel << ": {}\n";
  for (const char* wheel : {"front_left", "front_right", "rear_left", "rear_right"})
    file << "  " << wheel << "_steering: {rotor_inertia: 0.05 kg m^2}\n";
  file << "stop: {deceleration: 1 m/s^2, force: 30 N}\n"
          "footprint: {polygon: [[0.4 m, 0.3 m], [-0.4 m, 0.3 m], [-0.4 m, -0.3 m], [0.4 m, -0.3 m]]}\n";
  const test::Folder folder;
  folder.write("rover.urdf", rover_urdf(drawing));
  Diagnostics diagnostics;
  std::optional<Robot> robot = load_robot(folder.write("rover.yaml", file.str()), diagnostics);
  if (!robot) throw std::runtime_error(test::rendered(diagnostics));
  return std::move(*robot);
}

Robot loaded_swerve() {
  Diagnostics diagnostics;
  std::optional<Robot> robot = load_robot(test::source_dir / "specs/robots/swerve_base.yaml", diagnostics);
  if (!robot) throw std::runtime_error(test::rendered(diagnostics));
  return std::move(*robot);
}

/// Each steering stands up to `most` aside.
solver::State steered_by(const Robot& robot, double most, unsigned seed) {
  solver::State state = start_state(robot);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> error(-most, most);
  for (int j = 0; j < robot.model.joint_count(); ++j) {
    if (robot.model.joint(j).name.ends_with("_steering")) state.q(j) += error(random);
  }
  return state;
}

/// The acceleration along x of a base that 20 N push ahead, while rows keep y, rz and the steering at rest.
double pushed_ahead(const Robot& robot, const solver::State& state) {
  solver::ConstraintSet set(16, 32);
  AxisConstraint row;
  row.move = row.in = {0, {}};
  for (const Axis axis : {Axis::x, Axis::y, Axis::rz}) {
    row.axis = axis;
    row.driver = Driver{.quantity = axis == Axis::x ? Quantity::force : Quantity::velocity,
                        .target = axis == Axis::x ? 20.0 : 0.0};
    if (!set.add(row)) throw std::logic_error("a row is refused");
  }
  for (int j = 0; j < robot.model.joint_count(); ++j) {
    if (!robot.model.joint(j).name.ends_with("_steering")) continue;
    AxisConstraint hold;
    hold.move = {j + 1, {}};
    hold.in = {0, {}};
    hold.axis = Axis::rz;
    hold.driver = Driver{.quantity = Quantity::velocity, .target = 0.0};
    hold.level = 2;
    if (!set.add(hold)) throw std::logic_error("a row is refused");
  }
  if (!set.fill(robot.model, state)) throw std::logic_error("the rows are not filled");
  solver::Solver solver(robot.model);
  solver::Solution solution(robot.model, 64);
  const solver::Status status = solver.solve(state, set.rows(), solution);
  if (status != solver::Status::ok) throw std::logic_error("not solved");
  return solution.acceleration[0].linear.x();
}

void expect_to_drive_as_exact(const Robot& robot, const Robot& exact, double error) {
  const solver::BaseAnalysis should = solver::analyse_base(exact.model, start_state(exact));
  const double ahead = pushed_ahead(exact, start_state(exact));
  ASSERT_GT(ahead, 0.1);
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const solver::State state = steered_by(robot, error, seed);
    const solver::BaseAnalysis is = solver::analyse_base(robot.model, state);
    EXPECT_EQ(is.base_mobility, should.base_mobility);
    EXPECT_EQ(is.mobility, should.mobility);
    EXPECT_EQ(is.axes[0].reachable, should.axes[0].reachable);
    EXPECT_EQ(is.axes[1].reachable, should.axes[1].reachable);
    EXPECT_EQ(is.axes[2].reachable, should.axes[2].reachable);
    // A mass that lies aside by the error e changes by its share, at most 2 e.
    EXPECT_NEAR(is.axes[0].effective_mass / should.axes[0].effective_mass, 1.0, 2.0 * error + 1e-9);
    EXPECT_NEAR(pushed_ahead(robot, state) / ahead, 1.0, 2.0 * error + 1e-9);
  }
}

TEST(SteeredWheels, ATenthOfADegreeOfEachSteeringHoldsNoSwerveBase) {
  const Robot swerve = loaded_swerve();
  for (const double error : {0.1 * one_degree, 6e-5, 1e-7}) {
    SCOPED_TRACE(error);
    expect_to_drive_as_exact(swerve, swerve, error);
  }
}

TEST(SteeredWheels, ATenthOfADegreeOfEachSteeringHoldsNoRover) {
  const Robot rover = loaded_rover({});
  for (const double error : {0.1 * one_degree, 6e-5, 1e-7}) {
    SCOPED_TRACE(error);
    expect_to_drive_as_exact(rover, rover, error);
  }
}

// In exact arithmetic, the wheel turns its steering as the base drives, and what holds it stops the base.
TEST(SteeredWheels, AWheelThatStandsBeforeItsSteeringHoldsNoBase) {
  const Robot exact = loaded_rover({});
  expect_to_drive_as_exact(loaded_rover({.ahead = 6.2e-3}), exact, 0.1 * one_degree);
}

TEST(SteeredWheels, BeyondATenthOfTheRadiusAndUnderASwivelAWheelTrails) {
  const auto freedoms = [](const RoverDrawing& drawing) {
    const Robot rover = loaded_rover(drawing);
    return solver::analyse_base(rover.model, start_state(rover)).mobility;
  };
  EXPECT_EQ(freedoms({.ahead = 7.9e-3}), 5) << "ahead, and each steering by itself";
  EXPECT_EQ(freedoms({.ahead = 8.1e-3}), 3) << "the base's way turns the front wheels";
  EXPECT_EQ(freedoms({.ahead = 7.9e-3, .swings_round = true}), 3);
}

TEST(SteeredWheels, TwoDegreesOfToeHold) {
  const Robot swerve = loaded_swerve();
  solver::State state = start_state(swerve);
  state.q(swerve.model.find_joint("front_left_steering").value()) = 2.0 * one_degree;
  state.q(swerve.model.find_joint("rear_right_steering").value()) = -2.0 * one_degree;
  EXPECT_EQ(solver::analyse_base(swerve.model, state).base_mobility, 0);
}

}  // namespace
}  // namespace zwang::lang
