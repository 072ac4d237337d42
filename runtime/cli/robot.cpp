// The description and the abilities of a robot, from its robot file or its bare URDF.
#include "zwang/lang/robot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "file_kind.hpp"
#include "output.hpp"
#include "robot_frames.hpp"
#include "verbs.hpp"
#include "zwang/lang/configurations.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;

std::string known_number(double value) {
  if (!std::isfinite(value)) return "no limit known";
  char text[40];
  std::snprintf(text, sizeof text, std::abs(value) >= 1e4 ? "%.0f" : "%.4g", value);
  return text;
}

/// The smallest and the largest over the swivels' angles.
struct Spread {
  double least = solver::infinity, most = 0.0;
  void add(double value) {
    if (!std::isfinite(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool exists() const { return least <= most; }
  std::string text(const char* unit) const {
    const bool is_one = most - least < 1e-3 * most;
    return (is_one ? known_number(least) : known_number(least) + " to " + known_number(most)) + " " + unit;
  }
};

struct AxisSpread {
  bool held = true;           ///< in every configuration: it cannot move
  bool held_in_some = false;  ///< configurations, which do not count among the figures
  bool reachable = false;
  Spread mass, force;
};

struct Analysis {
  solver::BaseAnalysis start;
  int mobility = 0;
  bool locked = false;  ///< at some angles of the swivels
  std::size_t configurations = 0;
  std::string looked_at;  ///< the configurations, in words
  std::array<AxisSpread, 3> axes;

  /// The motors make every wrench along the freedoms of the base.
  bool exact() const {
    return mobility ==
           std::count_if(axes.begin(), axes.end(), [](const AxisSpread& a) { return a.reachable; });
  }
};

/// At the start and with other joint angles: what depends on swivels shows.
Analysis analyse(const lang::Robot& robot) {
  Analysis result;
  bool is_start = true;
  const std::vector<solver::State> states = lang::configurations(robot, std::nullopt);
  result.configurations = states.size();
  result.looked_at = lang::describe_configurations(robot);
  for (const solver::State& state : states) {
    const solver::BaseAnalysis base = solver::analyse_base(robot.model, state);
    if (is_start) result.start = base;
    is_start = false;
    result.mobility = std::max(result.mobility, base.base_mobility);
    result.locked = result.locked || base.locked;
    for (std::size_t k = 0; k < base.axes.size(); ++k) {
      const solver::AxisAnalysis axis = lang::usable(base.axes[k]);
      AxisSpread& spread = result.axes[k];
      const bool is_held = !std::isfinite(axis.effective_mass);
      spread.held = spread.held && is_held;
      spread.held_in_some = spread.held_in_some || is_held;
      spread.reachable = spread.reachable || axis.reachable;
      if (!axis.reachable) continue;
      spread.mass.add(axis.effective_mass);
      spread.force.add(axis.largest_force);
    }
  }
  return result;
}

constexpr std::array axis_words{"x", "y", "rz"};

std::string axes_text(const Analysis& a) {
  std::string text;
  for (std::size_t k = 0; k < axis_words.size(); ++k) {
    const bool turns = k == 2;
    text += "  " + padded(axis_words[k], 4);
    if (!a.axes[k].reachable) {
      text += a.axes[k].held ? "cannot move: the wheels hold it\n" : "no motor pushes along it\n";
      continue;
    }
    text += "effective mass " + a.axes[k].mass.text(turns ? "kg m^2" : "kg") + ", largest force " +
            (a.axes[k].force.exists() ? a.axes[k].force.text(turns ? "N m" : "N") : "without a known limit") +
            (a.axes[k].held_in_some ? "; in some configurations held by the wheels\n" : "\n");
  }
  if (a.configurations > 1) text += "  least to most over " + a.looked_at + "\n";
  return text;
}

std::string verdicts(const Analysis& a) {
  const solver::BaseAnalysis& s = a.start;
  std::string text = "  mobility " + std::to_string(a.mobility) + ": the motors make " +
                     (a.exact() ? "every wrench along it exactly" : "some wrenches along it only") + "\n";
  if (s.redundant_ground_rows > 0) {
    text += "  " + std::to_string(s.redundant_ground_rows) + " redundant row" +
            (s.redundant_ground_rows == 1 ? "" : "s") +
            " of the ground: wheels that hold the same direction\n";
  }
  if (s.internal_forces > 0) {
    text += "  " + std::to_string(s.internal_forces) +
            (s.internal_forces == 1 ? " direction" : " directions") +
            " in which motors only squeeze each other; the least torque is taken\n";
  }
  if (s.mirrored_rollers && !a.axes[2].reachable) {
    text +=
        "  MIRRORED ROLLERS? no torque turns this base. `roller` is the angle at the ground; seen from "
        "above\n"
        "  it is mirrored. Usual: 45 deg at front left and rear right, -45 deg at the others\n";
  }
  if (a.locked) {
    text +=
        "  LOCKED at general angles of its swivels: the axles do not meet in one point, so it must steer\n"
        "  before it drives\n";
  }
  return text;
}

ordered_json analysis_json(const Analysis& a) {
  ordered_json axes = ordered_json::object();
  const auto spread = [](const Spread& s) {
    return s.exists() ? ordered_json({s.least, s.most}) : ordered_json(nullptr);
  };
  for (std::size_t k = 0; k < axis_words.size(); ++k) {
    axes[axis_words[k]] = {{"held", a.axes[k].held},
                           {"held_in_some", a.axes[k].held_in_some},
                           {"reachable", a.axes[k].reachable},
                           {"effective_mass", spread(a.axes[k].mass)},
                           {"largest_force", spread(a.axes[k].force)}};
  }
  return {{"mobility", a.mobility},
          {"motor_rank", a.start.motor_rank},
          {"exact", a.exact()},
          {"redundant_ground_rows", a.start.redundant_ground_rows},
          {"internal_forces", a.start.internal_forces},
          {"mirrored_rollers", a.start.mirrored_rollers && !a.axes[2].reachable},
          {"locked", a.locked},
          {"looked_at", a.looked_at},
          {"axes", axes}};
}

std::string holds(const solver::Wheel& wheel) {
  if (wheel.roller_angle) return "rollers at " + with_unit(*wheel.roller_angle, "rad", 3);
  if (wheel.holds_rolling && wheel.holds_sideways) return "holds rolling and sideways";
  return wheel.holds_rolling ? "holds rolling, slides sideways" : "holds sideways only";
}

std::string drive_of(const solver::Model& model) {
  const auto rollers = std::count_if(model.wheels().begin(), model.wheels().end(),
                                     [](const solver::Wheel& w) { return w.roller_angle.has_value(); });
  const auto skids = std::count_if(model.wheels().begin(), model.wheels().end(), [](const solver::Wheel& w) {
    return !w.roller_angle && !w.holds_sideways;
  });
  const auto steered = std::count_if(
      model.wheels().begin(), model.wheels().end(),
      [&](const solver::Wheel& w) { return model.bodies()[static_cast<std::size_t>(w.body)].parent > 0; });
  std::string text = std::to_string(model.wheels().size()) + " wheels";
  if (rollers > 0) text += ", " + std::to_string(rollers) + " with rollers";
  if (skids > 0) text += ", " + std::to_string(skids) + " that slide sideways";
  if (steered > 0) text += ", " + std::to_string(steered) + " on swivels";
  return text;
}

/// The accelerations that tip the base over along its own x and y: ahead, back, left, right.
std::array<double, 4> tipping_accelerations(const lang::Footing& footing) {
  using solver::Vector3;
  return {footing.tipping_acceleration(Vector3::UnitX()), footing.tipping_acceleration(-Vector3::UnitX()),
          footing.tipping_acceleration(Vector3::UnitY()), footing.tipping_acceleration(-Vector3::UnitY())};
}

std::string statics_text(const lang::Robot& robot) {
  const std::optional<lang::Footing> footing = lang::footing_of(robot);
  if (!footing) return "";
  const std::array<double, 4> tips = tipping_accelerations(*footing);
  return "  its mass is " + with_unit(footing->inside * 1e3, "mm", 3) + " inside its wheels and supports, " +
         with_unit(footing->height * 1e3, "mm", 3) + " high: it tips over beyond " + known_number(tips[0]) +
         " m/s^2 ahead,\n  " + known_number(tips[1]) + " back, " + known_number(tips[2]) + " to the left, " +
         known_number(tips[3]) + " to the right\n";
}

ordered_json statics_json(const lang::Robot& robot) {
  const std::optional<lang::Footing> footing = lang::footing_of(robot);
  if (!footing) return nullptr;
  return {{"inside", footing->inside},
          {"height", footing->height},
          {"tips_beyond", tipping_accelerations(*footing)}};
}

ordered_json frames_json(const lang::Robot& robot) {
  ordered_json all = ordered_json::object();
  for (const SeenFrame& frame : frames_at_start(robot)) {
    const auto three = [](const solver::Vector3& v) { return ordered_json::array({v.x(), v.y(), v.z()}); };
    const solver::Matrix3& axes = frame.pose.rotation;
    all[frame.name] = {{"at", three(frame.pose.position)},
                       {"x", three(axes.col(0))},
                       {"y", three(axes.col(1))},
                       {"z", three(axes.col(2))}};
  }
  return all;
}

std::vector<std::string> gaps(const lang::Robot& robot) {
  std::vector<std::string> lines;
  if (robot.limits.empty()) lines.push_back("limits: nothing bounds the base where a task says nothing");
  if (!robot.bumper_height_said)
    lines.push_back("bumper: {height: ..}: taken as " + with_unit(robot.bumper_height * 1e3, "mm"));
  std::vector<int> told;  // bodies: a swivel carries two wheels
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const int carrier = robot.model.bodies()[static_cast<std::size_t>(wheel.body)].parent;
    for (const int body : {wheel.body, carrier}) {
      if (body == 0 || std::find(told.begin(), told.end(), body) != told.end()) continue;
      told.push_back(body);
      const solver::Joint& joint = robot.model.joint(body - 1);
      if (joint.actuated && joint.rotor_inertia == 0.0)
        lines.push_back("rotor_inertia of `" + joint.name + "`: taken as 0");
    }
  }
  return lines;
}

ordered_json wheel_json(const lang::Robot& robot, const solver::Wheel& wheel) {
  const solver::Joint& joint = robot.model.joint(wheel.body - 1);
  return {
      {"joint", joint.name},
      {"radius", wheel.radius},
      {"holds", holds(wheel)},
      {"actuated", joint.actuated},
      {"effort", std::isfinite(joint.max_effort) ? ordered_json(joint.max_effort) : ordered_json(nullptr)}};
}

void show(const lang::Robot& robot, Format format) {
  const Analysis analysis = analyse(robot);
  if (format == Format::json) {
    ordered_json wheels = ordered_json::array();
    for (const solver::Wheel& wheel : robot.model.wheels()) wheels.push_back(wheel_json(robot, wheel));
    const ordered_json whole = {{"robot", robot.name},
                                {"drive", drive_of(robot.model)},
                                {"mass", robot.model.total_mass()},
                                {"wheels", wheels},
                                {"analysis", analysis_json(analysis)},
                                {"statics", statics_json(robot)},
                                {"frames", frames_json(robot)},
                                {"missing", gaps(robot)}};
    print_data(whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
    return;
  }
  std::string text = "robot `" + robot.name + "`, " + known_number(robot.model.total_mass()) + " kg, " +
                     drive_of(robot.model) + "\n\nwheels\n";
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Joint& joint = robot.model.joint(wheel.body - 1);
    text += "  " + joint.name + ": radius " + with_unit(wheel.radius * 1e3, "mm") + ", " + holds(wheel) +
            ", " +
            (joint.actuated ? known_number(joint.max_effort) + " N m, at most " +
                                  known_number(joint.max_effort / wheel.radius) + " N at the ground"
                            : std::string("no motor")) +
            "\n";
  }
  text += "\nthe base, in its own axes\n" + axes_text(analysis) + verdicts(analysis) + statics_text(robot) +
          frames_text(robot) + "\n" + titled_list("missing", gaps(robot));
  print(text);
}

void show(const lang::RobotDraft& draft, Format format) {
  if (format == Format::json) {
    ordered_json wheels = ordered_json::array();
    for (const lang::DraftWheel& w : draft.wheels) {
      wheels.push_back({{"joint", w.joint},
                        {"at", w.at},
                        {"radius", w.radius ? ordered_json(*w.radius) : ordered_json(nullptr)},
                        {"effort", w.effort ? ordered_json(*w.effort) : ordered_json(nullptr)},
                        {"swivel", w.swivel}});
    }
    ordered_json casters = ordered_json::array();
    for (const lang::DraftWheel& caster : draft.casters) casters.push_back(caster.joint);
    ordered_json assumed = ordered_json::array();
    for (const lang::AssumedRobot& a : draft.assumed) {
      assumed.push_back({{"as", a.as}, {"analysis", analysis_json(analyse(a.robot))}});
    }
    const ordered_json whole = {
        {"robot", draft.name},        {"base", draft.base},       {"drive", draft.drive},
        {"mass", draft.mass},         {"wheels", wheels},         {"casters", casters},
        {"supports", draft.supports}, {"missing", draft.missing}, {"assumptions", draft.assumption_notes},
        {"assumed", assumed}};
    print_data(whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
    return;
  }
  std::string text =
      "URDF of `" + draft.name + "`, " + known_number(draft.mass) + " kg, " + draft.drive + "\n\n";
  if (!draft.wheels.empty()) text += "wheels\n";
  for (const lang::DraftWheel& w : draft.wheels) {
    text += "  " + w.joint + ": at (" + known_number(w.at[0]) + ", " + known_number(w.at[1]) +
            ") m, radius " + (w.radius ? with_unit(*w.radius * 1e3, "mm") : std::string("unknown")) +
            ", torque " + (w.effort ? known_number(*w.effort) + " N m" : std::string("unknown")) +
            (w.swivel.empty() ? "" : ", on the swivel `" + w.swivel + "`") + "\n";
  }
  for (const lang::DraftWheel& caster : draft.casters)
    text += "  " + caster.joint + ": a caster without a motor\n";
  for (const std::string& link : draft.supports) text += "  " + link + ": a support that holds nothing\n";
  for (const lang::AssumedRobot& a : draft.assumed) {
    const Analysis analysis = analyse(a.robot);
    text += "\nthe base, " + a.as + "\n" + axes_text(analysis) + verdicts(analysis);
  }
  text += "\n" + titled_list("assumed for these figures", draft.assumption_notes) +
          titled_list("missing in the URDF; `zwang robot init` writes a robot file to fill", draft.missing);
  print(text);
}

int refused(const lang::Diagnostics& diagnostics, Format format) {
  if (format == Format::json) {
    print_data("{\"ok\": false, \"diagnostics\": " + lang::render_json(diagnostics) + "}\n");
  } else {
    print(rendered(diagnostics));
  }
  return exit_bad;
}

}  // namespace

int robot_inspect(const RobotInspectArguments& arguments) {
  require_file(arguments.file);
  lang::Diagnostics diagnostics;
  if (is_urdf(arguments.file)) {
    const auto name = std::filesystem::path(arguments.file).filename().string();
    const auto draft = lang::draft_robot(arguments.file, name, diagnostics);
    if (!draft) return refused(diagnostics, arguments.format);
    show(*draft, arguments.format);
    return exit_good;
  }
  const auto robot = lang::load_robot(arguments.file, diagnostics);
  if (!robot) return refused(diagnostics, arguments.format);
  show(*robot, arguments.format);
  if (arguments.format == Format::human && !diagnostics.all().empty()) print("\n" + rendered(diagnostics));
  return exit_good;
}

}  // namespace zwang::cli
