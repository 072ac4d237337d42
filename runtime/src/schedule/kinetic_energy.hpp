/// The kinetic energy of a robot, as its model has it.
#pragma once

#include "zwang/solver/frame.hpp"

namespace zwang::runtime {

/// T = sum over the bodies of 1/2 V' I V, and over the rotors of 1/2 J qd^2. [J] `motions`: at `state`.
/// Does not allocate, lock, throw or print.
double kinetic_energy(const solver::Model& model, const solver::State& state,
                      solver::BodyMotions& motions) noexcept;

}  // namespace zwang::runtime
