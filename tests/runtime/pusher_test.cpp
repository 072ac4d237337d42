// A person who leans on a base that gives way does not count as a motor's fault.
#include "guard/pusher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "../is_long.hpp"
#include "robots.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime::test {
namespace {

constexpr double ramp = 0.05;  // [s] of a hand's force, a first-order rise

lang::Program may_give_way() {
  lang::Task task_ =
      task("go", {free_axis("go.x", Axis::x), free_axis("go.y", Axis::y), free_axis("go.rz", Axis::rz)});
  for (auto& axis : task_.groups[0].axes) axis.velocity = between(-0.3, 0.3);
  return program({task_});
}

lang::Program stands_softly() {
  lang::Task task_ = task(
      "go", {drive("go.x", Axis::x, Quantity::velocity, 0.0), drive("go.y", Axis::y, Quantity::velocity, 0.0),
             drive("go.rz", Axis::rz, Quantity::velocity, 0.0)});
  for (auto& axis : task_.groups[0].axes) axis.force = between(-30.0, 30.0);
  return program({task_});
}

// A second of `force` [N] at each corner and the middle, every 45 deg (15 deg with --long), then 1.2 s to
// come to rest.
void expect_no_stop(const lang::Program& program_, double force) {
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 0.25}, {0.3, -0.25}, {-0.3, 0.25}, {-0.3, -0.25}}) {
    for (int k = 0; k < 24; k += zwang::test::is_long() ? 1 : 3) {
      const double angle = k * std::numbers::pi / 12.0;
      const double fx = force * std::cos(angle);
      const double fy = force * std::sin(angle);
      const Eigen::Vector3d hand(fx, fy, x * fy - y * fx);
      Runner runner(program_);
      Sensed sensed(program_.robot.model);
      PlanarBase base;
      Eigen::Vector3d pushes = Eigen::Vector3d::Zero();
      for (int tick = 0; tick < 2500; ++tick) {
        const bool is_on = tick > 300 && tick < 1300;
        pushes += (1e-3 / ramp) * ((is_on ? hand : Eigen::Vector3d::Zero().eval()) - pushes);
        base.sense(sensed);
        base.step(runner.step(sensed), pushes);
      }
      EXPECT_FALSE(runner.guard().stopped()) << force << " N at " << x << ", " << y << " m, " << 15 * k
                                             << " deg: " << to_string(runner.guard().reason());
    }
  }
}

TEST(Pusher, DoesNotStopABaseThatMayGiveWay) {
  for (const double force : {20.0, 40.0, 80.0}) expect_no_stop(may_give_way(), force);
}

TEST(Pusher, DoesNotStopABaseThatStandsWithMore) {
  expect_no_stop(stands_softly(), 20.0);
}

}  // namespace
}  // namespace zwang::runtime::test
