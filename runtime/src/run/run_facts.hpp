/// How a run was computed, in the words of a log's facts.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

using RunFacts = std::map<std::string, std::string>;

/// The version, the compiler and the library that torques depend on to their last bit, and the settings.
RunFacts facts_of(const RunnerSettings& settings, double period);

/// Throws std::runtime_error where they lack the control period, or a number is invalid.
RunnerSettings settings_of(const RunFacts& facts);

/// The number that `exactly` has written; nullopt for a text that is no number.
std::optional<double> number_in(const std::string& text);

}  // namespace zwang::runtime
