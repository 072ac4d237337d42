// Scene files: objects, signals and faults as they are read, and mistakes found where they are written.
#include "zwang/lang/scene.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace zwang::lang {
namespace {

struct SceneMistake {
  const char* from;
  const char* to;
  const char* code;
  int line;
};

TEST(Scene, reads_what_unfolds_in_time) {
  const test::Folder folder;
  const auto path = folder.write("scene.yaml", R"(zwang_scene: 1
state: {position: 2 mm, velocity: 1 cm/s}
objects:
  cart:
    box: [0.6 m, 0.4 m, 0.5 m]
    at: [2 m, 0 m]
    motion: [{time: 1 s, at: [2 m, 0 m]}, {time: 3 s, at: [2 m, 1 m], yaw: 90 deg}]
    dock: {at: [-0.3 m, 0 m], reach: 3 cm, hook: hook}
signals:
  loaded: {script: [[0 s, false], [5 s, true]]}
  partner: {pose_of: cart, noise: 5 mm, angle_noise: 0.5 deg, delay: 100 ms, rate: 20 Hz, dropouts: 5 %}
faults:
  - {at: 2 s, wheel: left_wheel, torque: flipped}
  - {at: 3 s, for: 10 ms, samples: nan}
)");
  Diagnostics diagnostics;
  const auto scene = load_scene(path, diagnostics);
  ASSERT_TRUE(scene) << test::rendered(diagnostics);
  EXPECT_EQ(scene->state.velocity, 0.01);
  ASSERT_EQ(scene->objects[0].motion.size(), 2u);
  EXPECT_NEAR(scene->objects[0].motion[1].yaw, 3.14159265358979 / 2.0, 1e-12);
  EXPECT_EQ(scene->objects[0].dock->reach, 0.03);
  EXPECT_EQ(scene->signals[1].period, 0.05);
  EXPECT_EQ(scene->signals[1].dropouts, 0.05);
  EXPECT_EQ(scene->signals[0].script[1].value, 1.0);
  EXPECT_EQ(scene->faults[0].joint, "left_wheel");
  EXPECT_EQ(scene->faults[1].kind, FaultKind::samples_nan);
}

TEST(Scene, mistakes_in_what_unfolds_are_found_where_they_are_written) {
  const char* const text = R"(zwang_scene: 1
objects:
  cart: {box: [0.6 m, 0.4 m, 0.5 m], at: [2 m, 0 m], motion: [{time: 1 s, at: [2 m, 0 m]}, {time: 3 s, at: [2 m, 1 m]}]}
signals:
  loaded: {script: [[0 s, false], [5 s, true]]}
  partner: {pose_of: cart, dropouts: 5 %}
)";
  const SceneMistake mistakes[] = {
      {"[5 s, true]", "[0 s, true]", "E908", 5},
      {"[5 s, true]", "[5 s]", "E908", 5},
      {"time: 3 s", "time: 1 s", "E908", 3},
      {"pose_of: cart", "pose_of: car", "E301", 6},
      {"pose_of: cart", "pose_of: cart, latch: cart", "E908", 6},
      {"pose_of: cart", "force_of: base", "E908", 6},
      {"pose_of: cart", "force_of: cart, bias: 3 mm", "E202", 6},
      {"pose_of: cart", "force_of: cart, noise: 3 mm", "E202", 6},
      {"pose_of: cart", "pose_of: cart, bias: 3 N", "E101", 6},
      {"dropouts: 5 %", "dropouts: 100 %", "E908", 6},
      {"dropouts: 5 %", "rate: 0 Hz", "E105", 6},

      {"at: [2 m, 0 m], motion", "at: [2 m, 0 m], mass: 3 kg, motion", "E902", 3},
  };
  for (const SceneMistake& mistake : mistakes) {
    const test::Folder folder;
    Diagnostics diagnostics;
    EXPECT_FALSE(
        load_scene(folder.write("s.yaml", test::replaced(text, mistake.from, mistake.to)), diagnostics));
    ASSERT_GE(test::count(diagnostics, mistake.code), 1) << mistake.to << "\n" << test::rendered(diagnostics);
    EXPECT_EQ(diagnostics.error_count(), 1) << test::rendered(diagnostics);
    EXPECT_EQ(diagnostics.sorted()[0].span.begin.line, mistake.line) << test::rendered(diagnostics);
  }
}

