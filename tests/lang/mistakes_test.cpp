// Mistakes that authors make, one at a time, in task files that are good without them. Each one is found
// where it was made, and told once.
#include <gtest/gtest.h>

#include <algorithm>

#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

struct Mistake {
  std::string name;
  std::string file;  ///< a shipped task file, or one of the drafts beside the checkout
  std::string from, to;
  std::string code;
  /// Where the message points: the text on that line; empty: the line of the mistake.
  std::string told_at;
};

/// In the files of hands, doors, carts, outputs and paths.
std::vector<Mistake> mistakes_in_forces() {
  return {
      {"yield_misspelt", "guide", "{yield: estimated", "{yeild: estimated", "E101", {}},
      {"mass_misspelt", "guide", "mass: $mass, damping", "mas: $mass, damping", "E101", {}},
      {"mass_without_damping", "guide", ", damping: $damping, dead_band", ", dead_band", "E103", {}},
      {"mass_in_newtons", "guide", "mass: {value: 60 kg, range: [40 kg, 200 kg]",
       "mass: {value: 60 N, range: [40 N, 200 N]", "E202", "        x: {yield"},
      {"part_of_the_estimate", "guide", "estimated.force.x", "estimated.force.z", "E301", {}},
      {"yield_in_the_axes_of_the_world", "guide", "        in: base\n        x: {yield",
       "        in: world\n        x: {yield", "W617", "        x: {yield"},
      {"torque_for_a_force", "guide", "estimated.force.x", "estimated.force.rz", "E202", {}},
      {"dead_band_of_a_speed", "guide", "dead_band: 5 N", "dead_band: 5 m/s", "E202", {}},
      {"yield_and_velocity", "guide", "dead_band: 5 N}", "velocity: 0.1 m/s}", "E401", {}},
      {"yield_with_a_time_constant", "guide", "dead_band: 5 N}", "time_constant: 0.2 s}", "E104", {}},
      {"build_up_too_fast", "door", "build_up: 0.4 s", "build_up: 0.2 s", "W604", {}},
      {"build_up_of_a_force",
       "door",
       "x: {velocity: $pace, force: +-$push, build_up",
       "x: {force: $push, build_up",
       "E104",
       {}},
      {"build_up_misspelt", "door", "build_up: 0.4 s", "buildup: 0.4 s", "E101", {}},
      {"build_up_without_unit", "door", "build_up: 0.4 s", "build_up: 0.4", "E201", {}},
      {"guard_without_group", "door", "way.x.saturated", "wai.x.saturated", "E301", {}},
      {"output_misspelt", "drawer", "{outputs.gripper: true}", "{outputs.griper: true}", "E301", {}},
      {"output_of_no_set", "drawer", "{set: {outputs.gripper: true}}", "{set: {gripper: true}}", "E105", {}},
      {"truth_in_words", "drawer", "outputs.gripper: true", "outputs.gripper: closed", "E105", {}},
      {"output_without_stop", "drawer", "start: false, stop: keep", "start: false", "E418", {}},
      {"stop_of_a_misspelt_word", "drawer", "stop: keep", "stop: keap", "E105", {}},
      {"type_of_an_output",
       "drawer",
       "{type: bool, start: false",
       "{type: boolean, start: false",
       "E301",
       {}},
      {"group_that_is_taken", "drawer", "moved(tool) > 5 cm", "moved(tol) > 5 cm", "E301", {}},
      {"goal_without_dollar", "cart", "{position: $goal,", "{position: goal,", "E301", {}},
      {"speed_beyond_zero", "cart", "speed(base) < 5 mm/s", "speed(base) < -5 mm/s", "E505", {}},
      {"template_of_a_group",
       "follow_wall",
       "{side: {use: at_the_wall, with: {pace: 0 m/s}}}",
       "{side: {use: at_wall, with: {pace: 0 m/s}}}",
       "E301",
       {}},
      {"argument_of_another_kind_of_group",
       "follow_wall",
       "with: {pace: 0 m/s}",
       "with: {pace: 0 m}",
       "E303",
       {}},
      {"group_and_body", "follow_wall", "    group:\n", "    grup:\n", "E101", {}},
      {"argument_that_is_missing", "follow_wall", ", with: {pace: $pace}", "", "E303", {}},
      {"pose_for_a_frame", "cradle", "in: socket\n", "in: plug\n", "E301", {}},
      {"holds_of_nobody", "cradle", "holds: hook", "holds: hok", "E301", {}},
      {"since_of_nothing", "cradle", "since(rest)", "since(rst)", "E301", {}},
      {"attempts_alone", "cradle", "{max: 3, goto: failed}", "3", "E104", {}},
      {"light_that_is_no_signal", "button", "when: lit,", "when: lid,", "E301", {}},
      {"turn_of_a_tool",
       "button",
       "x: {force: $press, velocity: +-4 cm/s}",
       "x: {force: $press, velocity: +-4 cm}",
       "E202",
       {}},
      {"hand_over_of_nobody", "carry", "goto: carry}", "goto: cary}", "E301", {}},
      {"time_in_words", "carry", "elapsed > 5 s", "elapsed > 5", "E201", {}},
      {"corner_that_is_none", "patrol", "{corner: two, then", "{corner: too, then", "E301", {}},
      {"norm_that_drives", "patrol", "velocity: [0 m/s, $speed]", "velocity: $speed", "E415", {}},
      {"distance_in_degrees", "patrol", "nearest < 1.05 m", "nearest < 1.05 deg", "E202", {}},
      {"path_misspelt", "deliver", "        in: way\n", "        in: wy\n", "E301", {}},
      {"length_of_a_frame", "deliver", "length(way)", "length(lead)", "E301", {}},
      {"fillet_too_wide", "deliver", "fillet: 0.6 m", "fillet: 6 m", "E419", {}},
      {"fillet_missing", "deliver", ", fillet: 0.6 m", "", "E103", {}},
      {"tilt_of_a_path",
       "deliver",
       "        rz: {position: 0 deg, force",
       "        rx: {position: 0 deg, force",
       "E420",
       {}},
  };
}

