// Contacts of the simulated plant: springs of the scene's stiffness, and forces that add up.
#include <gtest/gtest.h>

#include <cstdio>

#include "../is_long.hpp"
#include "plant_robots.hpp"

namespace zwang::runtime {
namespace {

using namespace testing;

constexpr double front = 0.40;  ///< [m] of the test bases' footprint

lang::SceneObject wall_with_face_at(double x) {
  lang::SceneObject wall;
  wall.name = "wall";
  wall.shape = lang::ShapeKind::wall;
  wall.size = {4.0, 0.2, 1.0};
  wall.at = {x, 0.0};
  return wall;
}

lang::SceneObject post_at(double x) {
  lang::SceneObject post;
  post.name = "post";
  post.shape = lang::ShapeKind::cylinder;
  post.size = {0.1, 0.1, 1.0};
  post.at = {x + 0.1, 0.0};
  return post;
}

lang::SceneObject crate_at(double x) {
  lang::SceneObject crate;
  crate.name = "crate";
  crate.shape = lang::ShapeKind::box;
  crate.size = {0.3, 0.3, 0.4};
  crate.at = {x + 0.15, 0.0};
  return crate;
}

lang::Scene scene_of(const lang::SceneObject& object) {
  lang::Scene scene;
  scene.objects = {object};
  return scene;
}

BaseDesign symmetric_design() {
  BaseDesign design;
  design.body_com.y() = 0.0;
  return design;
}

lang::Robot round_base() {
  lang::Robot robot = mecanum_base(symmetric_design());
  robot.footprint.clear();
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 24.0;
    robot.footprint.emplace_back(front * std::cos(angle), front * std::sin(angle), 0.0);
  }
  return robot;
}

void run(MujocoPlant& plant, const Eigen::VectorXd& tau, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / 1e-3));
  for (int i = 0; i < steps; ++i) ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
}

/// Pushes along x; sideways and yaw are held by springs that are at rest at 0, for one-point contacts are
/// unstable.
void push_and_hold(MujocoPlant& plant, const PlanarReference& reference, double push, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / 1e-3));
  for (int i = 0; i < steps; ++i) {
    const Truth& truth = plant.truth();
    const Vector3 wrench(push, -500.0 * truth.y - 300.0 * truth.velocity.y(),
                         -200.0 * truth.yaw - 60.0 * truth.velocity.z());
    ASSERT_EQ(plant.apply(reference.torque_of_wrench(wrench)), PlantStatus::ok);
  }
}

struct StaticCase {
  const char* what;
  lang::SceneObject object;
  lang::Robot robot;
  int points;
};

std::vector<StaticCase> static_cases() {
  const double face = front + 0.002;
  return {{"wall, two corners", wall_with_face_at(face), mecanum_base(), 2},
          {"wall, differential base", wall_with_face_at(face), differential_base(symmetric_design()), 2},
          {"post, one point", post_at(face), mecanum_base(), 1},
          {"crate, its two edges", crate_at(face), mecanum_base(), 2},
          {"wall, round base", wall_with_face_at(face), round_base(), 1},
          {"post, round base", post_at(face), round_base(), 1},
          {"crate, round base", crate_at(face), round_base(), 1}};
}

// Blocked, the object feels the push exactly, and gives way by F / (n K).
TEST(PlantContact, StaticPushGivesThePushAndItsSpringsDeflection) {
  std::vector<double> stiffnesses{1e4, 1e5, 1e6};
  for (StaticCase& c : static_cases()) {
    for (const double stiffness : stiffnesses) {
      c.object.stiffness = stiffness;
      c.object.damping = 1.0;
      MujocoPlant plant(c.robot, scene_of(c.object));
      const PlanarReference reference(c.robot.model);
      push_and_hold(plant, reference, 20.0, 2.0);
      EXPECT_NEAR(plant.truth().objects[0].force, 20.0, 0.1) << c.what << " K " << stiffness;
      const double expected = 20.0 / (c.points * stiffness);
      const double measured = plant.truth().x + front - (front + 0.002);
      std::printf("%s: K %.0e force %.4f deflection / (F/nK) %.4f yaw %.2e\n", c.what, stiffness,
                  plant.truth().objects[0].force, measured / expected, plant.truth().yaw);
      EXPECT_NEAR(measured, expected, 0.01 * expected) << c.what;
    }
    if (!zwang::test::is_long()) stiffnesses = {1e5};  // all three of the first contact
  }
}

