#include "tick_cases.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../temporary_folder.hpp"

namespace zwang::bench {

namespace {

namespace fs = std::filesystem;

lang::Program load(const fs::path& task, const fs::path& robot) {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  if (!robot.empty()) options.robot = robot;
  auto program = lang::load(task, options, diagnostics);
  if (!program) {
    std::fprintf(stderr, "%s does not load\n", task.c_str());
    std::exit(2);
  }
  return *program;
}

constexpr const char* head = "zwang: 2\nrobot: robots/mecanum_base.yaml\nscene: scenes/open.yaml\n";
constexpr const char* task_head =
    "start: go\n"
    "tasks:\n"
    "  go:\n"
    "    timeout: {after: 4 s, goto: done}\n"
    "    constraints:\n"
    "      drive: {move: base, in: world, x: {velocity: 0.3 m/s, force: +-60 N}, y: {velocity: 0.05 m/s, "
    "force: +-60 N}, rz: {velocity: 0.1 rad/s, force: +-20 N m}}\n";

lang::Program load_text(const std::string& text) {
  const test::TemporaryFolder folder;
  const fs::path specs = folder.path() / "specs";
  fs::copy(ZWANG_SOURCE_DIR "/specs", specs, fs::copy_options::recursive);
  std::ofstream(specs / "made.yaml") << text;
  return load(specs / "made.yaml", {});
}

}  // namespace

lang::Program shipped(const std::string& task, const std::string& robot) {
  const fs::path specs = ZWANG_SOURCE_DIR "/specs";
  return load(specs / task, specs / "robots" / (robot + ".yaml"));
}

lang::Program groups(int count) {
  std::ostringstream text;
  text << head << task_head;
  for (int i = 1; i < count; ++i) {
    const double looser = 1.0 + 0.01 * i;
    text << "      g" << i << ": {move: base, in: world, level: " << 2 + i / 8 << ", x: {velocity: +-"
         << looser << " m/s, acceleration: +-" << 1.0 + looser << " m/s^2}, y: {velocity: +-" << looser
         << " m/s}, rz: {velocity: +-" << looser << " rad/s}}\n";
  }
  return load_text(text.str());
}

lang::Program exits(int count) {
  std::ostringstream text;
  text << head << task_head << "    exits:\n";
  for (int i = 0; i < count; ++i) {
    text << "      - {when: abs(drive.x.position) > " << 100 + i << " m and abs(drive.y.velocity) > "
         << 50 + i << " m/s and elapsed > " << 1000 + i << " s, goto: failed}\n";
  }
  return load_text(text.str());
}

lang::Program star(int count) {
  std::ostringstream text;
  text << std::fixed << head << "regions:\n  yard:\n    polygon:\n";
  for (int i = 0; i < count; ++i) {
    const double radius = i % 2 == 0 ? 5.0 : 4.6, angle = 2.0 * std::numbers::pi * i / count;
    text << "      - [" << radius * std::cos(angle) << " m, " << radius * std::sin(angle) << " m]\n";
  }
  text << "always:\n  constraints:\n    boundary: {move: footprint, inside: yard, margin: 5 cm}\n"
       << task_head;
  return load_text(text.str());
}

lang::Program tasks(int count) {
  std::ostringstream text;
  text << head << task_head;
  for (int i = 1; i < count; ++i) {
    text << "    exits: [{when: elapsed > 1000 s, goto: t" << i << "}]\n  t" << i
         << ":\n    timeout: {after: 4 s, goto: done}\n    constraints:\n"
            "      drive: {move: base, in: world, x: {velocity: 0.3 m/s}, y: {velocity: 0.05 m/s}, rz: "
            "{velocity: 0.1 rad/s}}\n";
  }
  return load_text(text.str());
}

lang::Program wheels(int count) {
  const char* const robot = count == 2   ? "diff_base"
                            : count == 3 ? "omni_base"
                            : count == 4 ? "mecanum_base"
                                         : "kelo_base";
  return load_text(std::string("zwang: 2\nrobot: robots/") + robot +
                   ".yaml\nscene: scenes/open.yaml\nstart: go\ntasks:\n  go:\n"
                   "    timeout: {after: 4 s, goto: done}\n    constraints:\n"
                   "      drive: {move: base, in: base, x: {velocity: 0.3 m/s, force: +-60 N}, "
                   "rz: {velocity: 0.1 rad/s, force: +-20 N m}}\n");
}

lang::Program program_of(const std::string& name) {
  std::istringstream words(name);
  int count = 0;
  std::string of;
  if (words >> count >> of) {
    if (of == "groups") return groups(count);
    if (of == "exits") return exits(count);
    if (of == "tasks") return tasks(count);
    return of == "wheels" ? wheels(count) : star(count);
  }
  if (name == "hospital") return shipped("hospital.yaml", "mecanum_base");
  if (name == "crowded") return shipped("laws/crowded.yaml", "mecanum_base");
  if (name == "wall_align") return shipped("wall_align.yaml", "mecanum_base");
  if (name == "obstacle") return shipped("obstacle.yaml", "mecanum_arm_base");
  std::fprintf(stderr, "no case %s\n", name.c_str());
  std::exit(2);
}

}  // namespace zwang::bench
