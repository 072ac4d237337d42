// The main job, judged by the plant: a base that knows nothing of the wall is turned square by it.
//
// Every figure is the plant's own measurement. The bounds are those of the physics. A push of F with the
// effective mass m meets a contact of stiffness K at the speed v. Without damping its peak is F + sqrt(F^2 +
// K m v^2).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <ostream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::runtime {
namespace {

struct Setting {
  const char* robot = "mecanum_base";
  double start_yaw = 20.0;  // [deg]
  const char* push = "20 N";
  double friction = 0.0;
};

void PrintTo(const Setting& setting, std::ostream* out) {
  *out << setting.robot << ", yaw " << setting.start_yaw << " deg, push " << setting.push << ", friction "
       << setting.friction;
}

/// The KELO base with its wheels 30 mm off the swivel axis instead of 10 mm.
std::filesystem::path with_long_casters(const std::filesystem::path& folder) {
  const std::filesystem::path robots = ZWANG_SOURCE_DIR "/specs/robots";
  std::filesystem::copy_file(robots / "kelo_base.yaml", folder / "kelo_base.yaml");
  std::ifstream in(robots / "kelo_base.urdf");
  std::stringstream text;
  text << in.rdbuf();
  std::ofstream(folder / "kelo_base.urdf")
      << std::regex_replace(text.str(), std::regex("xyz=\"-0.01 "), "xyz=\"-0.03 ");
  return folder / "kelo_base.yaml";
}

lang::Program load(const Setting& setting) {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.parameters["push"] = setting.push;
  const bool is_long = setting.robot == std::string("kelo30");
  const zwang::test::TemporaryFolder temporary;
  options.root = "/";
  options.scene = ZWANG_SOURCE_DIR "/specs/scenes/wall_far.yaml";
  options.robot = is_long ? with_long_casters(temporary.path())
                          : std::filesystem::path(ZWANG_SOURCE_DIR "/specs/robots") /
                                (std::string(setting.robot) + ".yaml");
  auto program = lang::load(ZWANG_SOURCE_DIR "/specs/wall_align.yaml", options, diagnostics);
  if (!program) throw std::runtime_error("specs/wall_align.yaml does not load");
  program->scene->objects.at(0).friction = setting.friction;
  return *program;
}

/// Apparent inertias of the base along x, y and rz; infinite where the wheels hold it.
Eigen::Vector3d apparent_inertia(const lang::Robot& robot) {
  const solver::BaseAnalysis base = solver::analyse_base(robot.model, lang::start_state(robot));
  return {base.axes[0].effective_mass, base.axes[1].effective_mass, base.axes[2].effective_mass};
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
        inertia_(apparent_inertia(program.robot)) {
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
  ScenePlantOptions options;
  options.simulation.period = period;
  options.simulation.start_yaw = setting.start_yaw * degree;
  ScenePlant plant(program, options);  // the robot has its wheels, not the truth
  Runner runner(program);
  Sensed sensed(program.robot.model, program.signals.size());
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
      "%s, yaw %+.0f deg, push %.0f N, friction %.1f: touched at %.3f s with yaw %+.3f deg, aligned %.2f s "
      "later "
      "to "
      "%.4f deg, steady %.3f N, torque at most %.0f %% of its limit\n",
      setting.robot, setting.start_yaw, push, setting.friction, outcome.touched,
      outcome.yaw_at_touch / degree, outcome.aligned - outcome.touched, std::abs(outcome.yaw) / degree,
      outcome.steady_force, 100.0 * outcome.worst_torque_share);
  EXPECT_EQ(outcome.state, RunState::done);
  ASSERT_GT(outcome.touched, 0.0);
  EXPECT_NEAR(outcome.yaw_at_touch, setting.start_yaw * degree, 1.0 * degree);
  EXPECT_LE(std::abs(outcome.yaw), 0.1 * degree);
  EXPECT_NEAR(outcome.steady_force, push, 0.1);
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
                         ::testing::Values(Setting{"mecanum_base", 20.0}, Setting{"mecanum_base", -20.0},
                                           Setting{"mecanum_base", 5.0}, Setting{"mecanum_base", 25.0},
                                           Setting{"mecanum_base", 20.0, "5 N"},
                                           Setting{"mecanum_base", 20.0, "40 N"},
                                           Setting{"mecanum_base", 20.0, "20 N", 0.1},
                                           Setting{"omni_base", 20.0}, Setting{"omni_base", -20.0},
                                           Setting{"omni_base", 20.0, "20 N", 0.1},
                                           Setting{"diff_base", 20.0}, Setting{"diff_base", -20.0},
                                           Setting{"diff_base", 20.0, "20 N", 0.1}, Setting{"kelo30", 20.0},
                                           Setting{"kelo30", -20.0}, Setting{"kelo30", 20.0, "20 N", 0.1}));

}  // namespace
}  // namespace zwang::runtime
