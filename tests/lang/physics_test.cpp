// The physical diagnostics against formulas of the robot's own figures. Each one is silent just inside its
// bound and appears just outside. Its numbers are the formula's.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support.hpp"
#include "zwang/lang/notes.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::lang {
namespace {

// tests/conformance/robots/mini: a chassis of 20 kg and 0.8 kg m^2 about the middle of the axle. Two wheels
// of 1 kg stand 0.2 m to the side, with motors of 5 N m. A wheel has 0.001 kg m^2 about the vertical and
// 0.002 kg m^2 about its axle.
constexpr double radius = 0.1, half_track = 0.2, spin = 0.002;
constexpr double mass = 20.0 + 2.0 * 1.0 + 2.0 * spin / (radius * radius);
constexpr double inertia = 0.8 + 2.0 * (0.001 + 1.0 * half_track * half_track) +
                           2.0 * spin * (half_track / radius) * (half_track / radius);
constexpr double force = 2.0 * 5.0 / radius;
constexpr double torque = force * half_track;
constexpr double stiffness = 20e3;  // of a bumper that the robot file does not tell

std::string number(double value, const std::string& unit) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9f ", value);
  return text + unit;
}

class Physics : public testing::Test {
 protected:
  Physics() {
    for (const char* name : {"mini.urdf", "mini.yaml"}) {
      folder_.write(std::string("robots/") + name,
                    test::slurp(test::source_dir / "tests/conformance/robots" / name));
    }
  }

  /// The diagnostics of a task whose one group moves `move` in `in` with these axes.
  Diagnostics said(const std::string& axes, const std::string& when = "elapsed > 2 s",
                   const std::string& move = "base_link", const std::string& in = "base_link") {
    const std::string text =
        "zwang: 1\nrobot: robots/mini.yaml\nframes:\n  nose: {parent: base_link, at: [0.3 m, 0 m]}\n" +
        std::string("start: go\ntasks:\n  go:\n    constraints:\n      go: {move: ") + move + ", in: " + in +
        ", " + axes + "}\n    exits:\n      - {when: " + when +
        ", for: 0.1 s, goto: done}\n    timeout: {after: 9 s, goto: failed}\n";
    Diagnostics diagnostics;
    load_with_notes(folder_.write("task.yaml", text), {}, diagnostics);
    return diagnostics;
  }

  /// The code is silent for `inside` and told once for `outside`; returns what it told.
  std::string only_outside(const std::string& code, const Diagnostics& inside, const Diagnostics& outside) {
    EXPECT_EQ(test::count(inside, code), 0) << test::rendered(inside);
    EXPECT_EQ(test::count(outside, code), 1) << test::rendered(outside);
    for (const Diagnostic& d : outside.all()) {
      if (d.code == code) return d.message + "\n" + d.help;
    }
    return "";
  }

  test::Folder folder_;
};

void expect_number(const std::string& text, const std::string& figure) {
  EXPECT_NE(text.find(figure), std::string::npos) << figure << " in: " << text;
}

TEST_F(Physics, a_push_is_capped_at_mass_times_acceleration) {
  const double cap = mass * 0.3;  // 6.72 N
  const auto axes = [](double f) { return "x: {force: " + number(f, "N") + ", acceleration: +-0.3 m/s^2}"; };
  const std::string text = only_outside("E601", said(axes(cap * 0.999)), said(axes(cap * 1.001)));
  expect_number(text, "caps it at 6.72 N (22.4 kg x 0.3 m/s^2)");
}

TEST_F(Physics, a_pull_is_capped_by_the_other_end_of_the_range) {
  const auto axes = [](double f) {
    return "x: {force: " + number(-f, "N") + ", acceleration: [-0.2 m/s^2, 3 m/s^2]}";
  };
  only_outside("E601", said(axes(mass * 0.2 * 0.999)), said(axes(mass * 0.2 * 1.001)));
}

TEST_F(Physics, a_torque_is_capped_by_the_inertia_with_wheels) {
  const auto axes = [](double n) {
    return "rz: {force: " + number(n, "N m") + ", acceleration: +-0.5 rad/s^2}";
  };
  only_outside("E601", said(axes(inertia * 0.5 * 0.999)), said(axes(inertia * 0.5 * 1.001)));
}

