// Habits that authors bring from other programs. Each one is told once, with the word that zwang has for it.
#include <gtest/gtest.h>

#include "support.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/scene_for_robot.hpp"

namespace zwang::lang {
namespace {

const char* const task_text = R"(zwang: 1
robot: robots/mini.yaml
scene: scene.yaml
params:
  gap: {value: 1 m, range: [0.6 m, 2 m]}
signals:
  person: {type: pose, in: base_link, stale_after: 500 ms}
  seated: {type: bool, stale_after: 500 ms}
frames:
  there: {parent: person, at: [0 m, 0 m]}
features:
  reach: {distance: [base_link, there]}
start: go
tasks:
  go:
    constraints:
      keep: {feature: reach, position: $gap}
      turn: {move: base_link, in: base_link, rz: {velocity: 0 rad/s, force: +-5 N m}}
    exits:
      - when: reach < 0.5 m and seated
        for: 0.2 s
        goto: stay
    timeout: {after: 20 s, goto: failed}
  stay:
    constraints:
      stand:
        move: base_link
        in: world
        x: {position: here}
        rz: {position: here}
    timeout: {after: 3 s, goto: done}
)";

const char* const scene_text = R"(zwang_scene: 1
objects:
  human:
    cylinder: {radius: 0.25 m, height: 1.7 m}
    at: [3 m, 0 m]
    motion: [{time: 1 s, at: [3 m, 0 m]}, {time: 9 s, at: [5 m, 1 m]}]
    dock: {at: [0 m, 0 m], hook: bumper}
signals:
  person: {pose_of: human, rate: 10 Hz, delay: 100 ms}
  seated: {latch: human}
)";

const char* const scenario_text = R"(zwang_scenario: 1
task: task.yaml
matrix:
  params.gap: [1 m, 1.5 m]
  start_yaw: [0 deg, 10 deg]
expect:
  - outcome: done
  - {at: end, that: truth.human.x > 1.6 m}
)";

struct Habit {
  std::string name;
  std::string file;  ///< task, scene, scenario, robot
  std::string from, to;
  std::string code;
  std::string help;     ///< part of it
  std::string told_at;  ///< text on the line of the message; empty: the mistake's
};

