#include "scenario/expectation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::runtime {

using lang::ExpectationKind;
using lang::Op;

namespace {

constexpr double not_at_all = -1.0;  ///< margin of what nobody knows

double distance(double below, double above, double scale) {
  const double left = above - below;
  if (std::isnan(left)) return not_at_all;
  // Of a threshold of 0 nothing is a share.
  if (scale == 0.0) return left == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), left);
  return left / std::abs(scale);
}

}  // namespace

double margin_of(const lang::Condition& condition, const TrueFacts& facts, std::vector<double>& values,
                 std::vector<double>& margins) noexcept {
  for (std::size_t i = 0; i < condition.nodes.size(); ++i) {
    const lang::ExpressionNode& node = condition.nodes[i];
    const auto left = static_cast<std::size_t>(std::max(node.left, 0));
    const auto right = static_cast<std::size_t>(std::max(node.right, 0));
    const double a = values[left], b = values[right];
    double value = 0.0, margin = 0.0;
    switch (node.op) {
      case Op::constant:
        value = node.number;
        break;
      case Op::abs:
        value = std::abs(a);
        break;
      case Op::negate:
        value = -a;
        break;
      case Op::add:
        value = a + b;
        break;
      case Op::subtract:
        value = a - b;
        break;
      case Op::multiply:
        value = a * b;
        break;
      case Op::divide:
        value = a / b;
        break;
      case Op::less:
      case Op::less_equal:
        margin = distance(a, b, b);
        break;
      case Op::greater:
      case Op::greater_equal:
        margin = distance(b, a, b);
        break;
      case Op::logical_and:
        margin = std::min(margins[left], margins[right]);
        break;
      case Op::logical_or:
        margin = std::max(margins[left], margins[right]);
        break;
      case Op::logical_not:
        margin = -margins[left];
        break;
      default:
        value = facts.look_up(node);
        break;
    }
    values[i] = value;
    margins[i] = margin;
  }
  return margins.back();
}

ExpectationWatch::ExpectationWatch(const lang::Expectation& expectation)
    : expectation_(expectation),
      values_(std::max<std::size_t>(1, expectation.that.nodes.size()), 0.0),
      margins_(values_) {}

void ExpectationWatch::look(const TrueFacts& facts, double time, bool in_task) noexcept {
  if (expectation_.that.nodes.empty()) return;
  if (expectation_.kind != ExpectationKind::always && !in_task) return;
  const double margin = margin_of(expectation_.that, facts, values_, margins_);
  last_time_ = time;
  if (expectation_.kind == ExpectationKind::at_end || margin < worst_) {
    worst_ = margin;
    worst_time_ = time;
  }
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
      if (was_looked_at_) result.margin = worst_;
      result.time = worst_time_;
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
  result.margin = (deadline - held_since_) / (expectation_.within > 0.0 ? expectation_.within : 1.0);
  result.time = held_since_;
  return result;
}

}  // namespace zwang::runtime
