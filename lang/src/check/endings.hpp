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

/// The latest time at which the exit's condition can become true and still fire. The timeout or another exit
/// ends the task for certain, and the exit's `for` comes off that time. 0 and less: the `for` is too long.
/// `exit` is the index of the exit in the task; past the last one, every exit counts as another one.
Ending ending_before(const CheckContext& context, const TaskText& task,
                     const std::vector<Condition>& conditions, std::size_t exit);

/// The earliest time at which the exit may fire, by its `for` and by what its condition says of `elapsed`.
/// [s]
double earliest(const CheckContext& context, const TaskText& task, const ExitText& exit,
                const Condition& condition);

/// Whether a way leads from the earlier task to this one.
bool is_entered_after(const CheckContext& context, const std::string& task, const std::string& earlier);
/// Whether a way leads from the task on and back to it.
bool is_entered_again(const CheckContext& context, const std::string& task);
/// Whether some exit leads `back`, to nobody knows which task.
bool leads_back(const CheckContext& context);

/// W510: tasks from which no way leads to `done` or `failed`. W512: exits that lead to and fro at once.
/// `reached`: the tasks that a run can come to.
void check_loops(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                 const std::vector<Condition>& always_conditions, const std::set<std::string>& reached);

}  // namespace zwang::lang
