#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

/// What reads well and cannot work on this robot. The examples' robot weighs 22.4 kg along x and its motors
/// make 100 N.
std::span<const Explanation> reach() {
  static constexpr std::array entries{
      Explanation{
          .code = "W416",
          .title = "ranges that exclude each other",
          .why =
              R"~(Two ranges in force exclude each other, or a driver asks for a value that a range on its axis never
allows. The robot ends somewhere between, and the file says nothing about where. Ranges of `always`,
of the task and of the robot file count alike. A region leaves a range of each position, two points of
a base stay as far apart as they are on it, and the motors bound the acceleration.)~",
          .fix = "Widen one of the two, take one out, or ask for a value that is in both.",
          .part = ExcerptOf::task,
          .example = R"~(constraints:
  go: {move: base, in: base, x: {velocity: [0.2 m/s, 0.5 m/s]}}
  calm: {move: base, in: base, x: {velocity: +-0.1 m/s}}
timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(constraints:
  go: {move: base, in: base, x: {velocity: [0.2 m/s, 0.5 m/s]}}
  calm: {move: base, in: base, x: {velocity: +-0.3 m/s}}
timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "W510",
          .title = "tasks that no way leads out of",
          .why =
              R"~(A run ends at `done` or `failed`. No exit or timeout of these tasks leads there, and no exit of
`always`. A way does not count if an exit that waits for time alone fires before it.)~",
          .fix =
              R"~(Let an exit or a timeout lead to `done` or `failed`. A patrol that is meant to last is stopped by a
signal: `always: {exits: [{when: stop_key, goto: failed}]}`.)~",
          .part = ExcerptOf::task_file,
          .example = R"~(tasks:
  go:
    timeout: {after: 10 s, goto: rest}
  rest:
    timeout: {after: 10 s, goto: go})~",
          .instead = R"~(tasks:
  go:
    timeout: {after: 10 s, goto: rest}
  rest:
    timeout: {after: 10 s, goto: done})~"},
      Explanation{
          .code = "W511",
          .title = "an exit that the ranges in force decide",
          .why =
              R"~(Ranges exclude the value that the condition asks for, or the timeout comes first, or the condition
is true at once on entry. An exit to `failed` may watch over a range of positions or speeds, because
a person may push the robot: that is no warning. Regions in force count as ranges of positions, and
as the longest way of a base that drives straight on. `entries` is at most 1 without a way back.)~",
          .fix = "Compare with a value that the ranges leave, or take the exit out.",
          .part = ExcerptOf::task,
          .example = R"~(constraints:
  go: {move: base, in: base, x: {velocity: 0.1 m/s, force: +-5 N}}
exits:
  - {when: go.x.force > 10 N, for: 0.1 s, goto: done}
timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(constraints:
  go: {move: base, in: base, x: {velocity: 0.1 m/s, force: +-5 N}}
exits:
  - {when: go.x.force > 4 N, for: 0.1 s, goto: done}
timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "W512",
          .title = "two exits that lead to and fro at once",
          .why =
              R"~(One exit leads from a task to another, the other leads back, and one value of what both measure
makes both true. The run then changes between the two tasks before either has faded in.)~",
          .fix = "Leave a gap between the two thresholds, or let one of the two wait with `for`.",
          .part = ExcerptOf::task_file,
          .example = R"~(signals:
  nearest: {type: number, unit: m, stale_after: 200 ms}
tasks:
  go:
    exits:
      - {when: nearest < 1 m, for: 20 ms, goto: wait}
    timeout: {after: 10 s, goto: failed}
  wait:
    exits:
      - {when: nearest > 0.8 m, for: 20 ms, goto: go}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(signals:
  nearest: {type: number, unit: m, stale_after: 200 ms}
tasks:
  go:
    exits:
      - {when: nearest < 1 m, for: 20 ms, goto: wait}
    timeout: {after: 10 s, goto: failed}
  wait:
    exits:
      - {when: nearest > 1.2 m, for: 20 ms, goto: go}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "W513",
          .title = "a frame that is set from what may not be known",
          .why =
              R"~(A frame on a pose signal is nowhere before the first sample, and while the signal is older than its
`stale_after`. A frame that is set from it then has no place. The run would drive to a false goal, so
it ends `failed` instead. The same is true of a set frame that hangs on such a signal itself.)~",
          .fix =
              R"~(Ask `valid(signal)` in the exit that sets the frame, or in each exit that leads to the task that
