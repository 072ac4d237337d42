// No silence: task files that read well and cannot work get the code of their fault. The files are drawn at
// random, with one fault each. As many sound files, drawn in the same way, get no diagnostic.
#include <gtest/gtest.h>

#include <cmath>

#include "../is_long.hpp"
#include "silence_draw.hpp"
#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang::silence {
namespace {

/// The effective mass [kg] along x of the mecanum base in the drawn files. Its limits are 1 m/s and 1 m/s^2.
constexpr double mass = 56.9;

/// Two ranges of one quantity, of the task and beside it or under `always`, apart or overlapping.
std::string two_ranges(Dice& d, bool fault) {
  const double edge = d.number(0.1, 0.4), gap = d.number(0.01, 0.2);
  const bool is_velocity = d.whole(0, 1) == 0;
  const std::string word = is_velocity ? "velocity" : "acceleration";
  const char* unit = is_velocity ? "m/s" : "m/s^2";
  const std::string first = "{move: base_link, in: base_link, x: {" + word + ": " +
                            range(-edge, fault ? edge - gap : edge + gap, unit) + "}}";
  const std::string second =
      "{move: bumper, in: base_link, x: {" + word + ": " + range(edge, edge + 0.3, unit) + "}}";
  const bool in_always = d.whole(0, 1) == 0;
  const std::string head = in_always ? "always: {constraints: {calm: " + first + "}}\n" : "";
  return file(task("a", "constraints: {" + (in_always ? "" : "one: " + first + ", ") + "two: " + second + "}",
                   "", "{after: 5 s, goto: done}"),
              head);
}

std::string beyond_a_range(Dice& d, bool fault) {
  const double most = d.number(0.1, 0.4),
               asked = fault ? most * d.number(1.05, 2.0) : most * d.number(0.3, 0.99);
  const double sign = d.whole(0, 1) == 0 ? 1.0 : -1.0;
  const std::string calm =
      "calm: {move: base_link, in: base_link, x: {velocity: " + range(-most, most, "m/s") + "}}";
  return file(task("a",
                   "constraints: {go: {move: base_link, in: base_link, x: {velocity: " +
                       q(sign * asked, "m/s") + "}}, " + calm + "}",
                   "", "{after: 5 s, goto: done}"));
}

/// Tasks in a ring; a sound one has a way out of one of them, or a signal that stops it.
std::string ring(Dice& d, bool fault) {
  const int count = d.whole(2, 6), way_out = d.whole(0, count - 1);
  const bool by_signal = d.whole(0, 2) == 0;
  const bool by_time = d.whole(0, 1) == 0;
  std::string tasks;
  for (int i = 0; i < count; ++i) {
    const std::string name(1, static_cast<char>('a' + i)), next(1, static_cast<char>('a' + (i + 1) % count));
    const double pause = d.number(0.5, 3.0);
    const bool leads_out = !fault && !by_signal && i == way_out;
    const std::string out = leads_out ? exit_when("moved(base_link) > 5 cm", "done") : "";
    // The timeout to `failed` comes after an exit that waits for time alone.
    const std::string on = "{when: \"elapsed > " + q(pause, "s") + "\", goto: " + next + "}";
    tasks += by_time ? task(name, drive("velocity: 0.1 m/s"), out + (leads_out ? ", " : "") + on,
                            "{after: " + q(pause * d.number(1.1, 3.0), "s") + ", goto: failed}")
                     : task(name, drive("velocity: 0.1 m/s"), out,
                            "{after: " + q(pause, "s") + ", goto: " + next + "}");
  }
  const bool stops = !fault && by_signal;
  return file(
      tasks, stops ? "signals: {stop_key: {type: bool, stale_after: 1 s}}\nalways: {exits: [{when: stop_key, "
                     "goto: failed}]}\n"
                   : "");
}

/// One comparison, on the far side of what the file allows or on the near one.
std::string impossible_exit(Dice& d, bool fault) {
  const double most = d.number(0.1, 0.5), limit = d.number(5.0, 40.0), until = d.number(3.0, 15.0);
  const double far = d.number(1.05, 3.0), near = d.number(0.3, 0.9), part = fault ? far : near;
  const std::string timeout = "{after: " + q(until, "s") + ", goto: failed}";
  const double reached = std::min(limit, mass * 1.0 * 0.9);
  std::string axis = "velocity: " + q(most, "m/s"), when;
  switch (d.whole(0, 5)) {
    case 0:  // speed
      axis = "acceleration: 0.3 m/s^2, velocity: " + range(-most, most, "m/s");
      when =
          fault ? "speed(base_link) > " + q(1.5 * far, "m/s") : "speed(base_link) > " + q(most * near, "m/s");
      break;
    case 1:  // velocity
      axis = "acceleration: 0.3 m/s^2, velocity: " + range(-most, most, "m/s");
      when = "go.x.velocity > " + q(most * part, "m/s");
      break;
    case 2:  // force of a driver
      axis = "force: " + q(reached, "N") + ", velocity: +-0.1 m/s";
      when = "go.x.force > " + q(reached * part, "N");
      break;
    case 3:  // time
      when = "elapsed > " + q(until * part, "s") + " and moved(base_link) > 1 cm";
      break;
    case 4:  // way
      axis = "force: 20 N, velocity: " + range(-most, most, "m/s");
      when = "moved(base_link) > " + q(fault ? 1.5 * until * far : most * until * near * 0.5, "m");
      break;
    default:  // parts that exclude each other
      when = "speed(base_link) > " + q(0.05, "m/s") + " and speed(base_link) < " +
             q(fault ? 0.05 * near : 0.05 * far, "m/s");
  }
  return file(task("a", drive(axis), exit_when(when, "done"), timeout));
}

std::string long_dwell(Dice& d, bool fault) {
  const double until = d.number(1.0, 10.0);
  return file(task("a", drive("velocity: 0.1 m/s"),
                   exit_when("speed(base_link) < 5 cm/s", "done",
                             until * (fault ? d.number(1.05, 3.0) : d.number(0.05, 0.9))),
                   "{after: " + q(until, "s") + ", goto: failed}"));
}

std::string flutter(Dice& d, bool fault) {
  const double there = d.number(0.5, 2.0), back = there * (fault ? d.number(0.3, 0.95) : d.number(1.05, 2.0));
  const std::string head = "signals: {gap: {type: number, unit: m, stale_after: 200 ms}}\n";
  const std::string still = drive("velocity: 0 m/s");
  return file(task("a", drive("velocity: 0.05 m/s"), exit_when("gap < " + q(there, "m"), "b", 0.02), fails) +
                  task("b", still, exit_when("gap > " + q(back, "m"), "a", 0.02), fails),
              head);
}

/// Blocked, a velocity driver presses with m v / T.
std::string unreached_force(Dice& d, bool fault) {
  const double v = d.number(0.02, 0.2), T = d.number(0.2, 1.0), made = mass * v / T;
  return file(task("a",
                   drive("velocity: " + q(v, "m/s") + ", time_constant: " + q(T, "s") + ", force: " +
                         range(-made * (fault ? d.number(2.1, 9.0) : d.number(0.3, 1.8)),
                               made * (fault ? d.number(2.1, 9.0) : d.number(0.3, 1.8)), "N")),
                   "", "{after: 5 s, goto: done}"));
}

/// The robot file's limit of 1 m/s^2 clips it.
std::string clipped_spring(Dice& d, bool fault) {
  const double k = mass * 1.0 / 0.2 * (fault ? d.number(1.1, 5.0) : d.number(0.1, 0.9));
  return file(
      task("a",
           "constraints: {s: {move: base_link, in: world, x: {position: here, stiffness: " + q(k, "N/m") +
               ", damping: " + q(2.0 * std::sqrt(k * mass) * d.number(0.3, 1.0), "N s/m") +
               "}, y: {position: here}, rz: {position: here}}}",
           "", "{after: 5 s, goto: done}"));
}

std::string held_steering(Dice& d, bool fault) {
  struct Steered {
    const char *robot, *held, *free;
  };
  static const std::vector<Steered> all{{"car_base", "rz: {velocity: V rad/s}", "x: {velocity: V m/s}"},
                                        {"tricycle_base", "rz: {velocity: V rad/s}", "x: {velocity: V m/s}"},
                                        {"swerve_base", "y: {velocity: V m/s}", "x: {velocity: V m/s}"},
                                        {"swerve_base", "rz: {velocity: V rad/s}", "x: {velocity: V m/s}"}};
  const Steered& one = d.of(all);
  const double v = d.number(0.03, 0.1) * (d.whole(0, 1) == 0 ? 1.0 : -1.0);
  const std::string axis = test::replaced(fault ? one.held : one.free, "V ", q(v, ""));
  return file(
      task("a", "constraints: {go: {move: base_link, in: base_link, time_constant: 1 s, " + axis + "}}", "",
           "{after: 5 s, goto: done}"),
      "", one.robot);
}

/// v (for + stale_after + blend / 2) + v^2 / 2a + a T^2 / 2, or v T, and 0.40 m of footprint.
std::string late_guard(Dice& d, bool fault) {
  const double v = d.number(0.2, 0.8), a = d.number(0.3, 1.0), T = 0.5;
  const double delay = 0.1 + 0.2 + 0.1;
  const double way = v * delay + (v < a * T ? v * T : v * v / (2.0 * a) + a * T * T / 2.0);
  const double asked = 0.4 + way * (fault ? d.number(0.3, 0.95) : d.number(1.05, 1.5));
  const std::string limit = ", acceleration: " + range(-a, a, "m/s^2");
  const std::string head = "signals: {gap: {type: number, unit: m, stale_after: 200 ms}}\n";
  return file(
      task("a", drive("velocity: " + q(v, "m/s") + limit), exit_when("gap < " + q(asked, "m"), "b"), fails) +
          task("b", drive("velocity: 0 m/s" + limit), exit_when("gap > " + q(asked + 0.5, "m"), "a", 1.0),
               fails),
      head);
}

std::string flutter_in_a_ring(Dice& d, bool fault) {
  const double most = d.number(0.8, 1.5), least = most * (fault ? d.number(0.3, 0.9) : d.number(1.1, 2.0));
  const std::string head = "signals: {gap: {type: number, unit: m, stale_after: 200 ms}}\n";
  const std::string still = drive("velocity: 0 m/s");
  const auto below = [&](double part) { return "gap < " + q(most * part, "m"); };
  return file(task("a", drive("velocity: 0.05 m/s"), exit_when(below(1.0), "b", 0.02), fails) +
                  task("b", still, exit_when(below(0.95), "c", 0.02), fails) +
                  task("c", still, exit_when("gap > " + q(least, "m"), "a", 0.02), fails),
              head);
}

/// Without a force range the bound is what the motors make, here 101 N.
std::string never_saturated(Dice& d, bool fault) {
  const double v = d.number(0.05, 0.1), T = d.number(0.3, 0.5), made = mass * v / T;
  const std::string bound = fault ? "" : ", force: " + range(-0.8 * made, 0.8 * made, "N");
  return file(task("a", drive("velocity: " + q(v, "m/s") + ", time_constant: " + q(T, "s") + bound),
                   exit_when("go.x.saturated and moved(base_link) > 1 cm", "done"), fails));
}

std::string force_beyond_a_sum(Dice& d, bool fault) {
  const double most = d.number(10.0, 30.0), push = most * (fault ? d.number(1.1, 1.8) : d.number(0.3, 0.95));
  const std::string head =
      "always: {constraints: {soft: {move: base_link, in: base_link, x: {force: " + range(-most, most, "N") +
      "}}}}\n";
  return file(task("a",
                   "constraints: {go: {move: bumper, in: base_link, x: {force: " + q(push, "N") +
                       ", velocity: +-0.1 m/s}}}",
                   "", "{after: 5 s, goto: done}"),
              head);
}

std::string faster_than_a_norm(Dice& d, bool fault) {
  const double most = d.number(0.1, 0.5), least = most * (fault ? d.number(1.1, 1.8) : d.number(0.2, 0.9));
  return file(task(
      "a",
      "constraints: {go: {move: base_link, in: base_link, x: {velocity: " + range(least, least + 0.2, "m/s") +
          "}, speed: {velocity: " + range(0.0, most, "m/s") + "}}}",
      "", "{after: 5 s, goto: done}"));
}

/// v along x and along y are v sqrt(2).
std::string diagonal_beyond_a_norm(Dice& d, bool fault) {
  const double most = d.number(0.1, 0.4), v = most * (fault ? d.number(0.72, 0.98) : d.number(0.2, 0.7));
  const std::string along = q(v, "m/s"), across = q(d.whole(0, 1) == 0 ? v : -v, "m/s");
  return file(task("a",
                   "constraints: {go: {move: base_link, in: base_link, x: {velocity: " + along +
                       "}, y: {velocity: " + across +
                       "}, rz: {velocity: 0 rad/s}}, calm: {move: base_link, " +
                       "in: base_link, speed: {velocity: " + range(0.0, most, "m/s") + "}}}",
                   "", "{after: 5 s, goto: done}"));
}

/// A task that comes later has neither been entered nor is the time since then known.
std::string before_it_is_entered(Dice& d, bool fault) {
  const std::string asked = fault ? "b" : "a", dwell = q(d.number(0.2, 3.0), "s");
  const bool counts = d.whole(0, 1) == 0;
  const std::string when = counts ? "entries(" + asked + ") > 0 and elapsed > " + dwell
                                  : "since(" + asked + ") > " + dwell + " and moved(base_link) > 1 cm";
  return file(task("a", drive("velocity: 0.05 m/s"), exit_when(when, "b"), fails) +
              task("b", drive("velocity: 0 m/s"), "", "{after: 2 s, goto: done}"));
}

/// The side that is weaker than the dead band lies on either side.
std::string weak_dead_band(Dice& d, bool fault) {
  const double band = d.number(2.0, 10.0), held = band * (fault ? d.number(0.2, 0.95) : d.number(1.05, 4.0));
  const double other = 5.0 * band;
  const std::string most = d.whole(0, 1) == 0 ? range(-held, other, "N") : range(-other, held, "N");
  return file(task("a",
                   "constraints: {led: {move: base_link, in: base_link, x: {yield: estimated.force.x, "
                   "mass: 60 kg, damping: 80 N s/m, dead_band: " +
                       q(band, "N") + ", force: " + most +
                       "}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}",
                   "", "{after: 20 s, goto: done}"));
}

/// D = -2 m ln(left) / T leaves that share of a swing after T = 20 s.
std::string swinging_spring(Dice& d, bool fault) {
  const double k = d.number(5.0, 50.0), left = fault ? d.number(0.55, 0.95) : d.number(0.05, 0.45);
  const double damping = -2.0 * mass * std::log(left) / 20.0;
  return file(
      task("a",
           "constraints: {go: {move: base_link, in: goal, x: {position: 0 m, stiffness: " + q(k, "N/m") +
               ", damping: " + q(damping, "N s/m") + "}, y: {position: 0 m}, rz: {position: 0 deg}}}",
           "", "{after: 20 s, goto: done}"),
      "frames: {goal: {parent: world, at: [0.5 m, 0 m]}}\n");
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = [] {
    std::vector<Kind> some{
        {"two_ranges", {"W416"}, two_ranges},
        {"beyond_a_range", {"W416"}, beyond_a_range},
        {"ring", {"W510"}, ring},
        {"impossible_exit", {"W511", "E505"}, impossible_exit},
        {"long_dwell", {"W511"}, long_dwell},
        {"flutter", {"W512"}, flutter},
        {"unreached_force", {"W619"}, unreached_force},
        {"clipped_spring", {"W601"}, clipped_spring},
        {"held_steering", {"W643", "E404"}, held_steering},
        {"late_guard", {"W620"}, late_guard},
        {"flutter_in_a_ring", {"W512"}, flutter_in_a_ring},
        {"never_saturated", {"W602"}, never_saturated},
        {"force_beyond_a_sum", {"W416"}, force_beyond_a_sum},
        {"faster_than_a_norm", {"W416"}, faster_than_a_norm},
        {"diagonal_beyond_a_norm", {"W416"}, diagonal_beyond_a_norm},
        {"before_it_is_entered", {"W511"}, before_it_is_entered},
        {"weak_dead_band", {"W647"}, weak_dead_band},
        {"swinging_spring", {"W648"}, swinging_spring},
    };
    for (Kind& kind : kinds_of_places()) some.push_back(std::move(kind));
    for (Kind& kind : kinds_of_drivers()) some.push_back(std::move(kind));
    for (Kind& kind : kinds_of_ways()) some.push_back(std::move(kind));
    return some;
  }();
  return all;
}

class Silence : public testing::Test {
 protected:
  Silence() {
    std::filesystem::copy(test::source_dir / "specs/robots", folder_.path() / "robots",
                          std::filesystem::copy_options::recursive);
    std::filesystem::copy(test::source_dir / "specs/scenes", folder_.path() / "scenes",
                          std::filesystem::copy_options::recursive);
  }

