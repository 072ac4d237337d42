// N603 is the plant's peak or its bound: on joints, at stops, on the floor, under a script, of other robots
// and of springs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>

#include "../is_long.hpp"
#include "../temporary_folder.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;

/// The number behind `words` in a message.
std::optional<double> figure_behind(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(text.substr(at + words.size()));
}

struct Told {
  std::string text;                  ///< of N603
  std::optional<double> near, most;  ///< [N]
  std::optional<double> in_steps;    ///< [N]
  std::vector<ObjectTruth> objects;  ///< after the hit
  double peak() const {
    double all = 0.0;
    for (const ObjectTruth& object : objects) all = std::max(all, object.peak_force);
    return all;
  }
};

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

constexpr const char* still =
    "{move: base, in: base, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}";

/// The mecanum base, 0.4 m from its middle to its front, 57 kg along x, drives by `x` from the origin.
/// `longest` [s]; it ends 0.3 s after it touches.
Told driven(const std::string& x, const std::string& scene, double longest = 60.0) {
  const zwang::test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  for (const char* name : {"mecanum_base.yaml", "mecanum_base.urdf"})
    fs::copy_file(fs::path(ZWANG_SOURCE_DIR "/specs/robots") / name, folder / name);
  std::ofstream(folder / "scene.yaml") << "zwang_scene: 1\n" << scene;
  const auto task = [&](const std::string& name, const std::string& group, const std::string& head) {
    std::ofstream(folder / name) << "zwang: 2\nrobot: mecanum_base.yaml\n"
                                 << head << "start: a\ntasks:\n  a:\n    constraints:\n      go: " << group
                                 << "\n    timeout: {after: 60 s, goto: done}\n";
  };
  task("still.yaml", still, "");
  task("task.yaml", "{move: base, " + x + ", rz: {velocity: 0 rad/s}}", "scene: scene.yaml\n");
  lang::Diagnostics diagnostics;
  const auto program = lang::load_with_notes(folder / "task.yaml", {}, diagnostics);
  std::ostringstream words;
  lang::render_human(diagnostics, words);
  Told told;
  EXPECT_TRUE(program) << words.str();
  if (!program) return told;
  for (const lang::Diagnostic& d : diagnostics.all()) {
    if (d.code == "N603") told.text = d.message;
  }
  told.near = figure_behind(told.text, "peaks near ");
  told.most = figure_behind(told.text, "peaks at up to ");
  if (const auto most = figure_behind(told.text, " N, at up to ")) told.most = most;
  told.in_steps = figure_behind(told.text, "do not resolve the hit: at most ");
  ScenePlant plant(*program);
  Runner runner(*program);
  Sensed sensed(program->robot.model, program->signals.size());
  std::optional<double> touched;
  while (plant.truth().time < (touched ? *touched + 0.3 : longest)) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    EXPECT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    for (const ObjectTruth& object : plant.truth().objects) {
      if (!touched && object.touched) touched = object.touched;
    }
  }
  told.objects = plant.truth().objects;
  return told;
}

/// A box of 0.6 m width, its face 1 m ahead of the base's front.
std::string box(const std::string& more) {
  return "objects:\n  o: {box: [0.2 m, 0.6 m, 0.5 m], at: [1.5 m, 0 m], " + more + "}\n";
}

class Draw {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Of a skin.
  std::string skin() {
    return "stiffness: " + text_of(std::pow(10.0, between(1.0, 2.7))) +
           " kN/m, damping: " + text_of(between(0.0, 1.0));
  }
  std::string mass() { return "mass: " + text_of(between(2.0, 60.0)) + " kg"; }

 private:
  std::mt19937 random_{6030};
};

void expect_near(const Told& told) {
  ASSERT_TRUE(told.near) << told.text;
  std::printf("%.0f N of %s\n", told.peak(), told.text.c_str());
  EXPECT_GT(told.peak(), 0.0) << told.text;
  EXPECT_LE(told.peak(), 1.25 * *told.near) << told.text;
  const bool is_felt = told.text.find("the simulation feels less") == std::string::npos;
  if (is_felt) {
    EXPECT_GE(told.peak(), 0.75 * *told.near) << told.text;
  }
}

// Without a force range every hit is told. 1 m is way enough for each of these speeds.
TEST(HitForecast, OfWhatGivesWayIsThePlantsPeakWithinAQuarter) {
  Draw draw;
  const int rounds = test::is_long() ? 40 : 1;
  for (int i = 0; i < rounds; ++i) {
    const std::string x = "in: base, x: {velocity: " + text_of(draw.between(0.1, 0.5)) +
                          " m/s, time_constant: " + text_of(draw.between(0.05, 0.3)) + " s}";
    const std::string holds = "preload: " + text_of(draw.between(0.0, 300.0)) +
                              " N, friction: " + text_of(draw.between(0.0, 100.0)) + " N";
    for (const std::string& more :
         {draw.mass() + ", slide: {along: x, range: [-0.3 m, 0 m]}, " + draw.skin(),
          draw.mass() + ", slide: {along: x, range: [0 m, 0.8 m], " + holds + "}, " + draw.skin(),
          draw.mass() + ", hinge: {at: [0 m, 0.6 m], range: [-90 deg, 0 deg]}, " + draw.skin(),
          draw.mass() + ", hinge: {at: [0 m, 0.6 m], range: [0 deg, 90 deg], friction: " +
              text_of(draw.between(0.0, 200.0)) + " N m}, " + draw.skin(),
          draw.mass() + ", friction: " + text_of(draw.between(0.0, 0.8)) + ", " + draw.skin()})
      expect_near(driven(x, box(more)));
  }
}

