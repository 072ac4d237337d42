// In an end, `done` or `failed`, nothing sets the base in motion. Its kinetic energy stays below its value at
// the switch. The judge is a base whose dynamics were derived apart from the library.
#include <gtest/gtest.h>

#include "planar_course.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

constexpr double end_after = 0.2;  // [s]

lang::Program ends_after(lang::Task only, const lang::Target& target = to_failed) {
  only.exits = {exit(after(end_after), target)};
  return program({std::move(only)});
}

lang::Task still() {
  return task("wait", {drive("wait.x", Axis::x, Quantity::velocity, 0.0),
                       drive("wait.y", Axis::y, Quantity::velocity, 0.0),
                       drive("wait.rz", Axis::rz, Quantity::velocity, 0.0)});
}

struct Ending {
  double gained = 0.0;   ///< [J] the most kinetic energy beyond that at the switch
  double hardest = 0.0;  ///< [m/s^2] the fastest change of the base's velocity afterwards
  double last_speed = 0.0;
  bool is_over = false;
  RunState state = RunState::running;
};

double energy(const Course& course) {
  return 0.5 * course.base.V.dot(course.base.inertia() * course.base.V);
}

Ending end_of(const lang::Program& p, const Eigen::Vector3d& pose = Eigen::Vector3d::Zero(),
              const Eigen::Vector3d& V = Eigen::Vector3d::Zero()) {
  Course course(p);
  course.base.pose = pose;
  course.base.V = V;
  Ending ending;
  std::optional<double> at_switch;
  Eigen::Vector3d last = V;
  course.run(4.0, [&] {
    if (course.runner.state() != RunState::running) {
      if (!at_switch) at_switch = energy(course);
      ending.gained = std::max(ending.gained, energy(course) - *at_switch);
      ending.hardest = std::max(ending.hardest, (course.base.V - last).head<2>().norm() / period);
    }
    last = course.base.V;
  });
  ending.last_speed = course.speed();
  ending.is_over = course.runner.finished();
  ending.state = course.runner.state();
  EXPECT_FALSE(course.runner.may_still_move());
  return ending;
}

/// Of the robot at half of the speed that counts as rest.
double rest_energy() {
  return 0.5 * PlanarBase().inertia()(0, 0) * 0.005 * 0.005;
}

lang::Group of_always(std::vector<AxisStatements> axes, int in = world_frame) {
  return at_level_zero(task("", std::move(axes), base_link, in).groups[0]);
}

lang::Program outside_of_a_range() {
  lang::Program p = ends_after(still(), to_done);
  p.always.groups = {of_always({within("back.x", Axis::x, Quantity::position, -100.0, -50.0)})};
  return p;
}

lang::Program outside_of_a_region() {
  lang::Program p = ends_after(still());
  lang::Region room;
  room.name = "room";
  room.polygon = {{10, 10}, {20, 10}, {20, 20}, {10, 20}};
  p.regions = {room};
  p.always.groups = {inside(0, 0.0)};
  return p;
}

lang::Program driven_by_always() {
  lang::Program p = ends_after(task("nothing", {free_axis("nothing.rz", Axis::rz)}));
  p.always.groups = {of_always({drive("on.x", Axis::x, Quantity::velocity, 0.3)}, base_link)};
  return p;
}

lang::Program pushed_by_always() {
  lang::Program p = ends_after(task("nothing", {free_axis("nothing.rz", Axis::rz)}));
  p.always.groups = {of_always({drive("on.x", Axis::x, Quantity::force, 20.0)}, base_link)};
  return p;
}

lang::Program never_slower() {
  lang::Program p = ends_after(task("nothing", {free_axis("nothing.rz", Axis::rz)}));
  p.always.groups = {of_always({within("on.x", Axis::x, Quantity::velocity, 0.1, 0.5)}, base_link)};
  return p;
}

lang::Program always_faster() {
  lang::Program p = ends_after(task("nothing", {free_axis("nothing.rz", Axis::rz)}));
  p.always.groups = {of_always({within("on.x", Axis::x, Quantity::acceleration, 0.1, 0.5)}, base_link)};
  return p;
}

lang::Program speeding_up() {
  lang::Task go = task("go", {drive("go.x", Axis::x, Quantity::acceleration, 1.0),
                              drive("go.rz", Axis::rz, Quantity::acceleration, 2.0)});
  return ends_after(go);
}

TEST(End, NeitherGivesEnergyNorBrakesHarderThanTheStop) {
  const struct {
    const char* what;
    lang::Program program;
    Eigen::Vector3d pose, V;
  } cases[] = {{"outside of a range", outside_of_a_range(), {0, 0, 0.2}, {0, 0, 0}},
               {"outside of a region", outside_of_a_region(), {0, 0, 0.5}, {0, 0, 0}},
               {"outside of a region, on its way out", outside_of_a_region(), {9, 15, 0}, {-0.6, 0.3, 0.4}},
               {"driven by `always`", driven_by_always(), {0, 0, 0}, {0, 0, 0}},
               {"pushed by `always`", pushed_by_always(), {0, 0, 0}, {0, 0, 0}},
               {"a range of velocities without 0", never_slower(), {0, 0, 0}, {0, 0, 0}},
               {"a range of accelerations without 0", always_faster(), {0, 0, 0}, {0, 0, 0}},
               {"speeding up", speeding_up(), {0, 0, 0}, {0, 0, 0}}};
  for (const auto& c : cases) {
    const Ending ending = end_of(c.program, c.pose, c.V);
    EXPECT_LT(ending.gained, rest_energy() + 0.02) << c.what;
    EXPECT_LT(ending.hardest, 1.42) << c.what << ": 1 m/s^2 along each of two axes";
    EXPECT_LT(ending.last_speed, 1e-3) << c.what;
    EXPECT_TRUE(ending.is_over) << c.what;
  }
}

// A base that keeps to its edge brakes, and is not let out.
TEST(End, HoldsBackAtAnEdge) {
  lang::Program p = ends_after(task("go", {drive("go.x", Axis::x, Quantity::velocity, 0.8)}));
  p.robot.stop.force = 5.0;  // it takes 4 m and more to stop by that alone
  p.always.groups = {of_always({within("fence.x", Axis::x, Quantity::position, -1.0, 0.6)})};
  Course course(p);
  course.base.V.x() = 0.8;
  double farthest = 0.0;
  course.run(6.0, [&] { farthest = std::max(farthest, course.base.pose.x()); });
  EXPECT_EQ(course.runner.state(), RunState::failed);
  EXPECT_LT(farthest, 0.6001);
}

TEST(End, ComesOnceTheBaseHasStoodForAWhile) {
  Course course(ends_after(still()));
  course.run(end_after + 0.05);
  EXPECT_EQ(course.runner.state(), RunState::failed);
  EXPECT_FALSE(course.runner.finished()) << "it stands, but for how long?";
  course.run(0.1);
  EXPECT_TRUE(course.runner.finished());
}

TEST(End, SaysWhenNobodySawTheBaseStand) {
  Course course(ends_after(still(), to_done));
  const Eigen::Vector3d wind(0.0, 200.0, 0.0);  // [N]; the stop may press with 80 N
  while (!course.runner.finished() && course.base.time < 20.0) course.tick(wind);
  EXPECT_NE(course.runner.state(), RunState::done) << "failed, or stopped as a runaway";
  EXPECT_TRUE(course.runner.may_still_move());
  EXPECT_EQ(course.runner.events().back().code, EventCode::not_at_rest);
  EXPECT_GT(course.runner.events().back().value, 1.0);
}

}  // namespace
}  // namespace zwang::runtime
