/// The axis statements of a program as one list with names for people. The robot's limits and the brake,
/// which every task shares, stand in it once.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime {

struct Statement {
  std::string name;  ///< "press.contact.x", "limits.x", "stop.rz"
  bool own = true;   ///< written in the task file
  lang::AxisStatements says;
  bool inside = false;  ///< stands for all the rows of a group `inside` a region
  std::string frame;    ///< that moves; of a footprint "footprint"
  std::string region;   ///< of `inside`
  double radius = 0.0;  ///< [m] of that region; 0: it is a polygon
};

class StatementTable {
 public:
  StatementTable(const Scheduler& scheduler, const lang::Program& program);
  const std::vector<Statement>& all() const noexcept { return statements_; }
  int id(const Origin& origin) const noexcept;

 private:
  int find_or_add(Statement statement);

  std::vector<Statement> statements_;
  std::vector<std::vector<std::vector<int>>> ids_;  // by task, group, axis
};

const char* unit_of(solver::Axis axis, solver::Quantity quantity) noexcept;  ///< SI

}  // namespace zwang::runtime
