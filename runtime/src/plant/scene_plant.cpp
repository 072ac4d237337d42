#include "zwang/runtime/scene_plant.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include "body_faults.hpp"
#include "encoders.hpp"
#include "estimate/ticks.hpp"
#include "injected_faults.hpp"
#include "motor_drive.hpp"
#include "robot_senses.hpp"
#include "scene_hands.hpp"
#include "wheel_size.hpp"

namespace zwang::runtime {

using lang::FaultKind;

namespace {

/// The faults of a robot of the scene, or of the first one and the world, whose name is empty.
std::vector<lang::Fault> faults_of(const std::string& robot, const std::vector<lang::Fault>& all) {
  std::vector<lang::Fault> faults;
  std::ranges::copy_if(all, std::back_inserter(faults),
                       [&](const lang::Fault& fault) { return fault.robot == robot; });
  return faults;
}

/// The spans of a scenario's faults point into the scenario, and not into the files of the program.
std::vector<lang::Fault> without_spans(std::vector<lang::Fault> faults) {
  for (lang::Fault& fault : faults) fault.span = {};
  return faults;
}

lang::Robot with_friction(lang::Robot robot, double factor) {
  for (lang::JointFriction& joint : robot.friction) {
    joint.coulomb *= factor;
    joint.viscous *= factor;
  }
  return robot;
}

const lang::Scene& scene_of(const lang::Program& program) {
  if (!program.scene) throw std::invalid_argument("plant: the program has no scene");
  return *program.scene;
}

}  // namespace

SimulationSteps::SimulationSteps(double control_period) noexcept {
  constexpr double longest = 1e-3;   // [s]
  constexpr double rounding = 1e-6;  // of it
  per_tick_ = std::max(1, static_cast<int>(std::ceil(control_period / longest - rounding)));
  period_ = control_period / per_tick_;
}

SimulationSteps::SimulationSteps(double control_period, double step) noexcept
    : per_tick_(ticks_of(control_period, step)), period_(step) {}

bool SimulationSteps::tick_is_due() noexcept {
  const bool is_due = until_tick_ == 0;
  until_tick_ = (is_due ? per_tick_ : until_tick_) - 1;
  return is_due;
}

ScenePartner::ScenePartner(const lang::SceneRobot& robot, const RunnerSettings& settings)
    : name(robot.name),
      program(robot.program),
      runner(*robot.program, settings),
      torque(Eigen::VectorXd::Zero(robot.program->robot.model.joint_count())) {}

struct ScenePlant::Parts {
  /// The samples that a partner receives, its senses of itself and of others, and its faults.
  struct Told {
    RobotSenses senses;
    InjectedFaults faults;
    Sensed actual, sensed;
    Eigen::VectorXd torque;  ///< what its motors make of the command
    BodyFaults changes;
    SimulationSteps steps;
    MotorDrive motors;
  };

  Parts(const lang::Program& program, const ScenePlantOptions& options)
      : scene(scene_of(program)),
        robot(with_friction(program.robot, options.deviation.friction)),
        wheels(program.robot.model, options.deviation.wheel_radius),
        simulation(robot, scene, options.simulation),
        senses(program, scene, 0, program.robot, options.seed),
        faults(faults_of({}, scene.faults), faults_of({}, without_spans(options.faults)),
               program.robot.model),
        encoders(options.deviation, options.seed),
        changes(0, program.robot.model, scene.floor_friction),
        motors(program.robot),
        period(options.simulation.period),
        switches(fault_switches(program.robot)),
        hand(idle_hand(program)),
        actual(program.robot.model),
        torque(Eigen::VectorXd::Zero(program.robot.model.joint_count())),
        pushed(torque),
        hands(scene, program.robot.model) {
    // As many as there ever are do not allocate afterwards.
    simulation.set_more_pushes(std::vector<BodyPush>(hands.size()));
    simulation.set_more_pushes({});
    static_cast<void>(sense());
    senses.start_at(actual);
    RunnerSettings settings;
    settings.extra_columns = base_truth_columns();
    for (const lang::Task& task : program.tasks) entries.push_back("run.entered." + task.name);
    for (const lang::SceneObject& object : scene.objects) things.push_back("truth." + object.name);
    for (const lang::SceneRobot& other : scene.robots) things.push_back("truth." + other.name);
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
      const SimulationSteps steps(scene.robots[i].program->robot.control_period, options.simulation.period);
      settings.period = steps.per_tick() * steps.period();
      partners.emplace_back(scene.robots[i], settings);
      const lang::Program& own = *partners.back().program;
      told.push_back({RobotSenses(own, scene, static_cast<int>(i) + 1, program.robot, options.seed),
                      InjectedFaults(faults_of(partners.back().name, scene.faults),
                                     faults_of(partners.back().name, options.faults), own.robot.model),
                      Sensed(own.robot.model), Sensed(own.robot.model, own.signals.size()),
                      partners.back().torque, BodyFaults(i + 1, own.robot.model, scene.floor_friction), steps,
                      MotorDrive(own.robot)});
      static_cast<void>(simulation.sense_partner(i, told.back().actual));
      told.back().senses.start_at(told.back().actual);
    }
  }

