#include "run_report.hpp"

#include <algorithm>
#include <cmath>

#include "colour.hpp"
#include "json_parts.hpp"
#include "output.hpp"
#include "run_json.hpp"
#include "table.hpp"
#include "why_report.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;
using runtime::LimitReport;
using runtime::Transition;

std::string seconds(double time) {
  return with_unit(time, "s", 4);
}

std::string transitions_table(const runtime::Runner& runner, const lang::Diagnostics& diagnostics) {
  const runtime::Scheduler& scheduler = runner.scheduler();
  Table table({true, false, false, false});
  for (const Transition& t : runner.transitions()) {
    std::string why = scheduler.why_with_note(t);
    const std::string where = place(diagnostics, scheduler.where(t));
    if (!where.empty()) why += "  (" + where + ")";
    for (const std::string& words : also_true(scheduler, t)) why += ", also true: " + words;
    table.add({seconds(t.time), task_name(scheduler, t.from), "-> " + task_name(scheduler, t.to), why});
  }
  std::string text = "transitions\n" + table.text();
  const std::uint64_t more = runner.transition_count() - runner.transitions().size();
  if (more > 0) text += "  and " + std::to_string(more) + " more\n";
  return text;
}

std::string events_table(const runtime::Runner& runner) {
  if (runner.events().empty()) return "";
  Table table({true, false, false, true});
  for (const runtime::Event& e : runner.events()) {
    table.add({seconds(e.time), to_string(e.code), runner.event_signal(e), with_unit(e.value, "")});
  }
  std::string text = "events\n" + table.text();
  const std::uint64_t more = runner.event_count() - runner.events().size();
  if (more > 0) text += "  and " + std::to_string(more) + " more\n";
  return text + "\n";
}

std::string limits_table(const runtime::Runner& runner, const lang::Diagnostics& diagnostics) {
  Table table({false, true, true, true, false, false});
  table.add({"", "worst", "limit", "margin", "", ""});
  for (const LimitReport& l : broken_first(runner.limits())) {
    table.add({l.row, with_unit(l.worst, l.unit), with_unit(l.limit, l.unit), with_unit(l.margin, l.unit),
               l.is_broken() ? marked(Hue::bad, "BROKEN") : "", place(diagnostics, l.span)});
  }
  return "limits\n" + table.text();
}

std::string truth_table(const RunReport& report, const lang::Diagnostics& diagnostics) {
  std::string text = "truth, as the plant measured it\n";
  Table table({false, false});
  for (const ObjectReport& o : report.objects) {
    if (o.latched) {
      table.add({o.name, "hooked on at " + seconds(*o.latched) + ", pulled with " +
                             with_unit(o.pull, "N", 5) + " by the hook as `" + o.steady_in + "` ended"});
    }
    if (!o.touched) {
      table.add({o.latched ? "" : o.name, "not touched"});
      continue;
    }
    table.add({o.latched ? "" : o.name, "touched at " + seconds(*o.touched) + ", pressed with " +
                                            with_unit(o.steady_force, "N", 5) + " as `" + o.steady_in +
                                            "` ended"});
    table.add({"", "peak " + with_unit(o.peak_force, "N") + " at " + seconds(o.peak_at) + " in `" +
                       o.peak_in + "`" +
                       (o.allowed ? ", where " + with_unit(*o.allowed, "N") + " are allowed" : "") +
                       (o.is_hit() ? "  " + marked(Hue::bad, "HIT") : "")});
  }
  if (report.base.slipped) {
    table.add({"wheels", "slide over the floor from " + seconds(*report.base.slipped) + " on, with " +
                             with_unit(report.base.most_slip, "m/s") + " at most"});
  }
  if (report.hand.began) {
    table.add({"hands", "push the robot from " + seconds(*report.hand.began) + " on, with " +
                            with_unit(report.hand.most, "N") + " at most"});
  }
  for (const FaultReport& fault : report.faults) {
    table.add({"fault", "of " + fault.whose() + ", from " + seconds(fault.at) + " on  " +
                            place(diagnostics, fault.span)});
  }
  for (const AskedForce& a : report.asked) {
    table.add({"asked", a.row + " for " + with_unit(a.force, a.unit, 5)});
  }
  for (const PartnerReport& p : report.partners) {
    std::string end = p.outcome;
    if (!p.task.empty()) end += " in `" + p.task + "`";
    if (!p.because.empty()) end += ": " + p.because;
    table.add({p.name, end});
  }
  table.add({"base", "x " + with_unit(report.x, "m") + ", y " + with_unit(report.y, "m") + ", yaw " +
                         with_unit(report.yaw, "rad")});
  return text + table.text();
}

