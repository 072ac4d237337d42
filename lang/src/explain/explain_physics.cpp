#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

/// What needs the robot's model to be found. The examples' robot weighs 22.4 kg along x, wheels included, and
/// its motors make 100 N.
std::span<const Explanation> physics() {
  static constexpr std::array entries{
      Explanation{
          .code = "E601",
          .title = "a push that an acceleration limit caps",
          .why =
              R"~(Before a contact zwang knows nothing of it: it predicts the acceleration that the force would give
in the open and keeps that within the limit. So the robot presses with its effective mass times the
limit, and no harder. The mass has wheels and rotors in it; `zwang plan` shows it.)~",
          .fix = "Ask for less force, or allow more acceleration: the message has both numbers.",
          .part = ExcerptOf::group,
          .example = "x: {force: 20 N, acceleration: +-0.3 m/s^2}",
          .instead = "x: {force: 20 N, acceleration: +-1 m/s^2}"},
      Explanation{
          .code = "W601",
          .title = "a push that an acceleration limit caps in some cases",
          .why =
              R"~(The acceleration limit leaves enough force now, but not always. The parameter's range allows more,
or the effective mass is smaller at other joint angles, or a spring is drawn farther.)~",
          .fix = "Narrow the parameter's range, ask for less, or allow more acceleration.",
          .part = ExcerptOf::task_file,
          .example = R"~(params:
  push: {value: 5 N, range: [1 N, 20 N]}
tasks:
  go:
    constraints:
      press: {move: base, in: base, x: {force: $push, acceleration: +-0.3 m/s^2}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(params:
  push: {value: 5 N, range: [1 N, 6 N]}
tasks:
  go:
    constraints:
      press: {move: base, in: base, x: {force: $push, acceleration: +-0.3 m/s^2}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "W602",
          .title = "a guard on `saturated` that never fires",
          .why =
              R"~(Blocked, a velocity driver asks for the acceleration velocity / time_constant and presses with the
effective mass times that. When this is less than the axis's force range, the driver never comes to
its bound and `saturated` stays false, however hard the obstacle. Without a force range the bound is
what the motors make.)~",
          .fix = "Narrow the force range or shorten the `time_constant`: the message has both numbers.",
          .part = ExcerptOf::task,
          .example = R"~(constraints:
  go: {move: base, in: base, x: {velocity: 0.05 m/s, force: +-20 N}}
exits:
  - {when: go.x.saturated, for: 0.1 s, goto: done}
timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(constraints:
  go: {move: base, in: base, x: {velocity: 0.05 m/s, force: +-20 N, time_constant: 50 ms}}
exits:
  - {when: go.x.saturated, for: 0.1 s, goto: done}
timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "N603",
          .title = "how hard the first hit is",
          .why =
              R"~(A force range bounds the force that the robot presses with. It cannot bound the momentum with which
the robot arrives: a mass m at the speed v runs into the springs and dampers of what it hits. All
corners that strike together count. Without a push the peak is v sqrt(K m) times 1 undamped, 0.81 at
a damping ratio of 0.27, 1 at 0.5, and 2 at 1. The driver pushes on: a constant force F makes it
F + sqrt(F^2 + K m v^2).

In the first task the note names the object straight ahead, and the way to it gives the speed:
v = sqrt(2 a s). Elsewhere the hardest object of the scene gives a bound: "up to".

* An object on a joint is light on its free way. Its friction and its preload hold it. At the stop
  it is a wall.
* Another robot counts with its mass and its skin. The note leaves the speed of its task out, and
  says "not counting".
* A script counts with its largest speed. The note leaves hands and payloads out, and names them.
* The simulation cannot follow very stiff objects: it feels less than their stiffness says.

Without a scene the robot file's bumper is hit. With a force range F the note appears above 2.5 F,
and gives the speed below which it is gone.)~",
          .fix = "Arrive more slowly, or put a softer bumper on and say so in the robot file.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.15 m/s, force: +-40 N, time_constant: 50 ms}",
          .instead = "x: {velocity: 0.06 m/s, force: +-40 N, time_constant: 50 ms}"},
      Explanation{
          .code = "W604",
          .title = "a time constant that is too short",
          .why =
              R"~(A position driver that arrives at the velocity v brakes hardest with v / (2.718 time_constant).
Where its acceleration range, or its force range over the effective mass, allows less, it
overshoots. And no driver can be faster than the robot's `control_period`, 1 ms, lets it be: 4 of
them for a velocity, 8 for a position.)~",
          .fix = "Lengthen the `time_constant` to what the message says, or lower the velocity.",
          .part = ExcerptOf::group,
          .example =
              "move: bumper\nin: world\nx: {position: 1 m, velocity: +-0.5 m/s, acceleration: +-0.3 m/s^2}",
          .instead =
              "move: bumper\nin: world\nx: {position: 1 m, velocity: +-0.5 m/s, acceleration: +-0.3 m/s^2, "
              "time_constant: 0.7 s}"},
      Explanation{
          .code = "N605",
          .title = "what other rows may add to a limited direction",
          .why =
              R"~(A force range beside a driver bounds this row only. Rows along other axes that share the direction
press as well, each within its own range.)~",
          .fix =
              R"~(Bound the sum: a force range alone on an axis, best under `always`, holds for all rows together.)~",
          .part = ExcerptOf::task_file,
          .example = R"~(frames:
  askew: {parent: base, yaw: 30 deg}
tasks:
  go:
    constraints:
      go: {move: base, in: base, x: {velocity: 0.01 m/s, force: +-40 N, time_constant: 10 ms}}
      stand: {move: base, in: askew, x: {velocity: 0 m/s}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(tasks:
  go:
    constraints:
      go: {move: base, in: base, x: {velocity: 0.01 m/s, force: +-40 N, time_constant: 10 ms}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "W606",
          .title = "a driver beyond the motors",
          .why =
              R"~(From rest, the driver asks for more than the wheels' torques make along this axis. It runs at the
motors' limit and does not follow its time constant.)~",
          .fix = "Ask for less, or lengthen the `time_constant`: the message has the number.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 1 m/s, time_constant: 0.1 s}",
          .instead = "x: {velocity: 1 m/s, time_constant: 0.3 s}"},
      Explanation{
          .code = "W607",
          .title = "a boundary that the motors cannot hold",
          .why =
              R"~(Before a boundary the robot counts on a deceleration: the axis's acceleration range, else the robot
file's. Times the effective mass that is a force, and the motors make less: the boundary can be
overrun. A base that skids makes none sideways: a boundary that it stands askew to does not hold it
back at all.)~",
          .fix = "Limit the acceleration to what the message says. A base that skids: keep it square to the "
                 "boundary, or where it cannot come to one.",
          .part = ExcerptOf::group,
          .example = "in: world\nx: {velocity: 0.1 m/s, position: [-1 m, 1 m], acceleration: +-6.5 m/s^2}",
          .instead = "in: world\nx: {velocity: 0.1 m/s, position: [-1 m, 1 m], acceleration: +-5 m/s^2}"},
      Explanation{
          .code = "W609",
          .title = "a free axis that the wheels hold",
          .why =
              R"~(An axis is left free so that what touches the base may move it: a wall turns it square, a socket
guides its hook. Where the wheels hold the axis nothing does, and the task may end `done` without
what it was meant for. Steered wheels hold the axis only while nobody steers: nothing is said where
a row of the task does.)~",
          .fix = "Leave the axis out where it does not matter; else take a base that can be moved along it.",
          .part = ExcerptOf::group,
          .example = "x: {force: 1 N}\ny: free",
          .instead = "x: {force: 1 N}\nrz: free"},
      Explanation{
          .code = "N608",
          .title = "a file too large to be asked about the robot's model",
          .why =
              R"~(zwang asks the robot's model about each axis that a file moves. That takes little time on a base
with four wheels, and much on a robot with a hundred joints. Checking always ends within two
seconds; past that nothing is said about what the robot can do.)~",
          .fix = "Split the file: a task file is one action, and a mission is made of several above it."},
      Explanation{
          .code = "W610",
          .title = "a driver that may not move anything",
          .why =
              R"~(A range of accelerations or forces ends at 0, or next to it, in the direction of the driver. The
range wins: the axis stands still for ever, and nothing fails. A velocity range of 0 beside a
position does the same.)~",
          .fix = "Widen the range. To stand still write `velocity: 0 m/s`.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s, acceleration: [0 m/s^2, 0 m/s^2]}",
          .instead = "x: {velocity: 0.1 m/s, acceleration: [0 m/s^2, 0.5 m/s^2]}"},
      Explanation{
          .code = "W611",
          .title = "a speed that the wheels do not turn to",
          .why =
              R"~(The `<limit velocity>` of the URDF says how fast a wheel's motor turns. To go this fast along the
axis a wheel would have to turn faster: a real motor does not, while zwang plans and simulates as if
it did. Along axes of the world, and of `speed`, nobody knows yet which way the base heads: there a
speed is told that it reaches in no direction.)~",
          .fix = "Stay within the speed of the message, or correct the URDF.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 4 m/s, time_constant: 2 s}",
          .instead = "x: {velocity: 1 m/s, time_constant: 2 s}"},
      Explanation{
          .code = "W612",
          .title = "an arm without the force limit that its base has",
          .why =
              R"~(A force range bounds the force at the frame that its group moves. A row that moves a frame of the
arm against the world pushes with all motors, the wheels' too. Only its own range bounds it. Without
a range, an arm that meets an obstacle presses with its effective mass times the acceleration that
it asks for. The base's own limit does not matter then. A row between the arm and the base presses
no harder than the base for long: the base gives way.)~",
          .fix = "Give the arm's axis a force range of its own, or a force range alone on that axis under "
                 "`always`."},
      Explanation{
          .code = "W613",
          .title = "a distance that is to vanish",
          .why =
              R"~(The distance of two points grows along the line between them, and two points that are one have no
such line. Drawn to a distance of 0 the base never stands: what little it moves across the line
makes it circle about the point, faster and faster. Heights count: a frame of the base never comes
nearer to a point than their difference in height. Below that distance the base swings across the
point with all that its ranges allow.)~",
          .fix = "Keep a distance; or drive two axes to the point, x and y of a group, on a base that moves "
                 "both ways.",
          .part = ExcerptOf::task_file,
          .example = R"~(frames:
  goal: {parent: world, at: [1 m, 0 m]}
