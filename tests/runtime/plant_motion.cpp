// The simulated plant moves as our model says: its apparent mass, and its acceleration under open-loop
// torques.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "plant_robots.hpp"

namespace zwang::runtime {
namespace {

using namespace testing;

const lang::Scene empty_scene;

Vector3 planar_twist(const Sensed& sensed) {
  const auto& twist = sensed.state.base_twist;
  return {twist.linear.x(), twist.linear.y(), twist.angular.z()};
}

TEST(PlantMotion, StartsExactlyWhereAskedAndStandsStill) {
  const lang::Robot robot = mecanum_base();
  MujocoPlantOptions options;
  options.start_at = {0.7, -0.3};
  options.start_yaw = 2.5;
  MujocoPlant plant(robot, empty_scene, options);
  EXPECT_NEAR(plant.truth().x, 0.7, 1e-12);
  EXPECT_NEAR(plant.truth().y, -0.3, 1e-12);
  EXPECT_NEAR(plant.truth().yaw, 2.5, 1e-12);
  EXPECT_EQ(plant.truth().time, 0.0);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(4);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(plant.apply(zero), PlantStatus::ok);
    ASSERT_LT(plant.truth().acceleration.norm(), 1e-3) << "step " << i;
  }
  EXPECT_NEAR(plant.truth().time, 1.0, 1e-9);
  EXPECT_LT(std::hypot(plant.truth().x - 0.7, plant.truth().y + 0.3), 1e-5);
}

// A URDF gives what CAD made of it: products of inertia, a millionth of the moments among them.
TEST(PlantMotion, TakesProductsOfInertiaOfAnySize) {
  for (double product = 1e-9; product < 1.0; product *= 3.0) {
    BaseDesign design;
    design.body_product = product;
    EXPECT_NO_THROW(MujocoPlant(mecanum_base(design), empty_scene)) << product;
  }
}

// Constant torques after the contacts' few milliseconds: the acceleration is that of the model's mass matrix.
void compare_apparent_mass(const char* what, const lang::Robot& robot) {
  const PlanarReference reference(robot.model);
  for (int wheel = 0; wheel < robot.model.joint_count(); ++wheel) {
    MujocoPlant plant(robot, empty_scene);
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(robot.model.joint_count());
    tau[wheel] = 0.5;
    Vector3 measured = Vector3::Zero(), expected = Vector3::Zero();
    for (int i = 0; i < 100; ++i) {
      const Vector3 v = plant.truth().velocity;
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
      if (i < 50) continue;
      measured += plant.truth().acceleration / 50.0;
      expected += reference.acceleration(tau, v) / 50.0;
    }
    const Vector3 error = (measured - expected).cwiseAbs();
    for (int axis = 0; axis < 3; ++axis) {
      const double size = std::max(std::abs(expected[axis]), 0.1 * expected.norm());
      EXPECT_LT(error[axis], 1e-3 * size) << what << ", wheel " << wheel << ", axis " << axis;
    }
    std::printf("%s, wheel %d: largest error %.2e of %.4f\n", what, wheel, error.maxCoeff(), expected.norm());
  }
}

TEST(PlantMotion, ApparentMassIsTheModels) {
  compare_apparent_mass("mecanum", mecanum_base());
  compare_apparent_mass("mirrored mecanum", mirrored_mecanum_base());
  compare_apparent_mass("three omni wheels", omni_base());
  compare_apparent_mass("differential", differential_base());
  compare_apparent_mass("mecanum at 30 deg", steep_mecanum_base());
}

struct Rms {
  double error = 0.0, demand = 0.0;
};

/// Sine demands on the axes of `amplitude`. Returns the rms error of each axis over its demand's rms. An axis
/// without a demand counts over the largest one.
Vector3 open_loop_error(const lang::Robot& robot, const Vector3& amplitude, const Vector3& frequency) {
  const PlanarReference reference(robot.model);
  MujocoPlant plant(robot, empty_scene);
  Sensed sensed(robot.model);
  std::array<Rms, 3> sums{};
  for (int i = 0; i < 4000; ++i) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    Vector3 demand;
    for (int axis = 0; axis < 3; ++axis) {
      demand[axis] = amplitude[axis] * std::sin(2.0 * std::numbers::pi * frequency[axis] * sensed.time);
    }
    EXPECT_EQ(plant.apply(reference.torque(demand, planar_twist(sensed))), PlantStatus::ok);
    if (sensed.time < 0.05) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      sums[axis].error += std::pow(plant.truth().acceleration[a] - demand[a], 2);
      sums[axis].demand += std::pow(demand[a], 2);
    }
  }
  double largest = 0.0;
  for (const Rms& sum : sums) largest = std::max(largest, sum.demand);
  Vector3 error;
  for (int axis = 0; axis < 3; ++axis) {
    const Rms& sum = sums[static_cast<std::size_t>(axis)];
    error[axis] = std::sqrt(sum.error / (sum.demand > 0.0 ? sum.demand : largest));
  }
  std::printf("open loop: relative rms error x %.5f y %.5f yaw %.5f\n", error[0], error[1], error[2]);
  return error;
}

