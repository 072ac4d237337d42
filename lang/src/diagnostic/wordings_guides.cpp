#include "diagnostic/wordings_guides.hpp"

#include "diagnostic/make.hpp"
#include "words/text.hpp"

namespace zwang::lang::wording {

Diagnostic two_ways_to_move(const Span& span, const std::string& what, const std::string& key,
                            const std::string& other) {
  return error("E917", span,
               what + " has " + in_ticks(other) + " and " + in_ticks(key) + ": it moves in one way",
               "keep one of them");
}

Diagnostic moves_without_mass(const Span& span, const std::string& what, const std::string& key) {
  return error("E917", span, what + " has " + in_ticks(key) + " and no mass: nothing could move it",
               "add its mass, as `mass: 20 kg`");
}

Diagnostic range_without_start(const Span& span, const std::string& what, bool turns) {
  return error("E918", span, what + "'s `range` does not reach from 0, where the object stands at the start",
               turns ? "write for example `[0 deg, 90 deg]`" : "write for example `[-0.4 m, 0 m]`");
}

Diagnostic preload_to_both_sides(const Span& span, const std::string& what) {
  return error("E919", span, what + "'s `preload` presses towards 0, and 0 lies inside of its `range`",
               "end the range at 0, or write a `stiffness` in the place of the `preload`");
}

Diagnostic yaw_twice(const Span& span, const std::string& what) {
  return error("E926", span, what + " has `yaw` and `rpy`: both say where it looks",
               "keep `rpy`, whose third angle is the yaw");
}

Diagnostic leans_and(const Span& span, const std::string& what, const std::string& key) {
  return error("E926", span,
               what + " leans by its `rpy` and has " + in_ticks(key) + ": only a fixed box or wall leans",
               "write `yaw` in the place of `rpy`, or delete " + in_ticks(key));
}

Diagnostic push_without_effect(const Span& span, const std::string& object, const std::string& reason) {
  return error("E927", span, "no push moves " + in_ticks(object) + ": " + reason,
               "push an object that has a `mass`, or a robot");
}

Diagnostic push_off_the_floor(const Span& span, const std::string& object) {
  return error("E927", span,
               in_ticks(object) + " moves on the floor: a force along z and a torque about x or y do nothing",
               "write the force along x and y, and the torque about z");
}

Diagnostic push_of_two(const Span& span) {
  return error("E927", span, "a push has `robot` and `object`: a hand presses on one of them", "keep one");
}

Diagnostic push_without_wrench(const Span& span) {
  return error("E927", span, "a push has neither `force` nor `torque`: it does nothing",
               "add for example `force: [30 N, 0 N]`");
}

Diagnostic push_key_of_other(const Span& span, const std::string& key, bool is_object) {
  return error("E927", span,
               is_object ? in_ticks(key) + " names a place on a robot, and this push presses on an object"
                         : in_ticks(key) + " names a place on an object, and this push presses on a robot",
               is_object ? "write `point`, the place in the object's axes" : "write `frame`");
}

Diagnostic pad_off_the_arm(const Span& span, const std::string& frame) {
  return error("E873", span, in_ticks(frame) + " is on no link of an arm: a pad is the flat end of one",
               "name a frame of the arm's last link; the base touches with its `footprint`");
}

Diagnostic nothing_travels(const Span& span, const std::string& name) {
  return error("E908", span, in_ticks(name) + " has no travel that could be measured",
               "give it a `hinge` or a `slide`");
}

Diagnostic idle_noise(const Span& span, const std::string& what, const std::string& key,
                      const std::string& other) {
  return error("E908", span, what + " has no " + in_ticks(key) + ": it would do nothing",
               other.empty() ? "delete it: a script and a latch give what they say"
                             : "write " + in_ticks(other) + ", or delete it");
}

}  // namespace zwang::lang::wording
