#include "diagnostic/wordings_guides.hpp"

#include "diagnostic/make.hpp"
#include "tree/text.hpp"

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

Diagnostic nothing_travels(const Span& span, const std::string& name) {
  return error("E908", span, in_ticks(name) + " has no travel that could be measured",
               "give it a `hinge` or a `slide`");
}

}  // namespace zwang::lang::wording
