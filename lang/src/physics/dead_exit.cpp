// W511: an exit that the ranges in force decide: never true, or true as soon as the task is entered.
//
// Ranges only hold the base back: a push from outside breaks them, and a task may be entered outside of them.
// So a position or a speed is never excluded for certain, and the message says what makes the exit true. An
// exit to `failed` may watch over such a range, and a scene may push: then nothing is said. Of where a task
// begins the start counts, and what earlier tasks drive (left_behind.cpp).
#include <algorithm>
#include <cmath>

#include "check/endings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_outputs.hpp"
#include "physics/known_number.hpp"
#include "physics/known_signal.hpp"
#include "physics/measured_number.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

bool pushes_the_base(const std::optional<Scene>& scene) {
  if (!scene) return false;
  const auto is_driven = [](const SceneObject& object) {
    const bool springs = object.guide && (object.guide->stiffness > 0.0 || object.guide->preload > 0.0);
    return !object.motion.empty() || springs;
  };
  return !scene->pushes.empty() || !scene->robots.empty() || !scene->faults.empty() ||
         std::any_of(scene->objects.begin(), scene->objects.end(), is_driven);
}

namespace {

class ExitQuestion {
 public:
  ExitQuestion(const CheckContext& context, const PlannedTask& plan, const AllTasks& all, Probe& probe)
      : context_(context),
        plan_(plan),
        numbers_(context, plan, all, probe),
        is_pushed_(pushes_the_base(all.scene)) {}

  /// `latest`: when the task ends at the latest. [s]
  void ask(const ExitText& exit, const Condition& condition, const Ending& latest, Remarks& remarks) {
    latest_ = latest;
    if (!(latest.time > 0.0)) {
      remarks.add(wording::never_in_time(exit.when.span, latest.by, latest.span));
      return;
    }
    const auto cases = cases_of(context_, condition, groups());
    if (!cases || remarks.any_at(exit.when.span) || is_decided(context_, condition, groups())) return;
    if (cases->empty()) {
      remarks.add(wording::contradicts_itself(exit.when.span));
      return;
    }
    std::optional<Found> why;
    for (const Case& one : *cases) {
      const std::optional<Found> found = contradicted(one, exit);
      if (!found) return ask_at_once(exit, condition, remarks);
      // The weakest of the reasons is what the message may claim.
      if (!why || (why->known.holds_whatever_pushes && !found->known.holds_whatever_pushes)) why = found;
    }
    if (why->known.output >= 0) return tell_output(exit, why->known, false, remarks);
    if (why->known.is_unknown)
      return remarks.add(wording::not_entered_yet(exit.when.span, why->what, why->known.by));
    const wording::Kept kept = kept_by(*why);
    if (why->known.holds_whatever_pushes) return remarks.add(wording::never_true(exit.when.span, kept));
    if (!is_pushed_)
      remarks.add(wording::only_from_outside(exit.when.span, kept, why->known.is_entered_anywhere));
  }

 private:
  struct Found {
    Known known;
    std::string what, unit;
  };

  static wording::Kept kept_by(const Found& found) {
    const Known& known = found.known;
    return {found.what, found.unit,      known.bounds.low, known.bounds.high,
            known.by,   known.parameter, known.span,       known.time};
  }

  const std::vector<GroupText>& groups() const {
    static const std::vector<GroupText> none;
    return plan_.task != nullptr ? plan_.task->groups : none;
  }

  /// True at every instant, so that the task is left as soon as it is entered.
  void ask_at_once(const ExitText& exit, const Condition& condition, Remarks& remarks) {
    if (exit.target.text == "failed") return;
    latest_ = {};
    const auto cases = cases_of(context_, condition, groups(), true);
    if (!cases) return;
    if (cases->empty()) return remarks.add(wording::part_is_always_true(exit.when.span));
    std::optional<Found> why;
    for (const Case& one : *cases) {
      const std::optional<Found> found = contradicted(one, exit);
      if (!found || (!found->known.holds_whatever_pushes && (is_pushed_ || found->known.is_entered_anywhere)))
        return;
      why = found;
    }
    if (why->known.output >= 0) return tell_output(exit, why->known, true, remarks);
    remarks.add(wording::always_true(exit.when.span, kept_by(*why)));
  }

  std::optional<Found> contradicted(const Case& demanded, const ExitText& exit) {
    const bool watches = exit.target.text == "failed";
    double until = latest_.time;
    for (const auto& [key, demand] : demanded) {
      if (demand.node->op == Op::elapsed) until = std::min(until, demand.bounds.high);
    }
    numbers_.set_time(latest_, until);
    std::optional<Found> found;
    for (const auto& [key, demand] : demanded) {
      const Known known = numbers_.of(*demand.node);
      if (watches && !known.holds_whatever_pushes) continue;
      if (!both(known.bounds, demand.bounds).is_empty()) continue;
      if (!known.holds_whatever_pushes && numbers_.is_entered_with(*demand.node, demand.bounds, known))
        continue;
      if (!found || known.holds_whatever_pushes)
        found = Found{known, name_measured(context_, plan_, *demand.node),
                      unit_measured(context_, plan_, *demand.node)};
      if (known.holds_whatever_pushes) break;
    }
    return found;
  }

  void tell_output(const ExitText& exit, const Known& known, bool is_true, Remarks& remarks) const {
    const Output& output = context_.symbols.outputs[static_cast<std::size_t>(known.output)].output;
    const bool is_set = !values_set(context_, output.name).empty();
    const std::string example = output.is_number ? ".." : output.start == 0.0 ? "true" : "false";
    remarks.add(wording::output_decides(exit.when.span, {output.name, is_set, example}, is_true, known.span));
  }

  const CheckContext& context_;
  const PlannedTask& plan_;
  KnownNumbers numbers_;
  bool is_pushed_;
  Ending latest_;
};

}  // namespace

void ask_exits(const CheckContext& context, const PlannedTask& plan, const std::vector<ExitText>& exits,
               const std::vector<Condition>& conditions, const AllTasks& all, Probe& probe,
               Remarks& remarks) {
  const bool is_of_task = plan.task != nullptr && &exits == &plan.task->exits;
  ExitQuestion question(context, plan, all, probe);
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (conditions[i].nodes.empty()) continue;
    const Ending latest = is_of_task ? ending_before(context, *plan.task, conditions, i) : Ending{};
    question.ask(exits[i], conditions[i], latest, remarks);
  }
}

}  // namespace zwang::lang