TEST(HitForecast, OfARobotThatStandsIsThePlantsPeakWithinAQuarter) {
  Draw draw;
  const int rounds = test::is_long() ? 20 : 1;
  for (int i = 0; i < rounds; ++i) {
    const double speed = draw.between(0.1, 0.4);
    expect_near(
        driven("in: base, x: {velocity: " + text_of(speed) + " m/s, time_constant: 0.1 s}",
               "robots: {other: {task: still.yaml, at: [1.8 m, 0 m], yaw: 180 deg, " + draw.skin() + "}}\n"));
  }
}

TEST(HitForecast, OfSpringsAndSoftWallsIsThePlantsPeakWithinAQuarter) {
  Draw draw;
  const int rounds = test::is_long() ? 40 : 1;
  for (int i = 0; i < rounds; ++i) {
    const std::string range = i % 2 == 0 ? "" : ", force: +-" + text_of(draw.between(10.0, 50.0)) + " N";
    const Told spring =
        driven("in: world, x: {position: " + text_of(draw.between(1.5, 3.0)) +
                   " m, stiffness: " + text_of(draw.between(40.0, 400.0)) +
                   " N/m, damping: " + text_of(draw.between(50.0, 400.0)) + " N s/m" + range + "}",
               box("fixed: true, " + draw.skin()));
    if (!spring.text.empty()) expect_near(spring);  // else it is gentle
    // The driver's own push builds up as the wall slows it.
    expect_near(
        driven("in: base, x: {velocity: " + text_of(draw.between(0.03, 0.3)) +
                   " m/s, time_constant: " + text_of(draw.between(0.05, 0.5)) + " s}",
               box("fixed: true, stiffness: " + text_of(draw.between(1.0, 10.0)) + " kN/m, damping: 0.3")));
  }
}

// The truck comes with a constant speed, wherever the two meet.
TEST(HitForecast, OfAScriptIsABound) {
  Draw draw;
  const int rounds = test::is_long() ? 20 : 1;
  for (int i = 0; i < rounds; ++i) {
    const Told told = driven(
        "in: base, x: {velocity: " + text_of(draw.between(0.1, 0.3)) + " m/s, time_constant: 0.1 s}",
        "objects:\n  o: {box: [0.2 m, 0.6 m, 0.5 m], at: [3 m, 0 m], motion: [{time: 0 s, at: [3 m, 0 m]}, "
        "{time: " +
            text_of(draw.between(4.0, 10.0)) + " s, at: [0 m, 0 m]}], " + draw.skin() + "}\n");
    EXPECT_FALSE(told.near) << told.text;
    ASSERT_TRUE(told.most) << told.text;
    std::printf("%.0f N of %s\n", told.peak(), told.text.c_str());
    EXPECT_LE(told.peak(), *told.most) << told.text;
    EXPECT_GE(told.peak(), 0.75 * *told.most) << told.text;
  }
}

// A drawer runs against its stop, a crate against a wall.
TEST(HitForecast, AtTheEndOfTheFreeWayIsABound) {
  const std::string x = "in: base, x: {velocity: 0.2 m/s, time_constant: 0.1 s, force: +-40 N}";
  for (const std::string& scene :
       {box("mass: 3 kg, slide: {along: x, range: [0 m, 2 cm]}"),
        box("mass: 3 kg, friction: 0.1") + "  wall: {wall: {length: 4 m}, at: [1.62 m, 0 m]}\n"}) {
    const Told told = driven(x, scene);
    ASSERT_TRUE(told.near && told.most) << told.text;
    EXPECT_GT(told.peak(), 1.25 * *told.near) << "the stop is the harder one: " << told.text;
    EXPECT_LE(told.peak(), *told.most) << told.text;
  }
}

TEST(HitForecast, OfAHardWallTellsWhatTheStepsFeel) {
  for (const double damping : {0.0, 0.3, 5.0}) {
    const Told told = driven("in: base, x: {velocity: 0.2 m/s, time_constant: 0.1 s}",
                             box("fixed: true, stiffness: 1e9 N/m, damping: " + text_of(damping)));
    ASSERT_TRUE(told.in_steps) << told.text;
    EXPECT_LE(told.peak(), *told.in_steps) << told.text;
    EXPECT_GT(told.peak(), 0.2 * *told.in_steps) << told.text;
  }
}

TEST(HitForecast, IsNoneOfWhatLiesTheOtherWay) {
  const std::string wall = box("fixed: true");
  for (const char* x : {"in: world, x: {position: -1 m, velocity: +-0.2 m/s}",
                        "in: base, x: {force: -20 N, velocity: +-0.1 m/s}",
                        "in: base, x: {velocity: -0.2 m/s}", "in: base, x: {acceleration: -0.2 m/s^2}"}) {
    const Told told = driven(x, wall, 0.1);
    EXPECT_EQ(told.text, "") << x;
  }
}

TEST(HitForecast, SaysWhatItDoesNotCount) {
  const std::string x = "in: base, x: {velocity: 0.2 m/s}";
  for (const auto& [scene, words] :
       {std::pair<std::string, const char*>{
            box("mass: 20 kg") + "pushes: [{at: 1 s, for: 1 s, object: o, force: [-60 N, 0 N]}]\n",
            "not counting the hand on `o`"},
        {box("fixed: true") + "pushes: [{at: 1 s, for: 1 s, force: [60 N, 0 N]}]\n",
         "not counting the hand on the base"},
        {box("fixed: true") + "faults: [{at: 1 s, payload: 50 kg}]\n", "not counting the scene's payload"},
        {"robots: {other: {task: task.yaml, at: [3 m, 0 m], yaw: 180 deg}}\n",
         "not counting how `other` moves"}}) {
    const Told told = driven(x, scene, 0.01);
    EXPECT_NE(told.text.find(words), std::string::npos) << words << " in " << told.text;
  }
}

}  // namespace
}  // namespace zwang::runtime
