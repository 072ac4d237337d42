// The main job, judged by the plant: a mecanum base that knows nothing of the wall is turned square by it.
//
// Every figure is the plant's own measurement. The bounds are those of the physics: a push of F meets a
// contact of stiffness K at the speed v with the effective mass m, and peaks at F + sqrt(F^2 + K m v^2) where
// nothing damps it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/solver/popov_vereshchagin.hpp"

namespace zwang::runtime {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double period = 1e-3;

struct Setting {
  double start_yaw = 20.0;  // [deg]
  const char* push = "20 N";
  double friction = 0.0;
};

void PrintTo(const Setting& setting, std::ostream* out) {
  *out << "yaw " << setting.start_yaw << " deg, push " << setting.push << ", friction " << setting.friction;
}

lang::Program load(const Setting& setting) {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.parameters["push"] = setting.push;
  auto program = lang::load(ZWANG_SOURCE_DIR "/specs/wall_align.yaml", options, diagnostics);
  if (!program) throw std::runtime_error("specs/wall_align.yaml does not load");
  program->scene->objects.at(0).friction = setting.friction;
  return *program;
}

/// Apparent inertias of the base along x, y and rz: the multiplier of a unit acceleration.
Eigen::Vector3d apparent_inertia(const solver::Model& model) {
  solver::PopovVereshchagin dynamics(model);
  solver::ConstrainedMotion motion(model);
  const solver::State rest(model);
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<solver::AccelerationRow> rows(1);
    (axis < 2 ? rows[0].a.linear : rows[0].a.angular)(axis) = 1.0;
    rows[0].b = 1.0;
    EXPECT_EQ(dynamics.solve(rest, rows, motion), solver::Status::ok);
    result(axis) = motion.nu(0);
  }
  return result;
}

/// One strike of a corner: what it may peak at, and the largest force on that corner until it leaves the
/// wall.
struct Hit {
  double time = 0.0;
  double bound = 0.0;  // F + sqrt(F^2 + K m v^2)
  double peak = 0.0;
};

struct Outcome {
  RunState state = RunState::running;
  double touched = 0.0, yaw_at_touch = 0.0;
  double aligned = 0.0;  // since when |yaw| stays within 0.1 deg
  double yaw = 0.0, steady_force = 0.0;
  double worst_torque_share = 0.0;
  std::vector<Hit> hits;
};

/// Follows the front corners into the wall, whose face stands across the world's x axis.
class HitWatch {
 public:
  HitWatch(const lang::Program& program, double push)
      : push_(push),
        stiffness_(program.scene->objects.at(0).stiffness),
        face_(program.scene->objects.at(0).at[0]),
        inertia_(apparent_inertia(program.robot.model)) {
    for (const solver::Vector3& corner : program.robot.footprint)
      corners_.push_back({corner.x(), corner.y()});
  }

  void look(const Truth& truth, std::vector<Hit>& hits) {
    const double c = std::cos(truth.yaw);
    const double s = std::sin(truth.yaw);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Corner& corner = corners_[i];
      const bool inside = truth.x + c * corner.x - s * corner.y > face_;
      const double vx = truth.velocity.x() - truth.velocity.z() * corner.y;
      const double vy = truth.velocity.y() + truth.velocity.z() * corner.x;
      const double speed = c * vx - s * vy;
      if (inside && !corner.inside) {
        const double lever =
            -s * corner.x - c * corner.y;  // of the wall's normal about the base, per unit force
        const double mass =
            1.0 / (c * c / inertia_.x() + s * s / inertia_.y() + lever * lever / inertia_.z());
        const double v = std::max(corner.speed_before, speed);
        corner.hit = hits.size();
        hits.push_back({truth.time, push_ + std::sqrt(push_ * push_ + stiffness_ * mass * v * v), 0.0});
      }
      if (inside) hits[corner.hit].peak = std::max(hits[corner.hit].peak, truth.corner_forces.at(i));
      corner.inside = inside;
      corner.speed_before = speed;
    }
  }

 private:
  struct Corner {
    double x, y;
    bool inside = false;
    double speed_before = 0.0;
    std::size_t hit = 0;
  };
  double push_, stiffness_, face_;
  Eigen::Vector3d inertia_;
  std::vector<Corner> corners_;
};