// A soft wall takes both corners of a side that presses on it askew, each as deep as it lies in the wall. The
// way out of its other faces, metres off, is none.
TEST(PlantContact, ASoftWallTakesASideThatIsAskew) {
  lang::SceneObject wall = wall_with_face_at(front + 0.002);
  wall.stiffness = 1e3;
  wall.damping = 1.0;
  for (const double yaw : {-0.05, -0.03, 0.025, 0.04}) {
    SCOPED_TRACE(yaw);
    wall.at[1] = yaw < 0.0 ? -1.0 : 1.0;  // more of it on the other side than on that of the corner behind
    MujocoPlant plant(mecanum_base(symmetric_design()), scene_of(wall));
    const PlanarReference reference(mecanum_base(symmetric_design()).model);
    for (int i = 0; i < 3000; ++i) {
      const Truth& truth = plant.truth();
      const Vector3 wrench(40.0, -500.0 * truth.y - 300.0 * truth.velocity.y(),
                           -2000.0 * (truth.yaw - yaw) - 200.0 * truth.velocity.z());
      ASSERT_EQ(plant.apply(reference.torque_of_wrench(wrench)), PlantStatus::ok);
    }
    const Truth& truth = plant.truth();
    double depth = 0.0;
    for (const double side : {-0.28, 0.28}) {
      const double corner = truth.x + front * std::cos(truth.yaw) - side * std::sin(truth.yaw);
      EXPECT_GT(corner, wall.at[0]) << "both are in the wall";
      depth += corner - wall.at[0];
    }
    EXPECT_NEAR(truth.objects[0].force, wall.stiffness * depth, 0.01 * 40.0);
    EXPECT_NEAR(truth.objects[0].force, 40.0, 0.01 * 40.0);
    EXPECT_LT(truth.objects[0].peak_force, 2.0 * 40.0) << "what a sudden force makes of a spring at most";
  }
}

/// A base that presses with 20 N against a wall of friction 0.3, and pulls along it.
struct Slide {
  Slide(double pull, double damping)
      : robot(mecanum_base(symmetric_design())),
        reference(robot.model),
        plant(robot, scene_of(rough(damping))) {
    run(plant, reference.torque_of_wrench({press, 0.0, 0.0}), 1.0);
    torque = reference.torque_of_wrench({press, pull, 0.0});
  }
  static lang::SceneObject rough(double damping) {
    lang::SceneObject wall = wall_with_face_at(front + 0.002);
    wall.stiffness = 5e4;
    wall.damping = damping;
    wall.friction = 0.3;
    return wall;
  }
  static constexpr double press = 20.0;
  static constexpr double friction = 0.3 * press;
  lang::Robot robot;
  PlanarReference reference;
  MujocoPlant plant;
  Eigen::VectorXd torque;
};

// Newton: the wall takes mu N along it, as much at any speed, and the press arrives while it does.
TEST(PlantContact, SlidingTakesItsFrictionAndPressesSteadily) {
  for (const double damping : {0.3, 1.0}) {
    Slide slide(11.0, damping);
    run(slide.plant, slide.torque, 0.2);
    const double before = slide.plant.truth().velocity.y();
    double least = 100.0, most = 0.0;
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(slide.plant.apply(slide.torque), PlantStatus::ok);
      least = std::min(least, slide.plant.truth().objects[0].force);
      most = std::max(most, slide.plant.truth().objects[0].force);
    }
    const double gained = slide.plant.truth().velocity.y() - before;
    const double expected = (11.0 - Slide::friction) / slide.reference.apparent_mass({0.0, 1.0, 0.0});
    std::printf("damping %.1f: %.4f to %.4f N, speed gained %.5f m/s, expected %.5f\n", damping, least, most,
                gained, expected);
    EXPECT_NEAR(gained, expected, 0.02 * expected);
    EXPECT_NEAR(least, Slide::press, 0.2);
    EXPECT_NEAR(most, Slide::press, 0.2);
  }
}

TEST(PlantContact, FrictionHoldsWithoutCreep) {
  Slide slide(5.0, 0.3);
  run(slide.plant, slide.torque, 1.0);
  const double before = slide.plant.truth().y;
  run(slide.plant, slide.torque, 5.0);
  EXPECT_NEAR(slide.plant.truth().y, before, 1e-6);
  // The base turns on the springs at its corners; where it touches it stays, once the jump of the pull is
  // over.
  EXPECT_NEAR(slide.plant.truth().y + front * slide.plant.truth().yaw, 0.0, 1e-4);
}

