#include <algorithm>
#include <array>

#include "check/condition_names.hpp"
#include "check/context.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "words/nearest.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

class ConditionCheck {
 public:
  ConditionCheck(CheckContext& context, const ConditionText& text, const std::vector<GroupText>& groups)
      : context_(context), text_(text), names_(context, groups) {}

  std::optional<Condition> check(Dimension* compared, std::vector<Dimension>* of_nodes) {
    Condition condition = lowered();
    const Type& root = types_.back();
    if (root.is_bad) return std::nullopt;
    if (!root.is_boolean) {
      context_.diagnostics.add(wording::not_a_condition(text_.nodes.back().span, root.dimension));
      return std::nullopt;
    }
    const int left = text_.nodes.back().left;
    if (compared != nullptr && left >= 0) *compared = type(left).dimension;
    list_terms(static_cast<int>(text_.nodes.size()) - 1, condition);
    if (of_nodes != nullptr) {
      for (const Type& type : types_) of_nodes->push_back(type.dimension);
    }
    return condition;
  }

  /// The expression, if its value has the dimension `expected`. nullopt on an error.
  std::optional<Condition> check_value_of(const std::string& what, const Dimension& expected) {
    Condition expression = lowered();
    const Type& root = types_.back();
    if (root.is_bad) return std::nullopt;
    const Span& span = text_.nodes.back().span;
    if (root.is_boolean) {
      context_.diagnostics.add(wording::expected_number(span));
      return std::nullopt;
    }
    if (root.dimension == expected) return expression;
    const ExpressionText& only = text_.nodes.back();
    const bool is_bare = only.kind == ExpressionKind::quantity && !only.quantity.has_unit;
    context_.diagnostics.add(is_bare ? wording::needs_unit(span, what, only.quantity.number, expected)
                                     : wording::wrong_dimension(span, what, expected, root.dimension));
    return std::nullopt;
  }

 private:
  Condition lowered() {
    Condition condition;
    condition.text = text_.text;
    condition.span = text_.span;
    for (const ExpressionText& node : text_.nodes) {
      ExpressionNode lowered;
      Type type = check_node(node, lowered);
      lowered.left = node.left;
      lowered.right = node.right;
      types_.push_back(type);
      condition.nodes.push_back(lowered);
    }
    return condition;
  }

  void list_terms(int node, Condition& condition) const {
    const auto i = static_cast<std::size_t>(node);
    const ExpressionNode& lowered = condition.nodes[i];
    const bool joins = lowered.op == Op::logical_and || lowered.op == Op::logical_or;
    if (joins || lowered.op == Op::logical_not) {
      list_terms(lowered.left, condition);
      if (joins) list_terms(lowered.right, condition);
      return;
    }
    const bool compares = lowered.op >= Op::less && lowered.op <= Op::greater_equal;
    condition.terms.push_back(
        {node, text_.nodes[i].text, compares ? usual_unit(type(lowered.left).dimension) : std::string()});
  }

  const Type& type(int i) const { return types_[static_cast<std::size_t>(i)]; }
  const ExpressionText& node_at(int i) const { return text_.nodes[static_cast<std::size_t>(i)]; }

  Type complain(Diagnostic diagnostic) {
    context_.diagnostics.add(std::move(diagnostic));
    return bad_type;
  }

  Type check_node(const ExpressionText& node, ExpressionNode& lowered) {
    switch (node.kind) {
      case ExpressionKind::quantity:
        lowered.op = Op::constant;
        lowered.number = node.quantity.value;
        return quantity_type(node.quantity.dimension);
      case ExpressionKind::parameter:
        return check_parameter(node, lowered);
      case ExpressionKind::name:
        return names_.type_of(node, lowered);
      case ExpressionKind::call:
        return check_call(node, lowered);
      case ExpressionKind::negate:
        lowered.op = Op::negate;
        return require_number(node.left);
      case ExpressionKind::logical_not:
        lowered.op = Op::logical_not;
        return require_boolean(node.left);
      case ExpressionKind::binary:
        break;
    }
    return check_binary(node, lowered);
  }

  Type check_parameter(const ExpressionText& node, ExpressionNode& lowered) {
    ParameterSymbol* symbol = context_.symbols.find_parameter(node.word);
    if (symbol == nullptr) {
      return complain(
          wording::unknown_name(node.span, "parameter", node.word, context_.symbols.parameter_names()));
    }
    symbol->is_used = true;
    lowered.op = Op::parameter;
    lowered.index = static_cast<int>(symbol - context_.symbols.parameters.data());
    return symbol->is_bad ? bad_type : quantity_type(symbol->dimension);
  }

  Type check_call(const ExpressionText& node, ExpressionNode& lowered) {
    if (node.word == "abs") {
      lowered.op = Op::abs;
      return require_number(node.left);
    }
    const ConditionFunction& function = *find_function(node.word);
    if (function.argument == FunctionArgument::task) return check_call_of_task(node, lowered);
    if (function.argument == FunctionArgument::signal) {
      const std::optional<int> signal = context_.symbols.find_signal(node.argument);
      if (!signal) return complain_of_argument(node, "signal", context_.symbols.signal_names());
      context_.symbols.signals[static_cast<std::size_t>(*signal)].is_used = true;
      lowered.op = Op::valid;
      lowered.index = *signal;
      return boolean_type;
    }
    if (function.argument == FunctionArgument::path) return check_call_of_path(node, lowered);
    const std::optional<int> frame = check_frame(context_, {node.argument, node.argument_span});
    if (!frame) return bad_type;
    if (context_.symbols.stands_in_world(*frame)) {
      const std::string base = context_.robot ? context_.robot->base_frame : "base_link";
      return complain(wording::motionless(node.span, node.word, node.argument, base));
    }
    lowered = call_of(node.word, *frame);
    return type_of_function(function);
  }

