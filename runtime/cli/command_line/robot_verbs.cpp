// The verbs about robots, in files and on wires.
#include <memory>

#include "command_line/command_line.hpp"
#include "robot_identify.hpp"
#include "shipped.hpp"

namespace zwang::cli {

namespace {

void add_identify(CLI::App& verb, Chosen& chosen) {
  const auto arguments = std::make_shared<RobotIdentifyArguments>();
  CLI::App* identify = verb.add_subcommand(
      "identify", "Estimate friction and torque constants from logs of the task `identify`");
  identify->add_option("logs", arguments->logs, "logs (.mcap) of one robot")->required();
  CLI::Option* mass = identify->add_option("--mass", arguments->mass, "what the robot weighs, as '46 kg'");
  identify
      ->add_option("--added", arguments->added,
                   "the load in the last log, as '15 kg': the mass is estimated, too")
      ->excludes(mass);
  identify->add_option("--update", arguments->update, "the robot file to write (default the logged one)");
  identify->add_flag("--dry-run", arguments->dry_run, "only print");
  add_format(*identify, arguments->format);
  identify->callback([=, &chosen] { chosen = [=] { return robot_identify(*arguments); }; });
}

void add_robot(CLI::App& app, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand("robot", "Look at a robot, or begin its robot file");
  verb->require_subcommand(1);
  const auto inspected = std::make_shared<RobotInspectArguments>();
  CLI::App* inspect = verb->add_subcommand("inspect", "What the robot is and can do");
  inspect->add_option("file", inspected->file, "a robot file, or a bare URDF")->required();
  add_format(*inspect, inspected->format);
  inspect->callback([=, &chosen] {
    inspected->file = file_or_shipped(inspected->file, "robots");
    chosen = [=] { return robot_inspect(*inspected); };
  });
  const auto begun = std::make_shared<RobotInitArguments>();
  CLI::App* init = verb->add_subcommand("init", "Write a robot file from a URDF, to be filled in");
  init->add_option("urdf", begun->urdf, "the URDF")->required();
  CLI::Option* out = init->add_option("-o,--out", begun->out, "the robot file to write (default stdout)");
  init->add_option("--update", begun->update, "a robot file to keep, with what is new in the URDF")
      ->excludes(out);
  init->add_option(
      "--task", begun->task,
      "also write a task and its scene for this robot: wall_align, feel_wall, obstacle, docking or "
      "hospital");
  init->callback([=, &chosen] { chosen = [=] { return robot_init(*begun); }; });
  add_identify(*verb, chosen);
}

void add_drive(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<ConnectArguments>();
  CLI::App* verb =
      app.add_subcommand("drive", "Run a task on a real robot that speaks ROS 2: its motors move");
  verb->add_option("file", arguments->file, "the task file")->required();
  verb->add_option("--over", arguments->connection, "the connection file: topics, command")->required();
  add_overrides(*verb, arguments->overrides);
  verb->add_option("--log", arguments->log, "an .mcap file for the log (default: none)");
  add_log_limits(*verb, arguments->log_rate, arguments->rotation);
  verb->add_option("--observe", arguments->observe,
                   "send nothing; for so many seconds tell what comes, and its signs")
      ->check(CLI::Range(0.1, 86400.0));
  verb->add_option("--wait", arguments->wait, "seconds to wait for the robot (default 10)")
      ->check(CLI::Range(0.0, 86400.0));
  verb->callback([=, &chosen] { chosen = [=] { return connect("drive", *arguments); }; });
}

void add_simulate(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<ConnectArguments>();
  CLI::App* verb = app.add_subcommand(
      "simulate", "Be the robot of a scene behind the topics of a connection, for `zwang drive`");
  verb->add_option("file", arguments->file, "the task file, whose robot and scene are simulated")->required();
  verb->add_option("--over", arguments->connection, "the connection file that `drive` reads")->required();
  add_overrides(*verb, arguments->overrides);
  verb->add_option("--seed", arguments->seed, "seed of everything random (default 0)");
  verb->callback([=, &chosen] { chosen = [=] { return connect("simulate", *arguments); }; });
}

}  // namespace

void add_robot_verbs(CLI::App& app, Chosen& chosen) {
  add_robot(app, chosen);
  add_drive(app, chosen);
  add_simulate(app, chosen);
}

}  // namespace zwang::cli
