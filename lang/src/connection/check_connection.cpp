#include <algorithm>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_connection.hpp"
#include "robot/wheel_speed.hpp"
#include "zwang/lang/configurations.hpp"
#include "zwang/lang/connection.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::lang {

namespace {

constexpr double rounding_of_rates = 1e-9;  // 1 / (1 / 3 Hz) is not 3 Hz to the last bit

SignalType measured_by(MessageType type) {
  switch (type) {
    case MessageType::pose_stamped:
      return SignalType::pose;
    case MessageType::wrench_stamped:
      return SignalType::wrench;
    case MessageType::float64:
    case MessageType::laser_scan:
      return SignalType::number;
    default:
      return SignalType::boolean;
  }
}

std::vector<std::string> joint_names(const Program& program, bool with_motor) {
  std::vector<std::string> names;
  for (int j = 0; j < program.robot.model.joint_count(); ++j) {
    const solver::Joint& joint = program.robot.model.joint(j);
    if (!with_motor || joint.actuated) names.push_back(joint.name);
  }
  return names;
}

void check_signals(const Connection& connection, const Program& program, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const Signal& signal : program.signals) known.push_back(signal.name);
  for (const SignalSource& source : connection.signals) {
    const auto signal = std::find_if(program.signals.begin(), program.signals.end(),
                                     [&](const Signal& s) { return s.name == source.name; });
    // One connection serves several tasks: a signal that this one does not read is no mistake.
    if (signal == program.signals.end()) continue;
    if (signal->type != measured_by(source.type))
      diagnostics.add(
          wording::signal_of_another_type(source.span, source.name, to_string(source.type), signal->span));
  }
  for (const Signal& signal : program.signals) {
    const bool has_source = std::any_of(connection.signals.begin(), connection.signals.end(),
                                        [&](const SignalSource& s) { return s.name == signal.name; });
    if (!has_source)
      diagnostics.add(wording::signal_without_source(signal.span, signal.name, connection.path));
  }
}

void check_outputs(const Connection& connection, const Program& program, Diagnostics& diagnostics) {
  for (const Output& output : program.outputs) {
    const auto sink = std::find_if(connection.outputs.begin(), connection.outputs.end(),
                                   [&](const OutputSink& s) { return s.name == output.name; });
    if (sink == connection.outputs.end()) {
      diagnostics.add(
          wording::output_without_sink(output.span, output.name, output.is_number, connection.path));
    } else if ((sink->type == MessageType::float64) != output.is_number) {
      diagnostics.add(
          wording::output_of_another_type(sink->span, output.name, to_string(sink->type), output.span));
    }
  }
}

void check_order(const CommandSink& command, const Program& program, Diagnostics& diagnostics) {
  const std::vector<std::string> motors = joint_names(program, true);
  for (std::size_t i = 0; i < command.order.size(); ++i) {
    const std::string& name = command.order[i];
    if (std::find(motors.begin(), motors.end(), name) == motors.end())
      diagnostics.add(wording::unknown_name(command.order_spans[i], "joint with a motor", name, motors));
    if (std::count(command.order.begin(), command.order.begin() + static_cast<std::ptrdiff_t>(i), name) > 0)
      diagnostics.add(wording::wrong_command(
          command.order_spans[i], "joint `" + name + "` stands twice in `order`", "name each joint once"));
  }
  for (const std::string& motor : motors) {
    if (std::find(command.order.begin(), command.order.end(), motor) == command.order.end())
      diagnostics.add(wording::wrong_command(command.span,
                                             "`order` leaves out the motor of joint `" + motor + "`",
                                             "add `" + motor + "` where its controller expects it"));
  }
}

/// A held force F accelerates a base of mass m by F/m. After v m/F its wheels turn at their largest speed v.
/// A receiver that waits so long stops a base that has run away.
void check_held_torque(const CommandSink& command, const Robot& robot, Diagnostics& diagnostics) {
  if (!command.timeout || *command.timeout > given_up_after) return;  // told already
  if (robot.model.has_fixed_base()) return;
  const solver::BaseAnalysis base = solver::analyse_base(robot.model, start_state(robot));
  double within = solver::infinity, speed = 0.0;
  for (const solver::Axis axis : {solver::Axis::x, solver::Axis::y}) {
    const solver::AxisAnalysis can = usable(base.axes[axis == solver::Axis::x ? 0 : 1]);
    const double most = wheel_speed_along(robot, axis).most;
    const double time = most * can.effective_mass / can.largest_force;
    if (!can.reachable || !(time < within)) continue;
    within = time;
    speed = most;
  }
  if (*command.timeout > within)
    diagnostics.add(wording::torque_held_too_long(command.timeout_span, *command.timeout, speed, within));
}

