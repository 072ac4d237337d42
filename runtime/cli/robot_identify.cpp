// Friction and torque constants of a robot's motors, from logs of its motion, into its robot file.
#include "robot_identify.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "output.hpp"
#include "run_log.hpp"
#include "zwang/lang/file_kind.hpp"
#include "zwang/lang/friction_update.hpp"
#include "zwang/lang/quantity.hpp"
#include "zwang/runtime/identification.hpp"
#include "zwang/runtime/replay.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;

/// A log, and the robot that it is of.
struct LoggedRobot {
  std::string log;
  lang::Robot robot;
  std::string robot_file;  ///< as the log names it
};

double mass_of(const std::string& option, const std::string& text) {
  const std::optional<double> mass = lang::read_mass(text);
  if (!mass || !(*mass > 0.0)) throw Impossible(option + " " + text + ": a mass is wanted, as `46 kg`");
  return *mass;
}

LoggedRobot robot_of(const std::string& log) {
  require_log(log);
  const runtime::LogContents contents = runtime::read_log(log, [](double, std::span<const double>) {});
  lang::Diagnostics diagnostics;
  std::optional<lang::Program> program = runtime::logged_program(contents.context, diagnostics);
  if (!program) throw Impossible(log + ": the logged files do not load any more");
  LoggedRobot logged{log, std::move(program->robot), ""};
  for (const lang::Source& source : contents.context.sources) {
    const bool is_robot_file = lang::kind_of_text(source.text) == lang::FileKind::robot;
    if (is_robot_file && logged.robot_file.empty()) logged.robot_file = source.path;
  }
  return logged;
}

std::vector<std::string> joints_of(const lang::Robot& robot) {
  std::vector<std::string> names;
  for (int j = 0; j < robot.model.joint_count(); ++j) names.push_back(robot.model.joint(j).name);
  return names;
}

void require_one_robot(const std::vector<LoggedRobot>& logs) {
  for (const LoggedRobot& logged : logs) {
    if (joints_of(logged.robot) == joints_of(logs.front().robot)) continue;
    throw Impossible(logged.log + ": of `" + logged.robot.name + "`, and " + logs.front().log + " of `" +
                     logs.front().robot.name + "`: one robot at a time");
  }
}

/// Where a record has the numbers of a joint.
struct JointPlaces {
  std::size_t q = 0, qd = 0, tau = 0;
};

std::vector<JointPlaces> places_in(const runtime::LogContents& head, const std::vector<std::string>& names) {
  std::vector<JointPlaces> places;
  const auto place = [&](const std::string& name) { return place_of(head.columns, name); };
  for (const std::string& name : names)
    places.push_back({place(name + ".q"), place(name + ".qd"), place(name + ".tau")});
  return places;
}

void feed(const LoggedRobot& logged, double added_load, runtime::DriveIdentification& identification) {
  const std::vector<std::string> names = joints_of(logged.robot);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.size())), qd = q, tau = q;
  std::vector<JointPlaces> places;
  identification.begin_run(added_load);
  const auto add = [&](double time, std::span<const double> values) {
    const auto number = [&](std::size_t place) {
      return place < values.size() ? values[place] : std::numeric_limits<double>::quiet_NaN();
    };
    for (std::size_t j = 0; j < names.size(); ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      q(k) = number(places[j].q);
      qd(k) = number(places[j].qd);
      tau(k) = number(places[j].tau);
    }
    if (q.allFinite() && qd.allFinite() && tau.allFinite()) identification.add(time, q, qd, tau);
  };
  runtime::read_log(logged.log, add,
                    [&](const runtime::LogContents& head) { places = places_in(head, names); });
}

std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string figure(const runtime::Estimate& estimate, const std::string& unit) {
  char error[40];
  std::snprintf(error, sizeof error, "%.1g", estimate.error);
  return digits(estimate.value) + " +- " + error + " " + unit;
}

ordered_json pair_of(const runtime::Estimate& estimate) {
  return {{"value", estimate.value}, {"error", estimate.error}};
}

ordered_json as_json(const runtime::Identification& found) {
  ordered_json motors = ordered_json::object();
  for (const runtime::IdentifiedMotor& motor : found.motors)
    motors[motor.joint] = {{"torque_factor", pair_of(motor.torque_factor)},
                           {"coulomb", pair_of(motor.coulomb)},
                           {"viscous", pair_of(motor.viscous)}};
  return {{"motors", motors},
          {"mass", pair_of(found.mass)},
          {"inertia", pair_of(found.inertia)},
          {"lag", found.lag},
          {"windows", found.windows}};
}

std::string as_text(const runtime::Identification& found) {
  std::string text =
      "from " + std::to_string(found.windows) + " windows of 0.2 s, each with its standard error\n";
  for (const runtime::IdentifiedMotor& motor : found.motors) {
    text += "  " + motor.joint + ": coulomb " + figure(motor.coulomb, "N m") + ", viscous " +
            figure(motor.viscous, "N m s/rad") + ",\n    gives " +
            figure({100.0 * motor.torque_factor.value, 100.0 * motor.torque_factor.error}, "%") +
            " of the torque it is told\n";
  }
  if (found.lag > 1e-3)
    text +=
        "  the samples come " + digits(1e3 * found.lag) + " ms after the torques, which is reckoned with\n";
  if (found.mass.error > 0.0) text += "  mass " + figure(found.mass, "kg") + "\n";
  text += "  inertia about the vertical through the base's origin " + figure(found.inertia, "kg m^2") + "\n";
  return text;
}

