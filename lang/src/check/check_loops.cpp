// Tasks that follow each other without end, and rings of them that a run flutters around in.
#include <algorithm>
#include <cmath>
#include <set>

#include "check/endings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

using Names = std::set<std::string>;

/// Where the task leads to, without ways that something certain always comes before.
Names ways_from(const CheckContext& context, const TaskText& task, const std::vector<Condition>& conditions) {
  Names ways;
  for (std::size_t i = 0; i < task.exits.size(); ++i) {
    const bool is_read = !conditions[i].nodes.empty();
    const Ending before = ending_before(context, task, conditions, i);
    const double dwell = dwell_of(context, task.exits[i]);
    const double first = is_read ? earliest(context, task, task.exits[i], conditions[i]) : 0.0;
    if (first <= before.time + dwell) ways.insert(task.exits[i].target.text);
  }
  if (task.timeout && !task.timeout->is_never) {
    const double after = present_value(context, task.timeout->after);
    TaskText rest = task;
    rest.timeout.reset();
    if (after <= ending_before(context, rest, conditions, rest.exits.size()).time)
      ways.insert(task.timeout->target.text);
  }
  if (task.attempts) ways.insert(task.attempts->target.text);
  return ways;
}

/// A task that says `timeout: never` and leads nowhere is meant to last; W503 tells of one that says nothing.
bool is_meant_to_last(const TaskText& task) {
  return task.exits.empty() && (!task.timeout || task.timeout->is_never);
}

class Ways {
 public:
  Ways(const CheckContext& context, const std::vector<std::vector<Condition>>& conditions)
      : context_(context) {
    for (const ExitText& exit : context.file.always_exits) always_.insert(exit.target.text);
    for (std::size_t i = 0; i < context.file.tasks.size(); ++i)
      from_.push_back(ways_from(context, context.file.tasks[i], conditions[i]));
  }

  /// Tasks from which a run can come to its end.
  Names ending() const {
    Names known{"done", "failed"};
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      for (std::size_t i = 0; i < from_.size(); ++i) {
        const std::string& name = context_.file.tasks[i].name.text;
        if (known.contains(name) || !ends(i, known)) continue;
        known.insert(name);
        has_grown = true;
      }
    }
    return known;
  }

 private:
  bool ends(std::size_t task, const Names& known) const {
    const auto leads_on = [&](const std::string& way) { return known.contains(way); };
    // `back` may resume any task that has been shown to end.
    const bool goes_back = from_[task].contains("back") && known.size() > 2;
    return is_meant_to_last(context_.file.tasks[task]) || goes_back ||
           std::any_of(from_[task].begin(), from_[task].end(), leads_on) ||
           std::any_of(always_.begin(), always_.end(), leads_on);
  }

  const CheckContext& context_;
  Names always_;
  std::vector<Names> from_;
};

void check_ways_out(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                    const Names& reached) {
  const Names ending = Ways(context, conditions).ending();
  std::vector<std::string> endless;
  const TaskText* first = nullptr;
  for (const TaskText& task : context.file.tasks) {
    if (task.is_bad || ending.contains(task.name.text) || !reached.contains(task.name.text)) continue;
    if (first == nullptr) first = &task;
    endless.push_back(task.name.text);
  }
  if (first != nullptr) context.diagnostics.add(wording::no_way_out(first->name.span, endless));
}

/// An exit and the cases in which it is true.
struct Way {
  const ExitText* exit = nullptr;
  std::vector<Case> cases;
};

/// A switch of tasks does not change a place, a speed or a signal.
bool outlasts_a_switch(const ExpressionNode& node) {
  const bool is_motion = node.op == Op::coordinate && (node.what == CoordinateQuantity::position ||
                                                       node.what == CoordinateQuantity::velocity);
  const bool is_of_now = node.op == Op::of_frame && !function_of(node).adds_up;
  return is_motion || is_of_now || node.op == Op::signal || node.op == Op::output || node.op == Op::feature ||
         node.op == Op::valid;
}

