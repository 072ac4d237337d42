#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> constraints() {
  static constexpr std::array entries{
      Explanation{
          .code = "E401",
          .title = "an axis is driven twice",
          .why =
              R"~(A single value drives, and an axis obeys one driver. It cannot be moved at a velocity and pushed
with a force at once: the world decides one of the two. Two lines on one axis can be a driver and
its limit.)~",
          .fix = "Keep one single value and write the others as ranges.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s, force: 20 N}",
          .instead = "x: {velocity: 0.1 m/s, force: +-5 N}"},
      Explanation{
          .code = "W402",
          .title = "a driver asks for more than `always` allows",
          .why =
              R"~(Limits of `always` hold first. The driver will never reach its value, and an exit that waits for it
will never fire.)~",
          .fix = "Ask for a value within the limit, or, if the limit is too narrow, widen it where it is "
                 "written.",
          .part = ExcerptOf::task_file,
          .example = R"~(always:
  constraints:
    manners: {move: base, in: base, x: {velocity: +-0.5 m/s}}
tasks:
  go:
    constraints:
      drive: {move: base, in: base, x: {velocity: 0.9 m/s}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(always:
  constraints:
    manners: {move: base, in: base, x: {velocity: +-0.5 m/s}}
tasks:
  go:
    constraints:
      drive: {move: base, in: base, x: {velocity: 0.4 m/s}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E403",
          .title = "an empty range",
          .why = "The lower end of a range is above its upper end: no value at all lies within.",
          .fix = "Write the lower end first. With negative numbers that is the one farther from zero.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: [0.08 m/s, -0.05 m/s]}",
          .instead = "x: {velocity: [-0.05 m/s, 0.08 m/s]}"},
      Explanation{
          .code = "E404",
          .title = "an axis that this base cannot move",
          .why =
              R"~(A wheeled base stands on the ground, which holds its height, roll and pitch; some drives hold its
sideways motion too. A driver there asks for a motion that no torque can make. A range is no demand,
and standing still costs nothing: both may stay.)~",
          .fix =
              R"~(Leave the axis out. Where a base of two freedoms shall move sideways, move a frame that lies ahead
of the axle: turning carries it to the side.)~",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s}\nz: {velocity: 0.1 m/s}",
          .instead = "x: {velocity: 0.1 m/s}"},
      Explanation{
          .code = "E405",
          .title = "a position in axes that move along",
          .why =
              R"~(Seen from its own axes a frame is always at the same place; however the robot drives, the number
stays what it is. So a position there can be neither reached nor kept, and a region on a frame of
the base never bounds the base.)~",
          .fix =
              R"~(Give the position in a frame of the world. `here` is allowed: it means the place in the world at
which the task was entered. Or drive a velocity. Give a region a parent in the world.)~",
          .part = ExcerptOf::group,
          .example = "move: bumper\nin: base\nx: {position: 1 m}",
          .instead = "move: bumper\nin: world\nx: {position: 1 m}"},
      Explanation{
          .code = "E406",
          .title = "more equality rows than freedoms",
          .why =
              R"~(A base that the ground leaves two freedoms can be told where to go in two ways, not in three. At one
level nothing says which row gives way, so all of them would miss their values a little.)~",
          .fix =
              R"~(Leave a row out, give it a later `level`, or a `weight`, which makes it soft. On a base of two
freedoms drive x and y of a frame ahead of the axle; the heading follows.)~",
          .part = ExcerptOf::task_file,
          .example = R"~(frames:
  nose: {parent: base, at: [0.3 m, 0 m]}
tasks:
  go:
    constraints:
      come: {move: nose, in: world, x: {position: 1 m}, y: {position: 0 m}, rz: {position: 0 deg}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(frames:
  nose: {parent: base, at: [0.3 m, 0 m]}
tasks:
  go:
    constraints:
      come: {move: nose, in: world, x: {position: 1 m}, y: {position: 0 m}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "W407",
          .title = "a row that others already imply",
          .why =
              R"~(Two rows drive the same motion, whatever the robot's pose. With equal values one of them does
nothing; with different ones neither is met.)~",
          .fix = "Leave one of them out, or write it as a range.",
          .part = ExcerptOf::task,
          .example = R"~(constraints:
  go: {move: base, in: base, x: {velocity: 0.1 m/s}}
  too: {move: bumper, in: base, x: {velocity: 0.1 m/s}})~",
          .instead = R"~(constraints:
  go: {move: base, in: base, x: {velocity: 0.1 m/s}}
  too: {move: bumper, in: base, x: {velocity: +-0.2 m/s}})~"},
      Explanation{
          .code = "E408",
          .title = "a force range without zero",
          .why =
              R"~(A force range says how much may be spent. Where nothing stands in the way no force is needed, and a
range from 5 N up would forbid just that. That zero is always allowed is what makes every task
solvable.)~",
          .fix = "Write the range from 0 or through 0. If the robot shall press, a single force does it.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s, force: [5 N, 20 N]}",
          .instead = "x: {velocity: 0.1 m/s, force: [0 N, 5 N]}"},
      Explanation{
          .code = "E409",
          .title = "a frame that nothing can move",
          .why =
              R"~(`move` names what the robot moves: one of its links, or a frame that is carried by one. This frame
stands in the world. For the same reason `speed` and `moved` of it are always 0, and a condition
that asks for them is decided before the run.)~",
          .fix = "Swap the two: move a frame of the robot, `in` this one. In a condition, name a frame of "
                 "the robot.",
          .part = ExcerptOf::group,
          .example = "move: world\nin: base",
          .instead = "move: base\nin: world"},
      Explanation{.code = "E410",
                  .title = "a region without area",
                  .why = "The corners lie on a line or are fewer than three: there is no inside to stay in.",
                  .fix = "Give three corners or more, in the order in which one would walk around.",
                  .part = ExcerptOf::task_file,
                  .example = R"~(regions:
  hall: {polygon: [[0 m, 0 m], [4 m, 0 m]]}
tasks:
  go:
    constraints:
      stay: {move: footprint, inside: hall}
    timeout: {after: 10 s, goto: failed})~",
                  .instead = R"~(regions:
  hall: {polygon: [[0 m, 0 m], [4 m, 0 m], [4 m, 3 m], [0 m, 3 m]]}
