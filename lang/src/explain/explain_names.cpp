#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> names() {
  static constexpr std::array entries{
      Explanation{
          .code = "E301",
          .title = "an unknown name",
          .why =
              R"~(A frame, a task, a group, a parameter, a signal, a region, a feature, a joint or a link is named
that nobody declared. Frames come from the robot's URDF, from the robot file and from `frames:`.)~",
          .fix =
              R"~(Take the name that the help suggests, or declare it. An axis can be measured in a condition only if
its group names it; `rz: free` does that and holds nothing.)~",
          .part = ExcerptOf::group,
          .example = "move: bumpr\nin: base",
          .instead = "move: bumper\nin: base"},
      Explanation{
          .code = "W302",
          .title = "declared and never used",
          .why =
              R"~(A parameter, frame, signal, region, feature, template or argument that nothing refers to is left
over, or the place that should refer to it does not. Setting an unused parameter changes nothing,
which surprises whoever sets it.)~",
          .fix = "Use it, or delete it.",
          .part = ExcerptOf::task_file,
          .example = "params:\n  push: 20 N",
          .instead = R"~(params:
  push: 20 N
tasks:
  go:
    constraints:
      contact: {move: base, in: base, x: {force: $push}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E303",
          .title = "a template used in a way that it does not allow",
          .why =
              R"~(A template names its arguments and their kinds. A use gives each of them, with a value of that kind,
and no other. A template that uses itself would never end.)~",
          .fix = "Give the template what its `args:` ask for.",
          .part = ExcerptOf::task_file,
          .example = R"~(templates:
  drive:
    args: {pace: velocity}
    body:
      constraints:
        go: {move: base, in: base, x: {velocity: $pace}}
      timeout: {after: 3 s, goto: done}
tasks:
  go: {use: drive, with: {pace: 3 N}})~",
          .instead = R"~(templates:
  drive:
    args: {pace: velocity}
    body:
      constraints:
        go: {move: base, in: base, x: {velocity: $pace}}
      timeout: {after: 3 s, goto: done}
tasks:
  go: {use: drive, with: {pace: 0.1 m/s}})~"},
      Explanation{
          .code = "E304",
          .title = "frames that hang on each other",
          .why = R"~(The place of a frame is known once its parent's is. In a loop none ever is. A frame that
has the name of a signal hides it: as its own parent it hangs on itself.)~",
          .fix = R"~(Give one of them a parent outside of the loop: `world`, or a frame of the robot. Give a
frame on a signal a name of its own.)~",
          .part = ExcerptOf::task_file,
          .example = R"~(frames:
  shelf: {parent: rack}
  rack: {parent: shelf}
tasks:
  go:
    constraints:
      reach: {move: base, in: shelf, x: {position: 0 m}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(frames:
  shelf: {parent: rack}
  rack: {parent: world}
tasks:
  go:
    constraints:
      reach: {move: base, in: shelf, x: {position: 0 m}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{.code = "E305",
                  .title = "a name that is taken",
                  .why = "Two things that can stand in the same place have the same name: a line that names "
                         "it could mean either.",
                  .fix = "Choose another name for one of them.",
                  .part = ExcerptOf::task_file,
                  .example = R"~(frames:
  bumper: {parent: world}
tasks:
  go:
    constraints:
      reach: {move: base, in: bumper, y: {velocity: 0 m/s}}
    timeout: {after: 10 s, goto: failed})~",
                  .instead = R"~(frames:
  wall: {parent: world}
tasks:
  go:
    constraints:
      reach: {move: base, in: wall, y: {velocity: 0 m/s}}
    timeout: {after: 10 s, goto: failed})~"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
