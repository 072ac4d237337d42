#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> urdfs() {
  static constexpr std::array entries{
      Explanation{.code = "E850",
                  .title = "the URDF is too large",
                  .why = "A URDF holds at most 4 MiB. Meshes are files of their own and are not counted.",
                  .fix = "Take out what is not the robot: worlds, copies, comments."},
      Explanation{.code = "E851",
                  .title = "the URDF is nested too deeply",
                  .why = "Elements may be nested 64 deep. A URDF needs five.",
                  .fix = "Look for elements that were opened and never closed."},
      Explanation{.code = "E852",
                  .title = "an element with too many attributes",
                  .why = "An element may have 64 attributes. URDF knows none with more than six.",
                  .fix = "Take out what URDF does not know."},
      Explanation{
          .code = "E853",
          .title = "too many links",
          .why = "A robot may have 256 links.",
          .fix = "Leave out links that only draw pictures; what is fixed to a link can be part of it."},
      Explanation{
          .code = "E854",
          .title = "the URDF cannot be read as XML",
          .why =
              R"~(The text breaks a rule of XML, or its outermost element is not `<robot>`. Document types and
entities are refused: they let a file blow itself up, or read others.)~",
          .fix = "Mend the place under the mark. A tag that is opened is closed, and the innermost first.",
          .part = ExcerptOf::urdf,
          .example = R"~(<link name="left_link">
  <inertial>
    <mass value="1"/>
  </inertia>
</link>)~",
          .instead = R"~(<link name="left_link">
  <inertial>
    <mass value="1"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~"},
      Explanation{
          .code = "E855",
          .title = "xacro that nobody expanded",
          .why =
              R"~(`${wheel_mass}` is a formula of xacro, the tool that many URDFs are written for. Most readers take
it for 0 and say nothing, and the robot weighs nothing from then on.)~",
          .fix = "Run xacro on the source, `xacro robot.urdf.xacro > robot.urdf`, and use what it writes.",
          .part = ExcerptOf::urdf,
          .example = R"~(<link name="left_link">
  <inertial>
    <mass value="${wheel_mass}"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~",
          .instead = R"~(<link name="left_link">
  <inertial>
    <mass value="1"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~"},
      Explanation{
          .code = "E856",
          .title = "not a number",
          .why =
              R"~(URDF counts in SI without units, with a decimal point. `1,5` and `1.5kg` are read as 1 or as 0 by
many programs; here they are told.)~",
          .fix = "Write a plain finite number, or as many of them as the message says, with spaces between.",
          .part = ExcerptOf::urdf,
          .example = R"~(<link name="left_link">
  <inertial>
    <mass value="1,5"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~",
          .instead = R"~(<link name="left_link">
  <inertial>
    <mass value="1.5"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~"},
      Explanation{
          .code = "E857",
          .title = "links and joints that do not make a tree",
          .why =
              R"~(Every link but one hangs on exactly one joint, every joint joins two links that exist, and from the
one root all others are reached. Anything else has no equations of motion as a tree.)~",
          .fix = "Mend the name that the message gives, or add the joint or link that is missing.",
          .part = ExcerptOf::urdf,
          .example = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_lnk"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~",
          .instead = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~"},
      Explanation{
          .code = "E858",
          .title = "a mass or an inertia that is missing or impossible",
          .why =
              R"~(An `<inertial>` gives a mass that is not negative and an inertia that is not negative about any
axis. Half of one is worse than none: the rest would be taken for zero.)~",
          .fix = "Complete or correct the `<inertial>` of the link.",
          .part = ExcerptOf::urdf,
          .example = R"~(<link name="left_link">
  <inertial>
    <mass value="1"/>
    <inertia ixx="-0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~",
          .instead = R"~(<link name="left_link">
  <inertial>
    <mass value="1"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>
  </inertial>
</link>)~"},
      Explanation{
          .code = "E859",
          .title = "a joint that cannot be moved as described",
          .why =
              R"~(zwang moves revolute, continuous and prismatic joints about or along one axis, within limits whose
lower end is not above the upper. `floating` and `planar` joints are what the base does by itself.)~",
          .fix = "Give the joint a type, an axis with a direction, and limits in order.",
          .part = ExcerptOf::urdf,
          .example = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 0 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~",
          .instead = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~"},
      Explanation{
          .code = "E860",
          .title = "the URDF library refuses the robot",
          .why =
              R"~(After zwang's own checks urdfdom reads links, joints, masses and simple shapes. Other tools use this
library, too. The message quotes its complaint. It never sees materials, meshes, transmissions, or what is meant for a
simulator.)~",
          .fix = "Mend what the message quotes; `check_urdf` prints the same."},
      Explanation{
          .code = "E861",
          .title = "a wheel or a motor that mimics another joint",
          .why =
              R"~(`<mimic>` says that a mechanism moves this joint together with another one. zwang knows each joint's
own motion only: it would drive the two one against the other, and count on a mobility that the base
does not have.)~",
          .fix =
              R"~(The URDF may stay as it is. Where the joint has a motor of its own, say `mimic: {JOINT: ignore}` in the
robot file: a `<mimic>` is often left over from a display. A belt or chain between two plain wheels in line is
`coupled`: the floor keeps the two in step, and the motor of the first drives both. Other mechanisms are not
simulated: make the joint `fixed`, or `ignore` the `<mimic>` of a steering linkage. Each pivot has a motor
then.)~",
          .part = ExcerptOf::urdf,
          .example = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
  <mimic joint="right"/>
</joint>)~",
          .instead = R"~(<joint name="left" type="continuous">
  <parent link="base_link"/>
  <child link="left_link"/>
  <origin xyz="0 0.2 0.1"/>
  <axis xyz="0 1 0"/>
  <limit effort="5" velocity="10"/>
</joint>)~"},
      Explanation{
          .code = "W862",
          .title = "joints that mimic others and swing freely",
          .why =
              R"~(The fingers of a gripper often follow one of them by a `<mimic>`. zwang couples no joints, so those
that nothing drives swing as if they were loose. Mostly nobody minds: a finger weighs little.)~",
          .fix = "Where it matters list the joints under `fixed` in the robot file; else allow the warning."},
      Explanation{
          .code = "W863",
          .title = "an inertia that no body has, of a link too light to matter",
          .why =
              R"~(About some axis the inertia is negative, or it is smaller than that of a grain of dust. A body that
moves cannot have it (E858). This link is fixed to another one and has less than 0.1 % of the robot's mass. It counts as
a point. A mass below that of a grain of dust, 1e-9 kg, counts as none.)~",
          .fix = "Nothing needs to be done. `ignore: [LINK]` in the robot file leaves the link out."},
      Explanation{
          .code = "W874",
          .title = "a motor that cannot hold its arm",
          .why =
              R"~(Gravity pulls at all that hangs on the joint. With the posture of the start that is more torque than the
motor has, or more force where the joint slides. The arm sinks from the first moment on, and the guard
stops the robot.)~",
          .fix = "Write the motor's own torque into `actuated`, choose another `posture`, or hold the joint "
                 "under `fixed`. A motor needs more than that to move the arm."},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
