/// The meaning and the dimension of the names in a condition.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/context.hpp"

namespace zwang::lang {

/// The type of an expression's value: a truth value, or a quantity. Bad: a diagnostic was already written.
struct Type {
  bool is_bad = false;
  bool is_boolean = false;
  Dimension dimension;
};

inline constexpr Type bad_type{true, false, {}};
inline constexpr Type boolean_type{false, true, {}};

inline Type quantity_type(const Dimension& dimension) {
  return {false, false, dimension};
}

class ConditionNames {
 public:
  /// `groups`: of the task that the condition stands in.
  ConditionNames(CheckContext& context, const std::vector<GroupText>& groups)
      : context_(context), groups_(groups) {}

  /// Marks what is used; writes E205, E301, E634 and slips. `lowered` takes what the name stands for.
  Type type_of(const ExpressionText& node, ExpressionNode& lowered);

 private:
  Type complain(Diagnostic diagnostic);
  Type type_of_unknown(const ExpressionText& node, const std::vector<std::string>& parts);
  std::vector<std::string> known_names() const;
  std::string truth_meant(const std::string& written) const;
  std::optional<Diagnostic> slip_of_a_name(const ExpressionText& node, const std::vector<std::string>& parts);
  Type check_signal(const ExpressionText& node, int index, ExpressionNode& lowered);
  Type check_output(int index, ExpressionNode& lowered);
  Type check_feature(int index, ExpressionNode& lowered);
  std::optional<Type> check_estimated_force(const ExpressionText& node, ExpressionNode& lowered);
  std::optional<Type> check_wrench(const ExpressionText& node, const std::vector<std::string>& parts,
                                   ExpressionNode& lowered);
  Type check_estimated_wrench(const ExpressionText& node, const std::string& frame, WrenchPart part,
                              ExpressionNode& lowered);
  Type check_coordinate(const ExpressionText& node, const std::vector<std::string>& parts,
                        ExpressionNode& lowered);
  const GroupText* find_group(const std::string& name, ExpressionNode& lowered) const;
  bool has_unread_group() const;
  bool has_unread_name() const;
  solver::Axis axis_measured(const GroupText& group, const std::string& axis) const;

  CheckContext& context_;
  const std::vector<GroupText>& groups_;
};

}  // namespace zwang::lang