sets it on entry. The task before then waits for the signal; its timeout says for how long.)~",
          .part = ExcerptOf::task_file,
          .example = R"~(signals:
  partner: {type: pose, in: base, stale_after: 300 ms}
frames:
  seen: {parent: partner}
  place: {parent: world}
tasks:
  go:
    exits:
      - {when: elapsed > 1 s, goto: drive, set: {frames.place: seen}}
    timeout: {after: 10 s, goto: failed}
  drive:
    constraints:
      go: {move: base, in: place, x: {position: -1 m, velocity: +-0.2 m/s}}
    timeout: {after: 10 s, goto: done})~",
          .instead = R"~(signals:
  partner: {type: pose, in: base, stale_after: 300 ms}
frames:
  seen: {parent: partner}
  place: {parent: world}
tasks:
  go:
    exits:
      - {when: elapsed > 1 s and valid(partner), goto: drive, set: {frames.place: seen}}
    timeout: {after: 10 s, goto: failed}
  drive:
    constraints:
      go: {move: base, in: place, x: {position: -1 m, velocity: +-0.2 m/s}}
    timeout: {after: 10 s, goto: done})~"},
      Explanation{
          .code = "W619",
          .title = "a force range of which less than half is made",
          .why =
              R"~(A blocked motion driver presses with its effective mass times the acceleration that it asks for: m v
/ T for a velocity. An acceleration limit may leave less. Nothing adds up over time. Friction above
that holds it up for ever.)~",
          .fix =
              R"~(Say what it makes, shorten the `time_constant`, or press with a force and limit the velocity:
`x: {force: 20 N, velocity: +-0.05 m/s}`.)~",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.05 m/s, force: +-20 N}",
          .instead = "x: {force: 20 N, velocity: +-0.05 m/s}"},
      Explanation{
          .code = "N616",
          .title = "a target that is trailed",
          .why =
              R"~(A pose signal is taken to stand between two samples, and a position driver damps its motion against
axes that stand. So it follows a target that goes on at v by 2 T v late.)~",
          .fix = "Give the signal a `twist`: then its frame goes on between two samples, and velocities "
                 "count against it.",
          .part = ExcerptOf::task_file,
          .example = R"~(signals:
  guide: {type: pose, in: base, stale_after: 600 ms}
frames: {person: {parent: guide}}
tasks:
  go:
    constraints:
      gap: {move: base, in: person, x: {position: -0.9 m, velocity: +-0.6 m/s}}
    timeout: {after: 60 s, goto: done})~",
          .instead = R"~(signals:
  guide: {type: pose, in: base, stale_after: 600 ms, twist: 0.5 s}