TEST(PlantMotion, OpenLoopAccelerationOfTheMecanumBase) {
  const lang::Robot robot = mecanum_base();
  for (const Vector3& amplitude :
       {Vector3(0.5, 0.0, 0.0), Vector3(0.0, 0.5, 0.0), Vector3(0.0, 0.0, 1.0), Vector3(0.5, 0.5, 1.0)}) {
    const Vector3 error = open_loop_error(robot, amplitude, {1.0, 0.7, 0.5});
    EXPECT_LE(error.maxCoeff(), 0.002) << "amplitude " << amplitude.transpose();
  }
}

// Wheels that spheres cannot stand for turn on hinges, and their contact holds one direction.
TEST(PlantMotion, OpenLoopAccelerationOnHingedWheelsWithRollers) {
  const lang::Robot robot = steep_mecanum_base();
  for (const Vector3& amplitude :
       {Vector3(0.5, 0.0, 0.0), Vector3(0.0, 0.5, 0.0), Vector3(0.0, 0.0, 1.0), Vector3(0.5, 0.5, 1.0)}) {
    const Vector3 error = open_loop_error(robot, amplitude, {1.0, 0.7, 0.5});
    EXPECT_LE(error.maxCoeff(), 0.005) << "amplitude " << amplitude.transpose();
  }
}

// A wheel that holds sideways only, as an idle roller along its axis: it lets the base roll ahead freely.
TEST(PlantMotion, AWheelThatHoldsSidewaysOnlyRollsFreely) {
  const lang::Robot idle =
      build_base({}, {{"a", 0.2, 0.2, 0.0}, {"b", 0.2, -0.2, 0.0}, {"c", -0.2, 0.0, 0.0}});
  MujocoPlant plant(idle, empty_scene);
  const Eigen::VectorXd tau = Eigen::VectorXd::Constant(3, 0.5);
  for (int i = 0; i < 200; ++i) ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  EXPECT_LT(plant.truth().velocity.norm(), 1e-3) << "its motors turn it on the spot";
  Sensed sensed(idle.model);
  ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
  const double axial = idle.model.bodies()[1].inertia.rotational(1, 1) + idle.model.joint(0).rotor_inertia;
  EXPECT_NEAR(std::abs(sensed.state.qd[0]), 0.5 / axial * sensed.time, 0.01 * 0.5 / axial * sensed.time);
}

TEST(PlantMotion, OpenLoopAccelerationOfTheDifferentialBase) {
  const lang::Robot robot = differential_base();
  for (const Vector3& amplitude : {Vector3(0.5, 0.0, 0.0), Vector3(0.0, 0.0, 1.0), Vector3(0.5, 0.0, 1.0)}) {
    const Vector3 error = open_loop_error(robot, amplitude, {1.0, 0.7, 0.5});
    EXPECT_LE(std::max(error[0], error[2]), 0.005) << "amplitude " << amplitude.transpose();
  }
}