TEST_F(Physics, the_motors_make_torque_over_radius) {
  const auto push = [](double f) { return "x: {force: " + number(f, "N") + "}"; };
  expect_number(only_outside("W606", said(push(force * 0.999)), said(push(force * 1.001))), "100 N at most");
  const auto turn = [](double n) { return "rz: {force: " + number(n, "N m") + "}"; };
  only_outside("W606", said(turn(torque * 0.999)), said(turn(torque * 1.001)));
  // m v / tau = F
  const double tau = mass * 1.0 / force;
  const auto drive = [](double t) { return "x: {velocity: 1 m/s, time_constant: " + number(t, "s") + "}"; };
  expect_number(only_outside("W606", said(drive(tau * 1.001)), said(drive(tau * 0.999))),
                "time_constant: 0.224 s");
}

TEST_F(Physics, a_blocked_velocity_driver_presses_with_mass_times_velocity_over_time_constant) {
  const double pressed = mass * 0.05 / 0.5;  // 2.24 N
  const auto axes = [](double f) {
    return "x: {velocity: 0.05 m/s, time_constant: 0.5 s, force: +-" + number(f, "N") + "}";
  };
  const std::string guard = "go.x.saturated";
  expect_number(only_outside("W602", said(axes(pressed * 0.999), guard), said(axes(pressed * 1.001), guard)),
                "2.24 N at most (22.4 kg x 0.1 m/s^2)");
  // Without a guard on it the range is nothing but a range.
  EXPECT_EQ(test::count(said(axes(pressed * 1.001)), "W602"), 0);
}

TEST_F(Physics, the_first_hit_peaks_at_what_momentum_adds) {
  // P = F + sqrt(F^2 + K m v^2) comes to 2.5 F at v = sqrt(1.25 F^2 / (K m)).
  const double F = 40.0;
  const double v = std::sqrt(1.25 * F * F / (stiffness * mass));
  const auto axes = [&](double speed) {
    return "x: {force: 40 N, velocity: +-" + number(speed, "m/s") + "}";
  };
  only_outside("N603", said(axes(v * 0.999)), said(axes(v * 1.001)));
  const double peak = F + std::sqrt(F * F + stiffness * mass * 0.15 * 0.15);
  char figure[40];
  std::snprintf(figure, sizeof figure, "peaks near %.0f N; below 100 N", peak);
  expect_number(only_outside("N603", said(axes(v * 0.9)), said(axes(0.15))), figure);
}

TEST_F(Physics, an_approach_brakes_with_velocity_over_e_time_constants) {
  const double tau = 0.5 / (std::numbers::e * 0.3);
  const auto axes = [](double t, const std::string& limit) {
    return "x: {position: 1 m, velocity: +-0.5 m/s, " + limit + ", time_constant: " + number(t, "s") + "}";
  };
  const auto about = [&](double t, const std::string& limit) {
    return said(axes(t, limit), "elapsed > 2 s", "nose", "world");
  };
  const std::string range = "acceleration: +-0.3 m/s^2";
  only_outside("W604", about(tau * 1.001, range), about(tau * 0.999, range));
  const std::string bound = "force: +-" + number(mass * 0.3, "N");
  only_outside("W604", about(tau * 1.001, bound), about(tau * 0.999, bound));
}

/// A mass on a spring that is felt one tick late: [m], after so many ticks from 1 m.
struct SampledSpring {
  double k, d, m = mass, dt = 1e-3;
  double s = 1.0, v = 0.0, felt_s = 1.0, felt_v = 0.0;

  void step() {
    const double f = -k * felt_s - d * felt_v;
    felt_s = s;
    felt_v = v;
    v += dt * f / m;
    s += dt * v;
  }
  double largest(int ticks) {
    double most = 0.0;
    for (int i = 0; i < ticks; ++i, step()) most = std::max(most, std::abs(s));
    return most;
  }
  bool settles() {
    const double first = largest(2000);
    largest(40000);
    return largest(2000) < first;
  }
};

TEST_F(Physics, a_spring_is_as_stiff_as_the_tick_can_follow) {
  const double d = 500.0, most = d * (1.0 - d * 1e-3 / mass) / 1e-3;
  EXPECT_TRUE((SampledSpring{.k = 0.98 * most, .d = d}.settles()));
  EXPECT_FALSE((SampledSpring{.k = 1.02 * most, .d = d}.settles()));
  const auto about = [&](double k) {
    return said("x: {position: here, stiffness: " + number(k, "N/m") + ", damping: 500 N s/m, force: +-20 N}",
                "elapsed > 2 s", "base_link", "world");
  };
  expect_number(only_outside("W604", about(0.999 * most), about(1.001 * most)), "`stiffness: 488000 N/m`");
}