TEST(Scene, signals_speak_of_objects_of_the_first_robot_and_of_others) {
  const test::Folder folder;
  const auto robots = test::source_dir / "tests/conformance";
  for (const char* name : {"ok_shorter_for.yaml", "robots/mini.yaml", "robots/mini.urdf"})
    folder.write(name, test::slurp(robots / name));
  const auto path = folder.write("s.yaml", R"(zwang_scene: 1
objects:
  cart: {box: [0.6 m, 0.4 m, 0.5 m], at: [2 m, 0 m]}
robots:
  near: {task: ok_shorter_for.yaml, at: [0 m, 2 m], signals: {seen: {pose_of: far}, me: {pose_of: base}}}
  far:  {task: ok_shorter_for.yaml, at: [0 m, 4 m]}
signals:
  a: {pose_of: cart}
  b: {pose_of: near}
  c: {pose_of: far}
)");
  Diagnostics diagnostics;
  const auto scene = load_scene(path, diagnostics);
  ASSERT_TRUE(scene) << test::rendered(diagnostics);
  EXPECT_EQ(scene->signals[0].object, 0);
  EXPECT_EQ(scene->signals[1].object, scene->seen_robot(0));
  EXPECT_EQ(scene->signals[2].object, scene->seen_robot(1));
  EXPECT_EQ(scene->robots[0].signals[0].object, scene->seen_robot(1));
  EXPECT_EQ(scene->robots[0].signals[1].object, scene->seen_robot(-1));
}

TEST(Scene, a_misspelt_key_is_the_only_mistake) {
  const char* const text = R"(zwang_scene: 1
objects:
  cart:
    box: [0.6 m, 0.4 m, 0.5 m]
    at: [2 m, 0 m]
    dock: {at: [-0.3 m, 0 m], hook: hook}
signals:
  partner: {pose_of: cart}
  hooked:  {latch: cart}
faults:
  - {at: 2 s, wheel: left, torque: lost}
)";
  const SceneMistake mistakes[] = {{"objects:", "ojbects:", "E101", 2},
                                   {"dock:", "dcok:", "E101", 6},
                                   {"torque: lost", "torque: los", "E907", 11},
                                   {"box:", "bx:", "E101", 4}};
  for (const SceneMistake& mistake : mistakes) {
    const test::Folder folder;
    Diagnostics diagnostics;
    EXPECT_FALSE(
        load_scene(folder.write("s.yaml", test::replaced(text, mistake.from, mistake.to)), diagnostics));
    ASSERT_EQ(diagnostics.all().size(), 1u) << test::rendered(diagnostics);
    EXPECT_EQ(diagnostics.all()[0].code, mistake.code) << test::rendered(diagnostics);
    EXPECT_EQ(diagnostics.all()[0].span.begin.line, mistake.line) << test::rendered(diagnostics);
  }
}

TEST(Scene, an_object_is_not_called_like_the_base_of_the_truth) {
  const test::Folder folder;
  Diagnostics diagnostics;
  EXPECT_FALSE(load_scene(
      folder.write("s.yaml", "zwang_scene: 1\nobjects:\n  base: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m]}\n"),
      diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1u) << test::rendered(diagnostics);
  EXPECT_EQ(diagnostics.all()[0].code, "E305");
  EXPECT_EQ(diagnostics.all()[0].span.begin.line, 3);
}

}  // namespace
}  // namespace zwang::lang