frames: {person: {parent: guide}}
tasks:
  go:
    constraints:
      gap: {move: base, in: person, x: {position: -0.9 m, velocity: +-0.6 m/s}}
    timeout: {after: 60 s, goto: done})~"},
      Explanation{
          .code = "N622",
          .title = "a heading along a path that nothing is left for",
          .why =
              R"~(A base of two freedoms meets two rows. If x and y of a point ahead of the axle are driven along a
path, nothing is left for its heading. It turns into a straight path by itself: to a third after each
length from the axle to the point.)~",
          .fix = "Leave `rz` out, or keep the line for bases with three freedoms: it does no harm."},
      Explanation{
          .code = "W618",
          .title = "a yield that rings when it is held",
          .why =
              R"~(The driver makes the robot feel lighter than it is, and it knows the force late: by 20 ms if it is
estimated. Something that holds it more stiffly than the message says makes the two swing against each
other. A clamp has 100 kN/m.)~",
          .fix = "Write the mass of the message: with that it holds still in any hand.",
          .part = ExcerptOf::group,
          .example = "x: {yield: estimated.force.x, mass: 8 kg, damping: 80 N s/m}",
          .instead = "x: {yield: estimated.force.x, mass: 60 kg, damping: 80 N s/m}"},
      Explanation{
          .code = "N619",
          .title = "what an acceleration limit leaves of a force range",
          .why =
              R"~(A position driver asks for the more the farther it has to go, up to its force range. An acceleration
limit in force leaves its effective mass times the limit: that is what the base presses with, where
this is less.)~",
          .fix = "Narrow the force range to say so, or allow more acceleration.",
          .part = ExcerptOf::group,
          .example = "move: bumper\nin: world\nx: {position: 1 m, force: +-40 N, acceleration: +-0.5 m/s^2}",
          .instead = "move: bumper\nin: world\nx: {position: 1 m, force: +-10 N, acceleration: +-0.5 m/s^2}"},
      Explanation{
          .code = "W620",
          .title = "a guard on a distance that fires too late",
          .why =
              R"~(Between the true distance and the brake lie the signal's `stale_after`, the exit's `for` and half of
the blend. Then the base brakes with what its ranges leave: v^2/2a + a T^2/2. A distance counts from
the base's origin, so the footprint is added. Behind a drive that feels, a force brakes a virtual robot
that is several times as heavy. Conditions beside the distance that are true of a moving base, and
distances to what a pose signal measures, are guards, too.)~",
          .fix = "Ask earlier, drive more slowly, or brake harder: the message has the numbers.",
          .part = ExcerptOf::task_file,
          .example = R"~(signals:
  nearest: {type: number, unit: m, stale_after: 200 ms}
