#include <algorithm>
#include <map>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/measured_value.hpp"
#include "spec/parse_group.hpp"
#include "spec/parse_task.hpp"
#include "spec/shape.hpp"
#include "spec/task_file.hpp"
#include "spec/templates.hpp"

namespace zwang::lang {

namespace {

ParameterText parse_parameter(const Entry& entry, Diagnostics& diagnostics) {
  ParameterText parameter;
  parameter.name = parse_name(entry.key, "a parameter's name", diagnostics);
  const std::string what = "parameter `" + entry.key.text + "`";
  if (!entry.value.is_mapping()) {
    parameter.value = parse_value(entry.value, what, diagnostics);
    return parameter;
  }
  MapReader map(entry.value, what, diagnostics);
  if (const Node* range = map.optional("range")) {
    parameter.range = parse_range(*range, "the range of " + what, diagnostics);
  }
  const bool has_unit = parameter.range && parameter.range->low.kind == ValueKind::quantity &&
                        parameter.range->low.quantity.has_unit;
  const auto measured = has_unit ? std::optional(parameter.range->low.quantity.dimension) : std::nullopt;
  if (const Node* value = map.required("value"))
    parameter.value = parse_measured_value(*value, what, measured, diagnostics);
  if (const Node* help = map.optional("help")) parameter.help = parse_text(*help, "`help`", diagnostics);
  map.finish();
  return parameter;
}

void parse_tasks(const Node& node, Templates& templates, TaskFile& file, Diagnostics& diagnostics) {
  if (!require_mapping(node, "`tasks`", diagnostics)) return;
  if (node.entries.empty()) diagnostics.add(wording::no_tasks(node.span));
  if (node.entries.size() > most_tasks) {
    diagnostics.add(wording::too_many_tasks(node.entries[most_tasks].key.span, most_tasks));
  }
  Node unreadable;
  unreadable.is_bad = true;
  for (auto entry = node.entries.begin(); entry != node.entries.end(); ++entry) {
    if (entry->key.is_bad) continue;
    const auto is_of_a_task = [](const Entry& line) {
      const bool is_exits = line.key.text == "exits" && line.value.is_sequence();
      const bool is_timeout =
          line.key.text == "timeout" && (line.value.is_scalar() || line.value.find("after") != nullptr);
      return is_exits || is_timeout || line.key.text == "constraints";
    };
    const auto next = entry + 1;
    if (entry->value.kind == NodeKind::null && next != node.entries.end() && is_of_a_task(*next)) {
      diagnostics.add(wording::not_indented_in_task(next->key.span, next->key.text, entry->key.text));
      file.tasks.push_back(parse_task(*entry, unreadable, diagnostics));
      entry = std::find_if_not(next, node.entries.end(), is_of_a_task) - 1;
      continue;
    }
    file.tasks.push_back(
        parse_task(*entry, templates.expand(entry->value).value_or(unreadable), diagnostics));
  }
}

void parse_always(const Node& written, Templates& templates, TaskFile& file, Diagnostics& diagnostics) {
  Node node = written;
  templates.expand_groups(node);
  MapReader map(node, "`always`", diagnostics, "{exits: [{when: elapsed > 60 s, goto: failed}]}");
  file.always_groups = parse_constraints(map, 0, diagnostics);
  if (const Node* exits = map.optional("exits")) file.always_exits = parse_exits(*exits, diagnostics);
  if (map.has_misspelt({"exits"})) file.always_exits.push_back({.is_incomplete = true});
  map.finish();
}

std::map<std::string, std::optional<Dimension>> dimensions_of(const std::vector<ParameterText>& parameters) {
  std::map<std::string, std::optional<Dimension>> dimensions;
  for (const ParameterText& parameter : parameters) {
    if (!parameter.name.exists()) continue;
    // Where only the range has a unit, the value lacks one.
    const bool lacks_unit = parameter.range && parameter.range->low.kind == ValueKind::quantity &&
                            parameter.range->low.quantity.has_unit && !parameter.value.quantity.has_unit;
    const bool is_good = parameter.value.kind == ValueKind::quantity && !lacks_unit;
    dimensions[parameter.name.text] =
        is_good ? std::optional(parameter.value.quantity.dimension) : std::nullopt;
  }
  return dimensions;
}

/// The help of a missing `start` names it.
std::string first_task(const Document& document) {
  const Entry* tasks = document.root.find("tasks");
  const bool is_known = tasks != nullptr && tasks->value.is_mapping() && !tasks->value.entries.empty();
  return is_known ? tasks->value.entries.front().key.text : "..";
}

}  // namespace

const char* word_of(solver::Quantity quantity) {
  switch (quantity) {
    case solver::Quantity::position:
      return "position";
    case solver::Quantity::velocity:
      return "velocity";
    case solver::Quantity::acceleration:
      return "acceleration";
    case solver::Quantity::force:
      break;
  }
  return "force";
}

std::optional<solver::Axis> axis_named(std::string_view name) {
  static constexpr std::array<std::string_view, 6> names{"x", "y", "z", "rx", "ry", "rz"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<solver::Axis>(i);
  }
  return std::nullopt;
}

bool is_rotation(solver::Axis axis) {
  return axis >= solver::Axis::rx;
}

Dimension dimension_of(solver::Axis axis, solver::Quantity quantity) {
  const bool turns = is_rotation(axis);
  switch (quantity) {
    case solver::Quantity::position:
      return turns ? dimension::angle : dimension::length;
    case solver::Quantity::velocity:
      return turns ? dimension::angular_velocity : dimension::velocity;
    case solver::Quantity::acceleration:
      return turns ? dimension::angular_acceleration : dimension::acceleration;
    case solver::Quantity::force:
      break;
  }
  return turns ? dimension::torque : dimension::force;
}

void parse_pose(MapReader& map, std::vector<double>& at, std::vector<double>& rpy, Diagnostics& diagnostics) {
  const Node* position = map.optional("at");
  const Node* yaw = map.optional("yaw");
  const Node* angles = map.optional("rpy");
  if (position != nullptr &&
      !complain_of_third_value(*position, map.what() + "'s `at`", "at", "yaw", true, diagnostics)) {
    at = parse_vector(*position, dimension::length, 2, 3, map.what() + "'s `at`", diagnostics)
             .value_or(std::vector<double>{});
  }
  if (yaw != nullptr && angles != nullptr) {
    diagnostics.add(wording::yaw_and_rpy(angles->span, map.what(), yaw->span));
  } else if (yaw != nullptr) {
    rpy = {0.0, 0.0, parse_plain(*yaw, dimension::angle, map.what() + "'s `yaw`", diagnostics).value_or(0.0)};
  } else if (angles != nullptr) {
    rpy = parse_vector(*angles, dimension::angle, 3, 3, map.what() + "'s `rpy`", diagnostics)
              .value_or(std::vector<double>{});
  }
}

FrameText parse_frame(const Entry& entry, Diagnostics& diagnostics) {
  FrameText frame;
  frame.name = parse_name(entry.key, "a frame's name", diagnostics);
  frame.span = entry.key.span;
  const std::string example = entry.value.is_scalar() ? "{parent: " + entry.value.text + "}"
                                                      : "{parent: world, at: [1 m, 0 m], yaw: 90 deg}";
  MapReader map(entry.value, "frame `" + entry.key.text + "`", diagnostics, example);
  if (const Node* parent = map.required("parent")) {
    frame.parent = parse_word(*parent, map.what() + "'s `parent`", diagnostics);
  }
  parse_pose(map, frame.at, frame.rpy, diagnostics);
  map.finish();
  return frame;
}

solver::Pose pose_of(const FrameText& frame) {
  solver::Pose pose;
  if (frame.rpy.size() == 3) {
    pose.rotation = solver::rotation_from_rpy(frame.rpy[0], frame.rpy[1], frame.rpy[2]);
  }
  for (std::size_t i = 0; i < frame.at.size(); ++i) {
    pose.position[static_cast<Eigen::Index>(i)] = frame.at[i];
  }
  return pose;
}

std::optional<TaskFile> parse(const Document& document, Diagnostics& diagnostics) {
  MapReader map(document.root, "a task file", diagnostics);
  if (!map.is_mapping()) return std::nullopt;
  if (!check_version(map, "zwang", newest_task_version, diagnostics)) return std::nullopt;
  TaskFile file;
  if (const Node* robot = map.required("robot")) file.robot = parse_word(*robot, "`robot`", diagnostics);
  if (const Node* scene = map.optional("scene")) file.scene = parse_word(*scene, "`scene`", diagnostics);
  if (const Node* about = map.optional("about")) file.about = parse_text(*about, "`about`", diagnostics);
  const auto each = [&](std::string_view key, const auto& use) {
    const Node* node = map.optional(key);
    if (node == nullptr || !require_mapping(*node, "`" + std::string(key) + "`", diagnostics)) return;
    for (const Entry& entry : node->entries) {
      if (!entry.key.is_bad) use(entry);
    }
  };
  each("params", [&](const Entry& e) { file.parameters.push_back(parse_parameter(e, diagnostics)); });
  each("frames", [&](const Entry& e) { file.frames.push_back(parse_frame(e, diagnostics)); });
  if (const Node* node = map.optional("regions")) file.regions = parse_regions(*node, diagnostics);
  if (const Node* node = map.optional("paths")) parse_paths(*node, file, diagnostics);
  if (const Node* node = map.optional("signals")) file.signals = parse_signals(*node, diagnostics);
  if (const Node* node = map.optional("outputs")) file.outputs = parse_outputs(*node, diagnostics);
  if (const Node* node = map.optional("features")) file.features = parse_features(*node, diagnostics);
  Templates templates(dimensions_of(file.parameters), diagnostics);
  if (const Node* node = map.optional("templates")) templates.declare(*node);
  if (map.has_misspelt({"templates", "params"})) templates.forgive_unknown();
  if (const Node* node = map.optional("always")) parse_always(*node, templates, file, diagnostics);
  if (const Node* start = map.required("start", first_task(document)))
    file.start = parse_word(*start, "`start`", diagnostics);
  if (const Node* tasks = map.required("tasks")) parse_tasks(*tasks, templates, file, diagnostics);
  for (const char* section : {"params", "frames", "regions", "paths", "signals", "outputs", "features",
                              "templates", "always", "tasks"}) {
    const Entry* entry = document.root.find(section);
    file.is_incomplete = file.is_incomplete || (entry == nullptr && map.has_misspelt({section})) ||
                         (entry != nullptr && !entry->value.is_mapping());
  }
  file.named_arguments = templates.named_arguments();
  map.finish();
  if (!diagnostics.has_errors()) templates.report_unused();
  return file;
}

}  // namespace zwang::lang
