#include "check/cases.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::lang {

namespace {

constexpr std::size_t most_cases = 64;

using Cases = std::optional<std::vector<Case>>;

/// scale x + offset, where x is what the node measures; without a node a constant.
struct Linear {
  double scale = 1.0;
  double offset = 0.0;
  int node = -1;
};

Op opposite(Op op) {
  switch (op) {
    case Op::less:
      return Op::greater_equal;
    case Op::less_equal:
      return Op::greater;
    case Op::greater:
      return Op::less_equal;
    default:
      return Op::less;
  }
}

Op mirrored(Op op) {
  switch (op) {
    case Op::less:
      return Op::greater;
    case Op::less_equal:
      return Op::greater_equal;
    case Op::greater:
      return Op::less;
    default:
      return Op::less_equal;
  }
}

Bounds above(double value, bool or_equal) {
  Bounds bounds;
  bounds.low = value;
  bounds.excludes_low = !or_equal;
  return bounds;
}

Bounds below(double value, bool or_equal) {
  Bounds bounds;
  bounds.high = value;
  bounds.excludes_high = !or_equal;
  return bounds;
}

class Splitter {
 public:
  Splitter(const CheckContext& context, const Condition& condition, const std::vector<GroupText>& groups)
      : context_(context), condition_(condition), groups_(groups) {}

  Cases split(int index, bool is_negated) const {
    const ExpressionNode& node = at(index);
    switch (node.op) {
      case Op::logical_not:
        return split(node.left, !is_negated);
      case Op::logical_and:
      case Op::logical_or: {
        const bool joins = (node.op == Op::logical_and) != is_negated;
        const Cases left = split(node.left, is_negated), right = split(node.right, is_negated);
        if (!left || !right) return std::nullopt;
        return joins ? joined(*left, *right) : either(*left, *right);
      }
      default:
        break;
    }
    if (is_comparison(node.op)) return compared(node, is_negated ? opposite(node.op) : node.op);
    const double truth = is_negated ? 0.0 : 1.0;
    return one(index, {truth, truth});
  }

 private:
  const ExpressionNode& at(int index) const { return condition_.nodes[static_cast<std::size_t>(index)]; }

  static Cases joined(const std::vector<Case>& left, const std::vector<Case>& right) {
    if (left.size() * right.size() > most_cases) return std::nullopt;
    std::vector<Case> all;
    for (const Case& a : left) {
      for (const Case& b : right) {
        if (auto case_of_both = both(a, b)) all.push_back(std::move(*case_of_both));
      }
    }
    return all;
  }

  static Cases either(std::vector<Case> left, const std::vector<Case>& right) {
    left.insert(left.end(), right.begin(), right.end());
    if (left.size() > most_cases) return std::nullopt;
    return left;
  }

  std::vector<Case> one(int index, const Bounds& bounds) const {
    if (bounds.is_empty()) return {};
    return {Case{{key_of(at(index)), {&at(index), bounds}}}};
  }

  /// A group's axis is the same in another task where frames and axis are.
  std::string key_of(const ExpressionNode& node) const {
    std::string key = std::to_string(static_cast<int>(node.op)) + " ";
    if (node.op != Op::coordinate)
      return key + std::to_string(node.function) + " " + std::to_string(node.index) + " " +
             std::to_string(node.axis);
    const auto& groups = node.in_always ? context_.file.always_groups : groups_;
    const GroupText& group = groups[static_cast<std::size_t>(node.index)];
    const std::string frames =
        group.kind == GroupKind::feature ? group.feature.text : group.move.text + " in " + group.in.text;
    return key + frames + " " + group.axes[static_cast<std::size_t>(node.axis)].name.text + " " +
           std::to_string(static_cast<int>(node.what));
  }

  std::optional<double> constant(int index) const {
    const ExpressionNode& node = at(index);
    if (node.op == Op::constant) return node.number;
    if (node.op != Op::parameter) return std::nullopt;
    const Parameter& parameter = context_.symbols.parameters[static_cast<std::size_t>(node.index)].parameter;
    if (is_set_later(context_, parameter.name)) return std::nullopt;
    return parameter.value;
  }

  std::optional<Linear> linear(int index) const {
    if (const auto value = constant(index)) return Linear{0.0, *value, -1};
    const ExpressionNode& node = at(index);
    switch (node.op) {
      case Op::elapsed:
      case Op::coordinate:
      case Op::of_frame:
      case Op::of_task:
      case Op::signal:
      case Op::output:
      case Op::feature:
      case Op::estimated_force:
      case Op::estimated_wrench:
      case Op::abs:
        return Linear{1.0, 0.0, index};
      case Op::negate: {
        std::optional<Linear> part = linear(node.left);
        if (part) *part = {-part->scale, -part->offset, part->node};
        return part;
      }
      case Op::add:
      case Op::subtract:
        return sum(node);
      case Op::multiply:
      case Op::divide:
        return scaled(node);
      default:
        return std::nullopt;
    }
  }

