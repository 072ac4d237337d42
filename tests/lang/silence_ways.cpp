// Faults of ways that end before the exit: along paths, to places, at an arm's speed, by a count.
#include <numbers>

#include "silence_draw.hpp"

namespace zwang::lang::silence {

namespace {

/// 2 m, a fillet of 0.5 m, 2 m: 4 m - 2 x 0.5 m + 0.5 m pi/2 long.
const std::string path = "paths: {way: {through: [[0 m, 0 m], [2 m, 0 m], [2 m, 2 m]], fillet: 0.5 m}}\n";
constexpr double path_length = 3.0 + 0.25 * std::numbers::pi;  // [m]

std::string along_path(const std::string& x) {
  return "constraints: {go: {move: base_link, in: way, x: {" + x +
         "}, y: {position: 0 m}, rz: {position: 0 deg}}}";
}

const std::string at_the_end = exit_when("go.x.position > length(way)", "done");

/// A tenth and 2 cm are left for overshoot.
std::string path_ends_short(Dice& d, bool fault) {
  const double target = path_length * (fault ? d.number(0.3, 0.85) : d.number(1.02, 1.3));
  return file(task("a", along_path("position: " + q(target, "m") + ", velocity: +-0.3 m/s"), at_the_end,
                   "{after: 40 s, goto: failed}"),
              path);
}

std::string path_backwards(Dice& d, bool fault) {
  const double v = d.number(0.1, 0.3) * (fault ? -1.0 : 1.0);
  return file(task("a", along_path("velocity: " + q(v, "m/s")), at_the_end, "{after: 60 s, goto: failed}"),
              path);
}

/// A driver of v leaves a fifth for overshoot.
std::string path_too_long(Dice& d, bool fault) {
  const double v = d.number(0.1, 0.3);
  const double until = path_length / v * (fault ? d.number(0.3, 0.75) : d.number(1.5, 2.0));
  return file(task("a", along_path("velocity: " + q(v, "m/s")), at_the_end,
                   "{after: " + q(until, "s") + ", goto: failed}"),
              path);
}

std::string starts_beside_a_path(Dice& d, bool fault) {
  const double most = d.number(0.05, 0.2), beside = most * (fault ? d.number(1.5, 5.0) : d.number(0.1, 0.9));
  const std::string line =
      "paths: {way: {through: [[0 m, " + q(beside, "m") + "], [2 m, " + q(beside, "m") + "]]}}\n";
  return file(task("a",
                   "constraints: {go: {move: base_link, in: way, x: {velocity: 0.2 m/s}, y: {position: " +
                       range(-most, most, "m") + "}, rz: {position: 0 deg}}}",
                   exit_when("go.x.position > length(way)", "done"), "{after: 60 s, goto: failed}"),
              line);
}

/// Of a way to a place a quarter and 5 cm are left: what shakes the base adds up.
std::string farther_than_the_place(Dice& d, bool fault) {
  const double way = d.number(0.5, 2.0), asked = way * (fault ? d.number(1.5, 3.0) : d.number(0.3, 0.95));
  return file(task("a",
                   "constraints: {go: {move: base_link, in: world, x: {position: " + q(way, "m") +
                       ", velocity: +-0.3 m/s}, y: {position: 0 m}, rz: {position: 0 deg}}}",
                   exit_when("moved(base_link) > " + q(asked, "m"), "done"), fails));
}

std::string farther_than_the_turn(Dice& d, bool fault) {
  const double turn = d.number(30.0, 120.0),
               asked = turn * (fault ? d.number(1.5, 3.0) : d.number(0.3, 0.95));
  return file(
      task("a",
           "constraints: {go: {move: base_link, in: world, x: {position: 0 m}, y: {position: 0 m}, rz: "
           "{position: " +
               q(turn, "deg") + ", velocity: +-0.5 rad/s}}}",
           exit_when("turned(base_link) > " + q(asked, "deg"), "done"), fails));
}

/// The base's origin stays 0.28 m inside of the region.
std::string goal_beyond_a_region(Dice& d, bool fault) {
  const double end = d.number(1.0, 2.0), goal = end + (fault ? d.number(0.0, 1.0) : -d.number(0.45, 0.8));
  const std::string body = drive("velocity: 0.2 m/s");
  return file(
      task("a", body.substr(0, body.size() - 1) + ", fence: {move: footprint, inside: r}}",
           exit_when("gap < " + q(0.2, "m"), "done"), fails),
      "frames: {goal: {parent: world, at: [" + q(goal, "m") +
          ", 0 m]}}\nfeatures: {gap: {distance: [base_link, goal]}}\nregions: {r: {polygon: [[-2 m, -2 "
          "m], [" +
          q(end, "m") + ", -2 m], [" + q(end, "m") + ", 2 m], [-2 m, 2 m]]}}\n");
}

std::string more_entries_than_attempts(Dice& d, bool fault) {
  const int most = d.whole(2, 4), asked = fault ? most + d.whole(0, 2) : most - 1;
  const std::string attempts = "attempts: {max: " + std::to_string(most) + ", goto: failed}\n    ";
  return file(task("a", attempts + drive("velocity: 0.05 m/s"),
                   exit_when("entries(a) > " + std::to_string(asked), "done"), "{after: 2 s, goto: b}") +
              task("b", drive("velocity: -0.05 m/s"), "", "{after: 2 s, goto: a}"));
}

/// Axes of the world and of the base, at the heading that the task keeps.
std::string ranges_at_one_heading(Dice& d, bool fault) {
  const double edge = d.number(0.05, 0.2), gap = d.number(0.01, 0.1) * (fault ? 1.0 : -1.0);
  return file(task("a",
                   "constraints: {one: {move: base_link, in: world, x: {velocity: " +
                       range(edge + gap, edge + 0.3, "m/s") +
                       "}, rz: {position: here}}, two: {move: base_link, in: base_link, x: {velocity: " +
                       range(-0.2, edge, "m/s") + "}}}",
                   "", "{after: 5 s, goto: done}"));
}

/// Seven joints of 0.873 rad/s, of which none is farther than 1.5 m from the tool.
std::string faster_than_the_joints(Dice& d, bool fault) {
  const double v = fault ? d.number(9.2, 12.0) : d.number(0.02, 0.1);
  return file(
      task("a",
           "constraints: {reach: {move: tool, in: base_link, z: {velocity: " + q(v, "m/s") +
               ", time_constant: 20 s}}, stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: "
               "{velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}",
           "", "{after: 1 s, goto: done}"),
      "", "mecanum_arm_base");
}

/// The motors make 101 N.
std::string yield_beyond_the_motors(Dice& d, bool fault) {
  const bool by_band = d.whole(0, 1) == 0;
  const double band = fault && by_band ? d.number(110.0, 200.0) : d.number(2.0, 8.0);
  const double most = by_band ? band * 1.1 : fault ? d.number(210.0, 900.0) : d.number(20.0, 190.0);
  return file(
      task("a",
           "constraints: {led: {move: base_link, in: base_link, x: {yield: estimated.force.x, mass: 60 "
           "kg, damping: 80 N s/m, dead_band: " +
               q(band, "N") + ", force: " + range(-most, most, "N") +
               "}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}",
           "", "{after: 20 s, goto: done}"));
}

/// A driver of velocity leaves a tenth for overshoot.
std::string faster_on_entry(Dice& d, bool fault) {
  const double v = d.number(0.05, 0.2), asked = v * (fault ? d.number(1.2, 3.0) : d.number(0.3, 0.9));
  return file(task("a", drive("velocity: " + q(v, "m/s")), "", "{after: 3 s, goto: b}") +
              task("b",
                   "enter: {require: speed(base_link) > " + q(asked, "m/s") + "}\n    " +
                       drive("velocity: " + q(v, "m/s")),
                   "", "{after: 5 s, goto: done}"));
}

/// Four wheels of 75.9 mm with 0.1 N m each, of which their motors leave a tenth: 0.527 N.
std::string weaker_than_friction(Dice& d, bool fault) {
  const double force = fault ? d.number(0.05, 0.5) : d.number(1.0, 20.0);
  return file(
      task("a", drive("force: " + q(force, "N") + ", velocity: +-0.1 m/s"), "", "{after: 5 s, goto: done}"),
      "", "mecanum_rough");
}

/// The bumper stands 0.15 m above the floor.
std::string nearer_than_the_height(Dice& d, bool fault) {
  const double asked = fault ? d.number(0.02, 0.14) : d.number(0.17, 0.5);
  return file(
      task("a", drive("velocity: 0.1 m/s"), exit_when("gap < " + q(asked, "m"), "done"), fails),
      "frames: {goal: {parent: world, at: [1 m, 0 m]}}\nfeatures: {gap: {distance: [bumper, goal]}}\n");
}

}  // namespace

std::vector<Kind> kinds_of_ways() {
  return {
      {"path_ends_short", {"W511"}, path_ends_short},
      {"path_backwards", {"W511"}, path_backwards},
      {"path_too_long", {"W511"}, path_too_long},
      {"starts_beside_a_path", {"W914"}, starts_beside_a_path},
      {"farther_than_the_place", {"W511"}, farther_than_the_place},
      {"farther_than_the_turn", {"W511"}, farther_than_the_turn},
      {"goal_beyond_a_region", {"W511"}, goal_beyond_a_region},
      {"more_entries_than_attempts", {"W511"}, more_entries_than_attempts},
      {"ranges_at_one_heading", {"W416"}, ranges_at_one_heading},
      {"faster_on_entry", {"W511"}, faster_on_entry},
      {"weaker_than_friction", {"W649"}, weaker_than_friction},
      {"nearer_than_the_height", {"W511"}, nearer_than_the_height},
      {"faster_than_the_joints", {"W611"}, faster_than_the_joints},
      {"yield_beyond_the_motors", {"W647", "W619"}, yield_beyond_the_motors},
  };
}

}  // namespace zwang::lang::silence
