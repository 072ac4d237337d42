#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> scenes() {
  static constexpr std::array entries{
      Explanation{
          .code = "E701",
          .title = "a signal that is measured as something else",
          .why =
              R"~(A task file says what a signal is, a scene or a robot what it reads. If they differ, one of the two
names the wrong thing. The task would never get a sample that it can use.)~",
          .fix = "Give the signal another source in the scene, or declare it as what it is."},
      Explanation{
          .code = "W702",
          .title = "a signal that is too old before the next one comes",
          .why =
              R"~(A sample is as old as its `delay` when it comes, and one period of its `rate` older before the next
one does. If that is more than the task file's `stale_after`, the signal is lost between its
samples. Then axes in its frame stop and start, conditions are unknown, and `always` fires.)~",
          .fix = "Give `stale_after` room for the delay and a few periods, or measure more often."},
      Explanation{
          .code = "E901",
          .title = "an object without a shape, or with two",
          .why = "An object has one shape: a `box`, a `cylinder` or a `wall`.",
          .fix = "Keep one of them.",
          .part = ExcerptOf::scene,
          .example =
              "objects:\n  crate: {box: [1 m, 1 m, 1 m], wall: {length: 2 m}, at: [2 m, 0 m], fixed: true}",
          .instead = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], fixed: true}"},
      Explanation{
          .code = "E902",
          .title = "an object that nothing can push, with a mass",
          .why =
              R"~(No push moves an object that is fixed or follows a motion, so its mass has no effect. One of the two
lines is a mistake.)~",
          .fix = "Delete `mass` if it stands fast, `fixed` or `motion` if it can be pushed.",
          .part = ExcerptOf::scene,
          .example = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], fixed: true, mass: 3 kg}",
          .instead = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], mass: 3 kg}"},
      Explanation{
          .code = "E916",
          .title = "an object that is not fixed, without a mass",
          .why =
              R"~(An object without `mass` stands fast, whatever pushes it. `fixed: false` says the opposite, and how
hard the object is to push is not known.)~",
          .fix = "Give the object its mass, or say `fixed: true`.",
          .part = ExcerptOf::scene,
          .example = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], fixed: false}",
          .instead = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg}"},
      Explanation{
          .code = "E917",
          .title = "an object that cannot move as it says",
          .why =
              R"~(A `hinge` turns an object, a `slide` leads it, `slides` and `casters` say how it stands on the floor,
`motion` moves it by a script, and `fixed` holds it. An object moves in one of these ways. What a
push moves has a mass.)~",
          .fix = "Keep one of the keys, and give the object its `mass`.",
          .part = ExcerptOf::scene,
          .example = "objects:\n  gate: {box: [4 cm, 1 m, 1 m], at: [2 m, 0 m], hinge: {at: [0 m, 50 cm], "
                     "range: [0 deg, 90 deg]}}",
          .instead =
              "objects:\n  gate: {box: [4 cm, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg, hinge: {at: [0 m, "
              "50 cm], range: [0 deg, 90 deg]}}"},
      Explanation{
          .code = "E918",
          .title = "a range of travel without 0",
          .why =
              R"~(`at` and `yaw` say where an object stands at the start. There its hinge or slide is at 0. A range
without 0 would put the object somewhere else before anything moved.)~",
          .fix = "Count the travel from where the object stands: its range begins, ends or lies around 0.",
          .part = ExcerptOf::scene,
          .example =
              "objects:\n  gate: {box: [4 cm, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg, hinge: {at: [0 m, 50 "
              "cm], range: [10 deg, 90 deg]}}",
          .instead =
              "objects:\n  gate: {box: [4 cm, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg, hinge: {at: [0 m, 50 "
              "cm], range: [0 deg, 90 deg]}}"},
      Explanation{
          .code = "E919",
          .title = "a preload to both sides",
          .why =
              R"~(A `preload` presses a door or a drawer shut: against the end of its range at 0. In the middle of a
range there is no end to press against, and the force would jump at 0.)~",
          .fix = "End the range at 0. A door that swings both ways is centred by its `stiffness`.",
          .part = ExcerptOf::scene,
          .example =
              "objects:\n  gate: {box: [4 cm, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg, hinge: {at: [0 m, 50 "
              "cm], range: +-90 deg, preload: 8 N m}}",
          .instead =
              "objects:\n  gate: {box: [4 cm, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg, hinge: {at: [0 m, 50 "
              "cm], range: +-90 deg, stiffness: 10 N m/rad}}"},
      Explanation{
          .code = "E926",
          .title = "an object that leans, and is not fixed",
          .why =
              R"~(`rpy` turns a box or a wall about its `at` on the floor, as a ramp or a desk stands. It stays as it
was put: what moves on the floor, on a hinge or on a script is upright. `yaw` and `rpy` both say where
an object looks, so an object has one of them.)~",
          .fix = "Write `yaw` for what moves, is round or holds a hook, and `rpy` for what leans.",
          .part = ExcerptOf::scene,
          .example = "objects:\n  desk: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg, rpy: [0 deg, 20 "
                     "deg, 0 deg]}",
          .instead = "objects:\n  desk: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], rpy: [0 deg, 20 deg, 0 deg]}"},
      Explanation{
          .code = "E927",
          .title = "a push that does nothing",
          .why =
              R"~(A hand presses on a frame of a robot or on a point of an object, with a force, a torque or both. An
object that is fixed, locked or scripted takes no push. What slides on the floor moves along x and y,
and turns about z.)~",
          .fix = "Name something that moves, and give the parts of the wrench that move it.",
          .part = ExcerptOf::scene,
          .example =
              "objects:\n  wall: {wall: {length: 2 m}, at: [2 m, 0 m]}\npushes:\n  - {at: 1 s, object: "
              "wall, force: [30 N, 0 N]}",
          .instead = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], mass: 20 kg}\npushes:\n  - "
                     "{at: 1 s, object: crate, force: [30 N, 0 N]}"},
      Explanation{
          .code = "E903",
          .title = "an outcome that no run can have",
          .why =
              R"~(A run ends as `done`, `failed`, `stopped`, `fallen`, `diverged`, `refused` or, at its
time limit, `unfinished`. A misspelt outcome would never come true.)~",
          .fix = "Write one of them, as in `- outcome: done`."},
      Explanation{
          .code = "E904",
          .title = "an expectation that says nothing, or two things",
          .why =
              R"~(Each entry of `expect` is one claim with one margin: `outcome`, `diagnostic`, `at: end`, `within` or
`always`. A scenario without any could not fail.)~",
          .fix = "Give each claim an entry of its own."},
      Explanation{
          .code = "E905",
          .title = "a matrix of no size, or of too great a size",
          .why =
              R"~(Every value of every key of `matrix` is tried with all others. A key without values leaves nothing
to run; a product of too many is a mistake more often than a wish.)~",
          .fix = "Give each key a value, or split the scenario."},
      Explanation{
          .code = "E906",
          .title = "an interval that starts at something other than a time",
          .why = "`within` counts from the time that `of` names, and that is one the plant measures.",
          .fix =
              R"~(Name a time, for example `of: truth.wall.touched`, or leave `of` out to count from the start.)~"},
      Explanation{
          .code = "E907",
          .title = "a fault that is none",
          .why =
              R"~(A fault is one thing that goes wrong at one time. It concerns the samples, the clock, a wheel's
torque, the floor, the payload, the centre of mass, the inertia or the plant.)~",
          .fix = "Name one thing, and give each other one an entry of its own.",
          .part = ExcerptOf::scene,
          .example = "faults:\n  - {at: 2 s, samples: nan, clock: backwards}",
          .instead = "faults:\n  - {at: 2 s, samples: nan}\n  - {at: 2 s, clock: backwards}"},
      Explanation{
          .code = "E908",
          .title = "a script, a motion or a signal that cannot be played",
          .why =
              R"~(A script is a list of times that rise, each with a value. The values are true and false, or numbers
of one kind, like the task file's signal. A motion goes through one point at least. A signal has one
source that can give it, and some of its samples must arrive in time.)~",
          .fix =
              R"~(Order the steps by time, one `[time, value]` each and all values alike; keep one source a signal.)~",
          .part = ExcerptOf::scene,
          .example = "signals:\n  loaded: {script: [[5 s, true], [3 s, false]]}",
          .instead = "signals:\n  loaded: {script: [[3 s, false], [5 s, true]]}"},
      Explanation{
          .code = "E909",
          .title = "a base that is measured, and is not",
          .why =
              R"~(`state` says how the robot knows where it is: measured on every tick, with some noise, or reckoned
from its wheels and corrected now and then by a `fix`. It cannot be both.)~",
          .fix = "Keep the `fix`, or the noise.",
          .part = ExcerptOf::scene,
          .example = "state: {position: 2 mm, fix: {noise: 1 cm, rate: 10 Hz}}",
          .instead = "state: {fix: {noise: 1 cm, rate: 10 Hz}}"},
      Explanation{
          .code = "E910",
          .title = "too many robots",
          .why =
              R"~(Every robot of a scene is simulated and controlled in the same tick as the first one. Reading a
scene reads all of their files. So their number has a limit.)~",
          .fix = "Leave some out."},
      Explanation{
          .code = "E911",
          .title = "real rollers on wheels that have none",
          .why =
              R"~(`real_rollers` builds mecanum and omni wheels roller by roller. A robot without such wheels would be
the same with and without it, and a comparison would show nothing.)~",
          .fix = "Delete `real_rollers`, or take a robot whose wheels have a `roller`."},
      Explanation{
          .code = "E912",
          .title = "a cell whose task is refused",
          .why =
              R"~(With the robot, the scene or the parameters of this cell the task file has an error that it does not
have otherwise. It would not run, and nothing that the scenario expects could come true.)~",
          .fix =
              R"~(Leave the robot, the scene or the value out of the matrix. If the refusal is the claim, expect
