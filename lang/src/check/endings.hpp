/// When a task ends for certain.
#pragma once

#include <set>

#include "check/cases.hpp"

namespace zwang::lang {

struct Ending {
  double time = std::numeric_limits<double>::infinity();  ///< [s] since the task was entered
  std::string by;                                         ///< `timeout`, `an exit`
  Span span;
};

/// The start of the last stretch of time, as long as the exit's `for`, that ends before the timeout or
/// another exit ends the task for certain; `exit` counts the exits of the task, past them no exit is left
/// out. 0 and less: the `for` is too long.
Ending ending_before(const CheckContext& context, const TaskText& task,
                     const std::vector<Condition>& conditions, std::size_t exit);

/// The earliest time at which the exit may fire, by its `for` and by what its condition says of `elapsed`.
/// [s]
double earliest(const CheckContext& context, const TaskText& task, const ExitText& exit,
                const Condition& condition);

/// W510: tasks from which no way leads to `done` or `failed`. W512: exits that lead to and fro at once.
/// `reached`: the tasks that a run can come to.
void check_loops(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                 const std::vector<Condition>& always_conditions, const std::set<std::string>& reached);

}  // namespace zwang::lang