tasks:
  go:
    constraints:
      stay: {move: footprint, inside: hall}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{.code = "E411",
                  .title = "a direction that points nowhere",
                  .why = "A direction is a sum of axes with coefficients; all of them are zero or absent.",
                  .fix = "Give at least one of x, y, z, rx, ry, rz a coefficient that is not zero.",
                  .part = ExcerptOf::task_file,
                  .example = R"~(features:
  slant: {direction: {move: base, in: world, x: 0, y: 0}}
tasks:
  go:
    constraints:
      slide: {feature: slant, velocity: 0.1 m/s}
    timeout: {after: 10 s, goto: failed})~",
                  .instead = R"~(features:
  slant: {direction: {move: base, in: world, x: 1, y: 1}}
tasks:
  go:
    constraints:
      slide: {feature: slant, velocity: 0.1 m/s}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E412",
          .title = "a feature that never changes",
          .why =
              R"~(Both frames are carried by the same link, so the distance or angle between them is fixed when the
robot is built. No motion can change it.)~",
          .fix = "Measure from a frame of the robot to a frame of the world, or of another link.",
          .part = ExcerptOf::task_file,
          .example = R"~(features:
  gap: {distance: [base, bumper]}
tasks:
  go:
    constraints:
      near: {feature: gap, velocity: -0.1 m/s}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(features:
  gap: {distance: [bumper, world]}
tasks:
  go:
    constraints:
      near: {feature: gap, velocity: -0.1 m/s}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E413",
          .title = "a place that a feature never comes to",
          .why =
              R"~(A distance is 0 or more, and the angle between two axes lies from 0 to half a turn: neither says on
which side something is. A target or a range beyond that is never reached.)~",
          .fix = "Give a place within. Where the side matters, use an axis of a frame, or a `direction`: "
                 "both have a "
                 "sign.",
          .part = ExcerptOf::task_file,
          .example = R"~(features:
  gap: {distance: [bumper, world]}
tasks:
  go:
    constraints:
      near: {feature: gap, position: -0.2 m}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(features:
  gap: {distance: [bumper, world]}
tasks:
  go:
    constraints:
      near: {feature: gap, position: 0.2 m}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E414",
          .title = "a boundary with no inside",
          .why =
              R"~(A point stays farther inside than the `margin`, a footprint with all its corners. No point of this
region lies that deep, so the opposite edges push against each other and the base swings between
them.)~",
          .fix = "Make the margin smaller or the region larger.",
          .part = ExcerptOf::task_file,
          .example = R"~(regions:
  hall: {polygon: [[-1 m, -1 m], [1 m, -1 m], [1 m, 1 m], [-1 m, 1 m]]}
tasks:
  go:
    constraints:
      stay: {move: footprint, inside: hall, margin: 3 m}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(regions:
  hall: {polygon: [[-1 m, -1 m], [1 m, -1 m], [1 m, 1 m], [-1 m, 1 m]]}
tasks:
  go:
    constraints:
      stay: {move: footprint, inside: hall, margin: 0.3 m}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E415",
          .title = "a norm that is to drive",
          .why =
              R"~(`plane` bounds how large a velocity, an acceleration or a force in the plane is, in whatever direction. It begins at 0:
a norm has no direction to drive in, and nothing keeps it up.)~",
          .fix = "Drive `x` and `y`, and give `plane` ranges that begin at 0.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.1 m/s}\nplane: {velocity: 0.5 m/s}",
          .instead = "x: {velocity: 0.1 m/s}\nplane: {velocity: [0 m/s, 0.5 m/s]}"},
      Explanation{
          .code = "E417",
          .title = "a yield that rings in any hand",
          .why =
              R"~(The driver makes the robot feel like a much lighter body, and it knows the force late. Something that
holds it with less than 1 kN/m already sets it swinging: a hand is stiffer than that.)~",
          .fix = "Write the mass of the message. W618 is the same, of a yield that a soft hand holds.",
          .part = ExcerptOf::group,
          .example = "x: {yield: estimated.force.x, mass: 2 kg, damping: 5 N s/m}",
          .instead = "x: {yield: estimated.force.x, mass: 60 kg, damping: 80 N s/m}"},
      Explanation{
          .code = "E418",
          .title = "an output without a stop",
          .why =
              R"~(A robot that stops lets go of what it holds, or keeps it: nobody but you knows which is safe. A
gripper with a load should stay shut, a magnet of a door should open.)~",
          .fix = "Say `stop: keep`, or the value that is safe.",
          .part = ExcerptOf::task_file,
          .example = R"~(outputs:
  gripper: {type: bool}