/// In the files of pegs, handovers, switches and steered bases.
std::vector<Mistake> mistakes_by_touch() {
  return {
      {"tip_misspelt", "peg", "estimated.tool.z", "estimated.tol.z", "E301", {}},
      {"saturated_misspelt", "peg", "peg.y.saturated, for", "peg.y.saturatd, for", "E301", {}},
      {"pace_of_a_length",
       "peg",
       "{force: 6 N, velocity: +-3 cm/s}",
       "{force: 6 N, velocity: +-3 cm}",
       "E202",
       {}},
      {"task_misspelt", "peg", "goto: insert}", "goto: inserts}", "E301", {}},
      {"link_misspelt", "peg", "parent: shoulder_link", "parent: sholder_link", "E301", {}},
      {"note_with_a_comma", "peg", "note: no slot within 40 cm", "note: no slot, within 40 cm", "E107", {}},
      {"stop_of_a_gripper", "handover", "stop: keep", "stop: hold", "E105", {}},
      {"number_for_a_gripper", "handover", "{outputs.gripper: false}", "{outputs.gripper: 0}", "E105", {}},
      {"pull_without_unit", "handover", "estimated.tool.z > 8 N", "estimated.tool.z > 8", "E201", {}},
      {"spring_without_damping",
       "handover",
       "stiffness: 200 N/m, damping: 60 N s/m",
       "stiffness: 200 N/m",
       "E104",
       {}},
      {"way_in_newtons", "handover", "moved(tool) > 10 cm", "moved(tool) > 10 N", "E202", {}},
      {"type_of_a_switch", "bumper", "type: bool", "type: boolean", "E301", {}},
      {"half_an_attempt", "bumper", "attempts: {max: 3,", "attempts: {max: 3.5,", "E105", {}},
      {"turn_in_metres", "bumper", "turned(base) > 90 deg", "turned(base) > 90 m", "E202", {}},
      {"steering_misspelt",
       "approach_car",
       "look: {bearing: [steer, goal]}",
       "look: {bearing: [ster, goal]}",
       "E301",
       {}},
      {"bearing_misspelt", "approach_car", "{bearing: [", "{bering: [", "E101", {}},
      {"bearing_of_three", "approach_car", "{bearing: [steer, ", "{bearing: [steer, base, ", "E104", {}},
      {"lock_that_drives", "approach_car", "{position: +-$lock}", "{position: $lock}", "E406", {}},
      {"way_in_seconds", "approach_car", "way < 0.4 m", "way < 0.4 s", "E202", {}},
      {"frame_for_a_feature", "approach_swerve", "{args: {where: feature}", "{args: {where: frame}", "E303",
       "      fl: {use: look, with: {where: front_left}}"},
      {"argument_misspelt",
       "approach_swerve",
       "fl: {use: look, with: {where:",
       "fl: {use: look, with: {wher:",
       "E303",
       {}},
      {"closed_misspelt", "deliver", "fillet: 0.6 m", "fillet: 0.6 m, closd: true", "E101", {}},
      {"closed_in_words", "deliver", "fillet: 0.6 m", "fillet: 0.6 m, closed: round", "E105", {}},
  };
}

