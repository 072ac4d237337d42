// Faults of regions, places, times and people.
#include <cmath>

#include "silence_draw.hpp"

namespace zwang::lang::silence {

namespace {

/// A region from -2 m to `end` along x, and 2 m to both sides.
std::string region(const std::string& name, double begin, double end) {
  return name + ": {polygon: [[" + q(begin, "m") + ", -2 m], [" + q(end, "m") + ", -2 m], [" + q(end, "m") +
         ", 2 m], [" + q(begin, "m") + ", 2 m]]}";
}

const std::string fenced = "fence: {move: footprint, inside: r}";

/// The base stays 0.28 m, half its breadth, away from the region's end however it is turned.
std::string exit_beyond_a_region(Dice& d, bool fault) {
  const double end = d.number(1.0, 2.0),
               asked = fault ? end + d.number(-0.25, 0.5) : end - d.number(0.45, 0.8);
  return file(task("a",
                   "constraints: {go: {move: base_link, in: world, x: {velocity: 0.2 m/s}, y: {velocity: 0 "
                   "m/s}, rz: {velocity: 0 rad/s}}, " +
                       fenced + "}",
                   exit_when("go.x.position > " + q(asked, "m"), "done"), fails),
              "regions: {" + region("r", -2.0, end) + "}\n");
}

/// A way longer than the region, whichever way round.
std::string way_beyond_a_region(Dice& d, bool fault) {
  const double end = d.number(0.5, 2.0), reach = std::hypot(0.4, 0.28);
  const double asked = fault ? end + 2.0 + reach + d.number(0.05, 1.0) : (end - 0.45) * d.number(0.2, 1.0);
  const std::string body = drive("velocity: 0.3 m/s");
  return file(task("a", body.substr(0, body.size() - 1) + ", " + fenced + "}",
                   exit_when("moved(base_link) > " + q(asked, "m"), "done"), fails),
              "regions: {" + region("r", -2.0, end) + "}\n");
}

std::string range_beside_a_region(Dice& d, bool fault) {
  const double end = d.number(0.6, 1.5), begin = fault ? end + d.number(-0.25, 0.5) : -d.number(0.1, 0.5);
  return file(task("a",
                   "constraints: {go: {move: base_link, in: world, x: {position: " +
                       range(begin, begin + 1.0, "m") + "}}, " + fenced + "}",
                   "", "{after: 5 s, goto: done}"),
              "regions: {" + region("r", -2.0, end) + "}\n");
}

std::string two_regions(Dice& d, bool fault) {
  const double end = d.number(0.6, 1.5), begin = fault ? end + d.number(-0.5, 0.5) : -d.number(0.6, 1.0);
  return file(task("a", "constraints: {other: {move: footprint, inside: q}, " + fenced + "}", "",
                   "{after: 5 s, goto: done}"),
              "regions: {" + region("r", -2.0, end) + ", " + region("q", begin, begin + 4.0) + "}\n");
}

/// The bumper stands 0.40 m ahead of the base's origin.
std::string two_points(Dice& d, bool fault) {
  const double most = d.number(0.05, 0.1), gap = 0.4 * (fault ? d.number(1.05, 2.0) : d.number(0.2, 0.7));
  return file(task("a",
                   "constraints: {one: {move: base_link, in: world, x: {position: " + range(-1.0, most, "m") +
                       "}}, two: {move: bumper, in: world, x: {position: " +
                       range(most + gap, most + gap + 0.5, "m") + "}}}",
                   "", "{after: 5 s, goto: done}"));
}

std::string time_in_a_task(Dice& d, bool fault) {
  const double until = d.number(3.0, 15.0), part = fault ? d.number(1.05, 3.0) : d.number(0.2, 0.9);
  const std::string timeout = "{after: " + q(until, "s") + ", goto: failed}";
  if (d.whole(0, 1) == 0)
    return file(task("a", drive("velocity: 0.1 m/s"),
                     exit_when("since(a) > " + q(until * part, "s") + " and moved(base_link) > 1 cm", "done"),
                     timeout));
  // The robot file's limit of 1.5 rad/s.
  const double turn = 1.5 * 0.8 * part;
  return file(task("a",
                   "constraints: {go: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 "
                   "m/s}, rz: {velocity: 1.2 rad/s}}}",
                   exit_when("turned(base_link) > " + q(turn, "rad") + " and elapsed < 0.8 s", "done", 0.05),
                   timeout));
}

std::string way_back(Dice& d, bool fault) {
  const std::string again = fault ? "failed" : "a";
  const std::string pause = "{after: " + q(d.number(2.0, 5.0), "s") + ", goto: ";
  return file(task("a", drive("velocity: 0.1 m/s"), exit_when("moved(base_link) > 5 cm", "b"), fails) +
              task("b", drive("velocity: 0 m/s"), exit_when("entries(a) > 1 and elapsed > 1 s", "done"),
                   pause + again + "}"));
}

/// The motors make 1.78 m/s^2.
std::string beyond_the_motors(Dice& d, bool fault) {
  const double least = 1.78 * (fault ? d.number(1.05, 2.0) : d.number(0.05, 0.4));
  return file(task("a",
                   "constraints: {go: {move: base_link, in: base_link, x: {acceleration: " +
                       range(least, least + 0.2, "m/s^2") + ", velocity: +-0.2 m/s}}}",
                   "", "{after: 5 s, goto: done}"));
}

/// As `late_guard`, at `done` with the robot's own stop of 1 m/s^2. Beside the distance stands a condition
/// that is true on the way, or a distance to a person.
std::string late_joint_guard(Dice& d, bool fault) {
  const double v = d.number(0.2, 0.8), way = v * (0.1 + 0.2) + v * v / 2.0;
  const double asked = 0.4 + way * (fault ? d.number(0.3, 0.95) : d.number(1.05, 1.5));
  const bool is_person = d.whole(0, 1) == 0;
  const std::string head =
      is_person ? "signals: {p: {type: pose, in: base_link, stale_after: 200 ms}}\nframes: {person: {parent: "
                  "p}}\nfeatures: {gap: {distance: [base_link, person]}}\n"
                : "signals: {gap: {type: number, unit: m, stale_after: 200 ms}}\n";
  const std::string beside = is_person            ? ""
                             : d.whole(0, 1) == 0 ? " and speed(base_link) > 5 cm/s"
                                                  : " and elapsed > 0.5 s";
  return file(task("a", drive("velocity: " + q(v, "m/s")),
                   exit_when("gap < " + q(asked, "m") + beside, "done"), fails),
              head);
}

/// Two equal ranges are a box, wherever they stand.
std::string box_in_two_groups(Dice& d, bool fault) {
  const double most = d.number(10.0, 30.0), other = fault ? most : 0.8 * most;
  const std::string frames = "{move: base_link, in: base_link, ";
  return file(task("a", drive("velocity: 0.05 m/s"), "", "{after: 5 s, goto: done}"),
              "always: {constraints: {one: " + frames + "x: {force: " + range(-most, most, "N") +
                  "}}, two: " + frames + "y: {force: " + range(-other, other, "N") + "}}}}\n");
}

}  // namespace

std::vector<Kind> kinds_of_places() {
  return {
      {"exit_beyond_a_region", {"W511"}, exit_beyond_a_region},
      {"way_beyond_a_region", {"W511"}, way_beyond_a_region},
      {"range_beside_a_region", {"W416"}, range_beside_a_region},
      {"two_regions", {"W416"}, two_regions},
      {"two_points", {"W416"}, two_points},
      {"time_in_a_task", {"W511"}, time_in_a_task},
      {"way_back", {"W511"}, way_back},
      {"beyond_the_motors", {"W416"}, beyond_the_motors},
      {"box_in_two_groups", {"W641"}, box_in_two_groups},
      {"late_joint_guard", {"W620"}, late_joint_guard},
  };
}

}  // namespace zwang::lang::silence
