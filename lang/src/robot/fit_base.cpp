// The properties of a base that a use case has to fit, from its robot file or from the draft of one.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "diagnostic/wordings_physics.hpp"
#include "zwang/lang/configurations.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/lang/task_draft.hpp"
#include "zwang/lang/wheel_level.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::lang {

namespace {

/// The radius [m] within which the shipped corridor leaves a base room to turn. The ward is 0.6 m off its
/// middle, the wall 1.2 m, and the region keeps 0.1 m off the wall.
constexpr double room_of_corridor = 1.2 - 0.1 - 0.6;

constexpr std::size_t x_axis = 0, y_axis = 1, yaw_axis = 2;

/// By as much a body may reach beyond its wheels while the outline is not known. [m]
constexpr double overhang = 0.3;

/// An arm's point as far beyond the outline is told; outlines are no more exact. [m]
constexpr double beyond_outline = 0.01;

constexpr double degree_of_yaw = std::numbers::pi / 180.0;

/// From which the tasks begin at a wall [deg], and by how much more the way there may turn the base.
constexpr std::array start_yaws{20.0, 15.0, 10.0, 5.0};
constexpr double swing = 2.0;

std::vector<Eigen::Vector2d> circle(double radius) {
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < 16; ++k)
    corners.push_back(radius * Eigen::Rotation2Dd(k * std::numbers::pi / 8.0).toRotationMatrix().col(0));
  return corners;
}

Freedoms freedoms_of(const Robot& robot) {
  const solver::Model& model = robot.model;
  const solver::BaseAnalysis analysis = solver::analyse_base(model, start_state(robot));
  bool is_steered = false, is_skid = false, is_held = false;
  for (const solver::Wheel& wheel : model.wheels()) {
    const int carrier = model.bodies()[static_cast<std::size_t>(wheel.body)].parent;
    is_steered = is_steered || (carrier > 0 && model.joint(carrier - 1).actuated);
    is_skid = is_skid || (!wheel.roller_angle && !wheel.holds_sideways);
    // A plain wheel that does not steer holds its own sideways, whatever a tilted pivot lets go.
    is_held = is_held || (carrier == 0 && !wheel.roller_angle && wheel.holds_sideways);
  }
  const bool goes_anywhere =
      usable(analysis.axes[x_axis]).reachable && usable(analysis.axes[y_axis]).reachable;
  if (goes_anywhere && !is_held) return Freedoms::all;
  return is_steered ? Freedoms::steered : is_skid ? Freedoms::skid : Freedoms::two;
}

double radius_of(const std::vector<Eigen::Vector2d>& outline) {
  double most = 0.0;
  for (const Eigen::Vector2d& corner : outline) most = std::max(most, corner.norm());
  return most;
}

/// Of bodies that neither are wheels nor carry them: how far what lies beyond the outline reaches.
void add_arm(const Robot& robot, BaseFit& fit) {
  const solver::Model& model = robot.model;
  std::set<int> of_base{0};  // and of wheels
  for (const solver::Wheel& wheel : model.wheels()) {
    for (int b = wheel.body; b > 0; b = model.bodies()[static_cast<std::size_t>(b)].parent) of_base.insert(b);
  }
  double front = 0.0;
  for (const Eigen::Vector2d& corner : fit.outline) front = std::max(front, corner.x());
  const Eigen::VectorXd q = start_state(robot).q;
  for (const solver::Frame& frame : model.frames()) {
    if (of_base.contains(frame.body)) continue;
    const Eigen::Vector2d at = Eigen::Rotation2Dd(-fit.heading) *
                               (pose_in_base(model, frame.body, q) * frame.pose_in_body.position).head<2>();
    if (plane::contains(fit.outline, at) || plane::distance_to_edges(fit.outline, at) < beyond_outline)
      continue;
    fit.arm_reach = std::max(fit.arm_reach, at.norm());
    if (at.x() > front) fit.arm_ahead = std::max(fit.arm_ahead, at.x());
  }
}

/// Swivels stand across as the base is pushed from aside, and turn over: the mass that they resist with then.
solver::BaseAnalysis with_swivels_across(const Robot& robot) {
  solver::State state = start_state(robot);
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const int swivel = robot.model.bodies()[static_cast<std::size_t>(wheel.body)].parent - 1;
    if (swivel >= 0 && !robot.model.joint(swivel).actuated) state.q(swivel) = 0.5 * std::numbers::pi;
  }
  return solver::analyse_base(robot.model, state);
}

