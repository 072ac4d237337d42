// Faults of drivers that something else in the file holds back, or takes the motion from.
#include "silence_draw.hpp"

namespace zwang::lang::silence {

namespace {

const std::string held = ", y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}";

std::string in_world(const std::string& x) {
  return "constraints: {go: {move: base_link, in: world, x: {" + x + "}" + held + "}}";
}

/// From the start at 0 a range of velocities leads to one side only; the target lies on the other one.
std::string led_away(Dice& d, bool fault) {
  const double way = d.number(0.3, 2.0) * (d.whole(0, 1) == 0 ? 1.0 : -1.0), most = d.number(0.1, 0.4);
  const bool to_the_right = (way > 0.0) != fault;
  return file(task("a",
                   in_world("time_constant: 2 s, position: " + q(way, "m") + ", velocity: " +
                            range(to_the_right ? 0.0 : -most, to_the_right ? most : 0.0, "m/s")),
                   "", "{after: 5 s, goto: done}"));
}

/// The same by a range on the base's own axis, as its heading is kept.
std::string led_away_by_the_base(Dice& d, bool fault) {
  const double way = d.number(0.3, 2.0), most = d.number(0.1, 0.4);
  const std::string body = in_world("time_constant: 2 s, position: " + q(way, "m"));
  return file(task("a",
                   body.substr(0, body.size() - 1) +
                       ", calm: {move: base_link, in: base_link, x: {velocity: " +
                       range(fault ? -most : 0.0, fault ? 0.0 : most, "m/s") + "}}}",
                   "", "{after: 5 s, goto: done}"));
}

/// A base that arrives is to stand.
std::string never_stands(Dice& d, bool fault) {
  const double least = d.number(0.02, 0.1) * (fault ? 1.0 : -1.0);
  return file(task("a", in_world("time_constant: 2 s, position: 1 m, velocity: " + range(least, 0.3, "m/s")),
                   "", "{after: 5 s, goto: done}"));
}

/// The base stays 0.28 m, half its breadth, away from the region's end however it is turned.
std::string target_beyond_a_region(Dice& d, bool fault) {
  const double end = d.number(1.0, 2.0),
               target = fault ? end + d.number(-0.25, 0.5) : end - d.number(0.45, 0.8);
  const std::string corners =
      "[[-2 m, -2 m], [" + q(end, "m") + ", -2 m], [" + q(end, "m") + ", 2 m], [-2 m, 2 m]]";
  const std::string body = in_world("position: " + q(target, "m") + ", velocity: +-0.2 m/s");
  return file(task("a", body.substr(0, body.size() - 1) + ", fence: {move: footprint, inside: r}}", "",
                   "{after: 5 s, goto: done}"),
              "regions: {r: {polygon: " + corners + "}}\n");
}

/// A row of a level above takes the motion whole; one that stands still takes what is left.
std::string taken_above(Dice& d, bool fault) {
  const double above = d.number(0.05, 0.2), below = fault ? above * d.number(1.1, 2.0) : 0.0;
  const std::string body = drive("velocity: " + q(above, "m/s"));
  return file(task("a",
                   body.substr(0, body.size() - 1) +
                       ", more: {move: bumper, in: base_link, level: 3, x: {velocity: " + q(below, "m/s") +
                       "}}}",
                   "", "{after: 5 s, goto: done}"));
}

/// Times and ways count from the entry on.
std::string required_on_entry(Dice& d, bool fault) {
  const std::string most = d.whole(0, 1) == 0 ? "elapsed > " + q(d.number(0.1, 2.0), "s")
                                              : "moved(base_link) > " + q(d.number(0.01, 0.3), "m");
  const std::string asked = fault ? most : "speed(base_link) < " + q(d.number(0.2, 0.4), "m/s");
  return file(task("a", drive("velocity: 0.05 m/s"), "", "{after: 1 s, goto: b}") +
              task("b", "enter: {require: " + asked + "}\n    " + drive("velocity: 0.05 m/s"), "",
                   "{after: 5 s, goto: done}"));
}

std::string push_without_speed(Dice& d, bool fault) {
  const std::string most = fault ? "[0 m/s, 0 m/s]" : range(0.0, d.number(0.05, 0.3), "m/s");
  const std::string calm =
      "always: {constraints: {calm: {move: base_link, in: base_link, speed: {velocity: " + most + "}}}}\n";
  return file(task("a", drive("force: " + q(d.number(5.0, 40.0), "N")), "", "{after: 5 s, goto: done}"),
              calm);
}

/// Drivers of velocity leave a tenth for overshoot.
std::string faster_than_its_driver(Dice& d, bool fault) {
  const double v = d.number(0.05, 0.2), asked = v * (fault ? d.number(1.15, 3.0) : d.number(0.3, 0.9));
  const std::string what = d.whole(0, 1) == 0 ? "speed(base_link)" : "go.x.velocity";
  return file(
      task("a", drive("velocity: " + q(v, "m/s")), exit_when(what + " > " + q(asked, "m/s"), "done"), fails));
}

/// Behind where it starts a driver of velocity comes no more.
std::string behind_its_start(Dice& d, bool fault) {
  const double v = d.number(0.05, 0.2), way = d.number(0.2, 0.8), sign = fault ? -1.0 : 1.0;
  return file(task(
      "a", in_world("velocity: " + q(v, "m/s")),
      exit_when("go.x.position " + std::string(fault ? "< " : "> ") + q(sign * way, "m"), "done"), fails));
}

/// Forty tasks in a row: each may be entered with the speed of any other.
std::string many_tasks(Dice& d, bool fault) {
  const double v = d.number(0.05, 0.2), asked = v * (fault ? d.number(1.2, 2.0) : d.number(0.3, 0.9));
  constexpr int count = 40;
  std::string tasks;
  for (int i = 0; i < count; ++i) {
    const std::string name = i == 0 ? "a" : "a" + std::to_string(i);
    const std::string next = i + 1 == count ? "done" : "a" + std::to_string(i + 1);
    const bool is_last = i + 1 == count;
    tasks += task(name, drive("velocity: " + q(v, "m/s")),
                  is_last ? exit_when("speed(base_link) > " + q(asked, "m/s"), "done") : "",
                  "{after: 1 s, goto: " + next + "}");
  }
  return file(tasks);
}

/// v (for + stale_after + blend / 2) + v^2 / 2a + a T^2 / 2, or v T, and 0.40 m of footprint.
std::string late_guard_on_a_place(Dice& d, bool fault) {
  const double v = d.number(0.2, 0.8), a = d.number(0.3, 1.0), T = 0.5;
  const double delay = 0.1 + 0.2 + 0.1;
  const double way = v * delay + (v < a * T ? v * T : v * v / (2.0 * a) + a * T * T / 2.0);
  const double asked = 0.4 + way * (fault ? d.number(0.3, 0.95) : d.number(1.05, 1.5));
  const std::string limit = ", acceleration: " + range(-a, a, "m/s^2");
  const std::string head =
      "signals: {seen: {type: pose, in: base_link, stale_after: 200 ms}}\nframes: {person: {parent: seen}}\n";
  const std::string measured = "near: {move: base_link, in: person, x: free}";
  const auto with = [&](std::string body) { return body.substr(0, body.size() - 1) + ", " + measured + "}"; };
  const std::string near =
      d.whole(0, 1) == 0 ? "abs(near.x.position) < " + q(asked, "m") : "near.x.position > " + q(-asked, "m");
  return file(task("a", with(drive("velocity: " + q(v, "m/s") + limit)), exit_when(near, "b"), fails) +
                  task("b", with(drive("velocity: 0 m/s" + limit)),
                       exit_when("abs(near.x.position) > " + q(asked + 0.5, "m"), "a", 1.0), fails),
              head);
}

/// 0.1 m/s of a driver for so long, on the way to a point that is 4 m away.
std::string too_far_in_time(Dice& d, bool fault) {
  const double v = d.number(0.05, 0.2), until = d.number(3.0, 10.0);
  const double left = 4.0 - v * until * (fault ? d.number(1.2, 2.0) : d.number(0.3, 0.9));
  return file(
      task("a", drive("velocity: " + q(v, "m/s")), exit_when("gap < " + q(left, "m"), "done"),
           "{after: " + q(until, "s") + ", goto: failed}"),
      "frames: {goal: {parent: world, at: [4 m, 0 m]}}\nfeatures: {gap: {distance: [base_link, goal]}}\n");
}

std::string way_beyond_a_region_by_force(Dice& d, bool fault) {
  const double asked = fault ? d.number(3.5, 6.0) : d.number(0.1, 0.5);
  const std::string body = drive("force: 20 N, velocity: +-0.2 m/s");
  return file(task("a", body.substr(0, body.size() - 1) + ", fence: {move: footprint, inside: r}}",
                   exit_when("moved(base_link) > " + q(asked, "m"), "done"), fails),
              "regions: {r: {polygon: [[-1 m, -1 m], [1 m, -1 m], [1 m, 1 m], [-1 m, 1 m]]}}\n");
}

std::string push_against_each_other(Dice& d, bool fault) {
  const double one = d.number(5.0, 20.0), other = d.number(5.0, 20.0) * (fault ? -1.0 : 1.0);
  const std::string body = drive("force: " + q(one, "N") + ", velocity: +-0.1 m/s");
  return file(task("a",
                   body.substr(0, body.size() - 1) +
                       ", more: {move: bumper, in: base_link, x: {force: " + q(other, "N") + "}}}",
                   "", "{after: 5 s, goto: done}"));
}

/// The car steers by 24 deg to either side.
std::string beyond_the_travel(Dice& d, bool fault) {
  const double angle =
      (fault ? d.number(26.0, 170.0) : d.number(1.0, 22.0)) * (d.whole(0, 1) == 0 ? 1.0 : -1.0);
  return file(task("a",
                   "constraints: {steer: {move: front_axle, in: base_link, rz: {position: " +
                       q(angle, "deg") + "}}, stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}}}",
                   "", "{after: 5 s, goto: done}"),
              "", "car_base");
}

/// From its first joint, 0.25 m above the floor and 0.15 m ahead, the arm reaches no farther than 1.5 m.
std::string beyond_the_reach(Dice& d, bool fault) {
  const bool is_height = d.whole(0, 1) == 0;
  const std::string in = is_height ? "in: world, z" : "in: base_link, x";
  const double place = fault ? d.number(1.8, 5.0) : is_height ? d.number(0.5, 0.8) : d.number(0.4, 0.7);
  return file(
      task("a",
           "constraints: {reach: {move: tool, " + in + ": {position: " + q(place, "m") +
               ", velocity: +-0.1 m/s}}, stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, "
               "y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}",
           "", "{after: 5 s, goto: done}"),
      "", "mecanum_arm_base");
}

}  // namespace

std::vector<Kind> kinds_of_drivers() {
  return {
      {"led_away", {"W610"}, led_away},
      {"led_away_by_the_base", {"W610"}, led_away_by_the_base},
      {"never_stands", {"W416"}, never_stands},
      {"target_beyond_a_region", {"W416"}, target_beyond_a_region},
      {"taken_above", {"W407"}, taken_above},
      {"required_on_entry", {"W511"}, required_on_entry},
      {"push_without_speed", {"W610"}, push_without_speed},
      {"faster_than_its_driver", {"W511"}, faster_than_its_driver},
      {"behind_its_start", {"W511"}, behind_its_start},
      {"many_tasks", {"W511"}, many_tasks},
      {"late_guard_on_a_place", {"W620"}, late_guard_on_a_place},
      {"too_far_in_time", {"W511"}, too_far_in_time},
      {"way_beyond_a_region_by_force", {"W511"}, way_beyond_a_region_by_force},
      {"push_against_each_other", {"W416"}, push_against_each_other},
      {"beyond_the_travel", {"W416"}, beyond_the_travel},
      {"beyond_the_reach", {"W416"}, beyond_the_reach},
  };
}

}  // namespace zwang::lang::silence
