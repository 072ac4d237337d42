/// What the checks share, and the questions that all of them ask.
#pragma once

#include <string>

#include "check/check.hpp"

namespace zwang::lang {

struct CheckContext {
  const TaskFile& file;
  const std::optional<Robot>& robot;
  const LoadOptions& options;
  Symbols& symbols;
  Diagnostics& diagnostics;
};

/// Whether the value is there and measures `expected`; writes E105, E201, E202, E301. Marks parameters used.
bool check_value(CheckContext& context, const ValueText& value, const Dimension& expected,
                 const std::string& what);
/// The value with the parameters as they are at the start. Of a checked value.
double present_value(const CheckContext& context, const ValueText& value);
/// A time that must not be negative, or must be above zero.
void check_time(CheckContext& context, const ValueText& value, const std::string& what, bool zero_allowed);
/// The frame's index; E301 when there is none. nullopt for bad and unknown names.
std::optional<int> check_frame(CheckContext& context, const Word& name);

void check_parameters(CheckContext& context);
void check_frames(CheckContext& context);
void check_groups(CheckContext& context, const TaskText& task);
void check_sets(CheckContext& context, const std::vector<SetText>& sets);
/// nullopt on an error.
std::optional<Condition> check_condition(CheckContext& context, const ConditionText& text,
                                         const std::vector<GroupText>& groups);
/// Unreachable tasks, tasks without an end, names without a use.
void check_flow(CheckContext& context, const std::vector<std::vector<Condition>>& conditions);

}  // namespace zwang::lang