void add_masses(const Robot& robot, BaseFit& fit) {
  const solver::BaseAnalysis analysis = solver::analyse_base(robot.model, start_state(robot));
  const auto known = [](double value) { return std::isfinite(value) ? value : 0.0; };
  const bool goes_along_y = std::abs(std::sin(fit.heading)) > 0.7;
  const auto ahead = goes_along_y ? y_axis : x_axis;
  fit.effective_mass = std::max(known(analysis.axes[ahead].effective_mass),
                                known(with_swivels_across(robot).axes[ahead].effective_mass));
  fit.largest_force = analysis.axes[ahead].largest_force;
  fit.effective_inertia = known(analysis.axes[yaw_axis].effective_mass);
  const std::optional<Footing> footing = footing_of(robot);
  if (footing) fit.centre = Eigen::Rotation2Dd(-fit.heading) * footing->centre.head<2>();
}

void turn(std::vector<Eigen::Vector2d>& outline, double heading) {
  for (Eigen::Vector2d& corner : outline) corner = Eigen::Rotation2Dd(-heading) * corner;
}

/// An outline that is round ahead has a short lever, and never none.
double front_lever_of(const std::vector<Eigen::Vector2d>& outline) {
  constexpr double flat = 0.01, least = 0.02;  // [m]
  double front = 0.0, left = 0.0, right = 0.0;
  for (const Eigen::Vector2d& corner : outline) front = std::max(front, corner.x());
  for (const Eigen::Vector2d& corner : outline) {
    if (corner.x() < front - flat) continue;
    left = std::max(left, corner.y());
    right = std::max(right, -corner.y());
  }
  return std::max(least, std::min(left, right));
}

/// The frame of the base that tasks call so: turned about its origin, where its x is not ahead.
void find_base_ahead(const Robot& robot, BaseFit& fit) {
  for (const char* name : {"ahead", "base"}) {
    const auto frame = robot.model.find_frame(name);
    if (!frame) continue;
    const solver::Frame& found = robot.model.frames()[static_cast<std::size_t>(*frame)];
    const solver::Pose& pose = found.pose_in_body;
    constexpr double rounding = 1e-6;
    if (found.body != 0 || pose.position.norm() > rounding || pose.rotation(2, 2) < 1.0 - rounding) continue;
    fit.base = name;
    fit.heading = std::atan2(pose.rotation(1, 0), pose.rotation(0, 0));
    return;
  }
  fit.base = robot.base_frame;
}

/// Where a round outline rests, near to whatever heading it comes with. None of one that comes to rest
/// square, or turns away to one of its sides.
std::optional<double> rests_askew_ahead(const std::vector<Eigen::Vector2d>& outline) {
  constexpr double to_a_side = 45.0 * degree_of_yaw;
  const std::optional<double> rests = resting_yaw(outline, start_yaws.front() * degree_of_yaw);
  const bool is_ahead = rests && std::abs(*rests) > round_ahead && std::abs(*rests) < to_a_side;
  return is_ahead ? rests : std::nullopt;
}

/// About the axle, where the wheels hold the base sideways.
std::vector<Eigen::Vector2d> about_axle(const BaseFit& fit) {
  std::vector<Eigen::Vector2d> outline = fit.outline;
  for (Eigen::Vector2d& corner : outline) corner.x() -= fit.axle;
  return outline;
}

/// Of a base that no start squares up.
std::string why_never_square(const std::vector<Eigen::Vector2d>& outline) {
  const std::optional<double> askew = rests_askew_ahead(outline);
  if (askew)
    return "its outline is round ahead: pressed to a wall it rests " +
           wording::figure(*askew / degree_of_yaw, "deg") + " askew";
  const std::optional<double> rests = resting_yaw(outline, start_yaws.back() * degree_of_yaw);
  return "its front is too narrow: pressed to a wall from " + wording::figure(start_yaws.back(), "deg") +
         " askew it " +
         (rests ? "comes to rest " + wording::figure(*rests / degree_of_yaw, "deg") + " askew"
                : "turns away from it");
}

}  // namespace