tasks:
  go:
    constraints:
      go: {move: base, in: base, x: {velocity: 0.5 m/s, acceleration: +-0.5 m/s^2}}
    exits:
      - {when: nearest < 0.5 m, for: 0.1 s, goto: stand}
    timeout: {after: 10 s, goto: failed}
  stand:
    constraints:
      still: {move: base, in: base, x: {velocity: 0 m/s, acceleration: +-0.5 m/s^2}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(signals:
  nearest: {type: number, unit: m, stale_after: 200 ms}
tasks:
  go:
    constraints:
      go: {move: base, in: base, x: {velocity: 0.5 m/s, acceleration: +-0.5 m/s^2}}
    exits:
      - {when: nearest < 1.2 m, for: 0.1 s, goto: stand}
    timeout: {after: 10 s, goto: failed}
  stand:
    constraints:
      still: {move: base, in: base, x: {velocity: 0 m/s, acceleration: +-0.5 m/s^2}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E621",
          .title = "a base that cannot tell square from stuck",
          .why =
              R"~(The task leaves the heading free, presses, and an exit waits until the heading rests. The wheels of
this base hold its heading. Or the floor holds wheels that slide sideways, with a larger moment than
the push has at a corner. The base rests as askew as it came, and the exit would call that square.)~",
          .fix = "Drive `rz` to a measured angle, or take a base that a wall can turn."},
      Explanation{
          .code = "W621",
          .title = "a free heading that no wall turns",
          .why =
              R"~(The heading is free, so that what the base presses on may turn it. The floor holds wheels that slide
sideways with mu m g l, more than the push has at a corner of the footprint.)~",
          .fix = "Drive `rz` to a measured angle, press harder, or take a base that a wall can turn."},
      Explanation{
          .code = "W615",
          .title = "a circle that the norm of the acceleration does not allow",
          .why =
              R"~(A base that drives ahead at v and turns at w goes around a circle, and its point accelerates towards the centre with w v. The
axes' own accelerations are 0 then; `plane` bounds the acceleration of the point, and slows the base down. A fillet of radius
r that is driven along at v needs v^2/r; where the norm allows less, the base leaves the path.)~",
          .fix = "Turn or drive more slowly, or allow the acceleration: the message has the numbers.",
          .part = ExcerptOf::group,
          .example =
              "x: {velocity: 0.8 m/s}\nrz: {velocity: 1 rad/s}\nplane: {acceleration: [0 m/s^2, 0.3 m/s^2]}",
          .instead = "x: {velocity: 0.8 m/s}\nrz: {velocity: 0.3 rad/s}\nplane: {acceleration: [0 m/s^2, 0.3 "
                     "m/s^2]}"},
      Explanation{
          .code = "W641",
          .title = "two ranges that are meant as a norm",
          .why =
              R"~(Equal ranges on x and on y are a box: at 45 deg both together allow 1.41 times as much as either. An acceleration range of an
axis bounds the rate of that axis's velocity, and nothing of what a turn adds.)~",
          .fix = "Write `plane`: it bounds the norm in any direction. If a box is meant, silence the line."},
      Explanation{
          .code = "E630",
          .title = "a force on a robot that cannot feel",
          .why =
              R"~(A drive with a torque limit of its own (`torque_limit: fixed`) pushes until its wheels turn as they
are told. zwang sends velocities and learns of no force, so nothing would keep what the task says.)~",
          .fix =
              "Say how fast the base may go, and let a signal tell of contact: a bumper or a force sensor. "
              "Forces need a drive that takes torques, a torque limit in each cycle, or a robot that "
              "`feels`."},
      Explanation{
          .code = "E631",
          .title = "a robot that feels contacts too late",
          .why =
              R"~(A drive with torque limits of its own presses until its command changes, and that changes when a sensor
tells of the contact. Between both lie the sensor's filter, a cycle and the delay. Beyond some time no virtual robot, however heavy, stands
still at a wall: base and wall would swing against each other.)~",
          .fix = "Shorten the delay, as the message says, or raise the rate. A loop with a larger T_i, or a "
                 "slower "
                 "one, helps, too."},
      Explanation{
          .code = "W632",
          .title = "a robot that is slow in contact",
          .why =
              R"~(What this robot feels comes late. So the virtual robot that leads it is heavy, and its velocities fade while
something presses on it. A task that waits until a wall has squared the base up waits longer than on torques.)~",
          .fix = "Give such tasks longer timeouts. If this is known, silence the line."},
      Explanation{
          .code = "W635",
          .title = "a robot that pushes with all that its motors have",
          .why =
              R"~(The drive has a torque limit of its own and measures no force. At an obstacle the base pushes with
that limit. The guard latches the protective stop once a wheel stays behind what it is told by 2 cm/s and 30 %
for 0.3 s, or by 5 mm/s and 30 % for 1.2 s. Until then nothing bounds the push but the motors.)~",
          .fix =
              "Keep people out of the way, or lower the torque limit in the drive. If this is known, silence "
              "the line."},
      Explanation{
          .code = "E634",
          .title = "an estimated force on a drive that takes velocities",
          .why =
              R"~(`estimated.force` is what the wheels' motion lacks of the torques that were sent. A drive that takes
velocities makes its torques itself, and does not tell them: only their bounds are known. A robot that `feels` has what it
feels in its place.)~",
          .fix = "Ask whether a row is `saturated`: the base is slower there than its force lets it be. Or "
                 "measure "
                 "the force, with a signal."},
      Explanation{
          .code = "W643",
          .title = "motion that the steering does not allow",
          .why =
              R"~(A steering that no row turns is held where it stands at the start. As it stands, the wheels hold
this axis, and no driver of the base's own axes steers: nothing moves.)~",
          .fix =
              R"~(Drive ahead along `x`, and point the steering at the place:
`features: {look: {bearing: [STEERED_LINK, PLACE]}}`, and a group `{feature: look, position: 0 deg}`. The way follows
(`specs/approach_car.yaml`). Or turn the steering in an earlier task,
`steer: {move: STEERED_LINK, in: base, rz: {position: 20 deg}}`, or start with it turned (`posture` in the robot file).)~"},
      Explanation{
          .code = "W645",
          .title = "a push across the way of driven casters",
          .why =
              R"~(A driven wheel on a free swivel turns its heading only as it rolls. A base on such wheels comes off a
wall beside its way, comes back at an angle, and is driven into the wall. In the simulation it hops along
walls of 5 kN/m and more: 10 N are 0 to 270 N there. A box that gives way is pressed evenly.)~",
          .fix = "Press while the base stands, as `wall_align` does, or keep the side at a distance by a "
                 "`position`. Mecanum and omni wheels press while they drive."},
      Explanation{
          .code = "W868",
          .title = "rollers that are mirrored",
          .why =
              R"~(A base on mecanum wheels turns by the lever of its rollers, the sum of half its length and half its
width. Mirrored, the two are taken from each other: x and y work, and a tenth of the torque is left
to turn with. If single rollers are mirrored, half of the force along an axis may be lost: every
arrangement is tried, and the one with the greatest forces along x, y and about z is taken as meant.)~",
          .fix =
              R"~(`roller` is the angle from the wheel's axis to the roller *on the ground*. Usual: 45 deg at front
