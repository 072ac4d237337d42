// W617: a driver that yields along an axis to a force along another one. It gives way where nobody pushes,
// and stands, or pushes back, where somebody does.
//
//   F = sum over parts i of c_i F_i      in axes e_i of one frame: along d = sum c_i e_i
//   angle(d, axis) > 5 deg               at the start, or once the base or the arm has turned
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_forces.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double most_askew = 5.0 * std::numbers::pi / 180.0;  // [rad]

/// An expression as a function of the parts of one wrench: along . F + constant.
struct ForceParts {
  int frame = -1;  ///< in whose axes they are; -1: there are none
  solver::Vector3 along = solver::Vector3::Zero();
  double constant = 0.0;
};

/// nullopt where the expression is no such sum, or its axes are not known.
class ForceDirection {
 public:
  ForceDirection(const CheckContext& context, const Condition& force) : context_(context), force_(force) {}

  std::optional<ForceParts> find() const {
    if (force_.nodes.empty()) return std::nullopt;
    std::optional<ForceParts> parts = of(static_cast<int>(force_.nodes.size()) - 1);
    return parts && parts->frame >= 0 && parts->along.norm() > 0.0 ? parts : std::nullopt;
  }

 private:
  std::optional<ForceParts> of(int index) const {
    const ExpressionNode& node = force_.nodes[static_cast<std::size_t>(index)];
    switch (node.op) {
      case Op::constant:
        return ForceParts{-1, solver::Vector3::Zero(), node.number};
      case Op::parameter:
        return ForceParts{-1, solver::Vector3::Zero(),
                          context_.symbols.parameters[static_cast<std::size_t>(node.index)].parameter.value};
      case Op::estimated_force:
        return part(context_.symbols.find_frame(context_.robot->base_frame), node.axis == 2 ? 5 : node.axis);
      case Op::estimated_wrench:
        return part(node.index, node.axis);
      case Op::signal:
        return part_of_signal(node);
      case Op::negate:
        return scaled(of(node.left), -1.0);
      case Op::add:
        return sum(of(node.left), of(node.right));
      case Op::subtract:
        return sum(of(node.left), scaled(of(node.right), -1.0));
      case Op::multiply:
        return product(of(node.left), of(node.right));
      default:
        return std::nullopt;
    }
  }

  /// x, y, z of a force, or rx, ry, rz of a torque; `plane` has no direction.
  static std::optional<ForceParts> part(const std::optional<int>& frame, int which) {
    if (!frame || which < 0 || which > 5) return std::nullopt;
    return ForceParts{*frame, solver::Vector3::Unit(which % 3), 0.0};
  }

  std::optional<ForceParts> part_of_signal(const ExpressionNode& node) const {
    const Signal& signal = context_.symbols.signals[static_cast<std::size_t>(node.index)].signal;
    if (signal.type != SignalType::wrench) return std::nullopt;
    return part(signal.in, node.axis);
  }

  static std::optional<ForceParts> scaled(std::optional<ForceParts> parts, double factor) {
    if (!parts) return std::nullopt;
    parts->along *= factor;
    parts->constant *= factor;
    return parts;
  }

  static std::optional<ForceParts> sum(const std::optional<ForceParts>& a,
                                       const std::optional<ForceParts>& b) {
    if (!a || !b || (a->frame >= 0 && b->frame >= 0 && a->frame != b->frame)) return std::nullopt;
    return ForceParts{a->frame >= 0 ? a->frame : b->frame, a->along + b->along, a->constant + b->constant};
  }

  static std::optional<ForceParts> product(const std::optional<ForceParts>& a,
                                           const std::optional<ForceParts>& b) {
    if (!a || !b || (a->frame >= 0 && b->frame >= 0)) return std::nullopt;
    return a->frame >= 0 ? scaled(a, b->constant) : scaled(b, a->constant);
  }

  const CheckContext& context_;
  const Condition& force_;
};

/// Whether a row keeps the base at the heading that it has at the start.
bool keeps_heading(const PlannedTask& plan, const Probe& probe) {
  for (const PlannedAxis& axis : plan.axes) {
    const bool is_heading = axis.measure == solver::Measure::axis && axis.axis == solver::Axis::rz &&
                            axis.move.body == 0 && axis.in_world && axis.is_placed && !axis.is_on_path;
    if (!is_heading || axis.driver != solver::Quantity::position || !axis.target) continue;
    if (std::abs(std::remainder(*axis.target - probe.position_at_start(axis), 2.0 * std::numbers::pi)) <=
        most_askew)
      return true;
  }
  return false;
}

}  // namespace

void ask_yield_axes(const CheckContext& context, const PlannedTask& plan, const Probe& probe,
                    Remarks& remarks) {
  if (context.yields == nullptr) return;
  for (const PlannedAxis& axis : plan.axes) {
    const auto force = context.yields->find(axis.text);
    if (!axis.is_yield || axis.is_feature() || force == context.yields->end()) continue;
    const std::optional<ForceParts> parts = ForceDirection(context, force->second).find();
    if (!parts) continue;
    const Place measured = place_of(context, parts->frame);
    const bool is_known = axis.is_placed && measured.is_known && !axis.is_set && !measured.is_set;
    const solver::Vector3 along = solver::Vector3::Unit(static_cast<int>(axis.axis) % 3);
    const Probe::Angles apart = probe.angles(measured.frame, parts->along, axis.in, along);
    const bool is_apart_at_start = is_known && apart.at_start > most_askew;
    const bool stays_together = is_known && keeps_heading(plan, probe);
    if (!is_apart_at_start && (apart.most <= most_askew || stays_together)) continue;
    const std::string& measured_in =
        context.symbols.frames[static_cast<std::size_t>(parts->frame)].declaration.name;
    remarks.add(
        wording::yields_across(axis.driver_span(), axis.path,
                               {axis.in_name, measured_in, is_apart_at_start ? apart.at_start : 0.0}));
  }
}

}  // namespace zwang::lang