BaseFit base_fit(const RobotDraft& draft) {
  BaseFit fit;
  fit.heading = draft.heading;
  fit.robot = draft.name;
  fit.outline_is_known = draft.outline_is_known;
  fit.outline = draft.outline;
  turn(fit.outline, fit.heading);
  fit.front_lever = front_lever_of(fit.outline);
  if (!fit.outline_is_known) fit.outline = circle(radius_of(draft.outline) + overhang);
  fit.arm_reach = draft.arm_reach;
  fit.mass = draft.mass;
  if (draft.has_own_base) fit.base = draft.base;
  if (!draft.base_ahead.empty()) fit.base = draft.base_ahead;
  // The freedoms of a base are not known before the rollers of its wheels are.
  if (draft.assumed.size() == 1) fit.freedoms = freedoms_of(draft.assumed.front().robot);
  if (draft.assumed.empty()) return fit;
  const Robot& assumed = draft.assumed.front().robot;
  add_masses(assumed, fit);
  const auto has_effort = [](const DraftWheel& wheel) { return wheel.effort.has_value(); };
  if (!std::all_of(draft.wheels.begin(), draft.wheels.end(), has_effort)) fit.largest_force = 0.0;
  if (fit.freedoms == Freedoms::two) fit.axle = axle_ahead(assumed.model, fit.heading);
  if (fit.outline_is_known) add_arm(assumed, fit);
  return fit;
}

BaseFit base_fit(const Robot& robot) {
  BaseFit fit;
  fit.robot = robot.name;
  for (const solver::Vector3& corner : robot.footprint) fit.outline.emplace_back(corner.head<2>());
  fit.outline_is_known = true;
  find_base_ahead(robot, fit);
  turn(fit.outline, fit.heading);
  fit.front_lever = front_lever_of(fit.outline);
  if (!fit.outline.empty()) add_arm(robot, fit);
  fit.mass = robot.model.total_mass();
  fit.freedoms = freedoms_of(robot);
  if (fit.freedoms == Freedoms::two) fit.axle = axle_ahead(robot.model, fit.heading);
  add_masses(robot, fit);
  return fit;
}

std::optional<double> start_askew(const BaseFit& fit) {
  if (!fit.outline_is_known) return start_yaws.front() * degree_of_yaw;
  const std::vector<Eigen::Vector2d> outline = about_axle(fit);
  if (rests_askew_ahead(outline)) return std::nullopt;
  const auto rests_square = [&](double yaw) {
    const std::optional<double> rests = resting_yaw(outline, yaw);
    return rests && std::abs(*rests) <= round_ahead;
  };
  for (const double yaw : start_yaws) {
    if (rests_square(yaw * degree_of_yaw) && rests_square((yaw + swing) * degree_of_yaw))
      return yaw * degree_of_yaw;
  }
  return std::nullopt;
}

std::string why_unfit(const std::string& task, const BaseFit& fit) {
  if (task == "feel_wall") return "";
  if (fit.freedoms == Freedoms::skid)
    return task == "wall_align"
               ? "no wall turns a base whose wheels slide sideways: the floor holds it harder (E621)"
               : "no motor pushes a base sideways whose wheels slide sideways (E404)";
  if (fit.freedoms == Freedoms::steered)
    return task == "wall_align" ? "no wall turns a base on steered wheels: they hold its heading (E621)"
                                : "a base on steered wheels cannot drive along x, y and rz at once (E406)";
  if (task == "wall_align" && !start_askew(fit)) return why_never_square(about_axle(fit));
  if (task == "wall_align" && fit.outline_is_known && fit.arm_ahead > 0.0)
    return "its arm reaches " + wording::figure(fit.arm_ahead, "m") +
           " ahead, beyond the outline, and would touch the wall first: fold it by `posture`";
  if (task == "hospital" && fit.outline_is_known && radius_of(fit.outline) > room_of_corridor + 1e-3)
    return "its corridor leaves room to turn within " + wording::figure(room_of_corridor, "m") +
           ", and the outline reaches " + wording::figure(radius_of(fit.outline), "m") +
           " from the base's origin";
  return "";
}

}  // namespace zwang::lang