TEST_F(Physics, a_damping_is_as_hard_as_the_tick_can_follow) {
  const double most = mass / 4e-3;
  const auto swings = [](double d) {
    SampledSpring spring{.k = 0.0, .d = d, .v = 1.0, .felt_v = 1.0};
    bool turned = false;
    for (int i = 0; i < 1000; ++i, spring.step()) turned = turned || spring.v < 0.0;
    return turned;
  };
  EXPECT_FALSE(swings(0.99 * most));
  EXPECT_TRUE(swings(1.01 * most));
  const auto about = [&](double d) {
    return said("x: {position: here, stiffness: 1 kN/m, damping: " + number(d, "N s/m") + ", force: +-20 N}",
                "elapsed > 2 s", "base_link", "world");
  };
  expect_number(only_outside("W604", about(0.999 * most), about(1.001 * most)), "`damping: 5600 N s/m`");
}

TEST_F(Physics, a_boundary_brakes_with_its_share_of_the_acceleration) {
  const double a = force / (0.72 * mass);
  const auto axes = [](double braking) {
    return "x: {velocity: 0.1 m/s, position: [-1 m, 1 m], acceleration: +-" + number(braking, "m/s^2") + "}";
  };
  only_outside("W607", said(axes(a * 0.999), "elapsed > 2 s", "base_link", "world"),
               said(axes(a * 1.001), "elapsed > 2 s", "base_link", "world"));
}

/// The diagnostics of a group on a feature.
class FeaturePhysics : public Physics {
 protected:
  Diagnostics said_of(const std::string& feature, const std::string& statements, const std::string& more = "",
                      const std::string& robot = "mini") {
    const std::string text = "zwang: 1\nrobot: robots/" + robot +
                             ".yaml\nframes:\n  wall: {parent: world, at: [2 m, 0 m]}\n" + more +
                             "features:\n  f: " + feature +
                             "\nstart: go\ntasks:\n  go:\n    constraints:\n      go: {feature: f, " +
                             statements + "}\n    timeout: {after: 9 s, goto: failed}\n";
    Diagnostics diagnostics;
    load_with_notes(folder_.write("task.yaml", text), {}, diagnostics);
    return diagnostics;
  }
};

TEST_F(FeaturePhysics, a_slanted_push_meets_the_mass_of_what_can_move) {
  // s = 0.6 x + 0.8 y with y held: 1/m_s = 0.6^2 / m.
  const double cap = mass / 0.36 * 0.3;
  const auto said_about = [&](double f) {
    return said_of("{direction: {move: base_link, in: base_link, x: 0.6, y: 0.8}}",
                   "force: " + number(f, "N") + ", acceleration: +-0.3 m/s^2");
  };
  expect_number(only_outside("E601", said_about(cap * 0.999), said_about(cap * 1.001)), "caps it at 18.7 N");
}

TEST_F(FeaturePhysics, a_distance_is_asked_along_its_line_and_in_other_directions) {
  // Straight ahead the whole base moves; where the wheels hold the line, nothing is said of it.
  const auto push = [&](double f) {
    return said_of("{distance: [base_link, wall]}", "force: " + number(-f, "N"));
  };
  expect_number(only_outside("W606", push(force * 0.999), push(force * 1.001)), "100 N at most");
}

/// One newton along e accelerates the point p of the base along e by e' W e. W is [1/m + py^2/I, -px py/I; .,
/// px^2/I]. Over all directions the mass lies between the inverses of W's eigenvalues.
TEST_F(FeaturePhysics, a_distance_meets_every_mass_that_a_direction_has) {
  const double px = 0.3, py = 0.2;
  const double xx = 1.0 / mass + py * py / inertia, yy = px * px / inertia, xy = -px * py / inertia;
  const double spread = std::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy);
  const double least = 2.0 / (xx + yy + spread), most = 2.0 / (xx + yy - spread);
  const auto push = [&](double f) {
    return said_of("{distance: [nose, wall]}", "force: " + number(-f, "N") + ", acceleration: +-0.3 m/s^2",
                   "  nose: {parent: base_link, at: [0.3 m, 0.2 m]}\n");
  };
  only_outside("W601", push(0.3 * least * 0.999), push(0.3 * least * 1.001));
  only_outside("E601", push(0.3 * most * 0.999), push(0.3 * most * 1.001));
}

