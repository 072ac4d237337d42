// A drive with a torque limit of its own pushes as hard as that limit lets it until its wheels turn as they
// are told. No row bounds that push:
//
//   F = sum tau_i / R_i        over the driven wheels, tau_i the motor's limit, R_i the wheel's radius
//
// is what it may be, in the best direction.
#include "check/check_feeling.hpp"

#include <cmath>
#include <set>
#include <utility>

#include "diagnostic/wordings_physics.hpp"

namespace zwang::lang {

namespace {

struct Push {
  double force = 0.0;  ///< [N]
  Span from;           ///< the torque limit of one of its motors
};

Push full_push(const Robot& robot) {
  Push push;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const auto joint = static_cast<std::size_t>(wheel.body - 1);
    const solver::Joint& motor = robot.model.joint(wheel.body - 1);
    if (!motor.actuated || !std::isfinite(motor.max_effort)) continue;
    push.force += motor.max_effort / wheel.radius;
    if (joint < robot.joint_spans.size()) push.from = robot.joint_spans[joint];
  }
  return push;
}

class FeelingCheck {
 public:
  explicit FeelingCheck(CheckContext& context) : context_(context), push_(full_push(*context.robot)) {}

  void look(const std::string& before, const std::vector<GroupText>& groups) {
    for (const GroupText& group : groups) {
      for (const AxisText& axis : group.axes)
        look(before + group.name.text +
                 (group.kind == GroupKind::feature ? std::string() : "." + axis.name.text),
             axis);
    }
  }
  const Push& push() const { return push_; }

 private:
  void look(const std::string& path, const AxisText& axis) {
    if (const std::optional<StatementText>& force = axis[solver::Quantity::force]) {
      complain(force->span, path, force->is_range ? "has a range of force" : "presses with a force");
    } else if (axis.stiffness) {
      complain(axis.stiffness->span, path, "pushes as a spring");
    }
  }
  void complain(const Span& span, const std::string& path, const char* says) {
    // An axis of a template stands in several tasks.
    if (!said_.insert({span.begin.line, span.begin.column}).second) return;
    context_.diagnostics.add(wording::cannot_feel(span, path, says, push_.force, push_.from));
  }

  CheckContext& context_;
  Push push_;
  std::set<std::pair<int, int>> said_;  ///< where
};

}  // namespace

void check_feeling(CheckContext& context) {
  if (!context.robot || !context.robot->drive.is_blind()) return;
  FeelingCheck check(context);
  const int errors_before = context.diagnostics.error_count();
  check.look("always.", context.file.always_groups);
  for (const TaskText& task : context.file.tasks) check.look("", task.groups);
  if (context.diagnostics.error_count() > errors_before) return;
  context.diagnostics.add(
      wording::pushes_fully(context.file.robot.span, check.push().force, check.push().from));
}

}  // namespace zwang::lang