std::vector<Habit> habits() {
  return {
      {"frame_for_move", "task", "stand:\n        move:", "stand:\n        frame:", "E101", "`move`",
       "frame:"},
      {"relative_to", "task", "        in: world", "        relative_to: world", "E101", "`in`", {}},
      {"priority", "task", "        in: world", "        in: world\n        priority: 2", "E101", "`level`",
       "priority"},
      {"a_joint",
       "task",
       "        move: base_link\n        in: world\n",
       "        joint: left\n",
       "E101",
       "needed, and not given: `move`, `in`",
       {}},
      {"yaw", "task", "        rz: {position: here}", "        yaw: {position: here}", "E101", "`rz`", {}},
      {"axis_without_quantity",
       "task",
       "        rz: {position: here}",
       "        rz: 0 deg",
       "E104",
       "{position: 0 deg}",
       {}},
      {"hold_for_an_axis",
       "task",
       "        rz: {position: here}",
       "        rz: hold",
       "E104",
       "{position: here}",
       {}},
      {"hold_for_a_position",
       "task",
       "        rz: {position: here}",
       "        rz: {position: hold}",
       "E301",
       "`here`",
       {}},
      {"dollar_before_here",
       "task",
       "        rz: {position: here}",
       "        rz: {position: $here}",
       "E301",
       "without the `$`",
       {}},
      {"max_force", "task", "force: +-5 N m", "max_force: 5 N m", "E101", "`force: +-5 N m`", {}},
      {"at_most", "task", "force: +-5 N m", "force: < 5 N m", "E105", "a bound is a range", {}},
      {"max", "task", "force: +-5 N m", "force: max 5 N m", "E105", "a bound is a range", {}},
      {"dots", "task", "force: +-5 N m", "force: 0..5 N m", "E105", "a bound is a range", {}},
      {"no_end", "task", "force: +-5 N m", "force: [0 N m, inf]", "E105", "two ends", {}},
      {"default", "task", "value: 1 m", "default: 1 m", "E101", "`value`", {}},
      {"timeout_of_a_signal",
       "task",
       "base_link, stale_after: 500 ms",
       "base_link, timeout: 500 ms",
       "E101",
       "`stale_after`",
       {}},
      {"if", "task", "- when: reach", "- if: reach", "E101", "`when`", {}},
      {"then", "task", "goto: stay", "then: stay", "E101", "`goto`", {}},
      {"time_for_a_target",
       "task",
       "{after: 20 s, goto: failed}",
       "{20 s: failed}",
       "E101",
       "needed, and not given: `after`, `goto`",
       {}},
      {"equals_true", "task", "and seated", "and seated == true", "E105", "alone", {}},
      {"comma", "task", "m and seated", "m, seated", "E105", "`and`", {}},
      {"quantity_of_a_feature",
       "task",
       "reach < 0.5 m and",
       "reach.position < 0.5 m and",
       "E301",
       "by its name alone",
       {}},
      {"constraints_as_a_list", "task", "    constraints:\n      stand:\n        move",
       "    constraints:\n      - stand:\n        move", "E104", "`- `", "- stand"},
      {"no_such_task",
       "task",
       "goto: stay",
       "goto: somewhere",
       "E301",
       "known here: go, stay, done, failed",
       {}},
      {"rotation", "task", "at: [0 m, 0 m]}", "rotation: 90 deg}", "E101", "`yaw`", {}},
      {"a_length_for_a_place", "task", "at: [0 m, 0 m]}", "at: 1 m}", "E104", "[0 m, 0 m]", {}},
      {"frame_of_nobody", "task", "parent: person", "parent: human", "E301", "known here: ", {}},
      {"path", "task", "scene: scene.yaml", "scene: scenery", "E109", "paths are seen from", {}},
      {"never_after", "task", "{after: 3 s, goto: done}", "{after: never}", "E104", "timeout: never", {}},
      {"a_sum_of_parameters",
       "task",
       "position: $gap",
       "position: 2*$gap",
       "E105",
       "nothing is computed",
       {}},
      {"no_units_at_all", "task", "at: [0 m, 0 m]}", "at: [0, 0.5]}", "E201", "[0 m, 0.5 m]", {}},
      {"a_parameter_in_a_condition",
       "task",
       "reach < 0.5 m and",
       "reach < 0.5 m and gap > 1 m and",
       "E301",
       "$gap",
       {}},
      {"an_axis_in_a_condition",
       "task",
       "reach < 0.5 m and",
       "reach < 0.5 m and turn.rz > 1 deg and",
       "E301",
       "turn.rz.position",
       {}},
      {"a_frame_in_a_condition",
       "task",
       "reach < 0.5 m and",
       "reach < 0.5 m and bumper.x > 1 m and",
       "E301",
       "speed(bumper)",
       {}},
      {"time", "task", "reach < 0.5 m and", "reach < 0.5 m and time > 1 s and", "E301", "elapsed", {}},
      {"at_least", "task", "reach < 0.5 m", "reach \u2264 0.5 m", "E105", "<=", {}},
      {"group_that_is_not_indented",
       "task",
       "        move: base_link\n        in: world\n        x: {position: here}\n        rz: {position: "
       "here}\n",
       "      move: base_link\n      in: world\n      x: {position: here}\n      rz: {position: here}\n",
       "E104",
       "two spaces more than `stand:`",
       {}},
      {"group_without_a_name",
       "task",
       "      stand:\n        move: base_link\n        in: world\n        x: {position: here}\n        rz: "
       "{position: here}\n",
       "      move: base_link\n      in: world\n      x: {position: here}\n      rz: {position: here}\n",
       "E104",
       "the name of a group",
       {}},
      {"group_in_a_task",
       "task",
       "    constraints:\n      stand:\n        move: base_link\n        in: world\n        x: {position: "
       "here}\n        rz: {position: here}\n",
       "    move: base_link\n    in: world\n    x: {position: here}\n",
       "E104",
       "`constraints: {NAME:",
       {}},
      {"task_that_is_not_indented",
       "task",
       "    constraints:\n      stand:\n        move: base_link\n        in: world\n        x: {position: "
       "here}\n        rz: {position: here}\n    timeout:",
       "  constraints:\n    stand:\n      move: base_link\n      in: world\n      x: {position: here}\n  "
       "timeout:",
       "E104",
       "two spaces more than `stay:`",
       {}},
      {"braces", "task", "position: $gap", "position: ${gap}", "E105", "`$gap`", {}},
      {"braces_in_a_block", "task", "keep: {feature: reach, position: $gap}",
       "keep:\n        feature: reach\n        position: -${gap}", "E105", "`-$gap`", "position: -$"},
      {"braces_in_a_list",
       "task",
       "velocity: 0 rad/s, force",
       "velocity: [${gap}, ${gap}], force",
       "E105",
       "`$gap`",
       {}},
      {"braces_in_a_condition", "task", "reach < 0.5 m and", "reach < ${gap} and", "E105", "`$gap`", {}},
      {"timeout_without_unit",
       "task",
       "{after: 3 s, goto: done}",
       "5.0",
       "E104",
       "{after: 5.0 s, goto: failed}",
       {}},
      {"timeout_that_is_a_task",
       "task",
       "{after: 3 s, goto: done}",
       "done",
       "E104",
       "{after: 20 s, goto: failed}",
       {}},
      {"map", "task", "        in: world", "        in: map", "E301", "`world`", {}},
      {"odom_as_a_parent", "task", "parent: person", "parent: odom", "E301", "`world`", {}},
      {"base_footprint",
       "task",
       "distance: [base_link",
       "distance: [base_footprint",
       "E301",
       "`base_link`",
       {}},
      {"zero_for_an_axis",
       "task",
       "        rz: {position: here}",
       "        rz: 0",
       "E104",
       "{velocity: 0 rad/s}",
       {}},
      {"angle_for_a_speed", "task", "rz: {velocity: 0 rad/s", "rz: {velocity: 0 deg", "E202", "`rad/s`", {}},
      {"plus_and_minus", "task", "force: +-5 N m", "force: +/- 5 N m", "E105", "`+-5 N m`", {}},
      {"no_colon",
       "task",
       "        rz: {position: here}",
       "        rz: {position here}",
       "E101",
       "`position: here`",
       {}},
      {"no_space",
       "task",
       "        rz: {position: here}",
       "        rz:{position: here}",
       "E101",
       "`rz: {..`",
       {}},
      {"for_in_a_condition", "task", "and seated\n        for: 0.2 s", "and seated for 0.2 s", "E105",
       "a line of its own", "and seated"},
      {"distance_in_a_condition",
       "task",
       "reach < 0.5 m and",
       "reach < 0.5 m and distance(bumper, there) < 1 m and",
       "E301",
       "`features`",
       {}},
      {"gain",
       "task",
       "        x: {position: here}",
       "        x: {position: here, kp: 100 N/m, damping: 10 N s/m}",
       "E101",
       "`stiffness`",
       {}},
      {"a_template_by_name", "task", "  stay:\n    constraints:\n",
       "  stay:\n    template: hold\n    constraints:\n", "E101", "`use`", "template: hold"},
      // --- scenes ---
      {"sphere", "scene", "cylinder: {radius: 0.25 m, height: 1.7 m}", "sphere: 1 m", "E101", "cylinder", {}},
      {"position_of_an_object",
       "scene",
       "    at: [3 m, 0 m]\n",
       "    position: [3 m, 0 m]\n",
       "E101",
       "`at`",
       {}},
      {"coordinates_by_name",
       "scene",
       "    at: [3 m, 0 m]\n",
       "    at: {x: 3 m, y: 0 m}\n",
       "E104",
       "[3 m, 0 m]",
       {}},
      {"pose", "scene", "pose_of: human", "pose: human", "E101", "`pose_of`", {}},
      {"to",
       "scene",
       "{time: 1 s, at: [3 m, 0 m]}",
       "{time: 1 s, to: [3 m, 0 m]}",
       "E101",
       "needed, and not given: `at`",
       {}},
      {"hook_of_the_task_file", "scene", "hook: bumper", "hook: there", "E301", "of the robot file", {}},
      {"start_as_a_list",
       "scene",
       "objects:\n",
       "start: [0, 0, 20]\nobjects:\n",
       "E104",
       "`{at: [0 m, 0 m], yaw: 20 deg}`",
       {}},
      {"floor_as_a_number", "scene", "objects:\n", "floor: 0.9\nobjects:\n", "E104", "`{friction: 0.9}`", {}},
      {"wall_by_its_length",
       "scene",
       "cylinder: {radius: 0.25 m, height: 1.7 m}",
       "wall: 3",
       "E104",
       "`{length: 3 m}`",
       {}},
      {"time_of_a_fault",
       "scene",
       "signals:\n",
       "faults: [{time: 1 s, clock: backwards}]\nsignals:\n",
       "E101",
       "`at`",
       {}},
      // --- scenarios ---
      {"start", "scenario", "matrix:", "start: [0 m, 0 m]\nmatrix:", "E101", "`start_at`", {}},
      {"heading_in_a_place",
       "scenario",
       "  start_yaw: [0 deg, 10 deg]",
       "  start_at: [[0, 1, 20]]",
       "E104",
       "`start_at: [0 m, 1 m]` and `start_yaw: 20 deg`",
       {}},
      {"one_place_for_many",
       "scenario",
       "  start_yaw: [0 deg, 10 deg]",
       "  start_at: [0 m, 0 m]",
       "E104",
       "`[[0 m, 0 m], ",
       {}},
      {"headings_without_unit",
       "scenario",
       "[0 deg, 10 deg]",
       "[0, 5, 10]",
       "E201",
       "`[0 deg, 5 deg, 10 deg]`",
       {}},
      {"timeout", "scenario", "matrix:", "timeout: 3 s\nmatrix:", "E101", "`time_limit`", {}},
      {"parameter_in_a_matrix", "scenario", "params.gap", "gap", "E101", "`params.gap`", {}},
      {"parameters_in_a_matrix",
       "scenario",
       "params.gap: [1 m, 1.5 m]",
       "params: {gap: [1 m]}",
       "E101",
       "`params.NAME: [..]`",
       {}},
      {"degrees_without_unit", "scenario", "10 deg", "10", "E201", "`10 deg`", {}},
      {"condition_without_key",
       "scenario",
       "that: truth.human.x",
       "truth.human.x",
       "E103",
       "`that: truth.human.x > 1.6 m`",
       {}},
      {"cells", "scenario", "matrix:", "cells:", "E101", "`matrix`", {}},
      // --- robots ---
      {"degrees_of_a_yaw",
       "robot",
       "at: [0.3 m, 0 m, 0.1 m]}",
       "at: [0.3 m, 0 m, 0.1 m], yaw: 90}",
       "E201",
       "`90 deg`",
       {}},
      {"wheel_by_name",
       "robot",
       "- {joint: left, radius: 0.1 m}",
       "- left",
       "E104",
       "`{joint: left, radius: ",
       {}},
      {"corners_alone",
       "robot",
       "{polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], [0.3 m, -0.2 m]]}",
       "[[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [0 m, -0.2 m]]",
       "E104",
       "{polygon: ",
       {}},
      {"gear_ratio", "robot", "left: {}", "left: {gear_ratio: 26}", "E101", "`gear`", {}},
      {"begin_of_a_word", "robot", "deceleration: 1", "decel: 1", "E101", "`deceleration`", {}},
      {"link_of_nobody", "robot", "base: base_link", "base: chassis", "E301", "`base_link`", {}},
  };
}

