#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> order() {
  static constexpr std::array entries{
      Explanation{
          .code = "W501",
          .title = "a measured quantity decides at a single instant",
          .why =
              R"~(A measured number has noise. Without `for` the first sample beyond the threshold ends the task. A
velocity passes zero whenever it changes its sign. Bool signals and `elapsed` do not flicker and
need none.)~",
          .fix = "Say how long the condition must hold without a break: `for: 0.1 s` is a hundred samples.",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: speed(base) < 5 mm/s and elapsed > 1 s, goto: done}",
          .instead = "exits:\n  - {when: speed(base) < 5 mm/s and elapsed > 1 s, for: 0.1 s, goto: done}"},
      Explanation{
          .code = "W502",
          .title = "a task that no way leads to",
          .why = "No `goto` of any task that can be reached from `start` names it: it will never run.",
          .fix = "Lead an exit or a timeout to it, or delete it.",
          .part = ExcerptOf::task_file,
          .example = R"~(tasks:
  go:
    constraints:
      drive: {move: base, in: base, x: {velocity: 0.1 m/s}}
    timeout: {after: 3 s, goto: done}
  pause:
    timeout: {after: 1 s, goto: go})~",
          .instead = R"~(tasks:
  go:
    constraints:
      drive: {move: base, in: base, x: {velocity: 0.1 m/s}}
    timeout: {after: 3 s, goto: pause}
  pause:
    timeout: {after: 1 s, goto: done})~"},
      Explanation{
          .code = "W503",
          .title = "a task that can run for ever",
          .why =
              R"~(The wall may be absent, or the sensor dead. If the condition never comes true, the robot presses,
drives or waits until a person notices.)~",
          .fix =
              R"~(Give the task a timeout and say where it leads. If it shall really wait as long as it takes, say so:
`timeout: never`.)~",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: moved(base) > 1 m, for: 0.1 s, goto: done}",
          .instead = "exits:\n  - {when: moved(base) > 1 m, for: 0.1 s, goto: done}\ntimeout: {after: "
                     "20 s, goto: failed}"},
      Explanation{
          .code = "E504",
          .title = "a signal without an age limit",
          .why =
              R"~(A sensor that stopped sending looks exactly like one that sees nothing new. Only its age tells them
apart, and nobody but you knows how often it sends.)~",
          .fix = "Say after which time a sample is too old: two or three times its period.",
          .part = ExcerptOf::task_file,
          .example = R"~(signals:
  latch: {type: bool}
tasks:
  go:
    exits:
      - {when: latch, goto: done}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(signals:
  latch: {type: bool, stale_after: 200 ms}
tasks:
  go:
    exits:
      - {when: latch, goto: done}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E510",
          .title = "a latch that cannot hold the base",
          .why =
              R"~(While a latch holds the base by a hook, motors push and nothing moves: as with encoders that are dead. `holds`
tells the guard that the hook is why. That takes a signal that is true or false, and a frame that the base carries.)~",
          .fix =
              "Let a `bool` signal name a frame that is fixed to the base: one of the robot file's `frames`.",
          .part = ExcerptOf::task_file,
          .example = R"~(signals:
  latch: {type: bool, holds: world, stale_after: 500 ms}
tasks:
  go:
    exits:
      - {when: latch, goto: done}
    timeout: {after: 10 s, goto: failed})~",
          .instead = R"~(signals:
  latch: {type: bool, holds: bumper, stale_after: 500 ms}
tasks:
  go:
    exits:
      - {when: latch, goto: done}
    timeout: {after: 10 s, goto: failed})~"},
      Explanation{
          .code = "E505",
          .title = "a condition that is decided beforehand",
          .why =
              R"~(A distance, a speed and a time are never negative, and parameters have ranges. So this condition is
true at every moment or at none. An exit that always fires hides the task, and one that never fires
hides what was meant.)~",
          .fix = "Look at the direction of the comparison and at the sign of the number.",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: speed(base) < -1 cm/s, for: 1 s, goto: done}\ntimeout: {after: "
                     "10 s, goto: failed}",
          .instead = "exits:\n  - {when: speed(base) < 1 cm/s, for: 1 s, goto: done}\ntimeout: {after: "
                     "10 s, goto: failed}"},
      Explanation{
          .code = "E506",
          .title = "`release` on the wrong side",
          .why =
              R"~(`release` keeps a condition true until the quantity has passed a second value, so that an exit does
not flutter at its threshold. The second value has to lie behind the first; on the near side the
condition would be taken back as soon as it is true.)~",
          .fix =
              R"~(After `<` write a release above the threshold, after `>` one below it. The condition must be a
single comparison with a fixed value.)~",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: speed(base) < 5 cm/s, release: 3 cm/s, for: 1 s, goto: done}\n"
                     "timeout: {after: 10 s, goto: failed}",
          .instead = "exits:\n  - {when: speed(base) < 5 cm/s, release: 8 cm/s, for: 1 s, goto: done}\n"
                     "timeout: {after: 10 s, goto: failed}"},
      Explanation{
          .code = "W507",
          .title = "an exit hidden by an earlier one",
          .why =
              R"~(Exits are asked from top to bottom and the first true one wins. An earlier exit has the same
condition and needs no longer for it, so this one never has its turn.)~",
          .fix = "Delete it, put it first, or give it the condition that it was meant to have.",
          .part = ExcerptOf::task,
          .example = R"~(exits:
  - {when: elapsed > 2 s, goto: done}
  - {when: elapsed > 2 s, goto: failed})~",
          .instead = R"~(exits:
  - {when: moved(base) > 5 cm, for: 0.1 s, goto: done}
  - {when: elapsed > 2 s, goto: failed})~"},
      Explanation{
          .code = "E508",
          .title = "`back` where nothing was interrupted",
          .why =
              R"~(`back` resumes the task that an exit under `always` interrupted. This task is never entered in that
way, so there is nothing to go back to.)~",
          .fix = "Name the task, or let an exit under `always` lead here.",
          .part = ExcerptOf::task,
          .example = "exits:\n  - {when: elapsed > 2 s, goto: back}",
          .instead = "exits:\n  - {when: elapsed > 2 s, goto: done}"},
      Explanation{
          .code = "W509",
          .title = "a signal that the scene does not give",
          .why =
              R"~(A condition reads the signal, or motion follows it: a driver, a yield, a frame on a pose. In this
scene it is never measured, so it stays unknown. A condition under `always` counts as true once the
signal's `stale_after` is over, in a task it never fires. An axis stands still, and a force is 0. Either
way the run says nothing about what the signal is for.)~",
          .fix =
              R"~(Give the signal a source under `signals` of the scene. A condition that is about its absence asks
`valid(signal)`. A wrench comes from a sensor, `wrench_at`; `estimated.FRAME` needs none.)~"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
