/// The result of `zwang.load`: a program with the texts that it was read from, which a log keeps.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/lang/source.hpp"

namespace zwang::python {

struct ReadProgram : lang::Program {
  std::vector<lang::Source> sources;
  std::map<std::string, std::string> facts;  ///< for a log: the robot and the scene that `load` was given
};

}  // namespace zwang::python
