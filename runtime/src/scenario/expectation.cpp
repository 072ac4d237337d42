#include "scenario/expectation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::runtime {

using lang::ExpectationKind;
using lang::Op;

namespace {

constexpr double not_at_all = -1.0;  ///< margin of an unknown condition

/// The margin of a comparison of equal values: `<=` holds, and its `not` does not; of `<` it is the other
/// way.
constexpr double just_held = std::numeric_limits<double>::denorm_min();

double distance(double below, double above, double scale, bool may_be_equal) {
  const double left = above - below;
  if (std::isnan(left)) return not_at_all;
  if (left == 0.0) return may_be_equal ? just_held : -just_held;
  // Of a threshold of 0 nothing is a share.
  if (scale == 0.0) return std::copysign(std::numeric_limits<double>::infinity(), left);
  return left / std::abs(scale);
}

/// Of the sides of a comparison the one that does not change; of two that do or do not, the right one.
const Reading& threshold(const Reading& left, const Reading& right) {
  return left.is_fixed && !right.is_fixed ? left : right;
}

/// The other one.
const Reading& measured(const lang::Condition& condition, const std::vector<Reading>& readings,
                        int comparison) {
  const lang::ExpressionNode& node = condition.nodes[static_cast<std::size_t>(comparison)];
  const Reading& left = readings[static_cast<std::size_t>(node.left)];
  const Reading& right = readings[static_cast<std::size_t>(node.right)];
  return &threshold(left, right) == &left ? right : left;
}

/// One of two sides holds: the better one; beside a window of time the other one, while the window is open.
const Reading& either(const Reading& a, const Reading& b) {
  if (a.is_of_time == b.is_of_time) return a.margin >= b.margin ? a : b;
  return a.is_of_time ? b : a;
}

bool is_shut(const Reading& a, const Reading& b) {
  return a.is_of_time != b.is_of_time && (a.is_of_time ? a : b).margin >= 0.0;
}

/// The reading comes from the plant, or from what the run is given.
void read_fact(const lang::ExpressionNode& node, const TrueFacts& facts, Reading& out) noexcept {
  out.value = facts.look_up(node);
  out.margin = out.value > 0.5 ? std::numeric_limits<double>::infinity() : not_at_all;  // of a truth value
  out.decisive = -1;
  out.is_fixed = node.op == Op::parameter;
  out.is_of_time = node.op == Op::elapsed || out.is_fixed;
}

Reading read_node(const lang::ExpressionNode& node, int number, const Reading& a, const Reading& b,
                  const TrueFacts& facts) noexcept {
  Reading out;
  out.decisive = number;
  out.is_of_time = a.is_of_time && (node.right < 0 || b.is_of_time);
  out.is_fixed = a.is_fixed && (node.right < 0 || b.is_fixed);
  switch (node.op) {
    case Op::constant:
      out.value = node.number;
      out.is_of_time = out.is_fixed = true;
      break;
    case Op::abs:
      out.value = std::abs(a.value);
      break;
    case Op::negate:
      out.value = -a.value;
      break;
    case Op::add:
      out.value = a.value + b.value;
      break;
    case Op::subtract:
      out.value = a.value - b.value;
      break;
    case Op::multiply:
      out.value = a.value * b.value;
      break;
    case Op::divide:
      out.value = a.value / b.value;
      break;
    case Op::less:
    case Op::less_equal:
      out.margin = distance(a.value, b.value, threshold(a, b).value, node.op == Op::less_equal);
      break;
    case Op::greater:
    case Op::greater_equal:
      out.margin = distance(b.value, a.value, threshold(a, b).value, node.op == Op::greater_equal);
      break;
    case Op::logical_and: {
      const Reading& least = a.margin <= b.margin ? a : b;
      out.margin = least.margin;
      out.decisive = least.decisive;
      break;
    }
    case Op::logical_or:
      out.margin = is_shut(a, b) ? not_asked : either(a, b).margin;
      out.decisive = is_shut(a, b) ? -1 : either(a, b).decisive;
      break;
    case Op::logical_not:
      out.margin = -a.margin;
      out.decisive = a.decisive;
      break;
    default:
      read_fact(node, facts, out);
      break;
  }
  return out;
}

}  // namespace