features:
  gap: {distance: [base, goal]}
tasks:
  go:
    constraints:
      near: {feature: gap, position: 0 m}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(frames:
  goal: {parent: world, at: [1 m, 0 m]}
features:
  gap: {distance: [base, goal]}
tasks:
  go:
    constraints:
      near: {feature: gap, position: 0.2 m}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "W614",
          .title = "a base that holds itself up once it is askew",
          .why =
              R"~(A base of two freedoms, a differential one, goes only where it heads. Square to an axis of the world
it cannot move along it, and to stand still there asks for nothing. Askew by a hair it does move
along it, by v sin(psi). It can then stand still only by not moving at all. The row takes as much
force as that needs, and a base that should press on a wall backs off. In its own axes sideways
stays sideways.)~",
          .fix = "Stand still in the base's own axes, in a group of its own: `sideways: {move: base, in: "
                 "base, y: {velocity: 0 m/s}}`. Or give the axis a later `level`: it gives way then.",
          .part = ExcerptOf::task_file,
          .example = R"~(frames:
  wall: {parent: world}
tasks:
  go:
    constraints:
      contact: {move: base, in: wall, x: {force: 5 N}, y: {velocity: 0 m/s}}
    timeout: {after: 10 s, goto: done})~",
          .instead = R"~(frames:
  wall: {parent: world}
