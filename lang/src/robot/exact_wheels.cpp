#include "robot/exact_wheels.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "robot/placed_urdf.hpp"

namespace zwang::lang {

namespace {

using solver::Matrix3;
using solver::Model;
using solver::Pose;
using solver::Vector3;
using solver::Wheel;

constexpr double rounding = 1e-9;  ///< [m] and [rad]: of numbers that are written with ten digits
constexpr double half_turn = 3.1;  ///< [rad] also where it is written as 3.14

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

double angle_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// A line in the plane that a wheel's axis lies on while all joints are at 0.
struct Axle {
  int body = 0;        ///< that moves when the axle is moved
  Vector3 along;       ///< level, unit
  double ahead = 0.0;  ///< [m] of the line from the reference, along `forward()`
  Vector3 forward() const { return along.cross(Vector3::UnitZ()); }
};

class ExactWheels {
 public:
  explicit ExactWheels(const Model& model) : model_(model) {
    for (const solver::Body& body : model.bodies()) poses_.push_back(body.pose_in_parent);
  }

  std::vector<ExactPlace> places() {
    straighten_steering();
    level_rollers();
    straighten_wheels();
    for (int body = 1; body < model_.body_count(); ++body) {
      if (steers(body)) align_on(body);
    }
    align_on_base();
    return moved();
  }

 private:
  bool on_base(int body) const { return model_.bodies()[at(body)].parent == 0; }

  /// The body hangs on the base by an upright joint and carries a wheel.
  bool steers(int body) const {
    return body > 0 && on_base(body) && model_.joint(body - 1).type != solver::JointType::prismatic &&
           std::abs(axis_in_base(body).z()) >= PlacedUrdf::upright &&
           std::any_of(model_.wheels().begin(), model_.wheels().end(),
                       [&](const Wheel& wheel) { return model_.bodies()[at(wheel.body)].parent == body; });
  }
  bool is_steered_by_motor(int body) const { return steers(body) && model_.joint(body - 1).actuated; }
  /// A caster swings round until its wheel trails. A steering that ends before half a turn cannot.
  bool cannot_swing_round(int body) const {
    const solver::Joint& joint = model_.joint(body - 1);
    return is_steered_by_motor(body) && joint.lower > -half_turn && joint.upper < half_turn;
  }

  Pose pose_in_base(int body) const {
    Pose pose;
    for (int b = body; b > 0; b = model_.bodies()[at(b)].parent) pose = poses_[at(b)] * pose;
    return pose;
  }
  Vector3 axis_in_base(int body) const {
    return pose_in_base(body).rotation * model_.bodies()[at(body)].joint.axis;
  }

  /// Turns the body about its origin so that its axis points along `target`, or against it.
  void turn(int body, Vector3 target) {
    const Vector3 axis = axis_in_base(body);
    if (axis.dot(target) < 0.0) target = -target;
    if (angle_between(axis, target) < rounding) return;
    const Matrix3 parent = pose_in_base(model_.bodies()[at(body)].parent).rotation;
    const Matrix3 turned = solver::rotation_between(axis, target);
    poses_[at(body)].rotation = parent.transpose() * turned * parent * poses_[at(body)].rotation;
  }

  /// By `step` in the base's axes.
  void move(int body, const Vector3& step) {
    if (step.norm() < rounding) return;
    poses_[at(body)].position += pose_in_base(model_.bodies()[at(body)].parent).rotation.transpose() * step;
  }

  static double angle_of_lines(const Vector3& a, const Vector3& b) {
    const double angle = angle_between(a, b);
    return std::min(angle, M_PI - angle);
  }
  static bool is_near(const Vector3& axis, const Vector3& target) {
    return angle_of_lines(axis, target) <= most_axis_angle + rounding;
  }

  void straighten_steering() {
    for (int body = 1; body < model_.body_count(); ++body) {
      if (steers(body) && is_near(axis_in_base(body), Vector3::UnitZ())) turn(body, Vector3::UnitZ());
    }
  }

  void level_rollers() {
    for (const Wheel& wheel : model_.wheels()) {
      if (!wheel.roller_angle) continue;
      const Vector3 axis = axis_in_base(wheel.body);
      const Vector3 level = Vector3(axis.x(), axis.y(), 0.0).normalized();
      if (is_near(axis, level)) turn(wheel.body, level);
    }
  }