// An undamped wall blocks the base at the speed v under the push F. The energy gives the peak F + sqrt(F^2 +
// n K m v^2). The step h takes the share (h w)^2 pi/8 of it, w^2 = n K/m.
TEST(PlantContact, UndampedImpactPeakIsThatOfTheSpring) {
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    for (const double push : {5.0, 20.0}) {
      const lang::Robot robot = mecanum_base(symmetric_design());
      const PlanarReference reference(robot.model);
      lang::SceneObject wall = wall_with_face_at(front + 0.05);
      wall.stiffness = stiffness;
      wall.damping = 0.0;
      MujocoPlant plant(robot, scene_of(wall));
      const Eigen::VectorXd tau = reference.torque_of_wrench({push, 0.0, 0.0});
      double speed = 0.0;
      while (!plant.truth().objects[0].touched) {
        speed = plant.truth().velocity.x();
        ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
        ASSERT_LT(plant.truth().time, 10.0);
      }
      run(plant, tau, 0.3);
      const double mass = reference.apparent_mass({1.0, 0.0, 0.0});
      const double taken = std::numbers::pi / 8.0 * 1e-3 * 1e-3 * 2.0 * stiffness / mass;
      const double expected =
          (1.0 - taken) * (push + std::sqrt(push * push + 2.0 * stiffness * mass * speed * speed));
      std::printf("K %.0e push %.0f v %.4f: peak %.3f expected %.3f ratio %.4f\n", stiffness, push, speed,
                  plant.truth().objects[0].peak_force, expected,
                  plant.truth().objects[0].peak_force / expected);
      EXPECT_NEAR(plant.truth().objects[0].peak_force, expected, 0.02 * expected);
    }
  }
}

// Coasting into the wall with one corner: the mass that counts is the one that the corner feels along the
// normal.
TEST(PlantContact, CornerImpactFeelsTheMassAtTheCorner) {
  const lang::Robot robot = mecanum_base();
  const PlanarReference reference(robot.model);
  const double yaw = 20.0 * std::numbers::pi / 180.0;
  lang::SceneObject wall = wall_with_face_at(0.62);
  wall.stiffness = 1e5;
  wall.damping = 0.0;
  MujocoPlantOptions options;
  options.start_yaw = yaw;
  MujocoPlant plant(robot, scene_of(wall), options);
  const Vector3 normal(std::cos(yaw), -std::sin(yaw), 0.0);  // of the wall, in base axes
  const Vector3 demand = 0.2 * normal;
  while (plant.truth().velocity.norm() < 0.1) {
    ASSERT_EQ(plant.apply(reference.torque(demand, plant.truth().velocity)), PlantStatus::ok);
  }
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(4);
  double speed = 0.0;
  while (!plant.truth().objects[0].touched) {
    speed = plant.truth().velocity.dot(normal);
    ASSERT_EQ(plant.apply(zero), PlantStatus::ok);
    ASSERT_LT(plant.truth().time, 10.0);
  }
  const Vector3 corner(0.40, -0.28, 0.0);  // the one ahead: cos * 0.40 + sin * 0.28 along the normal
  // The corner that touches first has the larger part along the normal.
  const Vector3 other(0.40, 0.28, 0.0);
  const Vector3& first = corner.dot(normal) > other.dot(normal) ? corner : other;
  const Vector3 direction(normal.x(), normal.y(), first.x() * normal.y() - first.y() * normal.x());
  run(plant, zero, 0.05);
  const double expected = std::sqrt(wall.stiffness * reference.apparent_mass(direction)) * speed;
  std::printf("corner: v %.4f mass %.2f peak %.3f expected %.3f\n", speed, reference.apparent_mass(direction),
              plant.truth().objects[0].peak_force, expected);
  EXPECT_NEAR(plant.truth().objects[0].peak_force, expected, 0.02 * expected);
}

TEST(PlantContact, FirstTouchIsWhenTheFootprintReachesTheWall) {
  const lang::Robot robot = mecanum_base(symmetric_design());
  const PlanarReference reference(robot.model);
  MujocoPlant plant(robot, scene_of(wall_with_face_at(front + 0.1)));
  const Eigen::VectorXd tau = reference.torque_of_wrench({20.0, 0.0, 0.0});
  run(plant, tau, 2.0);
  // From rest under a constant force: t = sqrt(2 s m / F).
  const double expected = std::sqrt(2.0 * 0.1 * reference.apparent_mass({1.0, 0.0, 0.0}) / 20.0);
  ASSERT_TRUE(plant.truth().objects[0].touched);
  EXPECT_NEAR(*plant.truth().objects[0].touched, expected, 0.002);
}