  /// The first robot, as its encoders have it.
  PlantStatus sense() noexcept {
    const PlantStatus status = simulation.sense(actual);
    if (status == PlantStatus::ok) wheels.tell(actual.state);
    return status;
  }

  /// The floor's friction where no fault names a wheel.
  double floor_friction(double time) const noexcept {
    const lang::Fault* slip = faults.find(FaultKind::floor_friction, time);
    return slip != nullptr ? slip->value : scene.floor_friction;
  }

  /// Floor, the first robot's body and the simulation itself.
  void change_world(double time) noexcept {
    changes.make(simulation, faults, floor_friction(time), time);
    if (faults.active(FaultKind::plant_diverges, time)) simulation.diverge();
  }

  /// A time of the run has come from which faults count.
  void come(const std::string& of, double time) noexcept {
    faults.come(of, time);
    for (Told& of_partner : told) of_partner.faults.come(of, time);
  }

  bool waits() const noexcept {
    return faults.waits() || std::ranges::any_of(told, [](const Told& one) { return one.faults.waits(); });
  }

  /// The onsets of faults that count from a contact, and objects that leave.
  void look_for_onsets(double time) noexcept {
    const std::vector<ObjectTruth>& objects = simulation.truth().objects;
    for (std::size_t k = 0; waits() && k < things.size(); ++k) {
      if (objects[k].touched) come(things[k] + ".touched", *objects[k].touched);
      if (objects[k].latched) come(things[k] + ".latched", *objects[k].latched);
    }
    if (!faults.active(FaultKind::object_leaves, time)) return;
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      if (faults.object_leaves(scene.objects[k].name, time)) send_away(k, time);
    }
  }

  /// Along its own x axis, on the side that is away from the first robot.
  void send_away(std::size_t number, double time) {
    const ObjectTruth& now = simulation.truth().objects[number];
    const double x = std::cos(now.yaw), y = std::sin(now.yaw);
    const bool is_ahead = x * (now.x - simulation.truth().x) + y * (now.y - simulation.truth().y) > 0.0;
    const double way = is_ahead ? lang::leaves_by : -lang::leaves_by;
    simulation.move_object(number,
                           {{time, {now.x, now.y}, now.yaw},
                            {time + lang::leaves_within, {now.x + way * x, now.y + way * y}, now.yaw}});
  }

  /// The partner's tick, when it is time for it.
  void step_partner(std::size_t i) noexcept {
    ScenePartner& partner = partners[i];
    Told& of = told[i];
    if (simulation.sense_partner(i, of.actual) != PlantStatus::ok) return;
    of.senses.measure(simulation.truth(), of.torque, of.actual);
    const double time = of.actual.time;
    of.changes.make(simulation, of.faults, floor_friction(time), time);
    // A sample that does not arrive leaves the last one: the guard counts it.
    if (!of.faults.active(FaultKind::samples_lost, time)) {
      of.senses.tell(of.actual, of.sensed);
      of.faults.spoil(of.sensed);
    }
    if (of.steps.tick_is_due()) tick_partner(i);
    of.motors.drive(partner.runner.command(), of.actual, period, of.torque);
    of.faults.spoil(of.torque, time);
    static_cast<void>(simulation.give_partner(i, of.torque));
  }

  /// Docks that an output of the task file holds shut.
  void find_held_docks(const lang::Program& program) {
    const auto add = [&](std::size_t owner, const std::optional<lang::Dock>& dock) {
      if (!dock || dock->held_while.empty()) return;
      const auto output = std::ranges::find(program.outputs, dock->held_while, &lang::Output::name);
      if (output == program.outputs.end()) return;
      held_docks.push_back({owner, static_cast<std::size_t>(output - program.outputs.begin())});
      simulation.set_dock(owner, output->start > 0.5);
    };
    for (std::size_t k = 0; k < scene.objects.size(); ++k) add(k, scene.objects[k].dock);
    for (std::size_t r = 0; r < scene.robots.size(); ++r) add(scene.objects.size() + r, scene.robots[r].dock);
  }

  void press_by_hands(double time) noexcept {
    if (hands.size() > 0) simulation.set_more_pushes(hands.at(time));
  }

  void hold_docks(const std::vector<double>& outputs) noexcept {
    for (const HeldDock& dock : held_docks) {
      if (dock.output < outputs.size()) simulation.set_dock(dock.owner, outputs[dock.output] > 0.5);
    }
  }

  /// The fault of a switch, as its value has it, in the place of the one before.
  void turn(const FaultSwitch& one, double value) {
    const Eigen::Index joint = one.joint.empty() ? -1 : robot.model.find_joint(one.joint).value_or(-1);
    for (const FaultKind kind : one.kinds) faults.lift(kind, joint);
    if (one.words.empty() ? std::isnan(value) : value < 1.0) return;
    lang::Fault fault;
    fault.kind = one.kinds[one.words.empty() ? 0 : static_cast<std::size_t>(value) - 1];
    fault.at = simulation.truth().time;
    fault.value = one.words.empty() ? value : 0.0;
    faults.put(fault, joint);
  }

  /// Straight and evenly from where it is.
  void send(const SentObject& sent) {
    const auto number = static_cast<std::size_t>(sent.object);
    const ObjectTruth& now = simulation.truth().objects[number];
    const double turning = std::remainder(sent.yaw - now.yaw, 2.0 * std::numbers::pi);
    const double way = std::hypot(sent.to[0] - now.x, sent.to[1] - now.y);
    const double lasts = std::max({way / hand_speed, std::abs(turning) / hand_turn, period});
    const double begin = simulation.truth().time;
    simulation.move_object(number,
                           {{begin, {now.x, now.y}, now.yaw}, {begin + lasts, sent.to, now.yaw + turning}});
  }

  /// With the first robot's torques as they stand.
  PlantStatus step() noexcept;

  void tick_partner(std::size_t i) noexcept {
    ScenePartner& partner = partners[i];
    Told& of = told[i];
    const ObjectTruth& own = simulation.truth().objects[scene.objects.size() + i];
    const BaseTruth& base = simulation.truth().robots[i].base;
    partner.torque = partner.runner.step(of.sensed, base_truth_values(own.x, own.y, own.yaw, base));
  }

  lang::Scene scene;
  lang::Robot robot;  ///< the first one, as it is
  WheelSize wheels;
  MujocoPlant simulation;
  RobotSenses senses;
  InjectedFaults faults;
  Encoders encoders;
  BodyFaults changes;
  MotorDrive motors;
  double period;  ///< [s] of a step
  std::vector<FaultSwitch> switches;
  Hand hand;  ///< as it is
  Sensed actual;
  Eigen::VectorXd torque;  ///< what the motors make of the command
  Eigen::VectorXd pushed;  ///< the same, at wheels of the model's size
  std::vector<ScenePartner> partners;
  std::vector<Told> told;  ///< parallel to `partners`
  struct HeldDock {
    std::size_t owner;   ///< in Truth::objects
    std::size_t output;  ///< of the program
  };
  std::vector<HeldDock> held_docks;
  SceneHands hands;
  std::vector<std::string> entries, things;  ///< `run.entered.press`, by task; `truth.wall`, by object
};

