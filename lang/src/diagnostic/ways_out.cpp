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
constexpr std::string_view bound_of_an_axis = "a bound is a range of an axis: `x: {velocity: +-0.3 m/s}`";
constexpr std::string_view bounds_of_a_group =
    "bounds are ranges in a group of `constraints`: `limits: {move: base_link, in: base_link, x: {velocity: "
    "+-0.3 m/s, acceleration: +-1 m/s^2}}`";
constexpr std::string_view way_on =
    "an exit says when a task ends and what follows: `exits: [{when: elapsed > 2 s, goto: done}]`";
constexpr std::string_view stop_of_a_robot =
    "the robot file says how it brakes at the end: `stop: {deceleration: 1 m/s^2, force: 80 N}`";
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

constexpr std::string_view corners_of_footprint =
    "a footprint is its corners: `footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], "
    "[0.3 m, -0.2 m]]}`";

constexpr WayOut ways[] = {
    // --- tasks ---
    {"constraint group",
     " axes axis linear angular twist wrench pose position velocity acceleration force torque xy xyz rpy ",
     axis_by_axis},
    {"constraint group", " in x y z rx ry rz speed ",
     "what stays `inside` a region, or is on a feature, has no axes: give them a group of their own"},
    {"constraint group", " type kind controller ",
     "a group has no type: it says which frame moves (`move`), in whose axes (`in`), and what each axis "
     "does: `x: {velocity: 0.1 m/s}`"},
    {"constraint group", " min max lower upper limit limits bounds ", bound_of_an_axis},
    {"axis", " min max lower upper limit limits bounds range ", bound},
    {"axis", " gain gains p ki i damping_ratio zeta bandwidth ",
     "there are no gains: `time_constant: 0.5 s`, or `stiffness` and `damping`"},
    {"constraint group", " gain gains p i d kp ki kd stiffness damping damping_ratio ",
     "there are no gains: `time_constant: 0.5 s`, or an axis's own `stiffness` and `damping` beside its "
     "`position`"},
    {"axis", " mode type control value setpoint desired target reference goal ",
     "an axis says its quantities by name: `position: 1 m`, `velocity: 0.1 m/s`, `force: 20 N`"},
    {"axis", " selected enabled enable active ",
     "an axis is left out where nothing is asked of it, or `free`"},
    {"constraint group", " mask selection dof dofs dimWeight dim_weight axis_mask ",
     "an axis is left out where nothing is asked of it, or `free`: `rz: free`"},
    {"constraint group", " outside avoid keep_out keepout exclude forbidden ",
     "a region is stayed `inside` of: draw one that leaves the place out, it need not be convex"},
    {"constraint group", " target objective goal setpoint desired ", axis_by_axis},
    {"an exit", " priority order ", "exits are asked from top to bottom, and the first true one wins"},
    {"task", " type kind action ", "a task has no type: its `constraints` say what it does"},
    {"task", " goal goal_pose pose waypoint waypoints ",
     "positions say where to go: `constraints: {go: {move: base_link, in: world, x: {position: 2 m}}}`"},
    {"task", " limits limit bounds max_velocity max_speed ", bounds_of_a_group},
    {"task", " stop ", stop_of_a_robot},
    {"a task file", " stop ", stop_of_a_robot},
    {"a task file", " limits limit bounds ",
     "what holds in every task are ranges under `always`: `constraints: {limits: {move: base_link, in: "
     "base_link, x: {velocity: +-0.3 m/s}}}`"},
    {"task", " blend ", "write `enter: {blend: 0.2 s}`"},
    {"template", " constraints exits timeout enter ", "what the template makes stands in its `body`"},
    {"parameter", " unit units type ", "its `value` has the unit behind the number: `value: 1 m`"},
    {"region", " x y min max size width height ",
     "a region is its corners: `polygon: [[0 m, 0 m], [2 m, 0 m], [2 m, 1 m], [0 m, 1 m]]`"},
    {"task", " when goto duration next then on_success on_failure until ", way_on},
    {"signal", " topic msg message source rate noise delay ", source},
    {"signal", " value initial ", "a signal that stays is a script with one step: `script: [[0 s, true]]`"},
    {"frame", " quat quaternion orientation_xyzw ",
     "an orientation is `yaw: 90 deg`, or `rpy: [0 deg, 0 deg, 90 deg]`"},
    {"frame", " child_frame_id child_frame child name ",
     "a frame's name is its key: `wall: {parent: world}`"},
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
    {"actuator", " friction damping coulomb viscous frictionloss ",
     "friction stands beside `actuated`: `friction: {left_wheel: {coulomb: 0.1 N m, compensate: 80 %}}`"},
    {"actuator", " command_interface command_interfaces state_interfaces mode control type ",
     "every motor is commanded by its torque: there is nothing to choose"},
    {"actuator", " efficiency ", "`effort` is what arrives at the joint, behind the gear"},
    {"`limits.", " linear angular theta yaw ", "a limit has an axis, `x`, `y` or `rz`: `{x: +-1 m/s}`"},
    {"`limits`", " max_vel_x max_vel_y max_vel_theta max_speed_xy ",
     "a limit has an axis: `velocity: {x: +-1 m/s, y: +-1 m/s, rz: +-1.5 rad/s}`"},
    {"`limits`", " acc_lim_x acc_lim_y acc_lim_theta ",
     "a limit has an axis: `acceleration: {x: +-1 m/s^2, y: +-1 m/s^2, rz: +-2 rad/s^2}`"},
    {"`limits`", " jerk ", "`slew` of an actuator bounds how fast its torque changes"},
    {"`limits`", " force torque effort ",
     "`effort` of an actuator bounds its torque, and `force` of an axis what a task presses with"},
    {"a robot file", " robot_radius footprint_padding length width ", corners_of_footprint},
    {"a robot file", " sensors laser lidar imu camera ",
     "what is measured outside is a task file's `signals`; where a sensor sits is one of `frames`"},
    {"`footprint`", " radius length width size box circle ", corners},
    {"`limits`", " x y rz yaw linear angular ",
     "first the quantity, then the axis: `velocity: {x: +-1 m/s}`"},
    // --- scenes ---
    {"object", " type shape geom geometry size sphere mesh ", shape},
    {"object", " rgba color colour material mesh_file texture contype conaffinity group condim ",
     "an object is what it feels like to touch: nothing else is said of it"},
    {"object", " solref solimp ",
     "write `stiffness: 100 kN/m` and `damping: 0.3`, a ratio to the critical one"},
    {"object", " euler quat rpy quaternion roll pitch ", "objects stand upright, and turn by `yaw: 90 deg`"},
    {"object", " diameter ", "write the `radius`, half of it"},
    {"object", " velocity vel speed twist ",
     "an object moves from point to point: `motion: [{time: 0 s, at: [2 m, 0 m]}, {time: 5 s, at: [3 m, 0 "
     "m]}]`"},
    {"a study", " task robot scene params start_at start_yaw matrix faults blend ",
     "`scenario` names a file that says it: write it there, or leave `scenario` out"},
    {"a scene file", " gravity ", "gravity is that of the earth, along the world's -z"},
    {"a scene file", " timestep dt option ",
     "a simulation takes steps of 1 ms at most; how often the robot's loop ticks is its `control_period`"},
    {"a scene file", " friction mu ", "write `floor: {friction: 0.9}`"},
    {"a scene file", " robot ",
     "the robot stands at `start: {at: [0 m, 0 m], yaw: 20 deg}`; others beside it are `robots`"},
    {"`state`", " noise ",
     "write `position: 1 cm` and `yaw: 1 deg`, or what a fix has: `fix: {noise: 1 cm}`"},
    // --- scenarios ---
    {"an expectation", " never ", "write `always: not (..)`"},
    {"an expectation", " finally end final ", "write `at: end`, and `that: ..`"},
    {"a scenario file", " repeat repeats runs iterations trials ",
     "each combination of the `matrix` is one run, and the same bits every time: another `seed`, another "
     "chance"},
    {"an expectation", " eventually ", "write `within: 10 s`, and `that: ..`"},
    {"an expectation", " tolerance ", "compare the distance: `that: abs(truth.base.x - 1 m) < 1 cm`"},
};

/// `v` of `vx`.
struct AxisPrefix {
  std::string_view prefix;
  solver::Quantity quantity;
  bool turns;
};
constexpr AxisPrefix axis_prefixes[] = {
    {"v", solver::Quantity::velocity, false},     {"vel_", solver::Quantity::velocity, false},
    {"w", solver::Quantity::velocity, true},      {"omega_", solver::Quantity::velocity, true},
    {"f", solver::Quantity::force, false},        {"force_", solver::Quantity::force, false},
    {"m", solver::Quantity::force, true},         {"torque_", solver::Quantity::force, true},
    {"a", solver::Quantity::acceleration, false}, {"acc_", solver::Quantity::acceleration, false},
};

}  // namespace

std::optional<AxisInOneWord> axis_in_one_word(std::string_view key) {
  if (key == "omega" || key == "yaw_rate") return axis_in_one_word("wz");
  for (const auto& [prefix, quantity, turns] : axis_prefixes) {
    const bool is_it = key.size() == prefix.size() + 1 && key.starts_with(prefix) &&
                       std::string_view("xyz").find(key.back()) != std::string_view::npos;
    if (is_it) return AxisInOneWord{std::string(turns ? "r" : "") + key.back(), quantity};
  }
  return std::nullopt;
}

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
