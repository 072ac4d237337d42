// What a switch of tasks does to the force that the wheels are told to make.
#include "blend_bench.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// Runs two tasks on the moving test base. `largest` is the largest step of the commanded planar force in one
/// tick from the switch on. `whole` is the largest change of force that the switch brings about in all.
struct Steps {
  double largest = 0.0;
  double whole = 0.0;
};
Steps commanded_steps(const lang::Task& from, const lang::Task& to, double blend) {
  Runner runner(switching_tasks(from, to, blend, 3.0));
  PlanarBase base;
  const lang::Robot robot = mecanum_robot();
  Sensed sensed(robot.model);
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  Eigen::Vector3d at_switch = Eigen::Vector3d::Zero();
  Steps steps;
  while (base.time < 3.6) {
    base.sense(sensed);
    const Eigen::VectorXd& tau = runner.step(sensed);
    EXPECT_EQ(runner.guard_status(), GuardStatus::passed) << "the torque limits must not shape this test";
    const Eigen::Vector3d force = base.commanded(tau);
    if (runner.scheduler().task() == 0) at_switch = force;
    if (runner.scheduler().task() == 1 && runner.scheduler().elapsed() < blend + 0.01) {
      steps.largest = std::max(steps.largest, (force - last).head<2>().norm());
      steps.whole = std::max(steps.whole, (force - at_switch).head<2>().norm());
    }
    last = force;
    base.step(tau);
  }
  return steps;
}

TEST(CommandedForce, StepsByNoMoreThanTheBlendsShareOfWhatFades) {
  const double blend = 0.2;
  const auto rest = [](AxisStatements x) {
    return std::vector<AxisStatements>{x, drive("go.y", Axis::y, Quantity::velocity, 0.0),
                                       drive("go.rz", Axis::rz, Quantity::velocity, 0.0)};
  };
  // At a steady 0.4 m/s nothing pushes; the new task brakes with what its time constant asks for.
  AxisStatements fast = drive("go.x", Axis::x, Quantity::velocity, 0.4);
  AxisStatements slow = drive("go.x", Axis::x, Quantity::velocity, 0.0);
  fast.time_constant.constant = slow.time_constant.constant = 0.2;
  const double mass = PlanarBase().inertia()(0, 0);
  const double hard_step = mass * 0.4 / 0.2;

  const Steps hard =
      commanded_steps(task("a", rest(fast)), task("b", rest(slow), base_link, world_frame), 0.0);
  EXPECT_NEAR(hard.largest, hard_step, 1e-3 * hard_step);

  // In the base's axes the rows persist, and only b blends.
  const double share = hard_step * period / blend;
  const Steps persisting = commanded_steps(task("a", rest(fast)), task("b", rest(slow)), blend);
  EXPECT_GT(persisting.whole, 0.2 * hard_step) << "the switch must do something";
  EXPECT_LE(persisting.largest, share * (1 + 1e-5));

  // In the world's axes the rows are others, and the blend is the same: (1 - p) D1 + p D2 of what each asks
  // for.
  const Steps fading =
      commanded_steps(task("a", rest(fast)), task("b", rest(slow), base_link, world_frame), blend);
  EXPECT_GT(fading.whole, 0.2 * hard_step);
  EXPECT_LE(fading.largest, share * (1 + 1e-5));
}

TEST(CommandedForce, OfAPushThatIsHandedOverStaysAndAPushThatEndsFades) {
  const auto push = [](double f) {
    return std::vector<AxisStatements>{drive("go.x", Axis::x, Quantity::force, f),
                                       drive("go.y", Axis::y, Quantity::velocity, 0.0)};
  };
  // The same push in other axes: 20 (1 - p) + 20 p.
  const Steps handed = commanded_steps(task("a", push(20)), task("b", push(20), base_link, world_frame), 0.2);
  EXPECT_LE(handed.whole, 0.05);
  const Steps ended = commanded_steps(task("a", push(20)), task("b", push(0)), 0.2);
  EXPECT_NEAR(ended.whole, 20.0, 0.2);
  EXPECT_LE(ended.largest, 20.0 * period / 0.2 * 1.01);
  const Steps cut = commanded_steps(task("a", push(20)), task("b", push(0)), 0.0);
  EXPECT_NEAR(cut.largest, 20.0, 0.2);
}

// 20 N of a velocity driver that something holds, before the switch and after it: the guards read 20 N
// throughout.
TEST(CommandedForce, IsReadOfAllSetsByTheirShares) {
  AxisStatements push = drive("go.x", Axis::x, Quantity::velocity, 0.5), gently = push;
  push.force = gently.force = between(-20, 20);
  gently.target.constant = 0.4;
  Runner runner(switching_tasks(task("a", {push}), task("b", {gently}), 0.1));
  PlanarBase base;
  Sensed sensed(mecanum_robot().model);
  base.V.x() = 0.01;  // something yields at this speed, whatever pushes
  while (base.time < 1.2) {
    base.sense(sensed);
    const Eigen::VectorXd& tau = runner.step(sensed);
    base.step(tau, -base.commanded(tau));
    if (base.time < 0.95) continue;
    const Scheduler& scheduler = runner.scheduler();
    EXPECT_NEAR(scheduler.reading({scheduler.task(), 0, 0}).force, 20.0, 1e-6) << base.time;
  }
}

}  // namespace
}  // namespace zwang::runtime
