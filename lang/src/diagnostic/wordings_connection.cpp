#include "diagnostic/wordings_connection.hpp"

#include <cmath>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/units.hpp"
#include "zwang/lang/connection.hpp"

namespace zwang::lang::wording {

Diagnostic bad_topic(const Span& span, const std::string& name) {
  return error("E921", span, "`" + name + "` is not the name of a ROS 2 topic",
               "write it with its namespace: `/cmd_vel`, of letters, digits, single `_` and `/`");
}

Diagnostic nearest_of_a_scan(const Span& span, bool is_scan) {
  if (is_scan)
    return error("E922", span, "a LaserScan has many ranges, and the signal is one number",
                 "add the angles that count: `nearest: [-10 deg, 10 deg]`");
  return error("E922", span, "`nearest` picks a range of a sensor_msgs/LaserScan; this is another type",
               "delete it, or write `type: sensor_msgs/LaserScan`");
}

Diagnostic signal_without_source(const Span& span, const std::string& name, const std::string& connection) {
  return error("E922", span, "signal `" + name + "` has no topic: nobody would measure it",
               "add `" + name + ": {topic: .., type: ..}` to `signals` in " + connection);
}

Diagnostic signal_of_another_type(const Span& span, const std::string& name, const std::string& type,
                                  const Span& declared) {
  return with_related(error("E922", span, "signal `" + name + "` is not what a " + type + " holds",
                            "name a topic of the type that the task file declares"),
                      declared, "declared here");
}

Diagnostic output_without_sink(const Span& span, const std::string& name, bool is_number,
                               const std::string& connection) {
  const std::string type = is_number ? "std_msgs/Float64" : "std_msgs/Bool";
  return error(
      "E922", span, "output `" + name + "` has no topic: nobody would carry it out",
      "add `" + name + ": {topic: /" + name + ", type: " + type + "}` to `outputs` in " + connection);
}

Diagnostic output_of_another_type(const Span& span, const std::string& name, const std::string& type,
                                  const Span& declared) {
  return with_related(error("E922", span, "output `" + name + "` is not what a " + type + " holds",
                            "std_msgs/Bool holds a bool, std_msgs/Float64 a number in SI"),
                      declared, "declared here");
}

Diagnostic nearest_of_nothing(const Span& span) {
  return error("E922", span, "`nearest` begins where it ends, or behind that: no range lies between",
               "write the smaller angle first: `[-10 deg, 10 deg]`");
}

Diagnostic feeling_without_topic(const Span& span) {
  return error("E922", span,
               "the robot `feels` by a wrench, and no topic tells it: the robot would stop at its first tick",
               "add `wrench: {topic: /bumper/wrench}` to `state`");
}

Diagnostic topic_twice(const Span& span, const std::string& name, const Span& first) {
  return with_related(error("E922", span, "`" + name + "` carries two things: one topic has one type",
                            "name the topic of each"),
                      first, "the other one");
}

Diagnostic name_twice(const Span& span, const std::string& name, const Span& first) {
  return with_related(
      error("E922", span, "two joints are called `" + name + "` in the messages", "give each its own name"),
      first, "the other one");
}

Diagnostic one_command(const Span& span) {
  return error("E923", span, "a connection has one command: `twist` or `joints`", "keep one of them");
}

Diagnostic wrong_command(const Span& span, const std::string& what, const std::string& help) {
  return error("E923", span, what, help);
}

Diagnostic two_fixes(const Span& span) {
  return error("E925", span, "`fix` has two sources: the base cannot be in two places",
               "keep `topic` or `tf`");
}

Diagnostic frame_in_itself(const Span& span, const std::string& frame) {
  return error(
      "E925", span, "frame `" + frame + "` stands in itself: that says nothing about the base",
      "write the world's frame as `parent`, and the base's as `child`: `{parent: map, child: base_link}`");
}

Diagnostic told_and_heard(const Span& span, const std::string& frame, const Span& fix) {
  return with_related(
      error("E925", span, "zwang would place frame `" + frame + "` itself, and hear of it where the base is",
            "delete `tf` of `publish`, or take the fix from a topic"),
      fix, "heard here");
}

Diagnostic reach_of_nothing(const Span& span) {
  return error("E104", span, "`reach` names no interface: nobody could be reached",
               "write the interfaces of the robot's network, as `[eth0]`, or `loopback`");
}

Diagnostic too_short_timeout(const Span& span, double cycle) {
  return error("E923", span,
               "the receiver stops the motors between two commands: one comes each " +
                   format_number(1e3 * cycle) + " ms",
               "write the receiver's real `timeout`, or a higher `rate`; three cycles are usual");
}

Diagnostic stale_too_late(const Span& span, double stale_after) {
  return error(
      "E928", span,
      "the base would drive on for " + format_number(stale_after) + " s without a sample of its robot",
      "write three to five times the period of the topic, as `100 ms`; " + format_number(given_up_after) +
          " s is the most");
}

Diagnostic stale_at_once(const Span& span, double stale_after, double sampled) {
  return error("E928", span,
               "each sample is too old when the next one comes: the robot has one each " +
                   format_number(1e3 * sampled) + " ms, and they may be " + format_number(1e3 * stale_after) +
                   " ms old",
               "write three to five times that period: `" + format_number(5e3 * sampled) + " ms`");
}

Diagnostic rate_too_high(const Span& span, double rate, double period) {
  return error("E928", span,
               "commands cannot leave with " + format_number(rate) + " Hz: there is one each " +
                   format_number(1e3 * period) + " ms, the control period",
               "leave `rate` out, or write the rate at which the receiver reads");
}

Diagnostic rate_below_drive(const Span& span, double rate, double of_drive) {
  return error("E928", span,
               "the robot file's `drive` counts on commands at " + format_number(of_drive) +
                   " Hz, the connection sends " + format_number(rate) + " Hz",
               "leave `rate` out, or write the lower rate into the robot file, too");
}

Diagnostic rate_too_low(const Span& span, double rate, double stale_after) {
  return error("E928", span,
               "a stop would wait for up to " + format_number(std::ceil(1e3 / rate)) +
                   " ms, until the next command leaves; `stale_after` promises " +
                   format_number(1e3 * stale_after) + " ms",
               "write a `rate` of 1 / `stale_after` or more; 50 Hz is usual");
}

Diagnostic tasks_without_goals(const Span& span) {
  return error("E924", span,
               "goals name `tasks`, and this connection takes no goals: one task begins by itself",
               "add `start: goals`, or delete `tasks`");
}

Diagnostic nothing_stops_it(const Span& span, const std::string& topic) {
  return warning(
      "W920", span,
      "nothing stops this robot when zwang dies: no `timeout` of what listens to `" + topic + "` is stated",
      "find out after which silence the receiver stops the motors, and write `timeout: 500 ms`");
}

Diagnostic stopped_too_late(const Span& span, double timeout) {
  return warning(
      "W929", span,
      "when zwang dies, the base drives on with its last command for " + format_number(timeout) + " s",
      "set the receiver to stop the motors after 500 ms of silence or less, and write that; " +
          format_number(given_up_after) + " s is the most");
}

Diagnostic torque_held_too_long(const Span& span, double timeout, double speed, double within) {
  return warning("W929", span,
                 "when zwang dies, the motors hold their last torques for " + format_number(1e3 * timeout) +
                     " ms: within " + figure(1e3 * within, "ms") + " they bring the base to " +
                     figure(speed, "m/s") + ", as fast as its wheels turn",
                 "set the receiver to a shorter silence, and write that: the base gains " +
                     figure(0.1 * speed / within, "m/s") + " within 100 ms");
}

}  // namespace zwang::lang::wording
