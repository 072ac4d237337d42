#include "draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace zwang::sweep {

namespace {

struct Job {
  const char* task;
  std::vector<const char*> scenes;
  std::vector<const char*> robots;
  double time_limit;    // [s]
  double speed, force;  // [m/s], [N] as the task file says them
  double start_yaw;     // [deg] drawn between this and its opposite
  std::map<std::string, std::string> parameters = {};
};

/// Speeds along two axes add up: 0.25 and 0.15 m/s are 0.29 m/s.
const std::vector<Job>& jobs() {
  static const std::vector<Job> all{
      {"wall_align.yaml",
       {"wall_far", "wall_far_rough"},
       {"mecanum_base", "omni_base", "diff_base", "kelo_base", "kelo_two_base", "mecanum_rough"},
       30.0,
       0.08,
       20.0,
       20.0},
      {"obstacle.yaml",
       {"obstacle", "obstacle_soft", "obstacle_corner", "obstacle_heavy", "obstacle_light",
        "obstacle_leaves"},
       {"mecanum_base", "omni_base", "kelo_base", "kelo_two_base"},
       80.0,
       0.18,
       40.0,
       0.0},
      {"obstacle.yaml",
       {"obstacle", "obstacle_soft", "obstacle_corner"},
       {"diff_base"},
       80.0,
       0.15,
       40.0,
       0.0},
      {"corner.yaml", {"corner", "corner_soft"}, {"mecanum_base", "omni_base"}, 30.0, 0.15, 30.0, 30.0},
      {"docking.yaml",
       {"dock", "dock_drifts"},
       {"mecanum_base", "omni_base", "kelo_base", "kelo_two_base"},
       60.0,
       0.29,
       10.0,
       15.0,
       {{"seat_force", "10 N"}}},
      {"docking.yaml",
       {"dock", "dock_drifts"},
       {"diff_base"},
       60.0,
       0.25,
       10.0,
       5.0,
       {{"seat_force", "10 N"}}},
      {"hospital.yaml", {"corridor"}, {"mecanum_base", "omni_base", "kelo_base"}, 15.0, 0.6, 80.0, 0.0},
      {"hospital.yaml", {"corridor"}, {"diff_base"}, 15.0, 0.6, 80.0, 0.0},
  };
  return all;
}

/// Apart from `jobs`, so that a seed draws the same runs as ever.
const std::vector<Job>& other_jobs() {
  static const std::vector<Job> all{
      {"button.yaml", {"button"}, {"mecanum_arm_base"}, 10.0, 0.04, 8.0, 0.0},
      {"drawer.yaml", {"drawer"}, {"mecanum_arm_base"}, 25.0, 0.1, 4.0, 0.0},
      {"wipe.yaml", {"board"}, {"mecanum_arm_base"}, 40.0, 0.1, 10.0, 0.0},
      {"deliver.yaml", {"cart_on_the_way"}, {"mecanum_base", "omni_base"}, 40.0, 0.2, 20.0, 0.0},
      {"guide.yaml", {"leading_hand"}, {"mecanum_base"}, 10.0, 0.5, 100.0, 0.0},
      {"door.yaml", {"gate"}, {"mecanum_base"}, 30.0, 0.2, 30.0, 0.0},
      {"cart.yaml", {"cart"}, {"mecanum_base"}, 30.0, 0.3, 60.0, 0.0},
      {"carry.yaml", {"box_between"}, {"mecanum_base"}, 20.0, 0.11, 25.0, 0.0},
      {"patrol.yaml", {"square"}, {"mecanum_base"}, 30.0, 0.4, 80.0, 0.0},
      {"cradle.yaml", {"cradle"}, {"mecanum_base"}, 25.0, 0.23, 60.0, 3.0},
  };
  return all;
}

constexpr double degree = std::numbers::pi / 180.0;
constexpr double softest = 2e3, stiffest = 1e6;       // [N/m] of a wall
constexpr double another_mass = 0.2;                  // of runs have one, up to
constexpr double mass_error = 0.3;                    // of the base's own
constexpr double soon = 0.1;                          // [s] after an entry
constexpr int pressing_jobs = 4;                      // the first ones of `jobs`: a wall, a crate, a corner
constexpr double longest_press = 1.0;                 // [s] until what is pressed on goes away
constexpr std::array steps = {0.0, 0.0, 5e-5, 1e-3};  // [rad] of encoders

std::string specs(const std::string& name) {
  return std::string(ZWANG_SOURCE_DIR "/specs/") + name;
}

lang::Program load(const Job& job, const std::string& robot, const std::string& scene) {
  lang::LoadOptions options;
  options.parameters = job.parameters;
  options.robot = specs("robots/" + robot + ".yaml");
  options.scene = specs("scenes/" + scene + ".yaml");
  lang::Diagnostics diagnostics;
  auto program = lang::load(specs(job.task), options, diagnostics);
  std::ostringstream text;
  lang::render_human(diagnostics, text);
  if (!program) throw std::runtime_error(robot + " does not do " + job.task + ": " + text.str());
  return *program;
}

void draw_world(Dice& dice, const Job& job, lang::Program& program) {
  lang::Scene& scene = *program.scene;
  if (job.start_yaw > 0.0) scene.start_yaw = dice.uniform(-job.start_yaw, job.start_yaw) * degree;
  for (lang::SceneObject& object : scene.objects) object.stiffness = dice.log_uniform(softest, stiffest);
  if (dice.uniform(0.0, 1.0) >= another_mass) return;
  lang::Fault payload;
  payload.kind = lang::FaultKind::payload;
  payload.value = dice.uniform(-mass_error, mass_error) * program.robot.model.bodies()[0].inertia.mass;
  scene.faults.push_back(payload);
}

}  // namespace

/// SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t Dice::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

double Dice::uniform(double low, double high) {
  constexpr double unit = 0x1p-53;
  return low + (high - low) * unit * static_cast<double>(next() >> 11U);
}

double Dice::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

int Dice::below(int count) {
  return std::min(count - 1, static_cast<int>(uniform(0.0, count)));
}

namespace {

/// Each of four drives, two faults and eleven onsets.
Drawn start(int index) {
  constexpr std::array robots = {"omni_base", "mecanum_base", "diff_base", "kelo_base"};
  constexpr std::array onsets = {0.0, 0.001, 0.005, 0.01, 0.02, 0.033, 0.05, 0.08, 0.12, 0.2, 0.4};  // [s]
  static_assert(2 * robots.size() * onsets.size() == start_count);
  const auto i = static_cast<std::size_t>(index) % start_count;
  const Job& job = jobs().front();
  Drawn drawn;
  drawn.program = load(job, robots[i / 22], "wall_far");
  drawn.name = std::string(job.task) + " on " + robots[i / 22];
  drawn.time_limit = job.time_limit;
  drawn.speed = job.speed;
  drawn.force = job.force;
  drawn.fault = i % 2 == 0 ? EncoderFault::dead : EncoderFault::frozen;
  drawn.onset.after = onsets[i / 2 % 11];
  return drawn;
}

}  // namespace

Drawn draw(std::uint64_t seed, int index, Which which) {
  if (which == Which::starts) return start(index);
  Dice dice(seed * 1'000'003U + static_cast<std::uint64_t>(index));
  const auto one_of = [&dice](const auto& all) {
    return all[static_cast<std::size_t>(dice.below(static_cast<int>(all.size())))];
  };
  const bool is_other = which == Which::others || which == Which::sound_others;
  const std::vector<Job>& all = is_other ? other_jobs() : jobs();
  const int count = which == Which::released ? pressing_jobs : static_cast<int>(all.size());
  const Job& job = all[static_cast<std::size_t>(dice.below(count))];
  const std::string robot = one_of(job.robots);
  const std::string scene = which == Which::released ? job.scenes.front() : one_of(job.scenes);
  Drawn drawn;
  drawn.program = load(job, robot, scene);
  drawn.name = std::string(job.task) + " on " + robot + ", " + scene;
  drawn.time_limit = job.time_limit;
  drawn.speed = job.speed;
  drawn.force = job.force;
  draw_world(dice, job, drawn.program);
  drawn.encoder_step = one_of(steps);
  drawn.seed = seed;
  if (which == Which::released) {
    drawn.leaves_after = dice.uniform(0.0, longest_press);
    drawn.press_share = dice.uniform(0.0, 1.0);
  }
  const bool is_faulty = which == Which::faulty || which == Which::others || which == Which::released ||
                         (which == Which::all && dice.below(3) > 0);
  if (!is_faulty) return drawn;
  drawn.fault = dice.below(2) == 0 ? EncoderFault::dead : EncoderFault::frozen;
  if (dice.below(2) == 0) {
    drawn.onset.after = dice.uniform(0.0, 0.5 * job.time_limit);
  } else {
    drawn.onset = {dice.below(5), dice.uniform(0.0, soon)};
  }
  return drawn;
}

}  // namespace zwang::sweep
