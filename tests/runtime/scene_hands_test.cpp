// Hands, force sensors, leaning objects and flat ends of arms in a scene. Expected values are closed forms of
// statics and of uniform acceleration.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plant/scene_signals.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {
namespace {

using solver::Vector3;

constexpr double reach = 0.2;   // [m] from the tool's joint to its tip
constexpr double ahead = 0.5;   // [m] of the tip from the base
constexpr double height = 0.5;  // [m]

solver::RigidInertia ball(double mass) {
  return solver::RigidInertia::from_com(mass, Vector3::Zero(), 0.01 * mass * solver::Matrix3::Identity());
}

/// A sledge along x that carries a tool on an upright axis, on a base that is bolted down.
lang::Robot sledge_with_tool() {
  solver::ModelBuilder builder(solver::BaseType::fixed, "base_link", ball(10.0));
  solver::Joint slide;
  slide.name = "slide";
  slide.type = solver::JointType::prismatic;
  slide.axis = Vector3::UnitX();
  slide.actuated = true;
  solver::Joint turn = slide;
  turn.name = "turn";
  turn.type = solver::JointType::continuous;
  turn.axis = Vector3::UnitZ();
  const solver::Matrix3 same = solver::Matrix3::Identity();
  builder.add_link("sledge", "base_link", {same, {0.0, 0.0, height}}, slide, ball(4.0));
  builder.add_link("tool_link", "sledge", {same, {ahead - reach, 0.0, 0.0}}, turn, ball(1.0));
  builder.add_frame("tool", "tool_link", {same, {reach, 0.0, 0.0}});
  lang::Robot robot;
  robot.name = "sledge";
  robot.model = builder.build();
  robot.base_frame = "base_link";
  robot.pads = {{"tool", 0.06, 0.04}};
  return robot;
}

lang::SceneObject leaning_wall(double x, double pitch = 0.0) {
  lang::SceneObject wall;
  wall.name = "wall";
  wall.size = {2.0, 0.1, 1.0};
  wall.at = {x, 0.0};
  wall.pitch = pitch;
  return wall;
}

BodyPush on_tool(const lang::Robot& robot, const Vector3& force, const Vector3& torque) {
  const solver::Frame& tool = robot.model.frames()[static_cast<std::size_t>(*robot.model.find_frame("tool"))];
  return {0, tool.body, tool.pose_in_body, {torque, force}};
}

void run_for(MujocoPlant& plant, const Eigen::Vector2d& torque, double time) {
  for (int i = 0; i < static_cast<int>(time * 1000.0); ++i) ASSERT_EQ(plant.apply(torque), PlantStatus::ok);
}

Eigen::VectorXd joints_of(MujocoPlant& plant, const lang::Robot& robot) {
  Sensed sensed(robot.model);
  EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
  return sensed.state.q;
}

/// Ahead of the tool, as high as it says; round or square, 0.2 m across.
lang::SceneObject post_ahead(double top, bool round) {
  lang::SceneObject post;
  post.name = "post";
  post.shape = round ? lang::ShapeKind::cylinder : lang::ShapeKind::box;
  post.size = round ? std::array{0.1, 0.1, top} : std::array{0.2, 0.2, top};
  post.at = {ahead + 0.2, 0.0};
  return post;
}

// The tool is 0.5 m high. Pushed with 10 N, the sledge of 5 kg rests on what is higher, and passes over what
// is lower: a t^2 / 2 after the time t.
TEST(SceneHands, AnArmMeetsWhatIsAsHighAsItsTip) {
  lang::Robot robot = sledge_with_tool();
  robot.pads.clear();
  for (const bool round : {false, true}) {
    for (const double top : {0.4, 0.6}) {
      lang::Scene scene;
      scene.objects = {post_ahead(top, round)};
      MujocoPlant plant(robot, scene);
      run_for(plant, {10.0, 0.0}, 1.3);
      const double way = joints_of(plant, robot)(0), free = 0.5 * 10.0 / 5.0 * 1.3 * 1.3;
      if (top > height) {
        EXPECT_NEAR(way, 0.1, 0.01) << "round " << round;
      } else {
        EXPECT_NEAR(way, free, 0.01 * free) << "round " << round;
      }
    }
  }
}

// The joints' torques -J'w balance a wrench w at the tool.
TEST(SceneHands, PressOnAnArmsFrameWithAWholeWrench) {
  const lang::Robot robot = sledge_with_tool();
  MujocoPlant plant(robot, lang::Scene{});
  const Vector3 force(3.0, -2.0, 0.7), torque(0.1, 0.2, 0.5);
  plant.set_more_pushes(std::vector{on_tool(robot, force, torque)});
  run_for(plant, {-force.x(), -(reach * force.y() + torque.z())}, 0.2);
  EXPECT_LT(joints_of(plant, robot).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(plant.truth().base.hand, force.norm(), 1e-9);
}

// Four corners of stiffness k make an angular spring of k w^2, less what the push F takes at the reach L.
TEST(SceneHands, APadHoldsATorqueAndTheSensorMeasuresIt) {
  constexpr double push = 20.0, torque = 0.2, width = 0.06, stiffness = 1e5;
  const lang::Robot robot = sledge_with_tool();
  lang::Scene scene;
  scene.objects = {leaning_wall(ahead + 1e-4)};
  lang::SceneSignal felt;
  felt.name = "felt";
  felt.kind = lang::SceneSignalKind::wrench;
  felt.frame = "tool";
  scene.signals = {felt};
  MujocoPlant plant(robot, scene);
  run_for(plant, {push, torque}, 1.0);
  const double angle = torque / (stiffness * width * width - push * reach);
  EXPECT_NEAR(joints_of(plant, robot)(1), angle, 0.03 * angle);
  const solver::ForceVector& measured = plant.truth().wrenches[0][0];
  EXPECT_NEAR(measured.linear.x(), -push, 0.01);
  EXPECT_NEAR(measured.angular.z(), -(torque + push * reach * angle), 0.002);
  EXPECT_NEAR(plant.truth().objects[0].force, push, 0.01);
}

// In the axes of the task's frame and about its origin: M + p x F, the sensor's bias included.
TEST(SceneHands, ASensorIsSeenFromAnotherFrame) {
  lang::Program program;
  program.robot = sledge_with_tool();
  lang::FrameDeclaration turned;
  turned.name = "turned";
  turned.parent = lang::FrameParent::world;
  turned.pose = {solver::rotation_from_rpy(0.0, 0.0, std::numbers::pi / 2.0), {0.1, 0.0, 0.0}};
  program.frames = {turned};
  lang::Signal declared;
  declared.name = "felt";
  declared.type = lang::SignalType::wrench;
  declared.in = 0;
  program.signals = {declared};
  lang::Scene scene;
  lang::SceneSignal felt;
  felt.name = "felt";
  felt.kind = lang::SceneSignalKind::wrench;
  felt.frame = "tool";
  felt.force_bias = {0.5, 0.0, 0.0};
  scene.signals = {felt};
  SceneSignals signals(program, scene, scene.signals, {{}}, 0, 0);
  Truth truth;
  const Vector3 force(-20.5, 4.0, 0.0), torque(0.0, 0.0, 0.3);
  truth.wrenches = {{{torque, force}}};
  signals.measure(truth, lang::start_state(program.robot));
  std::vector<SignalSample> samples(1);
  signals.report(0.0, samples);
  ASSERT_TRUE(samples[0].valid);
  const Vector3 at(ahead - 0.1, 0.0, height), measured(-20.0, 4.0, 0.0);
  const Vector3 moment = torque + at.cross(measured);
  // The world's y is the x of the frame, and its -x the y.
  EXPECT_NEAR((samples[0].wrench.linear - Vector3(4.0, 20.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((samples[0].wrench.angular - Vector3(moment.y(), -moment.x(), moment.z())).norm(), 0.0, 1e-12);
}

// It stands on its edge from F w/2 on.
TEST(SceneHands, APadTipsOverItsEdge) {
  constexpr double push = 20.0, limit = 0.5 * push * 0.06;
  const lang::Robot robot = sledge_with_tool();
  for (const double share : {0.9, 1.1}) {
    lang::Scene scene;
    scene.objects = {leaning_wall(ahead + 1e-4)};
    MujocoPlant plant(robot, scene);
    run_for(plant, {push, 0.0}, 0.3);
    run_for(plant, {push, share * limit}, 0.4);
    EXPECT_EQ(joints_of(plant, robot)(1) > 0.02, share > 1.0) << share;
  }
}

// A face that leans back by p takes F/cos p across it, and is h tan p farther away at the height h.
TEST(SceneHands, AWallThatLeansTakesMoreThanThePush) {
  constexpr double push = 20.0, pitch = 0.4;
  lang::Robot robot = sledge_with_tool();
  robot.pads.clear();
  lang::Scene scene;
  scene.objects = {leaning_wall(ahead - height * std::tan(pitch) + 1e-3, pitch)};
  MujocoPlant plant(robot, scene);
  run_for(plant, {push, 0.0}, 1.0);
  EXPECT_NEAR(plant.truth().objects[0].force, push / std::cos(pitch), 0.02);
  const double depth = push / std::cos(pitch) / scene.objects[0].stiffness;
  EXPECT_NEAR(joints_of(plant, robot)(0), 1e-3 + depth / std::cos(pitch), 2e-5);
  EXPECT_NEAR(plant.truth().objects[0].x, scene.objects[0].at[0], 1e-9);
}

TEST(SceneHands, ABlockThatLeansIsCutAtTheHeight) {
  lang::SceneObject wall = leaning_wall(1.0, 0.3);
  const auto outline = lang::outline_of(wall, 0.15);
  ASSERT_EQ(outline.size(), 4U);
  double nearest = 1.0, farthest = -1.0;
  for (const Vector3& p : outline) {
    nearest = std::min(nearest, p.x());
    farthest = std::max(farthest, p.x());
  }
  EXPECT_NEAR(nearest, 0.15 * std::tan(0.3), 1e-12);
  EXPECT_NEAR(farthest - nearest, 0.1 / std::cos(0.3), 1e-12);
  EXPECT_TRUE(lang::reaches(wall, 0.9));
  EXPECT_FALSE(lang::reaches(wall, 1.1));
}

lang::SceneObject crate(double mass) {
  lang::SceneObject object;
  object.name = "crate";
  object.shape = lang::ShapeKind::box;
  object.size = {0.4, 0.4, 0.4};
  object.at = {3.0, 0.0};
  object.yaw = 0.5;
  object.mass = mass;
  return object;
}

// a = (F - mu m g)/m along the crate's own axis; the torque about z turns it by no more than friction lets
// it.
TEST(SceneHands, PushACrateAlongItsOwnAxis) {
  lang::Scene scene;
  scene.objects = {crate(10.0)};
  scene.objects[0].slides = 0.1;
  MujocoPlant plant(sledge_with_tool(), scene);
  plant.set_more_pushes(std::vector{BodyPush{-1, 0, {}, {Vector3::Zero(), Vector3(20.0, 0.0, 0.0)}}});
  run_for(plant, {0.0, 0.0}, 1.0);
  const ObjectTruth& truth = plant.truth().objects[0];
  const double way = 0.5 * (20.0 - 0.1 * 10.0 * 9.81) / 10.0;
  EXPECT_NEAR(std::hypot(truth.x - 3.0, truth.y), way, 0.01 * way);
  EXPECT_NEAR(std::atan2(truth.y, truth.x - 3.0), 0.5, 0.01);
  EXPECT_NEAR(truth.yaw, 0.5, 1e-3);
  EXPECT_NEAR(truth.hand, 20.0, 1e-9);
}

// A hand that follows a door at the lever r holds it at q = (F r - preload)/k.
TEST(SceneHands, PushADoorAtAPoint) {
  lang::Scene scene;
  lang::SceneObject gate = crate(20.0);
  gate.size = {0.04, 1.2, 1.0};
  gate.yaw = 0.0;
  lang::Guide hinge;
  hinge.at = {0.0, 0.6};
  hinge.upper = 1.5;
  hinge.preload = 8.0;
  hinge.stiffness = 10.0;
  hinge.damping = 20.0;
  gate.guide = hinge;
  scene.objects = {gate};
  MujocoPlant plant(sledge_with_tool(), scene);
  BodyPush push{-1, 0, {}, {Vector3::Zero(), Vector3(12.0, 0.0, 0.0)}};
  push.pose.position = {0.0, -0.5, 0.0};
  plant.set_more_pushes(std::vector{push});
  run_for(plant, {0.0, 0.0}, 12.0);
  EXPECT_NEAR(plant.truth().objects[0].travel, (12.0 * 1.1 - 8.0) / 10.0, 0.005);
}

}  // namespace
}  // namespace zwang::runtime
