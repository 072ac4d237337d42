#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> quantities() {
  static constexpr std::array entries{
      Explanation{
          .code = "E201",
          .title = "a number without a unit",
          .why =
              R"~(`0.08` may be metres a second to you and millimetres to the next reader, and degrees were taken for
radians often enough. A number says what it measures, unless it measures nothing: gears, fractions,
counts.)~",
          .fix = "Write the unit behind the number. The help names the usual one, not necessarily the one "
                 "you meant.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 0.08}",
          .instead = "x: {velocity: 0.08 m/s}"},
      Explanation{
          .code = "E202",
          .title = "a quantity of the wrong kind",
          .why =
              R"~(A velocity cannot be a force, whatever the number. zwang follows the dimension of every quantity,
through parameters and through every sum, product and comparison of a condition. Angles have a
dimension of their own here: `deg/s` is not a velocity, and on the axes rx, ry and rz a force is a
torque.)~",
          .fix = "Correct the unit, or move the value to the quantity that it was meant for.",
          .part = ExcerptOf::group,
          .example = "x: {velocity: 20 N}",
          .instead = "x: {force: 20 N}"},
      Explanation{
          .code = "E203",
          .title = "an unknown unit",
          .why =
              R"~(Units are written as the SI writes them: case matters (`N`, not `n`), and a product has a space
(`N m`, because `Nm` could be a nanometre written hastily). Units whose zero is elsewhere, like
degrees Celsius, and those that mean several things are not known on purpose.)~",
          .fix = "Take the unit that the help names. docs/language.md lists them all.",
          .part = ExcerptOf::group,
          .example = "rz: {force: 3 Nm}",
          .instead = "rz: {force: 3 N m}"},
      Explanation{
          .code = "E204",
          .title = "a parameter outside its own range",
          .why =
              R"~(The range of a parameter is a promise to everyone who sets it: within it the task was thought
through. A value from the command line, from `set` or from the file itself must keep it.)~",
          .fix = "Choose a value within the range, or, knowing why it is there, widen the range.",
          .part = ExcerptOf::task_file,
          .example = R"~(params:
  push: {value: 200 N, range: [5 N, 40 N]}
tasks:
  go:
    constraints:
      contact: {move: base, in: base, x: {force: $push}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(params:
  push: {value: 20 N, range: [5 N, 40 N]}
tasks:
  go:
    constraints:
      contact: {move: base, in: base, x: {force: $push}}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E205",
          .title = "not a condition",
          .why =
              R"~(A condition is true or false. A quantity is neither until it is compared with another one, and what
is true or false cannot be compared or added.)~",
          .fix = "Compare the quantity with a value, or take the comparison away from what is a condition "
                 "already.",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: moved(base), for: 0.1 s, goto: done}\ntimeout: {after: 10 s, "
                     "goto: failed}",
          .instead = "exits:\n  - {when: moved(base) > 2 cm, for: 0.1 s, goto: done}\ntimeout: {after: "
                     "10 s, goto: failed}"},
      Explanation{
          .code = "E206",
          .title = "a parameter that may break the place that uses it",
          .why =
              R"~(A parameter may be set to any value of its range: with `-p`, by `set`, or by the program that runs
the task. Each place that uses it must be sound with all of them. A negative stiffness pushes the
robot away, a time constant of 0 has no answer, and a range whose ends cross is empty. Without a
range, the values that the file sets count.)~",
          .fix = "Narrow the range to what every place can take. Where two places need different ranges, "
                 "declare two parameters.",
          .part = ExcerptOf::task_file,
          .example = R"~(params:
  pace: {value: 0.1 m/s, range: [-0.2 m/s, 0.2 m/s]}
tasks:
  go:
    constraints:
      drive: {move: base, in: base, x: {force: 10 N, velocity: +-$pace}}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(params:
  pace: {value: 0.1 m/s, range: [0 m/s, 0.2 m/s]}
tasks:
  go:
    constraints:
      drive: {move: base, in: base, x: {force: 10 N, velocity: +-$pace}}
    timeout: {after: 10 s, goto: failed})~"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