// Driving a circle at constant speed: the wheels' angles are those of rolling without slip.
TEST(PlantMotion, WheelAnglesFollowFromRolling) {
  const lang::Robot robot = mecanum_base();
  const PlanarReference reference(robot.model);
  MujocoPlant plant(robot, empty_scene);
  Sensed sensed(robot.model);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(4);
  for (int i = 0; i < 2000; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    const Vector3 v = planar_twist(sensed);
    const Vector3 demand = i < 500 ? Vector3(0.6, -0.4, 0.8) : Vector3(Vector3::Zero());
    ASSERT_EQ(plant.apply(reference.torque(demand, v)), PlantStatus::ok);
    for (Eigen::Index w = 0; w < 4; ++w) {
      expected[w] += 1e-3 * -reference.P.row(w).head<3>().dot(plant.truth().velocity) / reference.P(w, 3 + w);
    }
  }
  ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
  EXPECT_LT((sensed.state.q - expected).cwiseAbs().maxCoeff(), 1e-3 * expected.cwiseAbs().maxCoeff())
      << sensed.state.q.transpose() << " against " << expected.transpose();
  const Eigen::VectorXd rates = -(reference.P.leftCols<3>() * planar_twist(sensed))
                                     .cwiseQuotient(reference.P.rightCols<4>().diagonal());
  EXPECT_LT((sensed.state.qd - rates).cwiseAbs().maxCoeff(), 1e-3 * rates.cwiseAbs().maxCoeff());
}

// A bolted arm of two joints on tilted mounts: rotor inertia, axes and gravity as in the model.
TEST(PlantMotion, BoltedArmFollowsItsEquationsOfMotion) {
  const double mass = 2.0, length = 0.4, across = 0.02, rotor = 0.05, tilt = 0.3;
  solver::ModelBuilder builder(solver::BaseType::fixed, "pedestal", {});
  solver::Joint hinge;
  hinge.name = "hinge";
  hinge.type = solver::JointType::revolute;
  hinge.axis = Vector3::UnitX();
  hinge.rotor_inertia = rotor;
  hinge.actuated = true;
  builder.add_link(
      "arm", "pedestal", {solver::rotation_from_rpy(0.0, 0.0, tilt), {0.1, 0.2, 1.0}}, hinge,
      RigidInertia::from_com(mass, {0.0, length, 0.0}, Vector3(across, 0.005, across).asDiagonal()));
  lang::Robot robot;
  robot.model = builder.build();
  MujocoPlant plant(robot, empty_scene);
  Sensed sensed(robot.model);
  const double inertia = across + mass * length * length + rotor;
  const double torque = 9.0;
  double q = 0.0, qd = 0.0;
  for (int i = 0; i < 500; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    EXPECT_NEAR(sensed.state.q[0], q, 1e-9);
    EXPECT_NEAR(sensed.state.qd[0], qd, 1e-9);
    ASSERT_EQ(plant.apply(Eigen::VectorXd::Constant(1, torque)), PlantStatus::ok);
    qd += 1e-3 * (torque - mass * 9.81 * length * std::cos(q)) / inertia;
    q += 1e-3 * qd;
  }
  EXPECT_GT(std::abs(q), 0.1);
}

TEST(PlantMotion, RealTimeFactor) {
  const lang::Robot robot = mecanum_base();
  MujocoPlant plant(robot, empty_scene);
  Sensed sensed(robot.model);
  const Eigen::VectorXd tau = Eigen::VectorXd::Constant(4, 0.02);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 5000; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("real-time factor of the plant alone: %.1f\n", 5.0 / seconds);
  RecordProperty("real_time_factor", std::to_string(5.0 / seconds));
}

}  // namespace
}  // namespace zwang::runtime
