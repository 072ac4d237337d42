/// The groups of `constraints`, their axes, and what an axis states.
#pragma once

#include "spec/shape.hpp"
#include "spec/task_file.hpp"

namespace zwang::lang {

/// `{name: group, ..}`
std::vector<GroupText> parse_groups(const Node& node, int lowest_level, Diagnostics& diagnostics);
/// The `constraints` of a task or of `always`. Where the key is misspelt, a group without a name stands for
/// those that nobody has read.
std::vector<GroupText> parse_constraints(MapReader& map, int lowest_level, Diagnostics& diagnostics);

/// Whether the entry is a line of a group, rather than a group: `move: base_link`, `x: {velocity: ..}`.
bool is_of_a_group(const Entry& entry);
/// In the place of groups that could not be read: one of them may be the one that a condition names.
GroupText unread_group();

}  // namespace zwang::lang