ScenePlant::ScenePlant(const lang::Program& program, const ScenePlantOptions& options)
    : parts_(std::make_unique<Parts>(program, options)) {
  parts_->find_held_docks(program);
}

ScenePlant::~ScenePlant() = default;

PlantStatus ScenePlant::sense(Sensed& sensed) noexcept {
  Parts& p = *parts_;
  const PlantStatus status = p.sense();
  if (status != PlantStatus::ok) return status;
  if (sensed.state.q.size() != p.actual.state.q.size()) return PlantStatus::unreachable;
  p.senses.measure(p.simulation.truth(), p.torque, p.actual);
  if (p.faults.active(FaultKind::samples_lost, p.actual.time)) return PlantStatus::unreachable;
  p.senses.tell(p.actual, sensed);
  p.encoders.count(sensed.state.q);
  p.faults.spoil(sensed);
  p.encoders.read(sensed.state.q);
  return PlantStatus::ok;
}

PlantStatus ScenePlant::apply(const Eigen::VectorXd& tau) noexcept {
  Parts& p = *parts_;
  if (tau.size() != p.torque.size() || p.motors.takes_velocity()) return PlantStatus::unreachable;
  p.torque = tau;
  return p.step();
}

PlantStatus ScenePlant::follow(const Command& command) noexcept {
  Parts& p = *parts_;
  if (command.torque.size() != p.torque.size()) return PlantStatus::unreachable;
  p.hold_docks(command.outputs);
  if (p.motors.takes_velocity()) {
    const PlantStatus status = p.sense();
    if (status != PlantStatus::ok) return status;
  }
  p.motors.drive(command, p.actual, p.period, p.torque);
  return p.step();
}