  std::optional<Linear> sum(const ExpressionNode& node) const {
    const std::optional<Linear> left = linear(node.left), right = linear(node.right);
    if (!left || !right || (left->node >= 0 && right->node >= 0)) return std::nullopt;
    const double sign = node.op == Op::add ? 1.0 : -1.0;
    const Linear& measured = left->node >= 0 ? *left : *right;
    return Linear{left->node >= 0 ? left->scale : sign * right->scale, left->offset + sign * right->offset,
                  measured.node};
  }

  std::optional<Linear> scaled(const ExpressionNode& node) const {
    const std::optional<Linear> left = linear(node.left), right = linear(node.right);
    if (!left || !right || right->node >= 0 || right->offset == 0.0) return std::nullopt;
    const double factor = node.op == Op::multiply ? right->offset : 1.0 / right->offset;
    return Linear{factor * left->scale, factor * left->offset, left->node};
  }

  Cases compared(const ExpressionNode& node, Op op) const {
    std::optional<Linear> left = linear(node.left), right = linear(node.right);
    if (!left || !right || (left->node >= 0) == (right->node >= 0)) return std::vector<Case>{Case{}};
    if (left->scale == 0.0 && right->scale == 0.0) return std::vector<Case>{Case{}};
    if (left->node < 0) {
      std::swap(left, right);
      op = mirrored(op);
    }
    return bounded(*left, op, right->offset);
  }

  /// scale x + offset (op) value
  Cases bounded(const Linear& side, Op op, double value) const {
    const double limit = (value - side.offset) / side.scale;
    if (side.scale < 0.0) op = mirrored(op);
    const bool or_equal = op == Op::less_equal || op == Op::greater_equal;
    const bool is_below = op == Op::less || op == Op::less_equal;
    const ExpressionNode& node = at(side.node);
    if (node.op != Op::abs) return one(side.node, is_below ? below(limit, or_equal) : above(limit, or_equal));
    const std::optional<Linear> inner = linear(node.left);
    if (!inner || inner->node < 0) return std::vector<Case>{Case{}};
    const Cases low = bounded(
        *inner,
        is_below ? (or_equal ? Op::greater_equal : Op::greater) : (or_equal ? Op::less_equal : Op::less),
        -limit);
    const Cases high = bounded(*inner, op, limit);
    if (!low || !high) return std::nullopt;
    if (is_below) return joined(*low, *high);
    return limit < 0.0 ? std::vector<Case>{Case{}} : either(*low, *high);
  }

  const CheckContext& context_;
  const Condition& condition_;
  const std::vector<GroupText>& groups_;
};

}  // namespace

bool is_set_later(const CheckContext& context, const ValueText& value) {
  return value.kind == ValueKind::parameter && is_set_later(context, value.name);
}

bool is_set_later(const CheckContext& context, const std::string& parameter) {
  const auto sets_it = [&](const std::vector<SetText>& sets) {
    return std::any_of(sets.begin(), sets.end(), [&](const SetText& set) {
      return set.kind == SetKind::parameter && set.name.text == parameter;
    });
  };
  const auto exit_sets_it = [&](const ExitText& exit) { return sets_it(exit.set); };
  const TaskFile& file = context.file;
  return std::any_of(file.always_exits.begin(), file.always_exits.end(), exit_sets_it) ||
         std::any_of(file.tasks.begin(), file.tasks.end(), [&](const TaskText& task) {
           return sets_it(task.set_on_entry) ||
                  std::any_of(task.exits.begin(), task.exits.end(), exit_sets_it);
         });
}

Bounds both(const Bounds& a, const Bounds& b) {
  Bounds result = a;
  if (b.low > a.low || (b.low == a.low && b.excludes_low)) {
    result.low = b.low;
    result.excludes_low = b.excludes_low;
  }
  if (b.high < a.high || (b.high == a.high && b.excludes_high)) {
    result.high = b.high;
    result.excludes_high = b.excludes_high;
  }
  return result;
}

std::optional<Case> both(const Case& a, const Case& b) {
  Case result = a;
  for (const auto& [key, demanded] : b) {
    const auto [entry, is_new] = result.try_emplace(key, demanded);
    if (!is_new) entry->second.bounds = both(entry->second.bounds, demanded.bounds);
    if (entry->second.bounds.is_empty()) return std::nullopt;
  }
  return result;
}

std::optional<std::vector<Case>> cases_of(const CheckContext& context, const Condition& condition,
                                          const std::vector<GroupText>& groups, bool is_negated) {
  if (condition.nodes.empty()) return std::nullopt;
  return Splitter(context, condition, groups).split(static_cast<int>(condition.nodes.size()) - 1, is_negated);
}

}  // namespace zwang::lang