left and rear right, -45 deg at the others. Seen from above it is mirrored: change the sign at every
wheel.)~"},
      Explanation{
          .code = "W869",
          .title = "a wheel that turns across its own cylinder",
          .why =
              R"~(The link's largest round shape is a cylinder, and the joint's axis does not point along it. As
drawn, it would roll over its edge, because zwang rolls the wheel about the joint's axis. A URDF
gives the axis in the link's axes; this one may be in the parent's.)~",
          .fix = "Let the joint's `<axis>` point along the cylinder, or turn the shape's `<origin rpy>`."},
      Explanation{
          .code = "W870",
          .title = "a wheel or a swivel with more inertia than its mass can have",
          .why =
              R"~(A wheel of mass m and radius R has at most m R^2 about its axle, if all of it is on the rim. URDFs that
were written for a picture have 1 kg m^2 everywhere. The base then seems many times as heavy along the floor, and every force
and acceleration is computed for that. The mass of a swivel lies within three times the reach of its wheel
from its axis.)~",
          .fix = "List the wheel's link under `inertias` in the robot file, as `left_wheel_link: {}`. It "
                 "counts as a solid "
                 "disc then, 1/2 m R^2 about the axle; a swivel's, as `fork: {radius: 50 mm}`, as a solid "
                 "ball. Or mend the URDF."},
      Explanation{
          .code = "W871",
          .title = "an inertia that is nearly a body's",
          .why =
              R"~(No moment of inertia of a body about its centre of mass is larger than the sum of the other two. This
link breaks the rule by little. zwang moves its moments to the nearest ones that keep it, by 10 % of the largest at most.
Beyond that the robot is refused (E808).)~",
          .fix = "Correct the link's `<inertia>`. Exporters of drawings give the products of inertia either "
                 "sign."},
      Explanation{
          .code = "W872",
          .title = "motors that no floor can take up",
          .why =
              R"~(The wheels press against the floor with their torques over their radii, and they spin before a floor holds
more than mu m g. With mu = 1.5, soft rubber on clean, dry concrete, and a load as heavy as the robot itself, that is three
times the robot's weight. A URDF that states more was written for a simulator. zwang would reckon with that push: in `plan`,
in E601 and in the guard.)~",
          .fix = "Write the motor's torque on the joint's side into the robot file, as `actuated: "
                 "{left_wheel: {effort: 2 N "
                 "m}}`, or once for all wheels as `each_wheel: {effort: 2 N m}`. Data sheets state it, or "
                 "the motor's "
                 "torque, which the gear multiplies. What the robot file states is believed."},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