void read_condition(const lang::Condition& condition, const TrueFacts& facts,
                    std::vector<Reading>& readings) noexcept {
  for (std::size_t i = 0; i < condition.nodes.size(); ++i) {
    const lang::ExpressionNode& node = condition.nodes[i];
    const Reading& a = readings[static_cast<std::size_t>(std::max(node.left, 0))];
    const Reading& b = readings[static_cast<std::size_t>(std::max(node.right, 0))];
    readings[i] = read_node(node, static_cast<int>(i), a, b, facts);
  }
}

ExpectationWatch::ExpectationWatch(const lang::Expectation& expectation)
    : expectation_(expectation), readings_(std::max<std::size_t>(1, expectation.that.nodes.size())) {}

void ExpectationWatch::note_worst(double time) noexcept {
  worst_ = readings_.back().margin;
  worst_time_ = time;
  decisive_ = readings_.back().decisive;
  if (decisive_ >= 0) worst_value_ = measured(expectation_.that, readings_, decisive_).value;
}

void ExpectationWatch::look(const TrueFacts& facts, double time, bool in_task) noexcept {
  if (expectation_.that.nodes.empty()) return;
  if (expectation_.kind != ExpectationKind::always && !in_task) return;
  read_condition(expectation_.that, facts, readings_);
  const double margin = readings_.back().margin;
  last_time_ = time;
  if (expectation_.kind == ExpectationKind::at_end || margin < worst_) note_worst(time);
  was_looked_at_ = true;
  if (expectation_.kind != ExpectationKind::within) return;
  if (begin_ < 0.0) {
    const double event = expectation_.of < 0 ? 0.0 : facts.quantity(expectation_.of);
    if (!std::isnan(event)) begin_ = event;
  }
  if (margin < 0.0) {
    held_since_ = -1.0;
  } else if (held_since_ < 0.0) {
    held_since_ = time;
  }
}

ExpectationResult ExpectationWatch::result(const std::string& outcome,
                                           const std::vector<std::string>& of_partners,
                                           const std::vector<std::string>& codes) const {
  ExpectationResult result;
  result.text = expectation_.text;
  result.span = expectation_.span;
  switch (expectation_.kind) {
    case ExpectationKind::outcome:
      if (expectation_.of_robot < 0) {
        result.held = outcome == expectation_.word;
      } else {
        const auto number = static_cast<std::size_t>(expectation_.of_robot);
        result.held = number < of_partners.size() && of_partners[number] == expectation_.word;
      }
      return result;
    case ExpectationKind::diagnostic:
      result.held = std::find(codes.begin(), codes.end(), expectation_.word) != codes.end();
      return result;
    case ExpectationKind::at_end:
    case ExpectationKind::always:
      result.held = was_looked_at_ && worst_ >= 0.0;
      result.time = worst_time_;
      if (!was_looked_at_ || worst_ == not_asked) return result;
      if (std::isfinite(worst_)) result.margin = std::abs(worst_) > just_held ? worst_ : 0.0;
      if (decisive_ < 0 || !std::isfinite(worst_value_)) return result;
      result.value = worst_value_;
      result.unit = expectation_.units[static_cast<std::size_t>(decisive_)];
      return result;
    case ExpectationKind::within:
      break;
  }
  // It must hold from some instant before the deadline until the end.
  if (begin_ < 0.0 || held_since_ < 0.0) {
    result.time = last_time_;
    return result;
  }
  const double deadline = begin_ + expectation_.within;
  result.held = held_since_ <= deadline;
  // The margin is a share of the time that is given. Of none there is no share.
  if (expectation_.within > 0.0) result.margin = (deadline - held_since_) / expectation_.within;
  result.value = held_since_ - begin_;
  result.unit.append("s");  // GCC bug 105651
  result.time = held_since_;
  return result;
}

}  // namespace zwang::runtime
