#include <algorithm>
#include <array>

#include "check/context.hpp"
#include "diagnostic/nearest.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"

namespace zwang::lang {

namespace {

/// What an expression yields: true or false, or a quantity. Bad: already complained of.
struct Type {
  bool is_bad = false;
  bool is_boolean = false;
  Dimension dimension;
};

constexpr Type bad_type{true, false, {}};
constexpr Type boolean_type{false, true, {}};

Type quantity_type(const Dimension& dimension) {
  return {false, false, dimension};
}

struct CoordinateWord {
  std::string_view word;
  CoordinateQuantity quantity;
};
constexpr std::array coordinate_words{
    CoordinateWord{"position", CoordinateQuantity::position},
    CoordinateWord{"velocity", CoordinateQuantity::velocity},
    CoordinateWord{"force", CoordinateQuantity::force},
    CoordinateWord{"residual", CoordinateQuantity::residual},
    CoordinateWord{"saturated", CoordinateQuantity::saturated},
};

// In the order of the axis of Op::estimated_force.
constexpr std::array estimated_forces{"estimated.force.x", "estimated.force.y", "estimated.force.rz"};

Type type_of(CoordinateQuantity what, solver::Axis axis) {
  switch (what) {
    case CoordinateQuantity::position:
      return quantity_type(dimension_of(axis, solver::Quantity::position));
    case CoordinateQuantity::velocity:
      return quantity_type(dimension_of(axis, solver::Quantity::velocity));
    case CoordinateQuantity::force:
      return quantity_type(dimension_of(axis, solver::Quantity::force));
    case CoordinateQuantity::residual:
      return quantity_type(dimension_of(axis, solver::Quantity::acceleration));
    case CoordinateQuantity::saturated:
      break;
  }
  return boolean_type;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  parts.push_back(path.substr(begin));
  return parts;
}

class ConditionCheck {
 public:
  ConditionCheck(CheckContext& context, const ConditionText& text, const std::vector<GroupText>& groups)
      : context_(context), text_(text), groups_(groups) {}

