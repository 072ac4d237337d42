#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

using solver::FrameMotion;

/// [rad] between two orientations. |A - B| = 2 sqrt(2) sin(angle / 2), the norm of all nine differences.
double angle_between(const solver::Matrix3& a, const solver::Matrix3& b) {
  return 2.0 * std::asin(std::min(1.0, (a - b).norm() / (2.0 * std::numbers::sqrt2)));
}

double speed(double, const FrameMotion&, const FrameMotion& now, double) {
  return now.linear.norm();
}

double moved(double so_far, const FrameMotion& before, const FrameMotion& now, double) {
  return so_far + (now.pose.position - before.pose.position).norm();
}

double turned(double so_far, const FrameMotion& before, const FrameMotion& now, double) {
  return so_far + angle_between(before.pose.rotation, now.pose.rotation);
}

double entries(const TaskEntries& entries) {
  return entries.count;
}

double since(const TaskEntries& entries) {
  return entries.since_last.value_or(std::numeric_limits<double>::quiet_NaN());
}

// The page prints this table: docs/language.md, "Conditions".
constexpr std::array table{
    ConditionFunction{.name = "abs", .argument = FunctionArgument::number, .of = "the magnitude"},
    ConditionFunction{.name = "speed",
                      .powers = {1, 0, -1, 0},
                      .measure = speed,
                      .of = "of the frame's origin, in the world"},
    ConditionFunction{.name = "moved",
                      .powers = {1, 0, 0, 0},
                      .adds_up = true,
                      .measure = moved,
                      .of = "of the origin's path since the task was entered"},
    ConditionFunction{.name = "turned",
                      .powers = {0, 0, 0, 1},
                      .adds_up = true,
                      .measure = turned,
                      .of = "that the frame has turned by since the task was entered, either way"},
    ConditionFunction{.name = "entries",
                      .argument = FunctionArgument::task,
                      .count = entries,
                      .of = "how often the task was entered since the start"},
    ConditionFunction{.name = "since",
                      .argument = FunctionArgument::task,
                      .powers = {0, 0, 1, 0},
                      .count = since,
                      .of = "since the task was entered last; unknown before"},
    ConditionFunction{.name = "length",
                      .argument = FunctionArgument::path,
                      .powers = {1, 0, 0, 0},
                      .of = "of the path, from its first point to its last one"},
    ConditionFunction{.name = "valid",
                      .argument = FunctionArgument::signal,
                      .is_truth = true,
                      .of = "whether the signal is known"},
};

}  // namespace

std::span<const ConditionFunction> condition_functions() {
  return table;
}

std::string list_of_functions() {
  constexpr std::array arguments = {"value", "signal", "frame", "task", "path"};  // by FunctionArgument
  std::string list;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (i > 0) list += i + 1 == table.size() ? " and " : ", ";
    list += std::string(table[i].name) + "(" + arguments[static_cast<std::size_t>(table[i].argument)] + ")";
  }
  return list;
}

const ConditionFunction* find_function(std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const ConditionFunction& function) { return function.name == name; });
  return found == table.end() ? nullptr : &*found;
}

const ConditionFunction& function_of(const ExpressionNode& node) {
  return table[static_cast<std::size_t>(node.function)];
}

bool calls(const ExpressionNode& node, std::string_view name) {
  return (node.op == Op::of_frame || node.op == Op::of_task) && function_of(node).name == name;
}

ExpressionNode call_of(std::string_view name, int frame_or_task) {
  const ConditionFunction* function = find_function(name);
  const bool is_called = function != nullptr && (function->argument == FunctionArgument::frame ||
                                                 function->argument == FunctionArgument::task);
  if (!is_called) throw std::invalid_argument("no function of a frame or a task: " + std::string(name));
  ExpressionNode node;
  node.op = function->argument == FunctionArgument::frame ? Op::of_frame : Op::of_task;
  node.index = frame_or_task;
  node.function = static_cast<int>(function - table.data());
  return node;
}

}  // namespace zwang::lang