std::vector<Mistake> mistakes() {
  return {
      // --- misspelt words ---
      {"key_of_a_task", "wall_align", "    constraints:\n", "    constrains:\n", "E101", {}},
      {"section", "wall_align", "params:", "parms:", "E101", {}},
      {"section_of_templates", "hospital", "templates:", "template:", "E101", {}},
      {"section_of_signals", "docking", "signals:", "signal:", "E101", {}},
      {"section_of_regions", "hospital", "regions:", "region:", "E101", {}},
      {"section_of_features", "docking", "features:", "feature:", "E101", {}},
      {"constraints_of_always", "hospital", "always:\n  constraints:", "always:\n  constraint:", "E101",
       "  constraint:"},
      {"body_of_a_template", "hospital", "    body:", "    bdy:", "E101", {}},
      {"quantity", "wall_align", "velocity: [-0.05", "velcity: [-0.05", "E101", {}},
      {"parameter", "wall_align", "force: $push", "force: $psuh", "E301", {}},
      {"measured_quantity", "wall_align", "contact.x.velocity", "contact.x.velocty", "E301", {}},
      {"target", "wall_align", "goto: hold", "goto: holt", "E301", {}},
      {"frame", "wall_align", "move: base", "move: bsae", "E301", {}},
      {"set", "obstacle", "frames.touch: base", "frame.touch: base", "E105", {}},
      {"capital", "obstacle", "goto: yield", "goto: Yield", "E301", {}},
      {"type_of_signal", "docking", "type: bool", "type: boolean", "E301", {}},
      {"parent", "docking", "{parent: partner}", "{parent: partnr}", "E301", {}},
      {"axis_of_a_group", "docking", "glide.x.saturated", "glide.z.saturated", "E301", {}},
      {"region", "hospital", "inside: corridor", "inside: coridor", "E301", {}},
      {"argument_that_is_a_frame", "hospital", "target: pharmacy", "target: pharmcy", "E301", {}},
      {"argument_that_is_a_task", "hospital", "then: load}", "then: laod}", "E301", {}},
      {"name_of_an_argument", "hospital", "pace: 0.25 m/s", "pce: 0.25 m/s", "E303", {}},
      {"template_of_a_task",
       "hospital",
       "to_door:      {use: drive_to",
       "to_door:      {use: driveto",
       "E301",
       {}},
      {"timeout_key",
       "docking",
       "timeout: {after: 4 s, goto: align",
       "tmeout: {after: 4 s, goto: align",
       "E101",
       {}},
      {"for_key", "obstacle", "for: 20 ms", "fr: 20 ms", "E101", {}},
      {"inside_key", "hospital", "inside: corridor", "iside: corridor", "E101", {}},
      {"unit_key", "hospital", "unit: m", "uit: m", "E101", {}},
      {"use_key", "hospital", "through_door: {use:", "through_door: {ue:", "E101", {}},
      {"key_in_the_body_of_a_template",
       "hospital",
       "      exits:\n        # The heading",
       "      eits:\n        # The heading",
       "E101",
       {}},
      {"tasks_key", "docking", "tasks:\n", "tsks:\n", "E101", {}},
      {"exits_of_always",
       "hospital",
       "  exits:\n    - {when: stop",
       "  eits:\n    - {when: stop",
       "E101",
       {}},
      {"target_of_an_interruption",
       "hospital",
       "for: 0.1 s, goto: pause",
       "for: 0.1 s, goto: puse",
       "E301",
       {}},
      {"with_key",
       "hospital",
       "{use: drive_to, with: {target: door",
       "{use: drive_to, wth: {target: door",
       "E101",
       {}},
      {"kind_of_an_argument", "hospital", "pace: velocity", "pace: vlocity", "E301", {}},
      {"declared_task", "docking", "  align:\n", "  algn:\n", "E301", "start: align"},
      {"declared_group", "docking", "      line:\n", "      lne:\n", "E301", "      - when: abs(line"},
      {"declared_parameter", "docking", "seat_force:     {", "set_force:      {", "E301",
       "x:  {velocity: $approach"},
      {"declared_argument", "hospital", "args: {target: frame", "args: {trget: frame", "E303",
       "  to_pharmacy:"},
      // --- units ---
      {"acceleration_for_velocity", "wall_align", "0.08 m/s]", "0.08 m/s^2]", "E202", {}},
      {"parameter_without_unit", "wall_align", "value: 20 N", "value: 20", "E201", {}},
      {"parameter_without_unit_or_range",
       "wall_align",
       "{value: 20 N, range: [5 N, 40 N],",
       "{value: 20,",
       "E201",
       {}},
      {"parameter_and_range_of_two_kinds", "hospital", "{value: 60 N", "{value: 60 kg", "E202", {}},
      {"time_without_unit", "wall_align", "for: 0.2 s", "for: 0.2", "E201", {}},
      {"unit_without_slash", "wall_align", "5 mm/s", "5 mms", "E203", {}},
      {"argument_without_unit", "hospital", "pace: 0.25 m/s", "pace: 0.25", "E303", {}},
      {"argument_of_another_kind",
       "hospital",
       "pace: $speed, then: load",
       "pace: $soft, then: load",
       "E303",
       {}},
      {"newton_metre_in_one", "hospital", "force: +-20 N m", "force: +-20 Nm", "E203", {}},
      {"degrees_for_metres",
       "docking",
       "abs(line.y.position) < 8 mm",
       "abs(line.y.position) < 1 deg",
       "E202",
       {}},
      // --- YAML ---
      {"yes_for_free", "wall_align", "rz: free", "rz: yes", "E104", {}},
      {"on_for_an_axis", "wall_align", "y:  {velocity", "on: {velocity", "E101", {}},
      {"dash_for_comma", "wall_align", "[5 N, 40 N]", "[5 N - 40 N]", "E104", {}},
      {"comma_in_a_condition", "docking", "when: not latch or", "when: not latch,", "E107", {}},
      {"tab", "wall_align", "        move: base", "\tmove: base", "E100", {}},
      {"key_twice", "wall_align", "rz: free", "y: free", "E102", {}},
      {"shared_by_anchor", "docking", "stale_after: 300 ms", "stale_after: &age 300 ms", "E106", {}},
      // --- shapes and levels ---
      {"timeout_that_leads_nowhere", "wall_align", "{after: $timeout, goto: failed}", "20 s", "E104", {}},
      {"axes_of_nobody", "wall_align", "        in: base\n", "", "E103", "move: base"},
      {"level_ten", "hospital", "      margin: 10 cm", "      margin: 10 cm\n      level: 10", "E105",
       "level: 10"},
      {"limit_as_a_value", "hospital", "velocity: [0 m/s, $speed]", "velocity: $speed", "E415", {}},
      {"number_in_words", "obstacle", "max: 3", "max: three", "E105", {}},
      {"equals", "obstacle", "elapsed > 3 s", "elapsed = 3 s", "E105", {}},
      {"ampersand", "obstacle", "go.x.saturated and moved", "go.x.saturated && moved", "E105", {}},
      // --- meaning ---
      {"swapped_range", "wall_align", "[-0.05 m/s, 0.08 m/s]", "[0.08 m/s, -0.05 m/s]", "E403", {}},
      {"swapped_range_of_a_parameter", "hospital", "[0.2 m/s, 0.8 m/s]", "[0.8 m/s, 0.2 m/s]", "E403", {}},
      {"two_drivers", "docking", "velocity: [-0.05 m/s, 0.05 m/s]", "velocity: 0.05 m/s", "E401", {}},
      {"swapped_frames", "docking", "in: standoff", "in: hook", "E405", "velocity: +-0.25 m/s"},
      {"dead_guard", "docking", "reach < 3 cm, for: 0.2 s", "reach < -3 cm, for: 0.2 s", "E505", {}},
      {"release_on_the_wrong_side", "hospital", "release: 1.6 m", "release: 0.6 m", "E506", {}},
      {"back_from_a_task_of_its_own",
       "hospital",
       "for: 1 s, goto: to_door",
       "for: 1 s, goto: back",
       "E508",
       {}},
      {"no_age", "docking", ", stale_after: 300 ms", "", "E504", {}},
      {"no_for", "obstacle", ", for: 20 ms", "", "W501", {}},
      {"no_timeout", "obstacle", "    timeout: {after: 8 s, goto: failed}\n", "", "W503", "  yield:"},
      {"value_outside_its_range", "docking", "{value: 20 N", "{value: 30 N", "E204", {}},
  };
}

