// A use case that ships is fitted to a base in three ways. Names: the task moves `base` and `lead`, which
// every robot has; a robot whose URDF calls another link `base` is named by its base link. Forces: in
// proportion to the weight of a light base. Distances: from the edge of the outline.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "diagnostic/wordings_physics.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {

namespace {

/// The shipped robot's mass, for which the shipped forces were chosen. [kg]
constexpr double shipped_mass = 46.0;

std::string to_the_millimetre(double value) {
  return wording::figure(std::round(value * 1e3) / 1e3, "m");
}

/// By as much a hand may reach beyond its joint. [m]
constexpr double hand = 0.2;

constexpr double degree_of_start = std::numbers::pi / 180.0;

/// As little a base may turn on its way to a wall by its own mass: nobody sees it. [rad]
constexpr double most_turn_by_itself = 1.0 * degree_of_start;

/// So many times its own mass a base weighs along x whose swivels turn over as it is pushed. Rotors behind
/// gears seldom weigh as much as the base.
constexpr double heavy_casters = 2.0;

/// Two digits.
double rounded(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / step) * step;
}

/// A shipped file has changed where `from` is not in it: told by the test that drafts every task.
void replace(std::string& text, const std::string& from, const std::string& to) {
  std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the shipped task does not hold `" + from + "`");
  for (; at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

bool is_of_a_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Where `from` is the value of a key, an argument or the first of a list. Words for people stay.
void replace_name(std::string& text, const std::string& from, const std::string& to) {
  for (const char* before : {": ", "(", "["}) {
    const std::string old_text = before + from, new_text = before + to;
    for (std::size_t at = 0; (at = text.find(old_text, at)) != std::string::npos; at += new_text.size()) {
      const std::size_t end = at + old_text.size();
      if (end == text.size() || !is_of_a_word(text[end])) text.replace(at, old_text.size(), new_text);
    }
  }
}

/// The rest of the line that begins so.
void replace_line(std::string& text, const std::string& begin, const std::string& line) {
  const std::size_t at = text.find("\n" + begin);
  if (at == std::string::npos) throw std::logic_error("the shipped task has no line `" + begin + "`");
  const std::size_t end = text.find('\n', at + 1);
  text.replace(at + 1, end - at - 1, line);
}

class Fitting {
 public:
  Fitting(const std::string& task, const BaseFit& fit)
      : task_(task), fit_(fit), askew_(start_askew(fit).value_or(20.0 * degree_of_start)) {}

  std::string scene() const {
    if (task_ == "wall_align") return wall_scene();
    if (task_ == "feel_wall") return felt_wall_scene();
    if (task_ == "obstacle") return cart_scene();
    if (task_ == "docking") return dock_scene();
    return "";  // the round's corridor is the same for every base that it has room for
  }

  std::string fitted(std::string text, const std::string& robot_file, const std::string& scene_file) const {
    replace_line(text, "robot: ", "robot: " + robot_file);
    replace_line(text, "scene: ", "scene: " + scene_file);
    const std::size_t schema = text.find('\n');
    text.replace(0, schema,
                 "# Written by `zwang robot init` for `" + fit_.robot + "`, from the task `" + task_ +
                     "` that ships with zwang.");
    if (fit_.base != "base") replace_name(text, "base", fit_.base);
    fit_forces(text);
    fit_times(text);
    return text;
  }

 private:
  /// How far the base reaches ahead in the world while it is turned by `yaw`. [m]
  double ahead(double yaw) const {
    double most = fit_.arm_reach > 0.0 ? fit_.arm_reach + hand : 0.0;
    for (const Eigen::Vector2d& c : fit_.outline)
      most = std::max(most, c.x() * std::cos(yaw) - c.y() * std::sin(yaw));
    return most;
  }
  double behind() const {
    double most = 0.0;
    for (const Eigen::Vector2d& c : fit_.outline) most = std::max(most, -c.x());
    return most;
  }

  std::string gap_text(double gap) const {
    return to_the_millimetre(gap) +
           (fit_.outline_is_known ? " ahead of the base's outline"
                                  : " ahead of what the body may reach, for its outline is not known yet");
  }

  /// Of the URDF's base, whose x may not be ahead. [deg]
  std::string start_yaw(double degrees) const {
    return wording::figure(degrees - std::round(fit_.heading / degree_of_start), "deg");
  }

  std::string head(const std::string& about) const {
    return "# Written by `zwang robot init` for `" + fit_.robot + "`: " + about + "\nzwang_scene: 1\n\n";
  }

  static std::string wall(double x, double length) {
    return "objects:\n  wall:\n    wall: {length: " + to_the_millimetre(length) +
           ", thickness: 0.1 m, height: 1 m}\n    at: [" + to_the_millimetre(x) +
           ", 0 m]\n    yaw: 0 deg\n    fixed: true\n    stiffness: 100 kN/m\n    damping: 0.3  # ratio to "
           "the critical "
           "one\n    friction: 0\n";
  }

  static constexpr double wall_gap = 0.5, felt_gap = 0.05, cart_gap = 2.0, dock_gap = 1.0;  // [m]

  std::string wall_scene() const {
    const double degrees = std::round(askew_ / degree_of_start);
    return head("a wall, " + gap_text(wall_gap) + ", and the base " + wording::figure(degrees, "deg") +
                " askew.") +
           "start: {at: [0 m, 0 m], yaw: " + start_yaw(degrees) + "}\nfloor: {friction: 0.9}\n\n" +
           wall(ahead(askew_) + wall_gap, std::max(4.0, 8.0 * ahead(askew_)));
  }

  std::string felt_wall_scene() const {
    return head("a wall, " + gap_text(felt_gap) + ", and a force sensor that feels it.") +
           "start: {at: [0 m, 0 m], yaw: " + start_yaw(0.0) + "}\nfloor: {friction: 0.9}\n\n" +
           wall(ahead(0.0) + felt_gap, std::max(4.0, 8.0 * ahead(0.0))) +
           "\nsignals:\n  felt: {force_of: wall, noise: " + force(0.5) + "}\n";
  }

  std::string cart_scene() const {
    const std::string at = to_the_millimetre(ahead(0.0) + cart_gap + 0.2);
    return head("a cart in the way, " + gap_text(cart_gap) + ", that is pulled aside after 20 s.") +
           "start: {at: [0 m, 0 m], yaw: " + start_yaw(0.0) +
           "}\nfloor: {friction: 0.9}\n\nobjects:\n  cart:\n    box: [0.4 "
           "m, 1.2 m, "
           "0.6 m]\n    at: [" +
           at +
           ", 0 m]\n    stiffness: 100 kN/m\n    damping: 0.3  # ratio to the critical one\n    friction: "
           "0.1\n    "
           "motion: [{time: 20 s, at: [" +
           at + ", 0 m]}, {time: 22 s, at: [" + at + ", 4 m]}]\n";
  }

  std::string dock_scene() const {
    return head("the back of another robot, " + to_the_millimetre(dock_gap) +
                " behind this one, with a socket that latches.") +
           "start: {at: [0 m, 0 m], yaw: " + start_yaw(0.0) +
           "}\nfloor: {friction: 0.9}\n\nobjects:\n  partner:\n    box: "
           "[0.6 m, 0.5 m, "
           "0.4 m]\n    at: [" +
           to_the_millimetre(-(behind() + dock_gap + 0.3)) +
           ", 0 m]\n    fixed: true\n    stiffness: 100 kN/m\n    damping: 0.3  # ratio to the critical "
           "one\n    "
           "friction: 0.1\n    dock: {at: [0.3 m, 0 m], reach: 1 cm, hook: hook}\n\nsignals:\n  # Seen as by "
           "a camera: a "
           "little wrong, late, and 15 times a second.\n  partner: {pose_of: partner, noise: 1 mm, "
           "angle_noise: 0.1 deg, "
           "delay: 60 ms, rate: 15 Hz}\n  latch:   {latch: partner}\n";
  }

  /// F = F_shipped m / m_shipped for a base lighter than the shipped one: as much of its weight, which the
  /// floor holds. A heavier one keeps the shipped force. If the motors' F_max accelerates a base with less
  /// than a = 1 m/s^2, it counts as one of m = F_max / a. The shipped 0.9 m/s^2 x m is 0.9 F_max then.
  double force_of(double shipped) const {
    constexpr double a = 1.0;  // [m/s^2]
    double mass = fit_.mass > 0.0 ? std::min(fit_.mass, shipped_mass) : shipped_mass;
    if (fit_.largest_force > 0.0) mass = std::min(mass, fit_.largest_force / a);
    return mass == shipped_mass ? shipped : rounded(shipped * mass / shipped_mass);
  }
  std::string force(double shipped) const { return wording::figure(force_of(shipped), "N"); }
  std::string range_of(double value, double low, double high) const {
    return "value: " + force(value) + ", range: [" + force(low) + ", " + force(high) + "]";
  }

  void fit_forces(std::string& text) const {
    if (task_ == "wall_align") replace(text, "value: 20 N, range: [5 N, 40 N]", range_of(20, 5, 40));
    if (task_ == "wall_align" && (fit_.freedoms == Freedoms::two || is_turned_by_its_mass())) damp_turn(text);
    if (task_ == "wall_align" && fit_.mass > 0.0 && fit_.effective_mass > heavy_casters * fit_.mass)
      hold_gently(text);
    if (task_ == "obstacle") replace(text, "value: 40 N, range: [10 N, 120 N]", range_of(40, 10, 120));
    if (task_ == "docking") {
      replace(text, "value: 20 N, range: [10 N, 25 N]", range_of(20, 10, 25));
      replace(text, "force: -10 N", "force: -" + force(10));
    }
    if (task_ == "feel_wall") {
      replace(text, "value: 20 N, range: [10 N, 40 N]", range_of(20, 10, 40));
      replace(text, "value: 5 N, range: [1 N, 100 N]", range_of(5, 1, 100));
      // 0.9 m/s^2 x mass: a base that is allowed 1 m/s^2 can press so.
      replace(text, "force: 56 N", "force: " + force(0.9 * shipped_mass));
    }
  }

  /// [N m] Half of the moment with which the least push squares the base up at last, and the proposed push at
  /// first. A narrow front has little lever while it is askew.
  double gentle_moment() const {
    const Eigen::Vector2d axle(fit_.axle, 0.0);
    Eigen::Vector2d first{0.0, 0.0};
    for (const Eigen::Vector2d& corner : fit_.outline) {
      const Eigen::Vector2d at = Eigen::Rotation2Dd(askew_) * (corner - axle);
      if (at.x() > first.x()) first = at;
    }
    const double at_first = fit_.outline_is_known ? force_of(20.0) * std::abs(first.y()) : solver::infinity;
    return rounded(0.5 * std::min(force_of(5.0) * lever(), at_first));
  }

  /// Casters that turn over weigh along x, and hardly across. The row that holds the heading makes up for a
  /// turn that the push would bring, and that the wall prevents. Its moment is less than the wall's.
  void hold_gently(std::string& text) const {
    const std::string row = "rz: {velocity: 0 rad/s, time_constant: 0.4 s";
    replace(text, row + "}", row + ", force: +-" + wording::figure(gentle_moment(), "N m") + "}");
  }

  /// A mass that lies d beside the base's origin turns a base that nothing holds: I w' = m d v'. On its way s
  /// the base turns by m d s / I.
  bool is_turned_by_its_mass() const {
    if (!(fit_.mass > 0.0) || !(fit_.effective_inertia > 0.0)) return false;
    return fit_.mass * fit_.centre.norm() * wall_gap / fit_.effective_inertia > most_turn_by_itself;
  }

  /// If the mass of a base on one axle lies behind or beside the axle, the base turns by itself as it drives
  /// ahead:
  ///   I w' = -m x v w + m y v'.
  /// A moment that is bounded holds it. The wall still turns it: the least push has twice that moment about
  /// the nearer end of the edge ahead.
  void damp_turn(std::string& text) const {
    replace(text, "        rz: free\n",
            "        # A mass beside or behind the base's origin would turn the base on its way. The wall is "
            "stronger.\n"
            "        rz: {velocity: 0 rad/s, force: +-" +
                wording::figure(gentle_moment(), "N m") + "}\n");
  }

  /// The shipped time allows for the shipped way: 0.5 m at 0.08 m/s, 5 cm at 1 cm/s.
  void fit_times(std::string& text) const {
    static constexpr double longest = 600.0;  // [s] that the shipped range of the parameter allows
    const auto timeout = [](double seconds) {
      return "timeout: {value: " + wording::figure(std::min(longest, std::ceil(seconds / 5.0) * 5.0), "s");
    };
    // A large base takes longer to swing around the corner that touches first. A drive that feels late takes
    // 15 s longer.
    constexpr double turn = 30.0;  // [s]
    if (task_ == "wall_align") replace(text, "for: 0.2 s", "for: " + wording::figure(still_for(), "s"));
    if (task_ == "wall_align")
      replace(text, "timeout: {value: 40 s",
              timeout(turn + (2.0 * wall_gap + slack()) / 0.08 + 10.0 * ahead(askew_) + still_for() +
                      2.0 * turning_time()));
    if (task_ == "feel_wall")
      replace(text, "timeout: {value: 20 s", timeout(15.0 + (felt_gap + slack()) / 0.01));
  }

  /// The way may be so much longer while the outline is not known: the body may end behind the base's origin.
  /// So it may where an arm does not reach as far ahead as its joints are from that origin. [m]
  double slack() const {
    double front = 0.0;
    for (const Eigen::Vector2d& corner : fit_.outline) front = std::max(front, corner.x());
    return fit_.outline_is_known ? ahead(0.0) - front : 2.0 * ahead(0.0);
  }

  double lever() const { return std::max(0.02, fit_.front_lever); }

  /// From `askew_` to square at the wall, without a bounce: t = sqrt(2 a I / (F d)). [s]
  double turning_time() const {
    constexpr double longest = 10.0;  // as of `still_for`
    return std::min(longest, std::sqrt(2.0 * askew_ * fit_.effective_inertia / (force_of(20.0) * lever())));
  }

  /// The time [s] for which the base has to be slower than the exit's speeds v = 5 mm/s and w = 0.5 deg/s.
  /// As the base bounces off the wall, it is slower for
  ///   t = 2 v m / F   and   t = 2 w I / (F d)
  /// F is the force at the corner that touches first, d beside the origin. Half as much again tells rest.
  double still_for() const {
    constexpr double v = 5e-3, w = 0.5 * degree_of_start, shipped = 0.2;
    Eigen::Vector2d first{0.0, 0.0};
    for (const Eigen::Vector2d& corner : fit_.outline) {
      const Eigen::Vector2d at = Eigen::Rotation2Dd(askew_) * corner;
      if (at.x() > first.x()) first = at;
    }
    const double push = force_of(20.0), lever = std::max(0.05, std::abs(first.y()));
    const double bounce =
        std::max(2.0 * v * fit_.effective_mass / push, 2.0 * w * fit_.effective_inertia / (push * lever));
    constexpr double longest = 3.0;  // some inertias count all that casters resist
    return std::clamp(std::ceil(1.5 * bounce * 10.0 - 1e-9) / 10.0, shipped, longest);
  }

  const std::string& task_;
  const BaseFit& fit_;
  double askew_;  ///< [rad] of the base at the start, before a wall squares it up
};

}  // namespace

const std::vector<std::string>& fitted_tasks() {
  static const std::vector<std::string> names = {"wall_align", "feel_wall", "obstacle", "docking",
                                                 "hospital"};
  return names;
}

TaskTexts draft_task(const std::string& task, const TaskTexts& shipped, const BaseFit& fit,
                     const std::string& robot_file, const std::string& scene_file) {
  const Fitting fitting(task, fit);
  std::string scene = fitting.scene();
  return {fitting.fitted(shipped.task, robot_file, scene_file),
          scene.empty() ? shipped.scene : std::move(scene)};
}

}  // namespace zwang::lang
