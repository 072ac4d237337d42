/// A snapshot that knows its signals by their names.
#pragma once

#include <string>
#include <vector>

#include "zwang/runtime/plant.hpp"

namespace zwang::python {

struct NamedSensed {
  explicit NamedSensed(const lang::Program& program) : sensed(program), signals(program.signals) {}
  runtime::Sensed sensed;
  std::vector<lang::Signal> signals;
};

}  // namespace zwang::python