void PrintTo(const Habit& habit, std::ostream* out) {
  *out << habit.file << ": " << habit.name;
}

class HabitOf : public testing::TestWithParam<Habit> {
 protected:
  /// The diagnostics of all files, with `habit` in one of them.
  Diagnostics said_about(const Habit& habit) {
    const auto put = [&](const std::string& kind, const std::string& name, const std::string& text) {
      return folder_.write(name, kind == habit.file ? test::replaced(text, habit.from, habit.to) : text);
    };
    const auto robots = test::source_dir / "tests/conformance/robots";
    const auto robot = put("robot", "robots/mini.yaml", test::slurp(robots / "mini.yaml"));
    folder_.write("robots/mini.urdf", test::slurp(robots / "mini.urdf"));
    folder_.write(".zwang-root", "");
    const auto task = put("task", "task.yaml", task_text);
    const auto scene = put("scene", "scene.yaml", scene_text);
    const auto scenario = put("scenario", "scenario.yaml", scenario_text);
    Diagnostics diagnostics;
    if (habit.file == "task") load(task, {}, diagnostics);
    if (habit.file == "scene") load_scene_for(robot, scene, diagnostics);
    if (habit.file == "scenario") check_scenario(scenario, diagnostics);
    if (habit.file == "robot") load_robot(robot, diagnostics);
    return diagnostics;
  }
  test::Folder folder_;
};

