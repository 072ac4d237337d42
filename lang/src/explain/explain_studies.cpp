#include <array>

#include "explain/catalogue.hpp"

namespace zwang::lang::catalogue {

std::span<const Explanation> studies() {
  static constexpr std::array entries{
      Explanation{
          .code = "E931",
          .title = "something that cannot be drawn",
          .why =
              R"~(A study draws values that its scenario, its scene or its robot has. A name that nothing has would be
drawn without an effect. The robot's mass, inertia, friction and wheels are drawn as factors on what
its file says. Some values are not possible at all: a base without mass, a wall without stiffness.)~",
          .fix =
              R"~(Write a name that the message lists, with `times: true` for a factor, and a range in which every value
is possible.)~"},
      Explanation{
          .code = "E932",
          .title = "a distribution from which nothing can be drawn",
          .why =
              R"~(Each draw has one distribution. A range needs its lower end first, a logarithm numbers above 0, a
normal distribution a deviation above 0, and a choice something to choose from.)~",
          .fix = "Write one distribution, as `uniform: [5 N, 40 N]`."},
      Explanation{
          .code = "E933",
          .title = "a probability that no number of runs can show",
          .why =
              R"~(Runs show that an expectation holds in a share of all cells, with some confidence. No number of clean
runs shows 100 %, and 0 % says nothing.)~",
          .fix =
              R"~(Write a share between the two, as `probability: 99.9 %`. An expectation without `probability` must hold
in each cell.)~"},
      Explanation{
          .code = "W934",
          .title = "fewer runs than the probability takes",
          .why =
              R"~(Even if no run misses, the probability is not shown: n clean runs show a share p with the confidence c
where p^n <= 1 - c. The verdict would be `too few runs` whatever happens.)~",
          .fix = "Write as many `runs` as the message says, or ask for less."},
  };
  return entries;
}

}  // namespace zwang::lang::catalogue