/// Exits to the task `to` that may fire before the task that they leave has faded in.
std::vector<Way> quick_ways(const CheckContext& context, const TaskText& task, const std::string& to,
                            const std::vector<Condition>& conditions) {
  std::vector<Way> ways;
  for (std::size_t i = 0; i < task.exits.size(); ++i) {
    const ExitText& exit = task.exits[i];
    if (exit.target.text != to || conditions[i].nodes.empty()) continue;
    auto cases = cases_of(context, conditions[i], task.groups);
    const bool is_quick = earliest(context, task, exit, conditions[i]) < blend_of(context, task);
    if (cases && is_quick) ways.push_back({&exit, std::move(*cases)});
  }
  return ways;
}

/// Both true at one and the same value of something that both ask for, and of nothing that a switch changes.
bool are_true_together(const Case& a, const Case& b) {
  const auto lasts = [](const Case& one) {
    return std::all_of(one.begin(), one.end(),
                       [](const auto& entry) { return outlasts_a_switch(*entry.second.node); });
  };
  const bool shares =
      std::any_of(a.begin(), a.end(), [&](const auto& entry) { return b.contains(entry.first); });
  return shares && lasts(a) && lasts(b) && both(a, b).has_value();
}

bool flutter(const Way& there, const Way& back) {
  return std::any_of(there.cases.begin(), there.cases.end(), [&](const Case& a) {
    return std::any_of(back.cases.begin(), back.cases.end(),
                       [&](const Case& b) { return are_true_together(a, b); });
  });
}

/// Rings of tasks whose exits are all true at one and the same value.
class Flutter {
 public:
  Flutter(CheckContext& context, const std::vector<std::vector<Condition>>& conditions) : context_(context) {
    const auto& tasks = context.file.tasks;
    hops_.resize(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      for (const ExitText& exit : tasks[i].exits) add_hops(i, exit.target.text, conditions[i]);
    }
  }

  void tell() {
    for (first_ = 0; first_ < hops_.size(); ++first_) {
      on_way_.assign(hops_.size(), false);
      follow(first_, {}, nullptr);
    }
  }

 private:
  struct Hop {
    std::size_t to;
    Way way;
  };

  void add_hops(std::size_t from, const std::string& to, const std::vector<Condition>& conditions) {
    const TaskText& task = context_.file.tasks[from];
    const std::optional<int> target = context_.symbols.find_task(to);
    const auto leads_there = [&](const Hop& hop) {
      return target && hop.to == static_cast<std::size_t>(*target);
    };
    const bool is_known = std::any_of(hops_[from].begin(), hops_[from].end(), leads_there);
    if (!target || is_known || task.attempts) return;
    for (Way& way : quick_ways(context_, task, to, conditions))
      hops_[from].push_back({static_cast<std::size_t>(*target), std::move(way)});
  }

  /// Each ring is found from the first of its tasks. True once one is told.
  bool follow(std::size_t at, const Case& so_far, const ExitText* begin) {
    on_way_[at] = true;
    for (const Hop& hop : hops_[at]) {
      if (hop.to < first_ || (hop.to != first_ && on_way_[hop.to])) continue;
      for (const Case& one : hop.way.cases) {
        if (--steps_ < 0) return true;
        if (begin != nullptr && !are_true_together(so_far, one)) continue;
        if (hop.to != first_) {
          const std::optional<Case> joined = both(so_far, one);
          if (joined && follow(hop.to, *joined, begin != nullptr ? begin : hop.way.exit)) return true;
        } else if (begin != nullptr) {
          const auto& tasks = context_.file.tasks;
          context_.diagnostics.add(wording::to_and_fro(hop.way.exit->when.span, tasks[at].name.text,
                                                       tasks[first_].name.text, begin->when.span));
          return true;
        }
      }
    }
    on_way_[at] = false;
    return false;
  }

  CheckContext& context_;
  std::vector<std::vector<Hop>> hops_;
  std::vector<bool> on_way_;
  std::size_t first_ = 0;
  int steps_ = 20000;  ///< a file may be hostile
};