TEST_P(HabitOf, is_told_once_with_the_word_for_it) {
  const Habit& habit = GetParam();
  const Diagnostics diagnostics = said_about(habit);
  ASSERT_EQ(diagnostics.all().size(), 1u) << test::rendered(diagnostics);
  const Diagnostic& said = diagnostics.all()[0];
  EXPECT_EQ(said.code, habit.code) << test::rendered(diagnostics);
  EXPECT_NE(said.help.find(habit.help), std::string::npos) << test::rendered(diagnostics);
  const std::string& text = diagnostics.source(said.span.source).text;
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < said.span.begin.line; ++i) std::getline(lines, line);
  const std::string told =
      habit.told_at.empty() ? habit.to.substr(habit.to.find_first_not_of(' ')) : habit.told_at;
  EXPECT_NE(line.find(told.substr(0, told.find('\n'))), std::string::npos) << test::rendered(diagnostics);
}

INSTANTIATE_TEST_SUITE_P(An, HabitOf, testing::ValuesIn(habits()),
                         [](const auto& habit) { return habit.param.name; });

TEST(Habits, nothing_is_said_of_the_files_without_them) {
  const test::Folder folder;
  const auto robots = test::source_dir / "tests/conformance/robots";
  folder.write("robots/mini.yaml", test::slurp(robots / "mini.yaml"));
  folder.write("robots/mini.urdf", test::slurp(robots / "mini.urdf"));
  folder.write("task.yaml", task_text);
  folder.write("scene.yaml", scene_text);
  Diagnostics diagnostics;
  EXPECT_TRUE(check_scenario(folder.write("scenario.yaml", scenario_text), diagnostics));
  EXPECT_TRUE(load(folder.path() / "task.yaml", {}, diagnostics));
  EXPECT_TRUE(diagnostics.all().empty()) << test::rendered(diagnostics);
}

}  // namespace
}  // namespace zwang::lang