TEST_F(FeaturePhysics, towards_what_the_wheels_hold_any_force_can_be_pressed) {
  const auto push = [&](double f) {
    return said_of("{distance: [base_link, wall]}",
                   "force: " + number(-f, "N") + ", acceleration: +-0.3 m/s^2");
  };
  // Sideways the mass is beyond all bounds: never is too much to say.
  EXPECT_EQ(test::count(push(90.0), "E601"), 0);
  only_outside("W601", push(0.3 * mass * 0.999), push(0.3 * mass * 1.001));
}

/// A box of accelerations allows most along the diagonal to its corner: hypot(ax, ay).
TEST_F(FeaturePhysics, a_distance_is_looked_at_where_two_ranges_bind) {
  for (const char* name : {"mecanum_base.urdf", "mecanum_base.yaml"}) {
    folder_.write(std::string("robots/") + name, test::slurp(test::source_dir / "specs/robots" / name));
  }
  Diagnostics of_robot;
  const auto robot = load_robot(test::source_dir / "specs/robots/mecanum_base.yaml", of_robot);
  ASSERT_TRUE(robot.has_value());
  const auto base = solver::analyse_base(robot->model, start_state(*robot));
  const double m = base.axes[0].effective_mass;
  ASSERT_NEAR(base.axes[1].effective_mass, m, 1e-9 * m);
  const double cap = m * std::hypot(0.2, 0.35);
  const auto push = [&](double f) {
    return said_of("{distance: [base_link, wall]}",
                   "force: " + number(-f, "N") +
                       "}\n      base: {move: base_link, in: base_link, x: {acceleration: +-0.2 m/s^2}, "
                       "y: {acceleration: +-0.35 m/s^2}",
                   "", "mecanum_base");
  };
  only_outside("E601", push(cap * 0.999), push(cap * 1.001));
}

TEST_F(FeaturePhysics, an_angle_is_a_turn) {
  const auto turn = [&](double n) {
    return said_of("{angle: [base_link.x, wall.y]}", "force: " + number(n, "N m"));
  };
  expect_number(only_outside("W606", turn(torque * 0.999), turn(torque * 1.001)), "20 N m at most");
}

TEST_F(FeaturePhysics, what_hangs_on_a_signal_may_lie_anywhere) {
  const std::string seen = "  seen: {parent: partner}\nsignals:\n  partner: {type: pose, stale_after: 1 s}\n";
  const auto push = [&](double f) {
    return said_of("{distance: [base_link, seen]}", "force: " + number(-f, "N"), seen);
  };
  only_outside("W606", push(force * 0.999), push(force * 1.001));
}

TEST_F(FeaturePhysics, a_feature_counts_among_the_rows) {
  const Diagnostics said_of_both = said_of(
      "{distance: [nose, wall]}",
      "velocity: 0.1 m/s}\n      two: {move: nose, in: world, x: {velocity: 0.1 m/s}, y: {velocity: 0.1 m/s}",
      "  nose: {parent: base_link, at: [0.3 m, 0 m]}\n");
  EXPECT_EQ(test::count(said_of_both, "E406"), 1) << test::rendered(said_of_both);
}

/// A point r ahead of the axle goes sideways with I / r^2 when the base turns: tons, a few millimetres ahead.
TEST_F(Physics, what_moves_by_millimetres_of_lever_counts_as_held) {
  const auto about = [&](const std::string& at) {
    const std::string text = "zwang: 1\nrobot: robots/mini.yaml\nframes:\n  hub: {parent: base_link, at: [" +
                             at +
                             ", 0 m]}\nstart: go\ntasks:\n  go:\n    constraints:\n      go: {move: hub, in: "
                             "base_link, y: {velocity: 1 mm/s}}\n    timeout: {after: 9 s, goto: failed}\n";
    Diagnostics diagnostics;
    load(folder_.write("task.yaml", text), {}, diagnostics);
    return diagnostics;
  };
  only_outside("E404", about("10 mm"), about("4 mm"));
}