ordered_json json_truth(const RunReport& report) {
  ordered_json truth = ordered_json::object();
  for (const ObjectReport& o : report.objects) {
    truth[o.name] = {{"touched", finite_or_null(o.touched)},
                     {"steady_force", o.steady_force},
                     {"peak_force", o.peak_force},
                     {"peak_at", o.peak_at},
                     {"peak_in", o.peak_in},
                     {"came", o.came},
                     {"pushed_away", o.pushed_away},
                     {"allowed", finite_or_null(o.allowed)},
                     {"hit", o.is_hit()},
                     {"yaw_at_touch", finite_or_null(o.yaw_at_touch)},
                     {"latched", finite_or_null(o.latched)},
                     {"pull", o.pull}};
  }
  truth["base"] = {{"x", report.x},
                   {"y", report.y},
                   {"yaw", report.yaw},
                   {"roll", report.base.roll},
                   {"pitch", report.base.pitch},
                   {"fallen", finite_or_null(report.base.fallen)},
                   {"slipped", finite_or_null(report.base.slipped)},
                   {"most_slip", report.base.most_slip},
                   {"pushed", finite_or_null(report.hand.began)},
                   {"hardest_push", report.hand.most}};
  return truth;
}

}  // namespace

PartnerReport partner_report(const runtime::ScenePartner& partner, const runtime::BaseTruth& base) {
  const runtime::Runner& runner = partner.runner;
  PartnerReport report;
  report.name = partner.name;
  report.outcome = to_string(runner.state());
  if (runner.state() == runtime::RunState::running) {
    report.outcome = "unfinished";
    report.task = task_name(runner.scheduler(), runner.scheduler().task());
  }
  report.because = runner.because();
  if (base.fallen) {
    report.outcome = "fallen";
    report.because = describe_fall(base);
  }
  return report;
}

std::string live_line(const runtime::Runner& runner, double time) {
  std::string line = padded_left(seconds(time), 9) + "  " +
                     padded(task_name(runner.scheduler(), runner.scheduler().task()), 12);
  if (const auto limit = runner.limit_now()) {
    line += "  " + limit->row + " at " + with_unit(limit->worst, limit->unit) + " of " +
            with_unit(limit->limit, limit->unit);
  }
  return line;
}

std::string transition_line(const runtime::Scheduler& scheduler, const Transition& t) {
  return padded_left(seconds(t.time), 9) + "  " + task_name(scheduler, t.from) + " -> " +
         task_name(scheduler, t.to) + "  " + scheduler.why_with_note(t);
}

namespace {

constexpr double told_way = 0.01;  // [m] that an object is pushed away: what an eye sees
constexpr double told_press =
    1.0;  // [N] that an object is pressed with at the end: a twentieth of a usual push

/// The objects that the base met, and the result. After a run that is done, a pushed object is where it
/// should be, so its way is not reported.
std::string met(const RunReport& report) {
  std::string text;
  const bool is_done = report.outcome == "done";
  if (!is_done && report.hand.began) {
    text += ", pushed from outside with " + with_unit(report.hand.most, "N") + " from " +
            seconds(*report.hand.began) + " on";
  }
  for (const ObjectReport& o : report.objects) {
    if (o.is_hit()) {
      text += std::string(o.came ? ", was hit by `" : ", hit `") + o.name + "` with " +
              with_unit(o.peak_force, "N") + " at " + seconds(o.peak_at);
      if (o.allowed) text += " where " + with_unit(*o.allowed, "N") + " are allowed";
    }
    if (is_done) continue;
    if (o.pushed_away > told_way)
      text += ", pushed `" + o.name + "` away by " + with_unit(o.pushed_away, "m");
    if (!o.latched && o.steady_force > told_press)
      text += ", stood pressed to `" + o.name + "` with " + with_unit(o.steady_force, "N");
  }
  return text;
}

}  // namespace

std::string verdict(const RunReport& report) {
  std::string text = report.outcome + " after " + seconds(report.elapsed) + met(report);
  if (report.why) {
    text += ": " + report.why->sentence;
  } else if (!report.because.empty()) {
    text += ": " + report.because;
  }
  if (report.ended_early) text += "; the run was ended before the robot stood";
  if (report.may_still_move) text += std::string("; ") + runtime::unseen_rest;
  return text;
}

