/// A condition as the ways in which it can be true.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "check/context.hpp"

namespace zwang::lang {

/// The range of a measured number, in SI. A truth value is 0 or 1.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool excludes_low = false, excludes_high = false;

  bool is_empty() const { return low > high || (low == high && (excludes_low || excludes_high)); }
};

Bounds both(const Bounds& a, const Bounds& b);

/// A measured number, and what a case demands of it.
struct Demanded {
  const ExpressionNode* node = nullptr;
  Bounds bounds;
};

/// All of it must hold at once. By what is measured: two tasks that measure the same have the same key.
using Case = std::map<std::string, Demanded>;

/// One of the cases makes the condition true; no case: none can. Parts that are not a sum of one measured
/// number and constants demand nothing. nullopt: too many cases to be told apart. `groups`: of the task that
/// the condition stands in. `is_negated`: the cases in which the condition is false.
std::optional<std::vector<Case>> cases_of(const CheckContext& context, const Condition& condition,
                                          const std::vector<GroupText>& groups, bool is_negated = false);

/// Whether some `set` of the file gives the parameter another value.
bool is_set_later(const CheckContext& context, const std::string& parameter);
bool is_set_later(const CheckContext& context, const ValueText& value);

/// Both at once; nullopt where they exclude each other.
std::optional<Case> both(const Case& a, const Case& b);

}  // namespace zwang::lang
