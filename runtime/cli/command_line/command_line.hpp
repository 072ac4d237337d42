/// The verbs of `zwang` and their options. This folder is the one that knows CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "verbs.hpp"

namespace zwang::cli {

using Chosen = std::function<int()>;  ///< what the verb that was typed does

// Each adds verbs; the one that is typed sets `chosen`.
void add_file_verbs(CLI::App& app, Chosen& chosen);
void add_robot_verbs(CLI::App& app, Chosen& chosen);
void add_run_verbs(CLI::App& app, Chosen& chosen);
void add_log_verbs(CLI::App& app, Chosen& chosen);
void add_tool_verbs(CLI::App& app, Chosen& chosen);

/// The words that an option takes: told as they are written, not with the numbers that they stand for.
template <typename Value>
void takes(CLI::Option* option, const std::map<std::string, Value>& words) {
  std::vector<std::string> names;
  for (const auto& [word, value] : words) names.push_back(word);
  CLI::Transformer to_value(words, CLI::ignore_case);
  to_value.description("");
  option->transform(to_value)->transform(CLI::IsMember(names, CLI::ignore_case))->type_name("TEXT");
}

void add_format(CLI::App& verb, Format& format);
/// The options by which a verb that reads a task file may replace its statements.
void add_overrides(CLI::App& verb, TaskOverrides& overrides);
/// The option `--log-rotate`.
CLI::Option* add_log_limits(CLI::App& verb, std::optional<double>& rate, std::vector<std::string>& rotation);

}  // namespace zwang::cli
