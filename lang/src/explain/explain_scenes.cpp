#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> scenes() {
  static constexpr std::array entries{
      Explanation{
          .code = "E901",
          .title = "an object without a shape, or with two",
          .why = "What the robot can meet has one shape: a `box`, a `cylinder` or a `wall`.",
          .fix = "Keep one of them.",
          .part = ExcerptOf::scene,
          .example =
              "objects:\n  crate: {box: [1 m, 1 m, 1 m], wall: {length: 2 m}, at: [2 m, 0 m], fixed: true}",
          .instead = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], fixed: true}"},
      Explanation{
          .code = "E902",
          .title = "a fixed object with a mass",
          .why = "What is fixed never moves, so its mass could have no effect; one of the two lines is a "
                 "mistake.",
          .fix = "Delete `mass` if it stands fast, `fixed` if it can be pushed.",
          .part = ExcerptOf::scene,
          .example = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], fixed: true, mass: 3 kg}",
          .instead = "objects:\n  crate: {box: [1 m, 1 m, 1 m], at: [2 m, 0 m], mass: 3 kg}"},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
