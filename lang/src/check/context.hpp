/// State that the checks share, and questions that all of them ask.
#pragma once

#include <map>
#include <string>

#include "check/check.hpp"

namespace zwang::lang {

struct CheckContext {
  const TaskFile& file;
  const std::optional<Robot>& robot;
  const LoadOptions& options;
  Symbols& symbols;
  Diagnostics& diagnostics;
  bool with_notes = false;
  /// Of axes that yield: what they give way to. None where nothing is lowered.
  std::map<const AxisText*, Condition>* yields = nullptr;
  bool of_truth = false;  ///< an expectation of a scenario: what the robot believes does not count
};

/// Whether the value is there and measures `expected`; writes E105, E201, E202, E301. Marks parameters used.
bool check_value(CheckContext& context, const ValueText& value, const Dimension& expected,
                 const std::string& what);
/// The value with the parameters as they are at the start. Of a checked value.
double present_value(const CheckContext& context, const ValueText& value);
/// [s] The exit's `for`; 0 where there is none.
double dwell_of(const CheckContext& context, const ExitText& exit);
/// [s] How long the switch into the task takes.
double blend_of(const CheckContext& context, const TaskText& task);
/// A time that must not be negative, or must be above zero.
void check_time(CheckContext& context, const ValueText& value, const std::string& what, bool zero_allowed);
/// A checked value that must not be negative, or must be above zero, whatever a parameter may be: E105, E206.
void check_positive(CheckContext& context, const ValueText& value, const std::string& what,
                    bool zero_allowed);
/// The frame's index; E301 when there is none. nullopt for bad and unknown names.
std::optional<int> check_frame(CheckContext& context, const Word& name);

/// Whether some `set` of the file puts the frame elsewhere.
bool is_frame_set(const TaskFile& file, const std::string& frame);

/// The link of the robot that floats; empty where there is no robot.
std::string base_of(const CheckContext& context);

void check_parameters(CheckContext& context);
/// The SI value that a scene, a scenario or the command line gives a parameter. Writes E105, E201 to E204.
/// nullopt on an error. If the declaration itself is bad, nullopt without a diagnostic.
std::optional<double> check_parameter_value(const ParameterSymbol& symbol, const Word& text,
                                            Diagnostics& diagnostics);
/// Whether the signals of the scene are what the task file takes them for: E701, W702, W703.
void check_scene_signals(CheckContext& context, const Scene& scene);
/// W302: signals of the scene that only nearly have the name of one of the task file's. Asked last: there may
/// be a better reason.
void check_scene_names(CheckContext& context, const Scene& scene);
/// W509: signals that conditions read or motion follows and that the scene does not give. Asked last.
void check_unfed_signals(CheckContext& context, const Scene& scene);
/// E305: words that conditions read as something else, so that nothing could ever ask for the name.
void check_is_no_word(CheckContext& context, const Word& name);
/// Names of signals; what they are seen from is asked in `check_world`, once the frames are known.
void declare_signals(CheckContext& context);
void check_frames(CheckContext& context);
/// Outputs: what they are set to at the start and at a stop. Behind features: names are one room.
void check_outputs(CheckContext& context);
/// Docks of the scene that an output holds shut: E301.
void check_held_docks(CheckContext& context, const Scene& scene);
/// Signals, regions and features: what they refer to.
void check_world(CheckContext& context);
void check_groups(CheckContext& context, const std::vector<GroupText>& groups);
/// A group `inside` a region.
void check_inside(CheckContext& context, const GroupText& group);
/// E413, W421: positions beyond half a turn, of an axis that turns or a bearing.
void check_half_turn(CheckContext& context, const AxisText& axis, const std::string& path);
/// W402: what a task's drivers ask for and `always` does not allow.
void check_against_always(CheckContext& context, const TaskText& task);
/// E506: `release` must lie on the far side of a single comparison's threshold.
void check_release(CheckContext& context, const ExitText& exit, const Condition& condition,
                   const Dimension& compared);
/// `<`, `<=`, `>` or `>=`.
constexpr bool is_comparison(Op op) {
  return op == Op::less || op == Op::less_equal || op == Op::greater || op == Op::greater_equal;
}
/// Whether the signs of its parts alone decide the condition.
bool is_decided(const CheckContext& context, const Condition& condition,
                const std::vector<GroupText>& groups);
/// E505: of such a condition.
void check_is_open(CheckContext& context, const Condition& condition, const std::vector<GroupText>& groups);
void check_sets(CheckContext& context, const std::vector<SetText>& sets);
/// nullopt on an error. `compared` takes what the two sides of a single comparison measure, `of_nodes` what
/// each node does.
std::optional<Condition> check_condition(CheckContext& context, const ConditionText& text,
                                         const std::vector<GroupText>& groups, Dimension* compared = nullptr,
                                         std::vector<Dimension>* of_nodes = nullptr);
/// Checks an expression whose value must have the dimension `expected`. nullopt on an error. `what` names the
/// expression in messages.
std::optional<Condition> check_expression(CheckContext& context, const ConditionText& text,
                                          const std::vector<GroupText>& groups, const std::string& what,
                                          const Dimension& expected);
/// As `check_value`, where a number signal may drive as well.
bool check_driver_value(CheckContext& context, const ValueText& value, const Dimension& expected,
                        const std::string& what);
/// Unreachable tasks, tasks and loops without an end, names without a use.
void check_flow(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                const std::vector<Condition>& always_conditions);
/// W511: an `enter.require` that is never true, of each task.
void check_requirements(CheckContext& context, const std::vector<std::optional<Condition>>& requirements);
/// Tasks that `always` interrupts to, and those that these lead to: where `back` means something.
std::vector<std::string> interrupting_tasks(const CheckContext& context);

}  // namespace zwang::lang