  /// Plain wheels that are nearly parallel on what carries them.
  void straighten_wheels() {
    std::vector<int> bodies;
    for (const Wheel& wheel : model_.wheels()) {
      const int carrier = model_.bodies()[at(wheel.body)].parent;
      if (!wheel.roller_angle && (carrier == 0 || steers(carrier))) bodies.push_back(wheel.body);
    }
    while (!bodies.empty()) {
      const int first = bodies.front();
      const auto is_neighbour = [&](int body) {
        return model_.bodies()[at(body)].parent == model_.bodies()[at(first)].parent &&
               angle_of_lines(axis_in_base(body), axis_in_base(first)) <= 2.0 * most_axis_angle;
      };
      const auto others = std::stable_partition(bodies.begin(), bodies.end(), is_neighbour);
      make_parallel({bodies.begin(), others});
      bodies.erase(bodies.begin(), others);
    }
  }

  /// Along x or y of the base where it or a motor carries them, else along their mean.
  void make_parallel(const std::vector<int>& bodies) {
    const int carrier = model_.bodies()[at(bodies.front())].parent;
    const Vector3 first = axis_in_base(bodies.front());
    const Vector3 of_base = std::abs(first.x()) > std::abs(first.y()) ? Vector3::UnitX() : Vector3::UnitY();
    if ((carrier == 0 || is_steered_by_motor(carrier)) && turn_all(bodies, of_base)) return;
    Vector3 mean = Vector3::Zero();
    for (const int body : bodies) {
      const Vector3 own = axis_in_base(body);
      mean += own.dot(first) < 0.0 ? -own : own;
    }
    mean.z() = 0.0;
    if (bodies.size() > 1) turn_all(bodies, mean.normalized());
  }

  /// False, and nothing turned, where one of them would have to turn farther than allowed.
  bool turn_all(const std::vector<int>& bodies, const Vector3& target) {
    const auto is_far = [&](int body) { return !is_near(axis_in_base(body), target); };
    if (std::any_of(bodies.begin(), bodies.end(), is_far)) return false;
    for (const int body : bodies) turn(body, target);
    return true;
  }

  Axle axle_of(int wheel_body, int moving_body, const Vector3& reference) const {
    Axle axle{moving_body, axis_in_base(wheel_body), 0.0};
    axle.along.z() = 0.0;
    axle.along.normalize();
    // One sense for all that are parallel.
    if (std::abs(axle.along.y()) > std::abs(axle.along.x()) ? axle.along.y() < 0.0 : axle.along.x() < 0.0)
      axle.along = -axle.along;
    axle.ahead = axle.forward().dot(pose_in_base(wheel_body).position - reference);
    return axle;
  }

  /// The wheels that a swivel carries, on axles that meet its own axis where a motor turns it. A wheel alone
  /// stands right below it: beside it, driving would turn the steering.
  void align_on(int carrier) {
    std::vector<Axle> axles;
    const bool has_motor = model_.joint(carrier - 1).actuated;
    const Vector3 middle = pose_in_base(carrier).position;
    for (const Wheel& wheel : model_.wheels()) {
      if (holds_sideways(wheel) && model_.bodies()[at(wheel.body)].parent == carrier)
        axles.push_back(axle_of(wheel.body, wheel.body, middle));
    }
    const bool is_alone = has_motor && axles.size() == 1;
    const int alone = is_alone ? axles.front().body : 0;
    if (is_alone && std::abs(axles.front().ahead) <= most_trail(carrier, alone)) {
      move(alone, -axles.front().ahead * axles.front().forward());
      axles.front().ahead = 0.0;
    }
    align(std::move(axles), has_motor);
    if (!is_alone) return;
    const Vector3 along = axle_of(alone, alone, middle).along;
    const double aside = along.dot(pose_in_base(alone).position - middle);
    if (std::abs(aside) <= most_wheel_offset + rounding) move(alone, -aside * along);
  }

  /// [m] A steering that cannot swing round holds its wheel, and the tyre scrubs within its own print. A tyre
  /// that the load presses in by 0.5 % of its radius r touches the floor ahead of and behind its axle by
  ///   sqrt(2 * 0.005) r = r / 10
  double most_trail(int carrier, int wheel_body) const {
    const auto& wheels = model_.wheels();
    const auto is_it = [&](const Wheel& other) { return other.body == wheel_body; };
    const double radius = std::find_if(wheels.begin(), wheels.end(), is_it)->radius;
    return cannot_swing_round(carrier) ? std::max(most_wheel_offset, radius / tyre_print) : most_wheel_offset;
  }