PlantStatus ScenePlant::Parts::step() noexcept {
  const double time = simulation.truth().time;
  look_for_onsets(time);
  faults.spoil(torque, time);
  change_world(time);
  press_by_hands(time);
  for (std::size_t i = 0; i < partners.size(); ++i) step_partner(i);
  pushed = torque;
  wheels.push(pushed);
  return simulation.apply(pushed);
}

void ScenePlant::set_push(const Push& push) noexcept {
  parts_->simulation.set_push(push);
}

void ScenePlant::set_hand(const Hand& hand) {
  Parts& p = *parts_;
  p.simulation.set_push(hand.push);
  if (hand.blocked != p.hand.blocked) p.senses.block(hand.blocked);
  for (std::size_t i = 0; i < p.switches.size(); ++i) {
    const double before = p.hand.faults[i], value = hand.faults[i];
    const bool is_same = before == value || (std::isnan(before) && std::isnan(value));
    if (!is_same) p.turn(p.switches[i], value);
  }
  if (hand.sent.object >= 0 && hand.sent != p.hand.sent) p.send(hand.sent);
  p.hand = hand;
}

void ScenePlant::end_lean() noexcept {
  constexpr double longest = 1.0;  // [s]
  Parts& p = *parts_;
  const BaseTruth& base = truth().base;
  const auto stands = [&] {
    const solver::Vector3& turning = p.actual.state.base_twist.angular;
    return std::hypot(base.roll, base.pitch) < standing_lean &&
           std::hypot(turning.x(), turning.y()) < standing_turn;
  };
  const double end = truth().time + longest;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(p.torque.size());
  while (!base.fallen && truth().time < end) {
    if (p.sense() != PlantStatus::ok || stands()) return;
    if (apply(rest) != PlantStatus::ok) return;
  }
}

void ScenePlant::note_entry(int task, double time) noexcept {
  if (parts_->waits()) parts_->come(parts_->entries[static_cast<std::size_t>(task)], time);
}

double ScenePlant::onset() const noexcept {
  double first = parts_->faults.onset_of_run();
  for (const Parts::Told& partner : parts_->told) first = std::min(first, partner.faults.onset_of_run());
  return first;
}

std::vector<lang::Fault> ScenePlant::faults() const {
  return parts_->faults.all();
}

const Truth& ScenePlant::truth() const noexcept {
  return parts_->simulation.truth();
}

const solver::State& ScenePlant::true_state() const noexcept {
  return parts_->actual.state;
}

std::vector<ScenePartner>& ScenePlant::partners() noexcept {
  return parts_->partners;
}

}  // namespace zwang::runtime
