#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> robots() {
  static constexpr std::array entries{
      Explanation{
          .code = "E801",
          .title = "a joint or link that the robot file uses and does not have",
          .why =
              R"~(The robot file names a joint as a wheel or an actuator, and the URDF or the file's own `fixed` holds it.
Or it names a part that its own `ignore` leaves out.)~",
          .fix =
              R"~(Name the joint that turns, or take it out of `fixed` or `ignore`. If the URDF fixes this one, it was
written for a picture of the robot: list the joint under `turns`, or make it `continuous` there.)~",
          .part = ExcerptOf::urdf,
          .example = R"~(<joint name="left" type="fixed">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
</joint>)~",
          .instead = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~"},
      Explanation{
          .code = "E802",
          .title = "a wheel that could not work",
          .why =
              R"~(A wheel turns on its own joint and holds some direction on the ground: its roller's axis, or rolling
and sideways. The message says which rule this wheel breaks. It slides, is named twice, or turns
about an axis that points up. It holds a direction that no wheel can hold, or has rollers that let
it drive nothing. It slides sideways though it is steered, or hangs on a rocker or a spring. Or one
of `supports` moves.)~",
          .fix =
              R"~(Give mecanum and omni wheels a `roller`: the angle from the wheel's axis to the roller's at the
ground, about the base's +z. Plain wheels need none. `holds: [rolling]` is for skid steering.)~",
          .part = ExcerptOf::robot,
          .example = R"~(wheels:
  - {joint: left, radius: 0.1 m, roller: 45 deg, holds: [rolling]}
  - {joint: right, radius: 0.1 m})~",
          .instead = R"~(wheels:
  - {joint: left, radius: 0.1 m, holds: [rolling]}
  - {joint: right, radius: 0.1 m})~"},
      Explanation{
          .code = "E803",
          .title = "a base that hangs on a moving joint",
          .why =
              R"~(`base` is the link that the wheels carry and that floats with three freedoms above the ground. A
link below a moving joint is somewhere else whenever that joint moves.)~",
          .fix = "Name the link that hangs on nothing that moves, often `base_link` or `base_footprint`.",
          .part = ExcerptOf::robot,
          .example = "base: left_link",
          .instead = "base: base_link"},
      Explanation{
          .code = "E804",
          .title = "a motor without strength",
          .why =
              R"~(The motors bound every task: zwang plans with their largest torque and never commands more. Neither
the robot file nor the URDF gives it for this joint.)~",
          .fix =
              R"~(Add `effort` with the largest torque on the wheel's side of the gear, from the data sheet. A URDF
that says `effort="0"` says nothing.)~",
          .part = ExcerptOf::urdf,
          .example = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
</joint>)~",
          .instead = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~"},
      Explanation{
          .code = "E805",
          .title = "friction compensated in full",
          .why =
              R"~(Suppose that zwang gives back all of the friction. If the friction is a little lower than measured,
the robot then keeps rolling by itself.)~",
          .fix = "Stay below 100 %; 80 % is usual.",
          .part = ExcerptOf::robot,
          .example = "friction: {left: {coulomb: 0.1 N m, compensate: 110 %}}",
          .instead = "friction: {left: {coulomb: 0.1 N m, compensate: 80 %}}"},
      Explanation{.code = "E806",
                  .title = "a limit that forbids standing still",
                  .why = "Limits of the robot hold at all times. A range without zero would demand motion "
                         "even when nothing runs; one that is nothing but zero would never let it move.",
                  .fix = "Write a range through 0, for example `+-1 m/s`.",
                  .part = ExcerptOf::robot,
                  .example = "limits: {velocity: {x: [0.1 m/s, 1 m/s]}}",
                  .instead = "limits: {velocity: {x: [0 m/s, 1 m/s]}}"},
      Explanation{
          .code = "E807",
          .title = "a footprint without area",
          .why = "The footprint is the outline of the robot on the floor; regions are kept by its corners.",
          .fix = "Give three corners or more, in the order in which one would walk around the robot.",
          .part = ExcerptOf::robot,
          .example = "footprint: {polygon: [[0.3 m, 0 m], [-0.3 m, 0 m]]}",
          .instead =
              "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], [0.3 m, -0.2 m]]}"},
      Explanation{
          .code = "E808",
          .title = "a body that cannot exist",
          .why =
              R"~(A link that moves needs a mass above zero, and inertias that a real body could have. Each of the
three inertias is at most the sum of the other two. With other numbers the robot's accelerations
would be nonsense, or infinite.)~",
          .fix =
              R"~(List the link under `inertias` in the robot file. It counts as a solid disc or ball then, and the URDF