tasks:
  go:
    enter: {set: {outputs.gripper: true}}
    timeout: {after: 1 s, goto: done})~",
          .instead = R"~(outputs:
  gripper: {type: bool, stop: keep}
tasks:
  go:
    enter: {set: {outputs.gripper: true}}
    timeout: {after: 1 s, goto: done})~"},
      Explanation{
          .code = "E419",
          .title = "a path that cannot be drawn",
          .why =
              R"~(A fillet of radius r takes r tan(turn/2) of the lines on both sides of its corner. Two corners share
the line between them. A path that turns back has no fillet, and one place alone has no direction.)~",
          .fix = "Take the radius of the message, move the points apart, or write two paths.",
          .part = ExcerptOf::task_file,
          .example = R"~(paths: {way: {through: [[0 m, 0 m], [3 m, 0 m], [3 m, 2 m]], fillet: 2.5 m}}
tasks:
  go:
    constraints:
      go: {move: bumper, in: way, x: {velocity: 0.3 m/s}, y: {position: 0 m}}
    exits: [{when: go.x.position > length(way), for: 20 ms, goto: done}]
    timeout: {after: 60 s, goto: failed})~",
          .instead = R"~(paths: {way: {through: [[0 m, 0 m], [3 m, 0 m], [3 m, 2 m]], fillet: 0.6 m}}
tasks:
  go:
    constraints:
      go: {move: bumper, in: way, x: {velocity: 0.3 m/s}, y: {position: 0 m}}
    exits: [{when: go.x.position > length(way), for: 20 ms, goto: done}]
    timeout: {after: 60 s, goto: failed})~"},
      Explanation{
          .code = "E420",
          .title = "an axis that a path does not have",
          .why =
              R"~(A path lies in a plane: a frame has its way along it (`x`), its offset to the left (`y`), its height
(`z`) and its heading against the tangent (`rz`). Norms and the other angles do not turn with it.)~",
          .fix = "State it in a group of its own, in the world or in the moved frame.",
          .part = ExcerptOf::task_file,
          .example = R"~(paths: {way: {through: [[0 m, 0 m], [3 m, 0 m]]}}
tasks:
  go:
    constraints:
      go: {move: bumper, in: way, x: {velocity: 0.3 m/s}, y: {position: 0 m}, plane: {velocity: [0 m/s, 0.4 m/s]}}
    exits: [{when: go.x.position > length(way), for: 20 ms, goto: done}]
    timeout: {after: 60 s, goto: failed})~",
          .instead = R"~(paths: {way: {through: [[0 m, 0 m], [3 m, 0 m]]}}
tasks:
  go:
    constraints:
      go: {move: bumper, in: way, x: {velocity: 0.3 m/s}, y: {position: 0 m}}
      calm: {move: bumper, in: world, plane: {velocity: [0 m/s, 0.4 m/s]}}
    exits: [{when: go.x.position > length(way), for: 20 ms, goto: done}]
    timeout: {after: 60 s, goto: failed})~"},
      Explanation{
          .code = "W617",
          .title = "a yield along another axis than its force",
          .why =
              R"~(The force is measured along an axis of one frame, and the robot gives way along an axis of another.
Where the two lie apart, it stands still where it is pushed, or moves aside. A force that is taken
for motion along the axis, and is none, can stop the robot. Axes of the world and of the base turn
apart with the base.)~",
          .fix =
              R"~(Write the frame of the force as `in`, or take the part of the force along this axis. A row that
keeps the base at its heading keeps the axes together, too.)~",
          .part = ExcerptOf::group,
          .example =
              "move: base_link\nin: world\nx: {yield: estimated.force.x, mass: 60 kg, damping: 80 N s/m}",
          .instead = "move: base_link\nin: base_link\nx: {yield: estimated.force.x, mass: 60 kg, damping: 80 "
                     "N s/m}"},
      Explanation{
          .code = "W646",
          .title = "a freedom that a distance or a bearing leaves to nothing",
          .why =
              R"~(A distance to a point is one row, and so is a bearing. A base of three freedoms can circle the point
with both of them met. No row asks for this motion, and no row stops it. Noise of a camera sets it
going, and the base goes round a person who stands.)~",
          .fix = R"~(Hold the other freedoms on a later level. Its rows use only what the features leave:
`still: {move: base, in: base, level: 2, x: {velocity: 0 m/s}, y: {velocity: 0 m/s},
rz: {velocity: 0 rad/s}}`. If something else moves the base along an axis, write the axis as
`free`.)~"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