tasks:
  go:
    constraints:
      contact: {move: base, in: wall, x: {force: 5 N}}
      sideways: {move: base, in: base, y: {velocity: 0 m/s}}
    timeout: {after: 10 s, goto: done})~"},
      Explanation{
          .code = "E640",
          .title = "a base that falls over as it stands",
          .why =
              R"~(A base stands as long as its centre of mass lies above the area between its wheels and supports.
The centre is that of the whole robot, with its arm in `posture`. The message gives the distance from
the edge of that area.)~",
          .fix = "Name every link that carries the base in `supports`; or mend the masses and places in the "
                 "URDF."},
      Explanation{
          .code = "W640",
          .title = "a motion or a push that could tip the base over",
          .why =
              R"~(The centre of mass lies d inside an edge of the supports, and h above the floor. If the base speeds
up away from that edge with more than g d / h, it tips over it. A push away from it at the height z
tips it from m g d / z on. zwang compares both with what the drivers ask for, and the first one with
the deceleration of the protective stop.)~",
          .fix =
              "Limit the acceleration or the force to less than the message says. If the robot file does not "
              "say `bumper: {height: ..}` and the height matters, say it."},
      Explanation{
          .code = "W642",
          .title = "more force than the floor holds",
          .why =
              R"~(A wheel passes on at most mu N, by friction. If a driver asks for more, the wheels slip: the base
presses with less, and the wheels count a way that the base does not go. On three points the loads N
are known. On more points zwang takes the largest sum that statics allow. The protective stop brakes
with m a, and is asked, too.)~",
          .fix = "Ask for less force or acceleration, or correct `floor: {friction: ..}` of the scene."},
      Explanation{
          .code = "E633",
          .title = "a base that cannot tell square from slow",
          .why =
              R"~(The heading is free, the task presses, and an exit waits until the heading hardly turns. Behind a drive
that feels, a wall turns the virtual robot with F b / (alpha gamma I), b beside the line of the push. The later
a robot feels, the larger alpha gamma is. If that turn is slower than the exit asks for, the exit is true of a base
that is still askew. zwang asks for a base that comes 25 deg askew.)~",
          .fix =
              "Press harder, ask for a slower turn, or drive `rz` to a measured angle: the message has the "
              "numbers."},
      Explanation{
          .code = "W644",
          .title = "an object that a bumper of unknown height may pass",
          .why =
              R"~(A base touches objects at the height of its bumper, and passes above lower ones. The robot file does
not say that height, and the object is low: nobody knows whether the two touch. zwang takes the base
to be twice as high as its centre of mass.)~",
          .fix = "Say `bumper: {height: ..}` in the robot file: measure from the floor to where the base "
                 "touches first."},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