TEST_F(Physics, a_planar_speed_bounds_the_approach_as_a_range_does) {
  const double tau = 0.5 / (std::numbers::e * 0.3);
  const auto axes = [](double t) {
    return "speed: {velocity: [0 m/s, 0.5 m/s]}, x: {position: 1 m, acceleration: +-0.3 m/s^2, "
           "time_constant: " +
           number(t, "s") + "}";
  };
  const auto about = [&](double t) { return said(axes(t), "elapsed > 2 s", "nose", "world"); };
  only_outside("W604", about(tau * 1.001), about(tau * 0.999));
}

TEST_F(Physics, a_planar_speed_bounds_the_first_hit) {
  const double F = 40.0;
  const double v = std::sqrt(1.25 * F * F / (stiffness * mass));
  const auto axes = [&](double speed) {
    return "speed: {velocity: [0 m/s, " + number(speed, "m/s") + "]}, x: {force: 40 N}";
  };
  only_outside("N603", said(axes(v * 0.999)), said(axes(v * 1.001)));
}

/// tests/conformance/robots/casters: 20 kg on two units. The swivel of a unit has 1 kg and 2 g m^2. A wheel
/// has 0.5 kg, 0.6 g m^2 about its axle and 0.3 g m^2 about the vertical.
TEST_F(Physics, a_push_over_casters_is_capped_between_two_masses) {
  for (const char* name : {"casters.urdf", "casters.yaml"}) {
    folder_.write(std::string("robots/") + name,
                  test::slurp(test::source_dir / "tests/conformance/robots" / name));
  }
  const double R = 0.05, c = 0.02, half_span = 0.05, I = 0.6e-3;
  // Swivels that trail only roll; across, the wheels' middle stands and the swivel turns about it with v/c.
  const double trailing = 20.0 + 2.0 * (1.0 + 2.0 * (0.5 + I / (R * R)));
  const double turning = 0.002 + 2.0 * (0.3e-3 + 0.5 * half_span * half_span);
  const double across = 20.0 + 2.0 * (1.0 + turning / (c * c) + 2.0 * I * std::pow(half_span / (c * R), 2));
  const auto about = [&](double f) {
    Diagnostics diagnostics;
    const std::string text =
        "zwang: 1\nrobot: robots/casters.yaml\nstart: go\ntasks:\n  go:\n    constraints:\n      go: {move: "
        "base_link, in: base_link, x: {force: " +
        number(f, "N") + ", acceleration: +-0.2 m/s^2}}\n    timeout: {after: 9 s, goto: failed}\n";
    load_with_notes(folder_.write("task.yaml", text), {}, diagnostics);
    return diagnostics;
  };
  EXPECT_TRUE(about(0.2 * trailing * 0.999).all().empty()) << test::rendered(about(0.2 * trailing * 0.999));
  only_outside("W601", about(0.2 * trailing * 0.999), about(0.2 * trailing * 1.001));
  const std::string text = only_outside("E601", about(0.2 * across * 0.999), about(0.2 * across * 1.001));
  expect_number(text, "10.7 N (53.5 kg x 0.2 m/s^2)");
  EXPECT_NEAR(across, 53.5, 0.05);
}

TEST_F(Physics, one_cause_has_one_message) {
  const Diagnostics said_of = said("x: {force: 500 N, acceleration: +-0.3 m/s^2}, y: {velocity: 1 m/s}");
  EXPECT_EQ(said_of.all().size() - static_cast<std::size_t>(test::count(said_of, "W302")), 2U)
      << test::rendered(said_of);
  EXPECT_EQ(test::count(said_of, "E601"), 1);
  EXPECT_EQ(test::count(said_of, "E404"), 1);
}

TEST_F(Physics, is_asked_beside_errors_of_other_kinds) {
  const Diagnostics said_of = said("x: {velocity: 1 N}, y: {velocity: 1 m/s}");
  EXPECT_EQ(test::count(said_of, "E202"), 1);
  EXPECT_EQ(test::count(said_of, "E404"), 1);
}

TEST_F(Physics, the_shipped_task_has_nothing_to_warn_of) {
  Diagnostics diagnostics;
  ASSERT_TRUE(load(test::source_dir / "specs/wall_align.yaml", {}, diagnostics));
  EXPECT_TRUE(diagnostics.all().empty()) << test::rendered(diagnostics);
}

}  // namespace
}  // namespace zwang::lang
