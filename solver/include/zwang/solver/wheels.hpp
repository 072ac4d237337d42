/// Which bodies are wheels, and which carry some.
#pragma once

#include <algorithm>

#include "zwang/solver/model.hpp"

namespace zwang::solver {

/// `body`: an index into Model::bodies.
inline bool turns_wheel(const Model& model, int body) {
  return std::any_of(model.wheels().begin(), model.wheels().end(),
                     [body](const Wheel& wheel) { return wheel.body == body; });
}

/// The body is a wheel, or one hangs on it, as on a steering.
inline bool carries_wheel(const Model& model, int body) {
  return std::any_of(model.wheels().begin(), model.wheels().end(), [&](const Wheel& wheel) {
    int b = wheel.body;
    while (b > body) b = model.bodies()[static_cast<std::size_t>(b)].parent;  // parents come first
    return b == body;
  });
}

}  // namespace zwang::solver
