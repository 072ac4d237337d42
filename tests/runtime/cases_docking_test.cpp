// The shipped docking task, on a base with ideal wheels and a partner from a script.
#include <gtest/gtest.h>

#include <random>

#include "shipped_case.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// The partner's socket, as the robot sees it: noisy, late and seldom; and the hook's latch.
struct DockingRun : Case {
  DockingRun() : Case(load_shipped("docking.yaml")) {
    script = [this] {
      past.push_back(base_pose());
      const double late = base.time - delay;
      const bool due = late >= 0.0 && static_cast<std::uint64_t>(base.time / period + 0.5) % 67 == 0;
      if (due && !lost(base.time)) {
        const solver::Pose then = past[static_cast<std::size_t>(late / period + 0.5)];
        hear("partner", [&](SignalSample& s) {
          s.stamp = late;
          s.pose = then.inverse() * socket;
          s.pose.position += solver::Vector3(noise(random), noise(random), 0.0);
          s.pose.rotation = s.pose.rotation * solver::rotation_from_rpy(0, 0, 2.0 * noise(random));
        });
      }
      hear_boolean("latch", latched);
    };
    contact = [this]() -> Eigen::Vector3d {
      const solver::Vector3 hook_at(-0.40, 0.0, 0.15);  // of the robot file
      const solver::Pose pose = base_pose();
      const solver::Vector3 r = pose.rotation * hook_at;
      const solver::Vector3 at = socket.inverse() * (pose * hook_at);
      const solver::Vector3 v_base = pose.rotation * solver::Vector3(base.V.x(), base.V.y(), 0.0);
      const solver::Vector3 v =
          socket.rotation.transpose() * (v_base + base.V.z() * solver::Vector3::UnitZ().cross(r));
      deepest = std::max(deepest, at.x());
      if (at.x() > 0.0 && std::abs(at.y()) < 0.03 && 2e4 * at.x() > 10.0) latched = true;
      double f = -2e4 * at.x() - 600.0 * v.x();
      if (!latched) f = at.x() > 0.0 ? std::min(f, 0.0) : 0.0;
      pressed = std::max(pressed, -f);
      const solver::Vector3 world = socket.rotation * solver::Vector3(f, 0, 0);
      const solver::Vector3 local = pose.rotation.transpose() * world;
      return {local.x(), local.y(), hook_at.x() * local.y() - hook_at.y() * local.x()};
    };
  }
  solver::Pose base_pose() const {
    return {solver::rotation_from_rpy(0, 0, base.pose.z()), {base.pose.x(), base.pose.y(), 0.0}};
  }

  solver::Pose socket{solver::rotation_from_rpy(0, 0, std::numbers::pi - 0.1), {-1.6, 0.2, 0.15}};
  std::vector<solver::Pose> past;
  double delay = 0.060;  // [s]
  std::function<bool(double)> lost = [](double) { return false; };
  std::mt19937 random{7};
  std::normal_distribution<double> noise{0.0, 0.001};  // [m], and twice as many rad
  bool latched = false;
  double deepest = -10.0, pressed = 0.0;
};

TEST(Docking, HooksOnWithANoisyLateAndSeldomPoseOfThePartner) {
  DockingRun run;
  run.run(120.0);
  std::printf("docking: %.1f s, pressed %.1f N, %s\n", run.base.time, run.pressed, run.way().c_str());
  EXPECT_EQ(run.runner.state(), RunState::done) << run.way();
  EXPECT_TRUE(run.latched);
  EXPECT_LE(run.pressed, 20.0 + std::sqrt(20.0 * 20.0 + 2e4 * run.base.inertia()(0, 0) * 0.08 * 0.08));
}

TEST(Docking, StandsStillWhileThePartnerIsLostAndGoesOnAfterwards) {
  DockingRun run;
  run.lost = [](double t) { return t > 3.0 && t < 6.0; };
  double fastest = 0.0;
  run.look = [&] {
    if (run.base.time > 5.0 && run.base.time < 6.0) fastest = std::max(fastest, run.base.V.norm());
  };
  run.run(120.0);
  EXPECT_EQ(run.runner.state(), RunState::done) << run.way();
  EXPECT_LT(fastest, 0.01);
}

TEST(Docking, ALatchThatNeverClosesFailsAfterItsAttempts) {
  DockingRun run;
  const auto contact = run.contact;
  run.contact = [&, contact] {
    const Eigen::Vector3d f = contact();
    run.latched = false;
    return f;
  };
  run.run(300.0);
  EXPECT_EQ(run.runner.state(), RunState::failed) << run.way();
  EXPECT_EQ(run.runner.transitions().back().refusal, Refusal::attempts) << run.way();
}

}  // namespace
}  // namespace zwang::runtime
