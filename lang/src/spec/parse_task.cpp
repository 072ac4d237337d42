#include "spec/parse_task.hpp"

#include "diagnostic/wordings.hpp"
#include "tree/text.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;

AxisText parse_axis(const Entry& entry, const std::string& group, Diagnostics& diagnostics) {
  AxisText axis;
  axis.name = {entry.key.text, entry.key.span};
  const std::string path = group + "." + entry.key.text;
  if (entry.value.is_scalar() && !entry.value.is_bad) {
    axis.is_free = entry.value.text == "free";
    if (!axis.is_free) diagnostics.add(wording::bare_axis(entry.value.span, path, entry.value.text));
    return axis;
  }
  MapReader map(entry.value, "axis `" + path + "`", diagnostics);
  for (const Quantity quantity :
       {Quantity::position, Quantity::velocity, Quantity::acceleration, Quantity::force}) {
    const std::string word = word_of(quantity);
    const Node* node = map.optional(word);
    if (node == nullptr) continue;
    StatementText statement = parse_statement(*node, path + "." + word, diagnostics);
    statement.key_span = entry.value.find(word)->key.span;
    axis.statements[static_cast<std::size_t>(quantity)] = std::move(statement);
  }
  if (const Node* node = map.optional("time_constant")) {
    axis.time_constant = parse_value(*node, path + ".time_constant", diagnostics);
  }
  if (const Node* node = map.optional("level")) {
    axis.level = parse_integer(*node, path + ".level", 0, 9, diagnostics);
  }
  map.finish();
  return axis;
}

GroupText parse_group(const Entry& entry, Diagnostics& diagnostics) {
  GroupText group;
  group.name = parse_name(entry.key, "a group's name", diagnostics);
  MapReader map(entry.value, "constraint group `" + entry.key.text + "`", diagnostics);
  if (const Node* node = map.required("move")) group.move = parse_word(*node, "`move`", diagnostics);
  if (const Node* node = map.required("in")) group.in = parse_word(*node, "`in`", diagnostics);
  if (const Node* node = map.optional("time_constant")) {
    group.time_constant = parse_value(*node, entry.key.text + ".time_constant", diagnostics);
  }
  if (const Node* node = map.optional("level")) {
    group.level = parse_integer(*node, entry.key.text + ".level", 0, 9, diagnostics);
  }
  for (const char* name : {"x", "y", "z", "rx", "ry", "rz"}) {
    if (map.optional(name) == nullptr) continue;
    group.axes.push_back(parse_axis(*entry.value.find(name), entry.key.text, diagnostics));
  }
  group.is_incomplete = map.has_unread_keys();
  map.finish();
  return group;
}

std::vector<SetText> parse_sets(const Node& node, Diagnostics& diagnostics) {
  std::vector<SetText> sets;
  if (!require_mapping(node, "`set`", diagnostics)) return sets;
  for (const Entry& entry : node.entries) {
    if (entry.key.is_bad) continue;
    SetText set;
    set.span = entry.key.span;
    const std::string& key = entry.key.text;
    const std::size_t dot = key.find('.');
    const std::string kind = key.substr(0, dot);
    const std::string name = dot == std::string::npos ? std::string() : key.substr(dot + 1);
    if ((kind != "frames" && kind != "params") || !is_identifier(name)) {
      diagnostics.add(wording::bad_set(entry.key.span, key));
      continue;
    }
    set.name = {name, entry.key.span};
    set.kind = kind == "frames" ? SetKind::frame : SetKind::parameter;
    if (set.kind == SetKind::frame) {
      set.source = parse_word(entry.value, "`" + key + "`", diagnostics);
    } else {
      set.value = parse_value(entry.value, "`" + key + "`", diagnostics);
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

ExitText parse_exit(const Node& node, Diagnostics& diagnostics) {
  ExitText exit;
  exit.span = node.span;
  MapReader map(node, "an exit", diagnostics);
  const Node* when = map.required("when");
  const Node* dwell = map.optional("for");
  const Node* target = map.required("goto");
  const Node* set = map.optional("set");
  const Node* note = map.optional("note");
  const bool is_split = map.report_split_condition();
  if (when != nullptr && !is_split) exit.when = parse_condition(*when, diagnostics);
  if (dwell != nullptr) exit.dwell = parse_value(*dwell, "`for`", diagnostics);
  if (target != nullptr) exit.target = parse_word(*target, "`goto`", diagnostics);
  if (set != nullptr) exit.set = parse_sets(*set, diagnostics);
  if (note != nullptr) exit.note = note->text;
  map.finish();
  return exit;
}

TimeoutText parse_timeout(const Node& node, Diagnostics& diagnostics) {
  TimeoutText timeout;
  timeout.span = node.span;
  if (node.is_scalar() && node.text == "never") {
    timeout.is_never = true;
    return timeout;
  }
  if (node.is_scalar()) {
    if (!node.is_bad) diagnostics.add(wording::bare_timeout(node.span, node.text));
    return timeout;
  }
  MapReader map(node, "`timeout`", diagnostics);
  if (const Node* after = map.required("after")) {
    timeout.after = parse_value(*after, "timeout.after", diagnostics);
  }
  if (const Node* target = map.required("goto")) timeout.target = parse_word(*target, "`goto`", diagnostics);
  map.finish();
  return timeout;
}

void parse_enter(const Node& node, TaskText& task, Diagnostics& diagnostics) {
  MapReader map(node, "`enter`", diagnostics);
  if (const Node* blend = map.optional("blend")) {
    task.blend = parse_value(*blend, "enter.blend", diagnostics);
  }
  if (const Node* set = map.optional("set")) task.set_on_entry = parse_sets(*set, diagnostics);
  map.finish();
}

}  // namespace

std::vector<GroupText> parse_groups(const Node& node, Diagnostics& diagnostics) {
  std::vector<GroupText> groups;
  if (!require_mapping(node, "`constraints`", diagnostics)) return groups;
  if (node.entries.size() > most_groups) {
    diagnostics.add(wording::too_many_groups(node.entries[most_groups].key.span, most_groups));
    return groups;
  }
  for (const Entry& entry : node.entries) {
    if (!entry.key.is_bad) groups.push_back(parse_group(entry, diagnostics));
  }
  return groups;
}

std::vector<ExitText> parse_exits(const Node& node, Diagnostics& diagnostics) {
  std::vector<ExitText> exits;
  if (!require_sequence(node, "`exits`", diagnostics)) return exits;
  for (const Node& item : node.items) exits.push_back(parse_exit(item, diagnostics));
  return exits;
}

TaskText parse_task(const Entry& entry, Diagnostics& diagnostics) {
  TaskText task;
  task.name = parse_name(entry.key, "a task's name", diagnostics);
  const std::string& name = task.name.text;
  if (name == "done" || name == "failed" || name == "back") {
    diagnostics.add(wording::reserved_name(entry.key.span, name));
  }
  MapReader map(entry.value, "task `" + entry.key.text + "`", diagnostics);
  if (const Node* node = map.optional("about")) task.about = node->text;
  if (const Node* node = map.optional("enter")) parse_enter(*node, task, diagnostics);
  if (const Node* node = map.optional("constraints")) task.groups = parse_groups(*node, diagnostics);
  if (const Node* node = map.optional("exits")) task.exits = parse_exits(*node, diagnostics);
  if (const Node* node = map.optional("timeout")) task.timeout = parse_timeout(*node, diagnostics);
  map.finish();
  return task;
}

}  // namespace zwang::lang