Outcome run(const Setting& setting) {
  const lang::Program program = load(setting);
  MujocoPlantOptions options;
  options.period = period;
  options.start_yaw = setting.start_yaw * degree;
  MujocoPlant plant(program.robot, *program.scene, options);
  Runner runner(program);
  Sensed sensed(program.robot.model);
  HitWatch watch(program, program.parameters.at(0).value);
  Outcome outcome;
  std::vector<double> forces;
  while (!runner.finished() && plant.truth().time < 30.0) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    const Eigen::VectorXd& tau = runner.step(sensed);
    for (int j = 0; j < tau.size(); ++j) {
      outcome.worst_torque_share =
          std::max(outcome.worst_torque_share, std::abs(tau(j)) / program.robot.model.joint(j).max_effort);
    }
    EXPECT_EQ(plant.apply(tau), PlantStatus::ok);
    const Truth& truth = plant.truth();
    watch.look(truth, outcome.hits);
    if (truth.objects[0].touched && outcome.touched == 0.0) {
      outcome.touched = *truth.objects[0].touched;
      outcome.yaw_at_touch = truth.yaw;
    }
    if (std::abs(truth.yaw) > 0.1 * degree) outcome.aligned = truth.time;
    if (runner.state() == RunState::running) forces.push_back(truth.objects[0].force);
  }
  outcome.state = runner.state();
  outcome.yaw = plant.truth().yaw;
  const auto steady = std::min<std::ptrdiff_t>(500, std::ssize(forces));
  for (auto it = forces.end() - steady; it != forces.end(); ++it)
    outcome.steady_force += *it / static_cast<double>(steady);
  return outcome;
}

class WallAlignment : public ::testing::TestWithParam<Setting> {};

TEST_P(WallAlignment, EndsSquareAndGentle) {
  const Setting setting = GetParam();
  const double push = load(setting).parameters.at(0).value;
  const Outcome outcome = run(setting);
  std::printf(
      "yaw %+.0f deg, push %.0f N, friction %.1f: touched at %.3f s with yaw %+.3f deg, aligned %.2f s later "
      "to "
      "%.4f deg, steady %.3f N, torque at most %.0f %% of its limit\n",
      setting.start_yaw, push, setting.friction, outcome.touched, outcome.yaw_at_touch / degree,
      outcome.aligned - outcome.touched, std::abs(outcome.yaw) / degree, outcome.steady_force,
      100.0 * outcome.worst_torque_share);
  EXPECT_EQ(outcome.state, RunState::done);
  ASSERT_GT(outcome.touched, 0.0);
  EXPECT_NEAR(outcome.yaw_at_touch, setting.start_yaw * degree, 1.0 * degree);
  EXPECT_LE(std::abs(outcome.yaw), 0.1 * degree);
  EXPECT_NEAR(outcome.steady_force, push, 0.2);
  EXPECT_LE(outcome.worst_torque_share, 1.0);
  if (push >= 20.0) {
    EXPECT_LE(outcome.aligned - outcome.touched, 3.0);
  }

  ASSERT_FALSE(outcome.hits.empty());
  double share = 0.0;
  for (const Hit& hit : outcome.hits) {
    share = std::max(share, hit.peak / hit.bound);
    EXPECT_GT(hit.peak, 0.0) << "hit at " << hit.time << " s";
    EXPECT_LE(hit.peak, 1.1 * hit.bound) << "hit at " << hit.time << " s";
  }
  std::printf("  %zu hits, the hardest %.1f N, at most %.2f of F + sqrt(F^2 + K m v^2)\n",
              outcome.hits.size(),
              std::max_element(outcome.hits.begin(), outcome.hits.end(),
                               [](const Hit& a, const Hit& b) { return a.peak < b.peak; })
                  ->peak,
              share);
}

INSTANTIATE_TEST_SUITE_P(Figures, WallAlignment,
                         ::testing::Values(Setting{20.0}, Setting{-20.0}, Setting{5.0}, Setting{25.0},
                                           Setting{20.0, "5 N"}, Setting{20.0, "40 N"},
                                           Setting{20.0, "20 N", 0.1}));

}  // namespace
}  // namespace zwang::runtime