// Coulomb friction at the wall: under 0.1 * 20 N = 2 N sideways the base sticks, above it slides by the rest.
TEST(PlantContact, WallFrictionHoldsAndThenSlides) {
  const lang::Robot robot = mecanum_base(symmetric_design());
  const PlanarReference reference(robot.model);
  lang::SceneObject wall = wall_with_face_at(front + 0.001);
  wall.friction = 0.1;
  MujocoPlant plant(robot, scene_of(wall));
  run(plant, reference.torque_of_wrench({20.0, 0.0, 0.0}), 3.0);
  const double still = plant.truth().y;
  run(plant, reference.torque_of_wrench({20.0, 1.0, 0.4}), 1.0);
  EXPECT_LT(std::abs(plant.truth().y - still), 5e-4);
  run(plant, reference.torque_of_wrench({20.0, 4.0, 0.8}), 0.5);
  const double before = plant.truth().velocity.y();
  run(plant, reference.torque_of_wrench({20.0, 4.0, 0.8}), 1.0);
  const double measured = plant.truth().velocity.y() - before;
  const double expected = (4.0 - 2.0) / reference.apparent_mass({0.0, 1.0, 0.0});
  std::printf("sliding: %.5f m/s^2, expected %.5f\n", measured, expected);
  EXPECT_NEAR(measured, expected, 0.02 * expected);
}

// A crate on the floor: under mu m g it stays, above it the robot presses with what friction and inertia
// take.
TEST(PlantContact, PushedCrateTakesFrictionAndInertia) {
  const lang::Robot robot = mecanum_base(symmetric_design());
  const PlanarReference reference(robot.model);
  lang::SceneObject crate = crate_at(front + 0.001);
  crate.mass = 5.0;
  crate.damping = 1.0;
  crate.yaw = 0.5 * std::numbers::pi;
  lang::Scene scene = scene_of(crate);
  scene.floor_friction = 0.6;
  const double friction = 0.6 * 5.0 * 9.81;
  MujocoPlant plant(robot, scene);
  run(plant, reference.torque_of_wrench({25.0, 0.0, 0.0}), 3.0);
  EXPECT_NEAR(plant.truth().objects[0].force, 25.0, 0.1);
  const double still = plant.truth().x;
  run(plant, reference.torque_of_wrench({25.0, 0.0, 0.0}), 1.0);
  EXPECT_NEAR(plant.truth().x, still, 1e-6);

  const Eigen::VectorXd tau = reference.torque_of_wrench({60.0, 0.0, 0.0});
  run(plant, tau, 0.5);
  const double acceleration = (60.0 - friction) / (reference.apparent_mass({1.0, 0.0, 0.0}) + 5.0);
  EXPECT_NEAR(plant.truth().acceleration.x(), acceleration, 0.005 * acceleration);
  EXPECT_NEAR(plant.truth().objects[0].force, friction + 5.0 * acceleration, 0.005 * friction);
}

// Beyond the crate stands a wall: what the robot presses the crate with reaches the wall through it.
TEST(PlantContact, CrateAgainstAWallIsBlocked) {
  const lang::Robot robot = mecanum_base(symmetric_design());
  const PlanarReference reference(robot.model);
  lang::SceneObject crate = crate_at(front + 0.001);
  crate.mass = 5.0;
  crate.damping = 1.0;
  lang::Scene scene = scene_of(crate);
  scene.objects.push_back(wall_with_face_at(front + 0.35));
  MujocoPlant plant(robot, scene);
  run(plant, reference.torque_of_wrench({80.0, 0.0, 0.0}), 4.0);
  EXPECT_NEAR(plant.truth().objects[0].force, 80.0, 0.4);
  EXPECT_FALSE(plant.truth().objects[1].touched);
  EXPECT_NEAR(plant.truth().x, 0.05, 0.002);
}

// An object lower than the bumper is driven over: the footprint is a line at the bumper's height.
TEST(PlantContact, ObjectsBelowTheBumperAreNotTouched) {
  const lang::Robot robot = mecanum_base();
  const PlanarReference reference(robot.model);
  lang::SceneObject kerb = wall_with_face_at(front + 0.01);
  kerb.size[2] = 0.1;
  MujocoPlant plant(robot, scene_of(kerb));
  run(plant, reference.torque_of_wrench({20.0, 0.0, 0.0}), 1.0);
  EXPECT_FALSE(plant.truth().objects[0].touched);
  EXPECT_GT(plant.truth().x, 0.1);
}

}  // namespace
}  // namespace zwang::runtime
