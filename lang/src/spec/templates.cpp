#include "spec/templates.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/shape.hpp"
#include "tree/read.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

struct ArgumentKind {
  std::string_view word;
  std::optional<Dimension> dimension;  ///< none: a name
};

constexpr std::array argument_kinds{
    ArgumentKind{"frame", std::nullopt},
    ArgumentKind{"task", std::nullopt},
    ArgumentKind{"feature", std::nullopt},
    ArgumentKind{"signal", std::nullopt},
    ArgumentKind{"region", std::nullopt},
    ArgumentKind{"bool", std::nullopt},
    ArgumentKind{"number", dimension::none},
    ArgumentKind{"length", dimension::length},
    ArgumentKind{"angle", dimension::angle},
    ArgumentKind{"time", dimension::time},
    ArgumentKind{"mass", dimension::mass},
    ArgumentKind{"velocity", dimension::velocity},
    ArgumentKind{"acceleration", dimension::acceleration},
    ArgumentKind{"force", dimension::force},
    ArgumentKind{"torque", dimension::torque},
    ArgumentKind{"angular_velocity", dimension::angular_velocity},
    ArgumentKind{"angular_acceleration", dimension::angular_acceleration},
};

const ArgumentKind* find_kind(const std::string& word) {
  for (const ArgumentKind& kind : argument_kinds) {
    if (kind.word == word) return &kind;
  }
  return nullptr;
}

bool is_name_part(char c) {
  return is_identifier(std::string{'_', c});
}

const Entry* misspelt_with(const Node& task) {
  if (task.find("with") != nullptr) return nullptr;
  for (const Entry& entry : task.entries) {
    if (!meant_key(entry.key.text, {"with"}).empty()) return &entry;
  }
  return nullptr;
}

int count_nodes(const Node& node) {
  int count = 1;
  for (const Node& item : node.items) count += count_nodes(item);
  for (const Entry& entry : node.entries) count += 1 + count_nodes(entry.value);
  return count;
}

/// The end of the name behind the `$` at `at`.
std::size_t name_end(const std::string& text, std::size_t at) {
  std::size_t end = at + 1;
  while (end < text.size() && is_name_part(text[end])) ++end;
  return end;
}

/// Every `$name` in the values below the node.
void gather_names(const Node& node, std::set<std::string>& names) {
  for (const Node& item : node.items) gather_names(item, names);
  for (const Entry& entry : node.entries) gather_names(entry.value, names);
  for (std::size_t at = node.text.find('$'); at != std::string::npos; at = node.text.find('$', at + 1))
    names.insert(node.text.substr(at + 1, name_end(node.text, at) - at - 1));
}

/// Puts the arguments' texts in the place of `$name` everywhere below a node.
class Substitution {
 public:
  Substitution(const std::map<std::string, Node>& values, Diagnostics& diagnostics)
      : values_(values), diagnostics_(diagnostics) {}

  void put_into(Node& node) const {
    for (Node& item : node.items) put_into(item);
    for (Entry& entry : node.entries) put_into(entry.value);
    if (!node.is_scalar() || put_behind_sign(node)) return;
    std::string result;
    for (std::size_t at = 0; at < node.text.size();) {
      const std::size_t end = node.text[at] == '$' ? name_end(node.text, at) : at + 1;
      const Node* value =
          node.text[at] == '$' ? value_named(node.text.substr(at + 1, end - at - 1)) : nullptr;
      if (value != nullptr) {
        result += trimmed(value->text);
        node.is_replaced = true;
        // A text that consists of the argument alone was written at the call. Its errors are reported there.
        const bool is_whole = at == 0 && end == node.text.size();
        if (is_whole && !value->is_bad) node.span = value->span;
        node.is_bad = node.is_bad || value->is_bad;
      } else {
        result += node.text.substr(at, end - at);
      }
      at = end;
    }
    node.text = std::move(result);
  }

 private:
  const Node* value_named(const std::string& name) const {
    const auto value = values_.find(name);
    return value == values_.end() ? nullptr : &value->second;
  }

  /// `-$name` and `+-$name`, and nothing else, with a value that has a minus itself. Whether it was so.
  bool put_behind_sign(Node& node) const {
    const std::size_t at = node.text.starts_with("+-$") ? 2 : node.text.starts_with("-$") ? 1 : 0;
    if (at == 0 || name_end(node.text, at) != node.text.size()) return false;
    const std::string name = node.text.substr(at + 1);
    const Node* value = value_named(name);
    if (value == nullptr || value->is_bad || !trimmed(value->text).starts_with("-")) return false;
    node.is_replaced = true;
    if (at == 1) {
      node.text = trimmed(trimmed(value->text).substr(1));
      return true;
    }
    diagnostics_.add(wording::negative_width(value->span, name, node.text, node.span));
    node.is_bad = true;
    return true;
  }

  const std::map<std::string, Node>& values_;
  Diagnostics& diagnostics_;
};

}  // namespace

