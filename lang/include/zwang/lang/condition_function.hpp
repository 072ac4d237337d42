/// The functions that conditions may call, in one table: whoever adds one writes a line of it, and what the
/// function measures.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/solver/frame.hpp"

namespace zwang::lang {

enum class FunctionArgument { number, signal, frame, task, path };

/// How often a task was entered, and when.
struct TaskEntries {
  int count = 0;                       ///< since the start of the run
  std::optional<double> since_last{};  ///< [s]; none: never entered
};

struct ConditionFunction {
  std::string_view name;
  FunctionArgument argument = FunctionArgument::frame;
  std::array<int, 4> powers{};                  ///< of length, mass, time and angle, in what it measures
  bool is_truth = false;                        ///< true or false, and no number
  solver::Range values{0.0, solver::infinity};  ///< that it may take
  /// It adds up from the entry of the task on, over an interruption, too. Of a frame: `measure` is given
  /// what it was.
  bool adds_up = false;
  /// Of a frame in one period dt [s], from how it moved before to how it moves now. SI
  double (*measure)(double so_far, const solver::FrameMotion& before, const solver::FrameMotion& now,
                    double dt) = nullptr;
  double (*count)(const TaskEntries& entries) = nullptr;  ///< of a task; NaN: unknown
  std::string_view of;                                    ///< the page's words: "of the frame's origin"
};

/// The table. ExpressionNode::function is an index into it.
ZWANG_EXPORT std::span<const ConditionFunction> condition_functions();
/// `abs(value), speed(frame), .. and valid(signal)`: each with the word for its argument.
ZWANG_EXPORT std::string list_of_functions();
/// nullptr if no function has this name.
ZWANG_EXPORT const ConditionFunction* find_function(std::string_view name);
/// Of a node of the kinds Op::of_frame and Op::of_task.
ZWANG_EXPORT const ConditionFunction& function_of(const ExpressionNode& node);
/// Whether the node calls the function of this name.
ZWANG_EXPORT bool calls(const ExpressionNode& node, std::string_view name);
/// Such a call. std::invalid_argument for a function that is none, or takes neither frame nor task.
ZWANG_EXPORT ExpressionNode call_of(std::string_view name, int frame_or_task);

}  // namespace zwang::lang