std::string text_of(const std::string& file) {
  const auto shipped = test::source_dir / "specs" / (file + ".yaml");
  return test::slurp(
      std::filesystem::exists(shipped) ? shipped : test::source_dir / "../shared/cases" / (file + ".yaml"));
}

Diagnostics told_of(const std::string& text) {
  const test::Folder folder;
  for (const char* file : {"robots/mecanum_base.yaml",
                           "robots/mecanum_base.urdf",
                           "robots/mecanum_arm_base.yaml",
                           "robots/mecanum_arm_base.urdf",
                           "scenes/corridor.yaml",
                           "scenes/dock.yaml",
                           "scenes/obstacle.yaml",
                           "scenes/wall.yaml",
                           "scenes/drawer.yaml",
                           "scenes/cart.yaml",
                           "scenes/cradle.yaml",
                           "scenes/button.yaml",
                           "scenes/box_between.yaml",
                           "partners/carry.yaml",
                           "scenes/square.yaml",
                           "scenes/leading_hand.yaml",
                           "scenes/wall_beside.yaml",
                           "scenes/gate.yaml",
                           "scenes/cart_on_the_way.yaml",
                           "robots/turtlebot3_burger.yaml",
                           "robots/turtlebot3_burger.urdf",
                           "robots/car_base.yaml",
                           "robots/car_base.urdf",
                           "robots/swerve_base.yaml",
                           "robots/swerve_base.urdf",
                           "scenes/peg.yaml",
                           "scenes/handover.yaml",
                           "scenes/bumper.yaml",
                           "scenes/open.yaml"}) {
    folder.write(file, test::slurp(test::source_dir / "specs" / file));
  }
  Diagnostics diagnostics;
  load(folder.write("task.yaml", text), {}, diagnostics);
  return diagnostics;
}