void Templates::declare(const Node& node) {
  if (!require_mapping(node, "`templates`", diagnostics_)) return;
  for (const Entry& entry : node.entries) {
    if (entry.key.is_bad) continue;
    Template declared;
    declared.span = entry.key.span;
    bool has_names = parse_name(entry.key, "a template's name", diagnostics_).exists();
    MapReader map(entry.value, "template `" + entry.key.text + "`", diagnostics_);
    const Node* group = map.optional("group");
    declared.is_group = group != nullptr || map.has_misspelt({"group"});
    if (group != nullptr && entry.value.find("body") != nullptr) {
      map.optional("body");
      diagnostics_.add(wording::body_and_group(entry.key.span, entry.key.text));
    }
    declared.body = declared.is_group ? group : map.required("body");
    std::set<std::string> named;
    if (declared.body != nullptr) gather_names(*declared.body, named);
    const Node* arguments = map.optional("args");
    const bool has_list = arguments == nullptr || require_mapping(*arguments, "`args`", diagnostics_);
    if (arguments != nullptr && has_list) {
      for (const Entry& argument : arguments->entries) {
        has_names = parse_name(argument.key, "an argument's name", diagnostics_).exists() && has_names;
        if (argument.value.kind == NodeKind::null) {
          diagnostics_.add(wording::argument_without_kind(argument.key.span, argument.key.text));
        } else if (find_kind(argument.value.text) == nullptr) {
          std::vector<std::string> known;
          for (const ArgumentKind& kind : argument_kinds) known.emplace_back(kind.word);
          diagnostics_.add(
              wording::unknown_name(argument.value.span, "kind of argument", argument.value.text, known));
        }
        declared.arguments[argument.key.text] = argument.value.text;
        if (declared.body != nullptr && !named.contains(argument.key.text))
          declared.unused.emplace_back(argument.key.text, argument.key.span);
      }
    }
    declared.is_bad = declared.body == nullptr || !has_list || !has_names || map.has_misspelt({"args"});
    if (declared.body != nullptr) declared.nodes = count_nodes(*declared.body);
    map.finish();
    templates_[entry.key.text] = declared;
  }
}

std::optional<Node> Templates::expand(const Node& task) {
  std::set<std::string> open;
  std::optional<Node> expanded = expand_from(task, false, open);
  if (expanded) expand_groups(*expanded);
  return expanded;
}

void Templates::expand_groups(Node& owner) {
  const auto constraints = std::find_if(owner.entries.begin(), owner.entries.end(),
                                        [](const Entry& entry) { return entry.key.text == "constraints"; });
  if (constraints == owner.entries.end()) return;
  for (Entry& group : constraints->value.entries) {
    if (!group.value.is_mapping() || group.value.find("use") == nullptr) continue;
    std::set<std::string> open;
    std::optional<Node> expanded = expand_from(group.value, true, open);
    if (expanded) {
      group.value = std::move(*expanded);
    } else {
      group.value.is_bad = true;
    }
  }
}

std::optional<Node> Templates::expand_from(const Node& task, bool is_group, std::set<std::string>& open) {
  const Entry* use = task.is_mapping() ? task.find("use") : nullptr;
  if (use == nullptr) return task;
  const Word name = parse_word(use->value, "`use`", diagnostics_);
  if (!name.exists()) return std::nullopt;
  const auto found = templates_.find(name.text);
  if (found == templates_.end() && forgives_unknown_) return std::nullopt;
  if (found == templates_.end()) {
    std::vector<std::string> known;
    for (const auto& [other, declared] : templates_) {
      if (declared.is_group == is_group) known.push_back(other);
    }
    diagnostics_.add(wording::unknown_name(name.span, "template", name.text, known));
    return std::nullopt;
  }
  Template& used = found->second;
  used.is_used = true;
  if (!used.is_bad && used.is_group != is_group) {
    diagnostics_.add(wording::template_of_another_part(name.span, name.text, used.is_group));
    return std::nullopt;
  }
  if (!open.insert(name.text).second) {
    diagnostics_.add(wording::template_recursion(name.span, name.text));
    return std::nullopt;
  }
  if (nodes_ > most_nodes) return std::nullopt;
  nodes_ += used.nodes;
  if (nodes_ > most_nodes) {
    diagnostics_.add(wording::too_many_expanded_nodes(name.span, most_nodes));
    return std::nullopt;
  }
  if (const Entry* with = misspelt_with(task)) {
    const std::string what = std::string(is_group ? "a group" : "a task") + " that uses a template";
    diagnostics_.add(wording::unknown_key(with->key.span, with->key.text, what, "with", {}, {}));
    return std::nullopt;
  }
  std::map<std::string, Node> values;
  if (used.is_bad || !fill_arguments(used, task, name.text, values)) return std::nullopt;
  Node body = *used.body;
  Substitution(values, diagnostics_).put_into(body);
  std::optional<Node> expanded = expand_from(body, is_group, open);
  const std::string what =
      std::string("the ") + (is_group ? "group" : "body") + " of template `" + name.text + "`";
  if (!expanded || !require_mapping(*expanded, what, diagnostics_)) {
    return std::nullopt;
  }
  for (const Entry& entry : task.entries) {
    if (entry.key.text == "use" || entry.key.text == "with") continue;
    std::erase_if(expanded->entries, [&](const Entry& old) { return old.key.text == entry.key.text; });
    expanded->entries.push_back(entry);
  }
  return expanded;
}