`outcome: refused` or the `diagnostic` in a scenario of its own.)~"},
      Explanation{
          .code = "E913",
          .title = "a start inside of something",
          .why =
              R"~(At the start the robot's footprint overlaps an object, or another robot's. At the start it must
touch nothing: a wall through its middle would hold nothing, and no sensor would feel it. Objects
lower than the robot's `bumper` pass below it.)~",
          .fix =
              R"~(Move the object, or the `start`. A wall's `at` lies on its face, which looks along its own -x.)~"},
      Explanation{
          .code = "W914",
          .title = "a start outside of a range or a region",
          .why =
              "Where the scene has the robot at the start, a range of positions or a region of `always` or "
              "of the first task does not hold it. It sets out at once to come back, with the speed that "
              "`return` gives (0.1 m/s or 0.1 rad/s where nothing is given), whatever else the task wants.",
          .fix =
              "Move the `start`, or the range or region. If the way back is meant, say its speed: "
              "`return: 0.2 m/s`; with `return: 0 m/s` the robot stays outside until the task moves it in."},
      Explanation{
          .code = "E915",
          .title = "what the simulated plant cannot start with",
          .why =
              R"~(`validate` starts the simulated plant of each task and robot file, as `run` does. The plant refuses
a robot or a scene that it cannot simulate. The message gives its reason.)~",
          .fix =
              R"~(Change what the message names. A part of an arm that starts inside an object, or a mass of a
millionth of a gram, is the usual cause.)~"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