int line_of(const std::string& text, std::size_t at) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.file << ": " << mistake.name;
}

class MistakeOf : public testing::TestWithParam<Mistake> {};

TEST_P(MistakeOf, is_found_in_its_place_and_told_once) {
  const Mistake& mistake = GetParam();
  const std::string good = text_of(mistake.file);
  if (good.empty()) GTEST_SKIP() << "the draft " << mistake.file << " is not here";
  ASSERT_TRUE(told_of(good).all().empty()) << test::rendered(told_of(good));
  const std::size_t at = good.find(mistake.from);
  ASSERT_NE(at, std::string::npos) << mistake.from;
  const std::string bad = test::replaced(good, mistake.from, mistake.to);
  const Diagnostics diagnostics = told_of(bad);
  ASSERT_EQ(diagnostics.all().size(), 1u) << test::rendered(diagnostics);
  const Diagnostic& said = diagnostics.all()[0];
  EXPECT_EQ(said.code, mistake.code) << test::rendered(diagnostics);
  // It names the fix: what to write, what is near, or (of a dimension or a range) what belongs there.
  const bool is_told_what_belongs = said.message.find(" but ") != std::string::npos ||
                                    said.message.find(" from ") != std::string::npos ||
                                    said.message.find(" within ") != std::string::npos ||
                                    said.message.find(" must ") != std::string::npos ||
                                    said.message.find(" compared with ") != std::string::npos;
  EXPECT_TRUE(!said.help.empty() || is_told_what_belongs) << test::rendered(diagnostics);
  const std::size_t told = mistake.told_at.empty() ? at : bad.find(mistake.told_at);
  ASSERT_NE(told, std::string::npos) << mistake.told_at;
  EXPECT_EQ(said.span.begin.line, line_of(bad, told)) << test::rendered(diagnostics);
}

INSTANTIATE_TEST_SUITE_P(An, MistakeOf, testing::ValuesIn(mistakes()),
                         [](const auto& mistake) { return mistake.param.name; });
INSTANTIATE_TEST_SUITE_P(ByTouch, MistakeOf, testing::ValuesIn(mistakes_by_touch()),
                         [](const auto& mistake) { return mistake.param.name; });
INSTANTIATE_TEST_SUITE_P(InForces, MistakeOf, testing::ValuesIn(mistakes_in_forces()),
                         [](const auto& mistake) { return mistake.param.name; });

}  // namespace
}  // namespace zwang::lang
