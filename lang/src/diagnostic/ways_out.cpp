#include "diagnostic/ways_out.hpp"

namespace zwang::lang {

namespace {

struct WayOut {
  std::string_view what;  ///< what the mapping's name begins with
  std::string_view keys;  ///< with a blank on both sides of each
  std::string_view help;
};

constexpr std::string_view how_near =
    "an exit says how near is near enough: `when: abs(contact.x.position - 0.5 m) < 1 cm`";
constexpr std::string_view axis_by_axis =
    "each axis says it for itself: `x: {velocity: 0.1 m/s}`, `rz: {velocity: 0 rad/s}`";
constexpr std::string_view bound = "a bound is a range of a quantity: `velocity: [0 m/s, 0.3 m/s]`";
constexpr std::string_view shape =
    "write the shape itself: `box: [1 m, 1 m, 1 m]`, `cylinder: {radius: 0.3 m, height: 1 m}` or `wall: "
    "{length: 4 m}`";
constexpr std::string_view source =
    "a task file says what it measures; the scene's `signals` say where that comes from";
constexpr std::string_view base_is_wheels =
    "a base is its `wheels`: `- {joint: left_wheel, radius: 100 mm}`; the URDF says where they stand";
constexpr std::string_view of_the_urdf = "the URDF says that";
constexpr std::string_view corners =
    "a footprint is its corners: `polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], [0.3 m, -0.2 "
    "m]]`";

constexpr WayOut ways[] = {
    // --- tasks ---
    {"constraint group",
     " axes axis linear angular twist wrench pose position velocity acceleration force torque xy xyz rpy ",
     axis_by_axis},
    {"constraint group", " in x y z rx ry rz speed ",
     "what stays `inside` a region, or is on a feature, has no axes: give them a group of their own"},
    {"constraint group", " type kind controller ", "a group has no type: its lines say what it does"},
    {"constraint group", " min max lower upper limit limits ", bound},
    {"axis", " min max lower upper limit limits range ", bound},
    {"axis", " gain gains p ki i ",
     "there are no gains: `time_constant: 0.5 s`, or `stiffness` and `damping`"},
    {"task", " type kind action ", "a task has no type: its `constraints` say what it does"},
    {"task", " goal goal_pose pose waypoint waypoints ",
     "positions say where to go: `constraints: {go: {move: base_link, in: world, x: {position: 2 m}}}`"},
    {"task", " blend ", "write `enter: {blend: 0.2 s}`"},
    {"template", " constraints exits timeout enter ", "what the template makes stands in its `body`"},
    {"parameter", " unit type ", "the unit stands behind the number: `value: 1 m`"},
    {"region", " x y min max size width height ",
     "a region is its corners: `polygon: [[0 m, 0 m], [2 m, 0 m], [2 m, 1 m], [0 m, 1 m]]`"},
    {"task", " when goto ", "a way out is an item of `exits`: `exits: [{when: elapsed > 2 s, goto: done}]`"},
    {"signal", " topic msg message source rate frequency noise delay ", source},
    {"signal", " value initial ", "a signal that stays is a script with one step: `script: [[0 s, true]]`"},
    {"frame", " quat quaternion orientation_xyzw ",
     "an orientation is `yaw: 90 deg`, or `rpy: [0 deg, 0 deg, 90 deg]`"},
    {"frame", " origin transform tf pose ",
     "its place and orientation stand beside `parent`: `at: [0.4 m, 0 m], yaw: 10 deg`"},
    // --- robots ---
    {"a robot file",
     " left_wheel_names right_wheel_names left_wheel right_wheel wheel_separation wheel_radius wheel_base "
     "wheelbase "
     "track_width wheel_names ",
     base_is_wheels},
    {"a robot file", " type kind drive kinematics ",
     "there are no types of drives: what the `wheels` hold says what the base can do"},
    {"a robot file", " casters caster ",
     "a caster's wheel is one of `wheels`, without a motor; a ball caster's link stands in `supports`"},
    {"a robot file", " mass inertia links ", of_the_urdf},
    {"a robot file", " max_velocity max_speed max_acceleration ", "write `limits: {velocity: {x: +-1 m/s}}`"},
    {"a wheel", " type kind ", "a mecanum or omni wheel has a `roller: 45 deg`; a plain one has none"},
    {"a wheel", " diameter ", "write the `radius`, half of it"},
    {"a wheel", " position at xyz link offset width ", of_the_urdf},
    {"actuator", " velocity max_velocity speed lower upper limits ",
     "the URDF's `<limit>` says a joint's speed and travel, `limits` the base's speed"},
    {"`footprint`", " radius length width size box circle ", corners},
    {"`limits`", " x y rz yaw linear angular ",
     "first the quantity, then the axis: `velocity: {x: +-1 m/s}`"},
    // --- scenes ---
    {"object", " type shape geom geometry size sphere mesh ", shape},
    {"a scene file", " friction mu ", "write `floor: {friction: 0.9}`"},
    {"a scene file", " robot ",
     "the robot stands at `start: {at: [0 m, 0 m], yaw: 20 deg}`; others beside it are `robots`"},
    {"`state`", " noise ",
     "write `position: 1 cm` and `yaw: 1 deg`, or what a fix has: `fix: {noise: 1 cm}`"},
    // --- scenarios ---
    {"an expectation", " never ", "write `always: not (..)`"},
    {"an expectation", " eventually ", "write `within: 10 s`, and `that: ..`"},
    {"an expectation", " tolerance ", "compare the distance: `that: abs(truth.base.x - 1 m) < 1 cm`"},
};

}  // namespace

std::string way_out(std::string_view what, std::string_view key) {
  if (key.empty() || key.find(' ') != std::string_view::npos) return {};
  const std::string word = " " + std::string(key) + " ";
  for (const WayOut& way : ways) {
    if (what.starts_with(way.what) && way.keys.find(word) != std::string_view::npos)
      return std::string(way.help);
  }
  // `xy_goal_tolerance` of a task's part.
  const bool is_of_a_task = what.starts_with("task") || what.starts_with("constraint group") ||
                            what.starts_with("axis") || what.starts_with("an exit");
  const bool is_tolerance = key.ends_with("tolerance") || key == "precision" || key == "accuracy";
  return is_of_a_task && is_tolerance ? std::string(how_near) : "";
}

}  // namespace zwang::lang