stays as it is. `zwang robot init` drafts that section. Or correct the link in the URDF: the inertia of a
box of mass m and sides a, b, c about its centre is m (b^2 + c^2) / 12, and so on.)~",
          .part = ExcerptOf::urdf,
          .example = R"~(<link name="left_link">
  <inertial>
    <mass value="0"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>
  </inertial>
</link>)~",
          .instead = R"~(<link name="left_link">
  <inertial>
    <mass value="1"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~"},
      Explanation{.code = "E809",
                  .title = "a joint that starts outside its limits",
                  .why = "`posture` is where the joints stand at the start, and what it does not name stands "
                         "at 0. Beyond "
                         "its limits a joint cannot stand: a simulation would throw it to its stop.",
                  .fix = "Choose a value between the joint's limits in the URDF, or correct these."},
      Explanation{
          .code = "W809",
          .title = "an arm's joint that starts close to an end of its travel",
          .why =
              R"~(The guard stops the robot before a joint of an arm leaves its travel. An arm that is held sways a little
while the base speeds up and presses. Closer to an end than 2 deg, or 5 mm where the joint slides, that
little is enough. A joint that stands at the end itself rests on it.)~",
          .fix = "Choose a `posture` farther inside."},
      Explanation{
          .code = "E810",
          .title = "wheels that do not stand on one level",
          .why =
              R"~(All wheels touch one floor. The lowest point of each follows from its joint's place in the URDF and
its `radius`. zwang levels out 2 mm about the middle, or 2 % of the smallest radius. A larger
difference is a wrong number.)~",
          .fix = "Mend the radius, or the height of the joint's `<origin>`: origin z - radius is the same "
                 "for all.",
          .part = ExcerptOf::robot,
          .example = "wheels: [{joint: left, radius: 200 mm}, {joint: right, radius: 100 mm}]",
          .instead = "wheels: [{joint: left, radius: 100 mm}, {joint: right, radius: 100 mm}]"},
      Explanation{
          .code = "E811",
          .title = "a control period that is too long, or too short",
          .why =
              R"~(Near a limit zwang brakes within 10 ms, so torques have to come at least 100 times a second. In a
slower loop the robot would press, and pass limits, before a tick notices.)~",
          .fix = "Say how often the loop that embeds zwang steps it, or close a faster loop on the robot.",
          .part = ExcerptOf::robot,
          .example = "control_period: 50 ms",
          .instead = "control_period: 10 ms"},
      Explanation{
          .code = "E814",
          .title = "a drive that zwang does not run yet",
          .why =
              R"~(A torque limit of each wheel goes with the velocity of each wheel, not with the base's twist. Twists for
wheels that swivel, and velocities for joints that turn no wheel, are not built.)~",
          .fix = "Command wheels. A drive that takes only the base's twist has a torque limit of its own.",
          .part = ExcerptOf::robot,
          .example =
              "drive: {command: velocity, as: twist, rate: 100 Hz, delay: 10 ms, time_constant: 20 ms, "
              "integral_time: 100 ms, torque_limit: each_cycle}",
          .instead =
              "drive: {command: velocity, as: twist, rate: 100 Hz, delay: 10 ms, time_constant: 20 ms, "
              "integral_time: 100 ms, torque_limit: fixed}"},
      Explanation{
          .code = "E815",
          .title = "a drive that cannot be",
          .why =
              R"~(`rate`, `delay` and the loop's times belong to drives that take velocities. Samples that are older than
those of a drive of 20 Hz with a delay of 50 ms have not been tried: nobody knows what the base does then.)~",
          .fix = "Give what the drive's manual says, and leave out what it does not have.",
          .part = ExcerptOf::robot,
          .example = "drive: {command: torque, rate: 100 Hz}",
          .instead = "drive: {command: torque}"},
      Explanation{
          .code = "W812",
          .title = "a wheel that is drawn beside its axle",
          .why =
              R"~(Two wheels on one axle let a base turn. A wheel that is drawn a micron beside the axle would forbid
it, in exact arithmetic. So zwang moves wheels onto the nearest exact place, by 5 mm and 2 deg at
most. There, axes are level and along the base's x or y, one axle passes the base's origin, and
steered wheels stand below their steering. The warning begins at 0.1 mm and 0.05 deg. Angles such as
1.57 and 3.14 in a URDF are the usual cause.)~",
          .fix =
              R"~(Write angles with all their digits, 3.141592653589793. If the axle really stands beside the origin
