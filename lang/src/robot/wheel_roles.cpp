// A URDF says who has a motor by an effort limit or a transmission. Where it says so of some wheels and not
// of others, that decides. Else names and places do:
//
//   on a swivel, with other wheels that do not steer, and the axle behind the swivel's axis      a caster
//   on a swivel, and called a caster, while others are not                                       a caster
//   on a swivel without a motor, and its axle not behind the swivel's axis: nothing turns it       a ball
//   stiff, and called a caster, while others are not                                             a ball
//   stiff, and a fifth smaller than the largest: on stiff axles such a base would drag           a ball
//
// Wheels on one axle, or on one swivel, are judged together. Where none would be left that drives, all do;
// but casters do not where the URDF holds wheels that are called otherwise.
#include "robot/wheel_roles.hpp"

#include <algorithm>
#include <cmath>

#include "diagnostic/wheel_places.hpp"
#include "robot/placed_urdf.hpp"
#include "robot/wheel_names.hpp"

namespace zwang::lang {

namespace {

/// Of the radius: an axle as much behind the swivel's axis makes the wheel follow.
constexpr double least_trail = 0.1;
/// Of the radius: axles that are as near are one.
constexpr double one_axle = 0.3;

enum class Role { driven, idle, caster, ball };

class Roles {
 public:
  Roles(const Urdf& urdf, FoundWheels& found) : urdf_(urdf), found_(found), wheels_(found.wheels) {
    const bool are_all_casters = std::all_of(wheels_.begin(), wheels_.end(), is_called_caster);
    for (const DraftWheel& wheel : wheels_) {
      // Simulators give limits to casters, too: beside other wheels theirs tell nothing.
      const bool counts = are_all_casters || !is_called_caster(wheel);
      const bool says = says_motor(wheel.joint);
      some_say_ = some_say_ || (says && counts);
      some_do_not_ = some_do_not_ || !says;
      some_are_turned_ = some_are_turned_ || urdf_.find_joint(wheel.joint)->is_turned;
      if (!wheel.swivel.empty() || is_called_caster(wheel)) continue;
      has_stiff_ = true;
      largest_ = std::max(largest_, wheel.radius.value_or(0.0));
    }
  }

  void assign() {
    if (are_all_casters_beside_stuck_wheels()) {
      found_.casters = std::move(found_.wheels);
      found_.wheels.clear();
      return;
    }
    std::vector<Role> roles;
    for (const DraftWheel& wheel : wheels_) roles.push_back(role_of(wheel));
    if (std::find(roles.begin(), roles.end(), Role::driven) == roles.end())
      roles.assign(roles.size(), Role::driven);
    found_.wheels.clear();
    for (std::size_t i = 0; i < wheels_.size(); ++i) place(wheels_[i], roles[i]);
    find_steering();
  }

 private:
  bool says_motor(const std::string& name) const {
    const UrdfJoint* joint = urdf_.find_joint(name);
    return joint != nullptr && (joint->has_transmission || std::isfinite(joint->joint.max_effort));
  }

  /// The file says of some wheels that they have motors, and not of others. Limits that are left at
  /// joints that it holds tell nothing.
  bool tells_motors() const { return some_say_ && some_do_not_ && !some_are_turned_; }

  static bool is_called_caster(const DraftWheel& wheel) {
    return lang::is_called_caster(wheel.swivel) || lang::is_called_caster(wheel.joint) ||
           lang::is_called_caster(wheel.link);
  }

  bool are_all_casters_beside_stuck_wheels() const {
    return std::all_of(wheels_.begin(), wheels_.end(), is_called_caster) && !found_.stuck.empty();
  }

  /// On one swivel, or on one axle of what does not steer.
  static bool are_together(const DraftWheel& a, const DraftWheel& b) {
    if (!a.swivel.empty() || !b.swivel.empty()) return a.swivel == b.swivel;
    const Eigen::Vector2d between(b.at[0] - a.at[0], b.at[1] - a.at[1]);
    const Eigen::Vector2d axle = a.axle.normalized();
    const auto across = [&](const Eigen::Vector2d& v) {
      return std::abs(axle.x() * v.y() - axle.y() * v.x());
    };
    return across(b.axle) < 0.1 && across(between) < one_axle * a.radius.value_or(0.1);
  }

  bool group_says_motor(const DraftWheel& wheel) const {
    return std::any_of(wheels_.begin(), wheels_.end(), [&](const DraftWheel& other) {
      return are_together(wheel, other) && says_motor(other.joint);
    });
  }

  bool is_small(const DraftWheel& wheel) const {
    return wheel.radius && *wheel.radius < (1.0 - PlacedUrdf::slack) * largest_;
  }

  Role role_of(const DraftWheel& wheel) const {
    const bool is_driven = group_says_motor(wheel);
    if (wheel.swivel.empty()) {
      const bool is_stiff_caster = has_stiff_ && (is_called_caster(wheel) || is_small(wheel));
      if (tells_motors()) return is_driven ? Role::driven : is_stiff_caster ? Role::ball : Role::idle;
      return is_stiff_caster ? Role::ball : Role::driven;
    }
    const bool trails = wheel.trail > least_trail * wheel.radius.value_or(0.1);
    const bool is_free = !says_motor(wheel.swivel) && !is_driven && is_called_caster(wheel);
    if (is_free && has_stiff_ && wheel.trail <= most_wheel_offset) return Role::ball;
    if (tells_motors()) {
      if (is_driven) return Role::driven;
      return says_motor(wheel.swivel) || !(trails || is_called_caster(wheel)) ? Role::idle : Role::caster;
    }
    return is_called_caster(wheel) || (has_stiff_ && trails) ? Role::caster : Role::driven;
  }

  void place(const DraftWheel& wheel, Role role) {
    if (role == Role::driven) found_.wheels.push_back(wheel);
    if (role == Role::idle) found_.idle.push_back(wheel);
    if (role == Role::caster) found_.casters.push_back(wheel);
    if (role != Role::ball) return;
    if (!wheel.swivel.empty()) found_.in_between.push_back(wheel.swivel);
    found_.in_between.push_back(wheel.joint);
    found_.supports.push_back(wheel.link);
  }

  /// A motor steers a swivel, or two driven wheels on it do by their difference. Above two of them, a limit
  /// of effort alone is a habit, and so is a transmission for its encoder: a motor has both.
  bool is_steered(const std::string& swivel) const {
    const auto driven = std::count_if(found_.wheels.begin(), found_.wheels.end(),
                                      [&](const DraftWheel& w) { return w.swivel == swivel; });
    const UrdfJoint* joint = urdf_.find_joint(swivel);
    return driven < 2 || (joint->has_transmission && std::isfinite(joint->joint.max_effort));
  }

  void find_steering() {
    for (const DraftWheel& wheel : holding_wheels(found_)) {
      const bool is_known =
          std::find(found_.steering.begin(), found_.steering.end(), wheel.swivel) != found_.steering.end();
      if (!wheel.swivel.empty() && !is_known && is_steered(wheel.swivel))
        found_.steering.push_back(wheel.swivel);
    }
  }

  const Urdf& urdf_;
  FoundWheels& found_;
  std::vector<DraftWheel> wheels_;
  bool some_say_ = false, some_do_not_ = false, some_are_turned_ = false;
  bool has_stiff_ = false;  ///< wheels that do not steer and are not called casters
  double largest_ = 0.0;    ///< [m] of their radii
};

}  // namespace

void assign_roles(const Urdf& urdf, FoundWheels& found) {
  Roles(urdf, found).assign();
}

}  // namespace zwang::lang