  std::optional<Condition> check(Dimension* compared, std::vector<Dimension>* of_nodes) {
    Condition condition;
    condition.text = text_.text;
    condition.span = text_.span;
    for (const ExpressionText& node : text_.nodes) {
      ExpressionNode lowered;
      lowered.left = node.left;
      lowered.right = node.right;
      types_.push_back(check_node(node, lowered));
      condition.nodes.push_back(lowered);
    }
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

 private:
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
        return check_name(node, lowered);
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

  Type check_name(const ExpressionText& node, ExpressionNode& lowered) {
    if (node.word == "elapsed") {
      lowered.op = Op::elapsed;
      return quantity_type(dimension::time);
    }
    if (const std::optional<int> signal = context_.symbols.find_signal(node.word)) {
      return check_signal(node, *signal, lowered);
    }
    if (const std::optional<int> feature = context_.symbols.find_feature(node.word)) {
      FeatureSymbol& symbol = context_.symbols.features[static_cast<std::size_t>(*feature)];
      symbol.is_used = true;
      lowered.op = Op::feature;
      lowered.index = *feature;
      if (symbol.is_bad) return bad_type;
      return quantity_type(symbol.feature.turns ? dimension::angle : dimension::length);
    }
    for (int axis = 0; axis < 3 && !context_.of_truth; ++axis) {
      if (node.word != estimated_forces[static_cast<std::size_t>(axis)]) continue;
      if (context_.robot && context_.robot->drive.takes_velocity && !context_.robot->drive.feels_contact())
        return complain(wording::estimate_without_torque(node.span, node.word));
      lowered.op = Op::estimated_force;
      lowered.axis = axis;
      return quantity_type(axis < 2 ? dimension::force : dimension::torque);
    }
    std::vector<std::string> parts = split(node.word);
    if (context_.of_truth && parts.size() > 1) {
      return complain(wording::unknown_truth(node.span, node.word, truth_meant(node.word)));
    }
    // Of a group on a feature, the group's name says it all: `near.velocity`.
    if (const GroupText* group = find_group(parts[0], lowered)) {
      const bool is_feature = group->kind == GroupKind::feature;
      if (is_feature && parts.size() == 3)
        return complain(wording::axis_of_a_feature(node.span, parts[0], parts[2]));
      if (is_feature && parts.size() == 2) parts.insert(parts.begin(), parts[0]);
    }
    if (parts.size() == 3) return check_coordinate(node, parts, lowered);
    if (has_unread_name()) return bad_type;
    if (parts.size() == 2 && context_.symbols.find_feature(parts[0]))
      return complain(wording::quantity_of_a_feature(node.span, node.word, parts[0]));
    if (!context_.of_truth) {
      if (const auto slip = slip_of_a_name(node, parts)) return complain(*slip);
    }
    if (const auto word = wording::word_for_a_condition(node.span, node.word)) return complain(*word);
    std::vector<std::string> known{"elapsed"};
    if (!context_.of_truth) known.insert(known.end(), estimated_forces.begin(), estimated_forces.end());
    for (const std::string& name : context_.symbols.signal_names()) known.push_back(name);
    for (const std::string& name : context_.symbols.feature_names()) known.push_back(name);
    for (const GroupText& group : groups_) {
      for (const AxisText& axis : group.axes) {
        for (const CoordinateWord& word : coordinate_words) {
          const std::string axis_of = group.kind == GroupKind::feature ? "" : "." + axis.name.text;
          known.push_back(group.name.text + axis_of + "." + std::string(word.word));
        }
      }
    }
    const std::string near = nearest(node.word, known);
    for (const char* touch : {"contact", "collision", "touched", "touch", "bumper", "in_contact"}) {
      if (node.word == touch && near.empty() && !context_.of_truth)
        return complain(wording::contact_in_a_condition(node.span, node.word));
    }
    return complain(wording::unknown_quantity(node.span, node.word, near));
  }

  /// `base.yaw` and `truth.base.theta` for `truth.base.yaw`.
  std::string truth_meant(const std::string& written) const {
    const std::vector<std::string> names = context_.symbols.signal_names();
    if (std::find(names.begin(), names.end(), "truth." + written) != names.end()) return "truth." + written;
    const std::string owner = written.substr(0, written.rfind('.') + 1);
    std::vector<std::string> words;
    for (const std::string& name : names) {
      if (name.starts_with(owner)) words.push_back(name.substr(owner.size()));
    }
    const std::string word = meant_key(written.substr(owner.size()), words);
    return word.empty() ? nearest(written, names) : owner + word;
  }

  /// A name that means something, elsewhere or with a word more.
  std::optional<Diagnostic> slip_of_a_name(const ExpressionText& node,
                                           const std::vector<std::string>& parts) {
    if (context_.symbols.find_parameter(node.word) != nullptr)
      return wording::parameter_without_dollar(node.span, node.word);
    if (parts.size() > 2) return std::nullopt;
    if (parts[0] == "params" && context_.symbols.find_parameter(parts[1]) != nullptr)
      return wording::parameter_without_dollar(node.span, parts[1]);
    ExpressionNode unused;
    const GroupText* group = find_group(parts[0], unused);
    if (group != nullptr && group->kind == GroupKind::inside)
      return wording::boundary_in_a_condition(node.span, parts[0], group->move.text);
    const bool names_axis = group != nullptr && parts.size() == 2 &&
                            std::any_of(group->axes.begin(), group->axes.end(),
                                        [&](const AxisText& axis) { return axis.name.text == parts[1]; });
    if (names_axis) return wording::axis_without_quantity(node.span, node.word);
    if (group == nullptr && context_.symbols.find_frame(parts[0]))
      return wording::frame_for_a_quantity(node.span, node.word, parts[0]);
    return std::nullopt;
  }

  Type check_signal(const ExpressionText& node, int index, ExpressionNode& lowered) {
    SignalSymbol& symbol = context_.symbols.signals[static_cast<std::size_t>(index)];
    symbol.is_used = true;
    lowered.op = Op::signal;
    lowered.index = index;
    if (symbol.is_bad) return bad_type;
    if (symbol.signal.type == SignalType::boolean) return boolean_type;
    if (symbol.signal.type == SignalType::number) return quantity_type(symbol.dimension);
    return complain(
        wording::incomparable_signal(node.span, node.word, symbol.signal.type == SignalType::pose));
  }

  /// The group of the task, or else of `always`, that a path starts with.
  const GroupText* find_group(const std::string& name, ExpressionNode& lowered) const {
    for (const auto* groups : {&groups_, &context_.file.always_groups}) {
      for (std::size_t g = 0; g < groups->size(); ++g) {
        if ((*groups)[g].name.text != name) continue;
        lowered.index = static_cast<int>(g);
        lowered.in_always = groups != &groups_;
        return &(*groups)[g];
      }
    }
    return nullptr;
  }

  /// A group without a name may be the one that is meant; it was complained of.
  bool has_unread_group() const {
    for (const auto* groups : {&groups_, &context_.file.always_groups}) {
      for (const GroupText& group : *groups) {
        if (!group.name.exists()) return true;
      }
    }
    return false;
  }

  /// A signal or feature whose name could not be read may be the one that is meant; it was complained of.
  bool has_unread_name() const {
    const auto is_unread = [](const auto& text) { return !text.name.exists(); };
    const auto& file = context_.file;
    return std::any_of(file.signals.begin(), file.signals.end(), is_unread) ||
           std::any_of(file.features.begin(), file.features.end(), is_unread);
  }

  Type check_coordinate(const ExpressionText& node, const std::vector<std::string>& parts,
                        ExpressionNode& lowered) {
    std::vector<std::string> known;
    const GroupText* found = find_group(parts[0], lowered);
    if (found == nullptr && has_unread_group()) return bad_type;
    if (found == nullptr) {
      for (const GroupText& group : groups_) known.push_back(group.name.text);
      return complain(wording::unknown_name(node.span, "group", parts[0], known));
    }
    const GroupText& group = *found;
    if (group.kind == GroupKind::inside)
      return complain(wording::boundary_in_a_condition(node.span, parts[0], group.move.text));
    for (std::size_t a = 0; a < group.axes.size(); ++a) {
      known.push_back(group.axes[a].name.text);
      if (group.axes[a].name.text == parts[1]) lowered.axis = static_cast<int>(a);
    }
    if (lowered.axis < 0 && group.is_incomplete) return bad_type;
    if (lowered.axis < 0) {
      return complain(
          wording::unknown_axis(node.span, parts[0], parts[1], axis_named(parts[1]).has_value(), known));
    }
    lowered.op = Op::coordinate;
    known.clear();
    for (const CoordinateWord& word : coordinate_words) {
      known.emplace_back(word.word);
      if (word.word != parts[2]) continue;
      lowered.what = word.quantity;
      return type_of(word.quantity, axis_measured(group, parts[1]));
    }
    Diagnostic unknown = wording::unknown_name(node.span, "quantity", parts[2], known);
    const std::string meant = meant_key(parts[2], known);
    if (!meant.empty()) unknown.help = "did you mean `" + meant + "`?";
    if (const auto word = wording::word_for_a_condition(node.span, node.word)) unknown.help = word->help;
    return complain(std::move(unknown));
  }

  /// The axis itself; of a feature any that measures alike.
  solver::Axis axis_measured(const GroupText& group, const std::string& axis) const {
    if (group.kind != GroupKind::feature) return axis_named(axis).value_or(solver::Axis::x);
    const std::optional<int> index = context_.symbols.find_feature(group.feature.text);
    const bool turns = index && context_.symbols.features[static_cast<std::size_t>(*index)].feature.turns;
    return turns ? solver::Axis::rz : solver::Axis::x;
  }

  Type check_call(const ExpressionText& node, ExpressionNode& lowered) {
    if (node.word == "abs") {
      lowered.op = Op::abs;
      return require_number(node.left);
    }
    if (node.word == "valid") {
      const std::optional<int> signal = context_.symbols.find_signal(node.argument);
      if (!signal) {
        return complain(
            wording::unknown_name(node.span, "signal", node.argument, context_.symbols.signal_names()));
      }
      context_.symbols.signals[static_cast<std::size_t>(*signal)].is_used = true;
      lowered.op = Op::valid;
      lowered.index = *signal;
      return boolean_type;
    }
    const std::optional<int> frame = check_frame(context_, {node.argument, node.span});
    if (!frame) return bad_type;
    if (context_.symbols.stands_in_world(*frame)) {
      const std::string base = context_.robot ? context_.robot->base_frame : "base_link";
      return complain(wording::motionless(node.span, node.word, node.argument, base));
    }
    lowered.op = node.word == "speed" ? Op::speed : Op::moved;
    lowered.index = *frame;
    return quantity_type(node.word == "speed" ? dimension::velocity : dimension::length);
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
  const std::vector<GroupText>& groups_;
  std::vector<Type> types_;
};

}  // namespace

std::optional<Condition> check_condition(CheckContext& context, const ConditionText& text,
                                         const std::vector<GroupText>& groups, Dimension* compared,
                                         std::vector<Dimension>* of_nodes) {
  return ConditionCheck(context, text, groups).check(compared, of_nodes);
}

}  // namespace zwang::lang