  /// W509 is of the scene, which gives no signals.
  std::vector<Diagnostic> said(const std::string& text) {
    Diagnostics diagnostics;
    load(folder_.write("task.yaml", text), {}, diagnostics);
    std::vector<Diagnostic> all;
    for (const Diagnostic& d : diagnostics.all()) {
      if (d.code != "W509") all.push_back(d);
    }
    return all;
  }

  static int count() { return zwang::test::is_long() ? 348 : 116; }

  test::Folder folder_;
};

TEST_F(Silence, a_drawn_fault_is_told) {
  for (int i = 0; i < count(); ++i) {
    const Kind& kind = kinds()[static_cast<std::size_t>(i) % kinds().size()];
    Dice draw(1000u + static_cast<unsigned>(i));
    const std::string text = kind.draw(draw, true);
    bool is_told = false;
    for (const Diagnostic& d : said(text)) {
      for (const char* code : kind.codes) is_told = is_told || d.code == code;
    }
    EXPECT_TRUE(is_told) << kind.name << " " << i << "\n" << text;
  }
}

TEST_F(Silence, a_sound_file_gets_no_word) {
  for (int i = 0; i < count(); ++i) {
    const Kind& kind = kinds()[static_cast<std::size_t>(i) % kinds().size()];
    Dice draw(5000u + static_cast<unsigned>(i));
    const std::string text = kind.draw(draw, false);
    for (const Diagnostic& d : said(text))
      ADD_FAILURE() << kind.name << " " << i << ": " << d.code << " " << d.message << "\n" << text;
  }
}

}  // namespace
}  // namespace zwang::lang::silence
