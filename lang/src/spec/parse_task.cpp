#include "spec/parse_task.hpp"

#include <algorithm>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/parse_group.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

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
    const bool is_kind = kind == "frames" || kind == "params" || kind == "outputs";
    if (!is_kind || !is_identifier(name)) {
      diagnostics.add(wording::bad_set(entry.key.span, key));
      continue;
    }
    set.name = {name, entry.key.span};
    set.kind = kind == "frames" ? SetKind::frame : kind == "params" ? SetKind::parameter : SetKind::output;
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
  const Node* release = map.optional("release");
  const Node* target = map.required("goto");
  const Node* set = map.optional("set");
  const Node* note = map.optional("note");
  const bool is_split = map.report_split_condition();
  if (when != nullptr && !is_split) exit.when = parse_condition(*when, diagnostics);
  if (dwell != nullptr) exit.dwell = parse_value(*dwell, "`for`", diagnostics);
  if (release != nullptr) exit.release = parse_value(*release, "`release`", diagnostics);
  if (target != nullptr) exit.target = parse_word(*target, "`goto`", diagnostics);
  if (set != nullptr) exit.set = parse_sets(*set, diagnostics);
  if (note != nullptr) exit.note = parse_text(*note, "`note`", diagnostics);
  exit.is_incomplete = map.has_unread_keys();
  map.finish();
  return exit;
}

/// `text` as a time: with a unit where it lacks one, and some time where it is none.
std::string time_of(const std::string& text) {
  const bool is_a_time = text.starts_with("$") || parse_quantity(text).error == QuantityError::none;
  return is_a_time ? wording::with_unit(text, dimension::time) : "20 s";
}

TimeoutText parse_timeout(const Node& node, Diagnostics& diagnostics) {
  TimeoutText timeout;
  timeout.span = node.span;
  if (node.is_scalar() && node.text == "never") {
    timeout.is_never = true;
    return timeout;
  }
  if (node.is_scalar()) {
    if (!node.is_bad) diagnostics.add(wording::bare_timeout(node.span, time_of(trimmed(node.text))));
    return timeout;
  }
  MapReader map(node, "`timeout`", diagnostics);
  const Entry* never = node.is_mapping() ? node.find("after") : nullptr;
  if (never != nullptr && never->value.is_scalar() && never->value.text == "never") {
    diagnostics.add(wording::never_after(node.span));
    timeout.is_never = true;
    return timeout;
  }
  if (const Node* after = map.required("after")) {
    timeout.after = parse_value(*after, "timeout.after", diagnostics);
  }
  if (const Node* target = map.required("goto")) timeout.target = parse_word(*target, "`goto`", diagnostics);
  if (const Node* note = map.optional("note")) timeout.note = parse_text(*note, "`note`", diagnostics);
  map.finish();
  return timeout;
}

void parse_enter(const Node& node, TaskText& task, Diagnostics& diagnostics) {
  MapReader map(node, "`enter`", diagnostics, "{blend: 0.2 s}");
  if (const Node* require = map.optional("require")) task.require = parse_condition(*require, diagnostics);
  if (const Node* blend = map.optional("blend")) {
    task.blend = parse_value(*blend, "enter.blend", diagnostics);
  }
  if (const Node* set = map.optional("set")) task.set_on_entry = parse_sets(*set, diagnostics);
  map.finish();
}

}  // namespace

std::vector<ExitText> parse_exits(const Node& node, Diagnostics& diagnostics) {
  std::vector<ExitText> exits;
  if (!require_sequence(node, "`exits`", diagnostics)) return exits;
  for (const Node& item : node.items) exits.push_back(parse_exit(item, diagnostics));
  return exits;
}

TaskText parse_task(const Entry& entry, const Node& body, Diagnostics& diagnostics) {
  TaskText task;
  task.name = parse_name(entry.key, "a task's name", diagnostics);
  const std::string& name = task.name.text;
  if (name == "done" || name == "failed" || name == "back") {
    diagnostics.add(wording::reserved_name(entry.key.span, name));
  }
  // Lines of a group are told once, and then not read as a task's.
  Node without_them;
  const auto stray = std::find_if(body.entries.begin(), body.entries.end(), is_of_a_group);
  const bool has_stray = stray != body.entries.end();
  if (has_stray) {
    diagnostics.add(wording::group_in_a_task(stray->key.span, stray->key.text));
    without_them = body;
    std::erase_if(without_them.entries, is_of_a_group);
  }
  MapReader map(has_stray ? without_them : body, "task `" + entry.key.text + "`", diagnostics);
  task.is_bad = !map.is_mapping();
  if (const Node* node = map.optional("about")) task.about = parse_text(*node, "`about`", diagnostics);
  if (const Node* node = map.optional("enter")) parse_enter(*node, task, diagnostics);
  task.groups = parse_constraints(map, 1, diagnostics);
  if (has_stray) task.groups.push_back(unread_group());
  if (const Node* node = map.optional("exits")) task.exits = parse_exits(*node, diagnostics);
  if (const Node* node = map.optional("timeout")) task.timeout = parse_timeout(*node, diagnostics);
  const Node* attempts_node = map.optional("attempts");
  if (attempts_node != nullptr && attempts_node->is_scalar() && !attempts_node->is_bad) {
    diagnostics.add(wording::bare_attempts(attempts_node->span, attempts_node->text));
  } else if (const Node* node = attempts_node) {
    MapReader attempts(*node, "`attempts`", diagnostics);
    AttemptsText text;
    text.span = node->span;
    if (const Node* most = attempts.required("max")) {
      text.most = parse_integer(*most, "attempts.max", 1, 1000000, diagnostics).value_or(1);
    }
    if (const Node* target = attempts.required("goto")) {
      text.target = parse_word(*target, "`goto`", diagnostics);
    }
    if (const Node* note = attempts.optional("note")) text.note = parse_text(*note, "`note`", diagnostics);
    attempts.finish();
    task.attempts = std::move(text);
  }
  if (map.has_misspelt({"use"})) {
    for (const char* key : {"use", "with"}) map.optional(key);
    task.groups.push_back(unread_group());
  }
  task.is_bad = task.is_bad || !task.name.exists() || map.has_unread_keys();
  map.finish();
  return task;
}

}  // namespace zwang::lang