bool Templates::fill_arguments(const Template& used, const Node& task, const std::string& name,
                               std::map<std::string, Node>& values) {
  const Entry* with = task.find("with");
  if (with != nullptr && !require_mapping(with->value, "`with`", diagnostics_)) return false;
  std::vector<std::string> known;
  for (const auto& [argument, kind] : used.arguments) known.push_back(argument);
  bool is_misspelt = false;
  bool is_good = true;
  for (const Entry& entry : with != nullptr ? with->value.entries : std::vector<Entry>{}) {
    const auto argument = used.arguments.find(entry.key.text);
    if (argument == used.arguments.end()) {
      const std::string meant = nearest(entry.key.text, known);
      is_misspelt = is_misspelt || !meant.empty();
      diagnostics_.add(wording::extra_argument(entry.key.span, name, entry.key.text, meant));
      is_good = false;
    } else if (check_argument(argument->first, argument->second, entry.value)) {
      values[argument->first] = entry.value;
    } else {
      values[argument->first].is_bad = true;
      is_good = false;
    }
  }
  std::vector<std::string> missing;
  for (const std::string& argument : known) {
    if (!values.contains(argument) && !is_misspelt) missing.push_back(argument);
  }
  if (!missing.empty()) {
    diagnostics_.add(wording::missing_template_arguments(task.find("use")->value.span, name, missing));
    is_good = false;
  }
  return is_good;
}

bool Templates::check_argument(const std::string& name, const std::string& kind, const Node& value) {
  const ArgumentKind* expected = find_kind(kind);
  if (expected == nullptr || value.is_bad) return false;
  if (expected->word == "bool") {
    const std::string text = value.is_scalar() ? trimmed(value.text) : std::string();
    if (text == "true" || text == "false") return true;
    diagnostics_.add(wording::wrong_argument(value.span, name, "`true` or `false`"));
    return false;
  }
  if (!expected->dimension) {
    if (value.is_scalar() && !value.text.empty() && value.text[0] != '$' && number_length(value.text) == 0) {
      named_arguments_.push_back({{trimmed(value.text), value.span}, name, kind});
      return true;
    }
    diagnostics_.add(wording::wrong_argument(value.span, name, "the name of a " + kind));
    return false;
  }
  const ValueText text = parse_value(value, "argument `" + name + "`", diagnostics_);
  if (text.kind == ValueKind::bad) return false;
  if (text.kind == ValueKind::parameter) return check_parameter(name, text, *expected->dimension);
  const bool fits = text.kind == ValueKind::quantity && text.quantity.dimension == *expected->dimension;
  if (!fits && text.kind == ValueKind::quantity && !text.quantity.has_unit) {
    diagnostics_.add(
        wording::argument_without_unit(value.span, name, text.quantity.number, *expected->dimension));
    return false;
  }
  if (!fits) diagnostics_.add(wording::wrong_argument(value.span, name, describe(*expected->dimension)));
  return fits;
}

bool Templates::check_parameter(const std::string& name, const ValueText& value, const Dimension& expected) {
  const auto parameter = parameters_.find(value.name);
  if (parameter == parameters_.end() && forgives_unknown_) return false;
  if (parameter == parameters_.end()) {
    std::vector<std::string> known;
    for (const auto& [other, dimension] : parameters_) known.push_back(other);
    diagnostics_.add(wording::unknown_name(value.span, "parameter", value.name, known));
    return false;
  }
  if (!parameter->second) return false;
  if (*parameter->second == expected) return true;
  diagnostics_.add(wording::wrong_argument(
      value.span, name,
      describe(expected) + ", but `" + value.name + "` is " + describe(*parameter->second)));
  return false;
}

bool Templates::has_unknown_name(const Node& body, const Template& declared) const {
  std::set<std::string> named;
  gather_names(body, named);
  return std::any_of(named.begin(), named.end(), [&](const std::string& name) {
    return !declared.arguments.contains(name) && !parameters_.contains(name);
  });
}

void Templates::report_unused() const {
  for (const auto& [name, declared] : templates_) {
    if (!declared.is_used) {
      diagnostics_.add(wording::unused(declared.span, "template", name));
      continue;
    }
    // The body may name the argument by a misspelt name. Then the unknown name is the error.
    if (has_unknown_name(*declared.body, declared)) continue;
    for (const auto& [argument, span] : declared.unused)
      diagnostics_.add(wording::unused(span, "argument", argument));
  }
}

}  // namespace zwang::lang