of `base`, name a link that stands on the axle as `base`.)~",
          .part = ExcerptOf::urdf,
          .example = R"~(<joint name="right" type="continuous">
  <parent link="base_link"/>
  <child link="right_link"/>
  <origin xyz="0.0013 -0.2 0.1" rpy="0 0 3.14"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~",
          .instead = R"~(<joint name="right" type="continuous">
  <parent link="base_link"/>
  <child link="right_link"/>
  <origin xyz="0 -0.2 0.1" rpy="0 0 3.141592653589793"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~"},
      Explanation{
          .code = "E816",
          .title = "a robot file that is based on itself",
          .why =
              R"~(`based_on` names another robot file, which says every key that is not said here. That file may be based on a third
one, up to 8 in a row. A chain that leads back to one of its files never ends. `zwang robot init --update` changes files that
stand by themselves.)~",
          .fix = "Remove the `based_on` that leads back."},
      Explanation{
          .code = "E873",
          .title = "a pad that is not the end of an arm",
          .why =
              R"~(`pads` says how large the flat end of an arm is: its four corners touch objects in the place of a
point. The base touches with its footprint and a wheel with the floor, so a pad there would touch
nothing.)~",
          .fix = "Name a frame of a link that a motor moves, whose x axis points out of the pad."},
      Explanation{
          .code = "E813",
          .title = "encoders that are too coarse",
          .why =
              R"~(The guard bounds motion that motors should make and no encoder confirms, by four steps of the encoder. With 63 steps
a turn a wheel of 75 mm goes 3 cm blindly, and a base is as fast as 0.25 m/s by then. Beyond that nothing is bounded.)~",
          .fix = "Give the least change of the wheel's angle that the robot reports, gear included.",
          .part = ExcerptOf::robot,
          .example = "encoder_step: 12 deg",
          .instead = "encoder_step: 0.01 deg"},
      Explanation{
          .code = "W813",
          .title = "encoders with coarse steps",
          .why =
              R"~(Encoders that are dead say what those of a standing base say. The guard therefore lets the motors move the base by
0.5 mm at a wheel's rim until an encoder confirms it, or by four steps of the encoder if that is more. The base stops later,
and faster, the coarser its encoders are. A wheel that a wall holds may turn by less than a step while the base slides along
the wall. The guard then takes its encoder for dead, and stops a sound robot.)~",
          .fix = "Read the encoders with all of their edges, or on the motor's side of the gear, if the "
                 "robot can do that.",
          .part = ExcerptOf::robot,
          .example = "encoder_step: 4 deg",
          .instead = "encoder_step: 0.01 deg"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