/// `back` resets neither a path nor a time: both only grow.
bool is_resumed(const Demanded& demanded) {
  const ExpressionNode& node = *demanded.node;
  const bool adds_up = node.op == Op::elapsed || (node.op == Op::of_frame && function_of(node).adds_up);
  return adds_up && std::isinf(demanded.bounds.high);
}

/// A `back` of the task, or of those that it leads to; may be nowhere. `task` takes the one that it stands
/// in.
Span find_back(const CheckContext& context, const TaskText& first, const TaskText*& task) {
  Names seen;
  std::vector<const TaskText*> open{&first};
  while (!open.empty()) {
    task = open.back();
    open.pop_back();
    if (!seen.insert(task->name.text).second || task->attempts) continue;
    std::vector<const Word*> targets;
    for (const ExitText& exit : task->exits) targets.push_back(&exit.target);
    if (task->timeout && !task->timeout->is_never) targets.push_back(&task->timeout->target);
    for (const Word* target : targets) {
      if (target->text == "back") return target->span;
      if (const auto index = context.symbols.find_task(target->text))
        open.push_back(&context.file.tasks[static_cast<std::size_t>(*index)]);
    }
  }
  return {};
}

/// Whether some task may go on until a case of `moved` and `elapsed` alone is true.
bool is_outlasted(const CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                  const Case& one) {
  double needed = 0.0;  // [s]
  for (const auto& [key, demanded] : one) {
    if (demanded.node->op == Op::elapsed) needed = std::max(needed, demanded.bounds.low);
  }
  for (std::size_t i = 0; i < context.file.tasks.size(); ++i) {
    const TaskText& task = context.file.tasks[i];
    if (ending_before(context, task, conditions[i], task.exits.size()).time > needed) return true;
  }
  return false;
}

double longest_blend(const CheckContext& context) {
  double longest = 0.0;
  for (const TaskText& task : context.file.tasks) longest = std::max(longest, blend_of(context, task));
  return longest;
}

/// An exit of `always` that asks for nothing but `moved` and `elapsed`, which go on after `back`.
bool check_resumed(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                   const ExitText& interrupts, const TaskText& target, const std::vector<Case>& cases) {
  const bool stays_true = std::any_of(cases.begin(), cases.end(), [&](const Case& one) {
    return !one.empty() && is_outlasted(context, conditions, one) &&
           std::all_of(one.begin(), one.end(), [](const auto& entry) { return is_resumed(entry.second); });
  });
  if (!stays_true || dwell_of(context, interrupts) >= longest_blend(context)) return false;
  const TaskText* task = nullptr;
  const Span back = find_back(context, target, task);
  if (!back.exists()) return false;
  context.diagnostics.add(wording::interrupts_again(back, task->name.text, interrupts.when.span));
  return true;
}

/// An exit of `always` interrupts a task, and `back` resumes it while the interruption is still true.
void check_flutter_back(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                        const std::vector<Condition>& always_conditions) {
  static const std::vector<GroupText> none;
  for (std::size_t a = 0; a < context.file.always_exits.size(); ++a) {
    const ExitText& interrupts = context.file.always_exits[a];
    const std::optional<int> target = context.symbols.find_task(interrupts.target.text);
    if (!target || always_conditions[a].nodes.empty()) continue;
    const TaskText& task = context.file.tasks[static_cast<std::size_t>(*target)];
    auto cases = cases_of(context, always_conditions[a], none);
    if (!cases || task.attempts || check_resumed(context, conditions, interrupts, task, *cases)) continue;
    const Way there{&interrupts, std::move(*cases)};
    for (const Way& back : quick_ways(context, task, "back", conditions[static_cast<std::size_t>(*target)])) {
      if (!flutter(there, back)) continue;
      context.diagnostics.add(wording::to_and_fro(back.exit->when.span, task.name.text,
                                                  "what was interrupted", interrupts.when.span));
    }
  }
}

}  // namespace

void check_loops(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                 const std::vector<Condition>& always_conditions, const std::set<std::string>& reached) {
  check_ways_out(context, conditions, reached);
  Flutter(context, conditions).tell();
  check_flutter_back(context, conditions, always_conditions);
}

}  // namespace zwang::lang