void check_command(const CommandSink& command, const Program& program, Diagnostics& diagnostics) {
  const Drive& drive = program.robot.drive;
  const char* const sent = command.kind == CommandKind::twist    ? "twists"
                           : command.kind == CommandKind::effort ? "efforts"
                                                                 : "wheel velocities";
  const char* const taken = drive.takes_twist      ? "twists"
                            : drive.takes_velocity ? "wheel velocities"
                                                   : "efforts";
  if (std::string(sent) != taken) {
    diagnostics.add(wording::wrong_command(
        command.span,
        std::string("the connection sends ") + sent + ", the robot file's `drive` takes " + taken,
        drive.takes_twist ? "write `twist: {topic: /cmd_vel, type: geometry_msgs/Twist}`"
        : drive.takes_velocity
            ? "write `joints: {.., what: velocity, ..}`, or `as: twist` in the robot file"
            : "write `joints: {.., what: effort, ..}`, or give the robot file a `drive` with "
              "`command: velocity` and `as: twist`"));
    return;
  }
  if (command.kind == CommandKind::velocity && !drive.limit_is_fixed)
    diagnostics.add(wording::wrong_command(
        command.span, "the drive takes a torque limit with each velocity, and a Float64MultiArray has none",
        "give the robot file `torque_limit: fixed`"));
  const double cycle = command.rate ? 1.0 / *command.rate : program.robot.control_period;
  if (command.timeout && *command.timeout <= cycle)
    diagnostics.add(wording::too_short_timeout(command.span, cycle));
  if (command.kind == CommandKind::effort) check_held_torque(command, program.robot, diagnostics);
  if (command.kind != CommandKind::twist) check_order(command, program, diagnostics);
}

/// Samples come once a cycle of the robot at most, commands leave once a control period at most. A stop is a
/// command: with a slower rate it comes later than `stale_after` promises.
void check_times(const Connection& connection, const Program& program, Diagnostics& diagnostics) {
  const Drive& drive = program.robot.drive;
  const JointsSource& joints = connection.joints;
  const double sampled = drive.takes_velocity ? 1.0 / drive.rate : program.robot.control_period;
  if (joints.stale_span.exists() && joints.stale_after <= sampled)
    diagnostics.add(wording::stale_at_once(joints.stale_span, joints.stale_after, sampled));
  const CommandSink& command = connection.command;
  if (!command.rate) return;
  if (1.0 / *command.rate < (1.0 - rounding_of_rates) * program.robot.control_period)
    diagnostics.add(wording::rate_too_high(command.rate_span, *command.rate, program.robot.control_period));
  if (drive.takes_velocity && *command.rate < (1.0 - rounding_of_rates) * drive.rate)
    diagnostics.add(wording::rate_below_drive(command.rate_span, *command.rate, drive.rate));
  if (1.0 / *command.rate > joints.stale_after)
    diagnostics.add(wording::rate_too_low(command.rate_span, *command.rate, joints.stale_after));
}

}  // namespace

bool check_connection(const Connection& connection, const Program& program, Diagnostics& diagnostics) {
  const int errors_before = diagnostics.error_count();
  const std::vector<std::string> joints = joint_names(program, false);
  for (const auto& [name, span] : connection.joints.name_spans) {
    if (std::find(joints.begin(), joints.end(), name) == joints.end())
      diagnostics.add(wording::unknown_name(span, "joint", name, joints));
  }
  check_signals(connection, program, diagnostics);
  check_outputs(connection, program, diagnostics);
  if (program.robot.drive.feels.by == Feels::By::wrench && !connection.wrench)
    diagnostics.add(wording::feeling_without_topic(connection.joints.topic.span));
  check_command(connection.command, program, diagnostics);
  check_times(connection, program, diagnostics);
  diagnostics.settle();
  return diagnostics.error_count() == errors_before;
}

}  // namespace zwang::lang
