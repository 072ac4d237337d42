#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> connections() {
  static constexpr std::array entries{
      Explanation{
          .code = "W920",
          .title = "a robot that nothing stops when zwang dies",
          .why =
              R"~(A process can be killed, and a cable can be pulled. Then no command comes any more, not even a zero.
A receiver with a timeout stops the motors after a silence: `diff_drive_controller` has 0.5 s. One
without, as `forward_command_controller`, goes on with the last command for good.)~",
          .fix =
              R"~(Look up what the receiver does after a silence, try it out, and state its `timeout` under `twist` or
`joints`. A receiver without one needs an emergency stop that somebody holds.)~"},
      Explanation{
          .code = "E921",
          .title = "a name that is no ROS 2 topic",
          .why =
              R"~(ROS 2 refuses such a name, so nobody could ever be at the other end. A connection writes topics in
full, because zwang has no namespace and remaps nothing.)~",
          .fix = "Write the name that `ros2 topic list` prints, as `/base/cmd_vel`."},
      Explanation{
          .code = "E922",
          .title = "a signal or an output without a topic",
          .why =
              R"~(A signal of the task file needs a topic whose messages hold what the signal is: `Bool` a bool,
`Float64` or the `nearest` range of a `LaserScan` a number, `PoseStamped` a pose, `WrenchStamped` a
wrench. Without it the signal would never be known. An output needs one that takes it, `Bool` or
`Float64`. Without it nobody would carry it out.)~",
          .fix = "Name the topic, with its type, under `signals` or `outputs` of the connection file."},
      Explanation{
          .code = "E923",
          .title = "a command that the robot's drive does not take",
          .why =
              R"~(The robot file says what the drive takes: torques, wheel velocities, or twists of the base. The
connection has to send the same, to every motor.)~",
          .fix = "Change `command` of the connection, or `drive` of the robot file, to what the robot has."},
      Explanation{
          .code = "E924",
          .title = "tasks that no goal can begin",
          .why =
              R"~(`tasks` are the names that a goal of the action `run` can have. `zwang drive` takes goals with
`start: goals` only. Otherwise it runs the task of its command line once, and nobody could ever name
another one.)~",
          .fix = "Add `start: goals` to the connection file, or delete `tasks`."},
      Explanation{
          .code = "E925",
          .title = "a fix with two sources",
          .why =
              R"~(`fix` tells where the base is in the world, now and then. A localisation tells it on a topic of its own
or by transforms, mostly by both. They differ by their delays, so zwang takes one of them.)~",
          .fix = "Keep `topic: /amcl_pose`, or `tf: {parent: map, child: base_link}`."},
      Explanation{
          .code = "E928",
          .title = "a time of the connection that stops the robot at once, or too late",
          .why =
              R"~(`stale_after` says how long the robot may be silent before it is stopped. Below the period of its
samples it stops at once. Above 2 s the base drives on blindly, and `zwang drive` has given it up.
A stop is a command, too: with a low `rate` it leaves later than `stale_after` promises. Commands leave
once a control period at most.)~",
          .fix = "Write three to five periods of the topic as `stale_after`, and the receiver's own rate as "
                 "`rate`."},
      Explanation{
          .code = "W929",
          .title = "a receiver that stops the motors too late",
          .why =
              R"~(A command is held until the next one comes, or until the receiver's `timeout`. When zwang dies, a
base on velocities drives on for that time. A base on torques gains speed: a torque F accelerates
the mass m by F/m, until its wheels turn as fast as they can. 2 s is the longest that zwang itself
waits for a silent robot.)~",
          .fix =
              R"~(Set the receiver to a shorter silence, three to five periods of the commands, and state that
`timeout`. The file says what the receiver does: another number in it alone stops nothing.)~"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