/// Beyond three standard errors and 2 %, the torque constant in the robot's driver is off.
std::string about_torque_constants(const runtime::Identification& found) {
  std::string text;
  for (const runtime::IdentifiedMotor& motor : found.motors) {
    const double off = std::abs(motor.torque_factor.value - 1.0);
    if (off < std::max(3.0 * motor.torque_factor.error, 0.02)) continue;
    text += "  `" + motor.joint + "`: multiply the torque constant in the robot's driver by " +
            digits(motor.torque_factor.value) + "\n";
  }
  return text.empty() ? "" : "the torque constants differ from what the driver takes them for\n" + text;
}

/// A mass that is wrong by a factor makes all torques wrong by it.
void require_plausible(const runtime::Identification& found) {
  constexpr double least = 0.5, most = 2.0;
  for (const runtime::IdentifiedMotor& motor : found.motors) {
    const double factor = motor.torque_factor.value;
    if (factor >= least && factor <= most) continue;
    throw Impossible("`" + motor.joint + "` would give " + digits(100.0 * factor) +
                     " % of the torque it is told: is the mass " + digits(found.mass.value) +
                     " kg, and was the floor level?");
  }
}

std::vector<lang::MeasuredFriction> frictions_of(const runtime::Identification& found) {
  std::vector<lang::MeasuredFriction> frictions;
  for (const runtime::IdentifiedMotor& motor : found.motors)
    frictions.push_back(
        {motor.joint, std::max(0.0, motor.coulomb.value), std::max(0.0, motor.viscous.value)});
  return frictions;
}

/// The log says the file's path from a folder that may be another one: there may stand another robot.
void require_robot_of_log(const std::string& file, const lang::Robot& logged) {
  if (!std::filesystem::is_regular_file(file))
    throw Impossible(file + ": no such file, seen from here; name the robot file with --update");
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(file, diagnostics);
  if (!robot) return;
  constexpr double rounding = 1e-9;
  const double mass = robot->model.total_mass(), of_log = logged.model.total_mass();
  if (std::abs(mass - of_log) > rounding * of_log)
    throw Impossible(file + ": weighs " + with_unit(mass, "kg") + ", the log's robot " +
                     with_unit(of_log, "kg") + "; if it is that robot, name it with --update");
}

/// Writes the file; an error where it is not of that robot.
int write_friction(const std::string& file, const std::vector<std::string>& joints,
                   const runtime::Identification& found) {
  require_file(file);
  lang::Diagnostics diagnostics;
  const auto robot = lang::load_robot(file, diagnostics);
  if (robot && joints_of(*robot) != joints)
    throw Impossible(file + ": of `" + robot->name + "`, whose joints are not those of the log");
  const auto text = robot ? lang::with_friction(file, frictions_of(found), diagnostics) : std::nullopt;
  if (!text) {
    print(rendered(diagnostics));
    return exit_bad;
  }
  write_file(file, *text);
  print(file + ": friction written\n");
  return exit_good;
}

}  // namespace

int robot_identify(const RobotIdentifyArguments& arguments) {
  if (!arguments.mass && !arguments.added)
    throw Impossible(
        "--mass: what the robot weighs, as `--mass '46 kg'`; or --added, of the load in the last log");
  if (arguments.added && arguments.logs.size() < 2)
    throw Impossible("--added: two logs are needed, the last one with the load");
  std::vector<LoggedRobot> logs;
  for (const std::string& log : arguments.logs) logs.push_back(robot_of(log));
  require_one_robot(logs);
  const auto given = [](const char* option, const std::optional<std::string>& text) {
    return text ? std::optional<double>(mass_of(option, *text)) : std::nullopt;
  };
  const std::optional<double> mass = given("--mass", arguments.mass),
                              added = given("--added", arguments.added);
  runtime::Identification found;
  try {
    runtime::DriveIdentification identification(logs.front().robot, mass);
    for (std::size_t i = 0; i < logs.size(); ++i)
      feed(logs[i], i + 1 == logs.size() ? added.value_or(0.0) : 0.0, identification);
    found = identification.solve();
  } catch (const runtime::NotIdentified& error) {
    throw Impossible(arguments.logs.front() + ": " + error.what());
  }
  require_plausible(found);
  if (arguments.format == Format::json) {
    print_data(as_json(found).dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  } else {
    print(as_text(found) + about_torque_constants(found));
  }
  if (arguments.dry_run) return exit_good;
  if (!arguments.update) require_robot_of_log(logs.front().robot_file, logs.front().robot);
  return write_friction(arguments.update.value_or(logs.front().robot_file), joints_of(logs.front().robot),
                        found);
}

}  // namespace zwang::cli