  Type complain_of_argument(const ExpressionText& node, const char* kind,
                            const std::vector<std::string>& known) {
    return complain(wording::unknown_name(node.argument_span, kind, node.argument, known));
  }

  /// Nothing changes its length: a constant.
  Type check_call_of_path(const ExpressionText& node, ExpressionNode& lowered) {
    const std::optional<int> frame = context_.symbols.find_frame(node.argument);
    const int path = frame ? context_.symbols.frames[static_cast<std::size_t>(*frame)].path : -1;
    if (path < 0) {
      std::vector<std::string> known;
      for (const Path& other : context_.file.paths) known.push_back(other.name);
      return complain_of_argument(node, "path", known);
    }
    context_.symbols.frames[static_cast<std::size_t>(*frame)].is_used = true;
    lowered.op = Op::constant;
    lowered.number = context_.file.paths[static_cast<std::size_t>(path)].length();
    return type_of_function(*find_function(node.word));
  }

  Type check_call_of_task(const ExpressionText& node, ExpressionNode& lowered) {
    const std::optional<int> task = context_.symbols.find_task(node.argument);
    if (!task) return complain_of_argument(node, "task", context_.symbols.tasks);
    lowered = call_of(node.word, *task);
    return type_of_function(*find_function(node.word));
  }

  static Type type_of_function(const ConditionFunction& function) {
    const auto& p = function.powers;
    return quantity_type({p[0], p[1], p[2], p[3]});
  }

  Type require_number(int operand) {
    if (type(operand).is_bad) return bad_type;
    if (type(operand).is_boolean) return complain(wording::expected_number(node_at(operand).span));
    return type(operand);
  }

  Type require_boolean(int operand) {
    if (type(operand).is_bad) return bad_type;
    if (!type(operand).is_boolean) {
      return complain(wording::not_a_condition(node_at(operand).span, type(operand).dimension));
    }
    return boolean_type;
  }

  Type check_binary(const ExpressionText& node, ExpressionNode& lowered) {
    struct Operator {
      std::string_view word;
      Op op;
    };
    static constexpr std::array operators{
        Operator{"and", Op::logical_and}, Operator{"or", Op::logical_or}, Operator{"<", Op::less},
        Operator{"<=", Op::less_equal},   Operator{">", Op::greater},     Operator{">=", Op::greater_equal},
        Operator{"+", Op::add},           Operator{"-", Op::subtract},    Operator{"*", Op::multiply},
        Operator{"/", Op::divide},
    };
    for (const Operator& candidate : operators) {
      if (candidate.word == node.word) lowered.op = candidate.op;
    }
    if (lowered.op == Op::logical_and || lowered.op == Op::logical_or) {
      const Type left = require_boolean(node.left);
      const Type right = require_boolean(node.right);
      return left.is_bad || right.is_bad ? bad_type : boolean_type;
    }
    const Type left = require_number(node.left);
    const Type right = require_number(node.right);
    if (left.is_bad || right.is_bad) return bad_type;
    if (lowered.op == Op::multiply) return quantity_type(left.dimension * right.dimension);
    const ExpressionText& below = node_at(node.right);
    const bool is_zero = below.kind == ExpressionKind::quantity && below.quantity.value == 0.0;
    if (lowered.op == Op::divide && is_zero) return complain(wording::divides_by_zero(below.span));
    if (lowered.op == Op::divide) return quantity_type(left.dimension / right.dimension);
    if (left.dimension != right.dimension) return complain_of_mismatch(node, left, right);
    const bool compares = lowered.op != Op::add && lowered.op != Op::subtract;
    return compares ? boolean_type : left;
  }

  /// A bare number beside a quantity lacks its unit; two quantities do not go together.
  Type complain_of_mismatch(const ExpressionText& node, const Type& left, const Type& right) {
    for (const int side : {node.left, node.right}) {
      const ExpressionText& operand = node_at(side);
      const bool is_bare = operand.kind == ExpressionKind::quantity && !operand.quantity.has_unit;
      if (!is_bare) continue;
      const Dimension& other = side == node.left ? right.dimension : left.dimension;
      return complain(wording::needs_unit(operand.span, "this number", operand.quantity.number, other));
    }
    return complain(wording::unlike_operands(node.span, node.word, left.dimension, right.dimension));
  }

  CheckContext& context_;
  const ConditionText& text_;
  ConditionNames names_;
  std::vector<Type> types_;
};

}  // namespace

std::optional<Condition> check_condition(CheckContext& context, const ConditionText& text,
                                         const std::vector<GroupText>& groups, Dimension* compared,
                                         std::vector<Dimension>* of_nodes) {
  return ConditionCheck(context, text, groups).check(compared, of_nodes);
}

std::optional<Condition> check_expression(CheckContext& context, const ConditionText& text,
                                          const std::vector<GroupText>& groups, const std::string& what,
                                          const Dimension& expected) {
  return ConditionCheck(context, text, groups).check_value_of(what, expected);
}

}  // namespace zwang::lang