  /// Wheels on the base, and steerings whose axles meet their axis: those do not hold the base with a lever.
  void align_on_base() {
    std::vector<Axle> axles;
    for (const Wheel& wheel : model_.wheels()) {
      if (!holds_sideways(wheel)) continue;
      const int carrier = model_.bodies()[at(wheel.body)].parent;
      if (carrier == 0) axles.push_back(axle_of(wheel.body, wheel.body, Vector3::Zero()));
      const auto is_listed = [&](const Axle& axle) { return axle.body == carrier; };
      if (!is_steered_by_motor(carrier) || std::any_of(axles.begin(), axles.end(), is_listed)) continue;
      if (std::abs(axle_of(wheel.body, carrier, pose_in_base(carrier).position).ahead) < rounding)
        axles.push_back(axle_of(wheel.body, carrier, Vector3::Zero()));
    }
    align(std::move(axles), true);
  }

  static bool holds_sideways(const Wheel& wheel) { return !wheel.roller_angle && wheel.holds_sideways; }

  /// Each group of parallel axles that nearly coincide, on their mean; `at_reference`: or on the reference.
  void align(std::vector<Axle> axles, bool at_reference) {
    const auto before = [](const Axle& a, const Axle& b) { return a.ahead < b.ahead; };
    std::stable_sort(axles.begin(), axles.end(), before);
    while (!axles.empty()) {
      const Axle first = axles.front();
      const auto is_neighbour = [&](const Axle& axle) {
        return angle_between(axle.along, first.along) < rounding &&
               axle.ahead - first.ahead <= 2.0 * most_wheel_offset + rounding;
      };
      const auto others = std::stable_partition(axles.begin(), axles.end(), is_neighbour);
      const std::vector<Axle> group(axles.begin(), others);
      if (!(at_reference && move_onto(group, 0.0)) && group.size() > 1) move_onto(group, mean_of(group));
      axles.erase(axles.begin(), others);
    }
  }

  static double mean_of(const std::vector<Axle>& group) {
    double sum = 0.0;
    for (const Axle& axle : group) sum += axle.ahead;
    return sum / static_cast<double>(group.size());
  }

  /// False, and nothing moved, where one of them would have to move farther than allowed.
  bool move_onto(const std::vector<Axle>& group, double ahead) {
    const auto is_far = [&](const Axle& axle) {
      return std::abs(axle.ahead - ahead) > most_wheel_offset + rounding;
    };
    if (std::any_of(group.begin(), group.end(), is_far)) return false;
    for (const Axle& axle : group) move(axle.body, (ahead - axle.ahead) * axle.forward());
    return true;
  }

  std::vector<ExactPlace> moved() const {
    std::vector<ExactPlace> places;
    for (int body = 1; body < model_.body_count(); ++body) {
      const Pose& drawn = model_.bodies()[at(body)].pose_in_parent;
      const Pose& exact = poses_[at(body)];
      ExactPlace place{body, exact, (exact.position - drawn.position).norm(), 0.0};
      place.angle = Eigen::AngleAxisd(Matrix3(exact.rotation * drawn.rotation.transpose())).angle();
      if (exact.position != drawn.position || exact.rotation != drawn.rotation) places.push_back(place);
    }
    return places;
  }

  const Model& model_;
  std::vector<Pose> poses_;  ///< of the bodies in their parents
};

/// Where the robot file names the joint as a wheel, else the URDF.
Span wheel_span(const RobotFile& file, const std::string& joint) {
  for (const WheelText& wheel : file.wheels) {
    if (wheel.joint.text == joint) return wheel.joint.span;
  }
  return file.urdf.span;
}

}  // namespace

std::vector<ExactPlace> exact_places(const Model& model) {
  if (model.base_type() != solver::BaseType::ground) return {};
  return ExactWheels(model).places();
}

/// P is the pose of a body, A that of its parent link, and O that of its joint in the parent link:
///   P = A O,   so that   O' = A^-1 P' = O P^-1 P'
void stand_wheels_exactly(const Model& drawn, const RobotFile& file, Urdf& urdf, Diagnostics& diagnostics) {
  std::vector<wording::Deviation> told;
  for (const ExactPlace& place : exact_places(drawn)) {
    const solver::Body& body = drawn.bodies()[at(place.body)];
    UrdfJoint& joint = *std::find_if(urdf.joints.begin(), urdf.joints.end(),
                                     [&](const UrdfJoint& j) { return j.joint.name == body.joint.name; });
    joint.origin = joint.origin * body.pose_in_parent.inverse() * place.pose_in_parent;
    if (place.is_told()) told.push_back({body.joint.name, place.distance, place.angle, joint.span});
  }
  if (told.empty()) return;
  const auto share = [](const wording::Deviation& d) {
    return std::max(d.distance / most_wheel_offset, d.angle / most_axis_angle);
  };
  std::stable_sort(told.begin(), told.end(),
                   [&](const auto& a, const auto& b) { return share(a) > share(b); });
  diagnostics.add(wording::nearly_exact_wheels(wheel_span(file, told.front().joint), told));
}

}  // namespace zwang::lang