namespace {

/// A run that is done and hit something is no good one.
std::string marked_verdict(const RunReport& report) {
  const bool has_hit = std::ranges::any_of(report.objects, &ObjectReport::is_hit);
  const Hue hue = report.outcome != "done" ? Hue::bad : has_hit ? Hue::warning : Hue::good;
  return marked(hue, report.outcome) + verdict(report).substr(report.outcome.size());
}

}  // namespace

std::string human_report(const RunReport& report, const runtime::Runner& runner,
                         const lang::Diagnostics& diagnostics) {
  std::string text = marked_verdict(report) + "\n\n";
  if (report.why) text += why_table(*report.why, diagnostics);
  for (const Chapter& chapter : report.before) {
    text += "until the task file was loaded again at " + seconds(chapter.until) + ": " +
            transitions_table(*chapter.runner, *chapter.diagnostics) + "\n" +
            limits_table(*chapter.runner, *chapter.diagnostics) + "\n";
  }
  text += transitions_table(runner, diagnostics) + "\n" + events_table(runner) +
          limits_table(runner, diagnostics) + "\n" + truth_table(report, diagnostics) + "\n";
  text += "log    ";
  for (const std::string& log : report.logs) text += log + ", ";
  text += std::to_string(report.records) + " records";
  if (report.processor_time > 0.0)
    text += ", " + with_unit(100.0 * report.log_processor_time / report.processor_time, "%", 2) +
            " of the processor time";
  if (!report.log_error.empty()) text += ", " + marked(Hue::bad, "INCOMPLETE") + ": " + report.log_error;
  if (!report.page.empty()) text += "\npage   " + report.page;
  text += "\nspeed  " + with_unit(report.elapsed / std::max(report.wall_time, 1e-9), "x real time", 3) + "\n";
  return text;
}

namespace {

/// All that does not hang on the machine or on where the log is.
ordered_json story(const RunReport& report, const runtime::Runner& runner,
                   const lang::Diagnostics& diagnostics) {
  ordered_json asked = ordered_json::array();
  for (const AskedForce& a : report.asked) {
    asked.push_back({{"row", a.row}, {"force", a.force}, {"unit", a.unit}});
  }
  ordered_json whole = {{"outcome", report.outcome},
                        {"verdict", verdict(report)},
                        {"elapsed", report.elapsed},
                        {"transitions", json_transitions(runner, diagnostics)},
                        {"events", json_events(runner)},
                        {"limits", json_limits(runner, diagnostics)},
                        {"asked", asked},
                        {"truth", json_truth(report)},
                        {"seed", report.seed}};
  for (const FaultReport& fault : report.faults) {
    whole["faults"].push_back({{"at", fault.at}});
    if (fault.span.exists()) whole["faults"].back()["line"] = fault.span.begin.line;
  }
  if (!report.because.empty()) whole["because"] = report.because;
  if (report.may_still_move) whole["may_still_move"] = true;
  if (report.why) whole["why"] = json_of(*report.why);
  for (const Chapter& chapter : report.before) {
    whole["before"].push_back({{"until", chapter.until},
                               {"transitions", json_transitions(*chapter.runner, *chapter.diagnostics)},
                               {"limits", json_limits(*chapter.runner, *chapter.diagnostics)}});
  }
  for (const PartnerReport& p : report.partners)
    whole["robots"][p.name] = {{"outcome", p.outcome}, {"because", p.because}, {"task", p.task}};
  return whole;
}

std::string text_of(const ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::map<std::string, std::string> conclusion(const RunReport& report, const runtime::Runner& runner,
                                              const lang::Diagnostics& diagnostics) {
  return {{"outcome", report.outcome},
          {"verdict", verdict(report)},
          {"report", text_of(story(report, runner, diagnostics), -1)}};
}

std::map<std::string, std::string> conclusion(const runtime::ScenePartner& partner,
                                              const runtime::BaseTruth& base) {
  const std::optional<runtime::Why> why = partner.runner.why();
  return {{"outcome", partner_report(partner, base).outcome}, {"why", why ? why->sentence : ""}};
}

std::string json_report(const RunReport& report, const runtime::Runner& runner,
                        const lang::Diagnostics& diagnostics) {
  ordered_json whole = story(report, runner, diagnostics);
  whole["log"] = report.logs.front();
  whole["logs"] = report.logs;
  whole["log_complete"] = report.log_error.empty();
  whole["wall_time"] = report.wall_time;
  whole["processor_time"] = report.processor_time;
  whole["log_processor_time"] = report.log_processor_time;
  if (!report.page.empty()) whole["page"] = report.page;
  return text_of(whole, 2) + "\n";
}

}  // namespace zwang::cli
