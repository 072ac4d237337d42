#include "zwang/runtime/hand.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "place_columns.hpp"
#include "zwang/lang/fault_word.hpp"

namespace zwang::runtime {

using lang::FaultKind;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double least_friction = 0.01, most_friction = 2.0;
constexpr double most_payload = 4.0;     // of the mass of the base link
constexpr double farthest_centre = 0.5;  // [m]
constexpr double most_inertia_more = 4.0;

/// All words of a key, as a switch of `joint`.
FaultSwitch worded(const std::string& key, const std::string& joint = {}) {
  FaultSwitch one;
  one.name = joint.empty() ? key : key + "." + joint;
  one.joint = joint;
  one.words = {"none"};
  for (const lang::FaultWord& word : lang::fault_words) {
    if (word.key != key) continue;
    one.words.emplace_back(word.word);
    one.kinds.push_back(word.kind);
  }
  return one;
}

FaultSwitch numbered_fault(const std::string& name, FaultKind kind, const std::string& unit, double low,
                           double high, const std::string& joint = {}) {
  FaultSwitch one;
  one.name = joint.empty() ? name : name + "." + joint;
  one.kinds = {kind};
  one.joint = joint;
  one.unit = unit;
  one.low = low;
  one.high = high;
  return one;
}

}  // namespace

double FaultSwitch::nothing() const {
  return words.empty() ? no_number : 0.0;
}

bool FaultSwitch::has(double value) const {
  if (words.empty()) return std::isnan(value) || (value >= low && value <= high);
  return value >= 0.0 && value < static_cast<double>(words.size()) && value == std::floor(value);
}

std::vector<FaultSwitch> fault_switches(const lang::Robot& robot) {
  const solver::Model& model = robot.model;
  std::vector<FaultSwitch> all{worded("samples"), worded("clock"), worded("plant")};
  for (int j = 0; j < model.joint_count(); ++j) {
    if (model.joint(j).actuated) all.push_back(worded("torque", model.joint(j).name));
  }
  const double mass = model.bodies().front().inertia.mass;
  all.push_back(
      numbered_fault("floor_friction", FaultKind::floor_friction, {}, least_friction, most_friction));
  for (const solver::Wheel& wheel : model.wheels())
    all.push_back(numbered_fault("floor_friction", FaultKind::floor_friction, {}, least_friction,
                                 most_friction, model.joint(wheel.body - 1).name));
  all.push_back(numbered_fault("payload", FaultKind::payload, "kg", -lang::most_payload_less * mass,
                               most_payload * mass));
  all.push_back(
      numbered_fault("centre_of_mass", FaultKind::centre_of_mass, "m", -farthest_centre, farthest_centre));
  all.push_back(
      numbered_fault("inertia", FaultKind::inertia, {}, -lang::most_inertia_less, most_inertia_more));
  return all;
}

Hand idle_hand(const lang::Program& program) {
  Hand hand;
  hand.blocked.assign(program.signals.size(), false);
  for (const FaultSwitch& one : fault_switches(program.robot)) hand.faults.push_back(one.nothing());
  return hand;
}

std::vector<std::size_t> given_signals(const lang::Program& program) {
  std::vector<std::size_t> given;
  for (std::size_t i = 0; i < program.signals.size(); ++i) {
    const std::string& name = program.signals[i].name;
    if (std::ranges::find(program.scene->signals, name, &lang::SceneSignal::name) !=
        program.scene->signals.end())
      given.push_back(i);
  }
  return given;
}

HandColumns::HandColumns(const lang::Program& program)
    : signals_(given_signals(program)),
      columns_{{"hand.at.x", "m", {}},
               {"hand.at.y", "m", {}},
               {"hand.force.x", "N", {}},
               {"hand.force.y", "N", {}}} {
  const std::vector<lang::SceneObject>& objects = program.scene->objects;
  for (const std::size_t signal : signals_)
    columns_.push_back({"hand.blocked." + program.signals[signal].name, {}, {}});
  for (const FaultSwitch& one : fault_switches(program.robot))
    columns_.push_back({"hand.fault." + one.name, one.unit, one.words});
  std::vector<std::string> names{"none"};
  for (const lang::SceneObject& object : objects) names.push_back(object.name);
  columns_.push_back({"hand.object", {}, names});
  columns_.push_back({"hand.to.x", "m", {}});
  columns_.push_back({"hand.to.y", "m", {}});
  columns_.push_back({"hand.to.yaw", "rad", {}});
  for (std::size_t k = 0; k < objects.size(); ++k) {
    if (objects[k].moves()) continue;
    fixed_.push_back(k);
    add_place_columns(objects[k].name, columns_);
  }
}

void HandColumns::put(const Hand& hand, const Truth& truth, std::span<double> values) const noexcept {
  std::size_t at = 0;
  const auto put_one = [&](double value) { values[at++] = value; };
  for (const double value : {hand.push.at.x(), hand.push.at.y(), hand.push.force.x(), hand.push.force.y()})
    put_one(value);
  for (const std::size_t signal : signals_) put_one(hand.blocked[signal] ? 1.0 : 0.0);
  for (const double value : hand.faults) put_one(value);
  const bool is_sent = hand.sent.object >= 0;
  put_one(hand.sent.object + 1);
  for (const double value : {hand.sent.to[0], hand.sent.to[1], hand.sent.yaw})
    put_one(is_sent ? value : no_number);
  for (const std::size_t k : fixed_) {
    const ObjectTruth& object = truth.objects[k];
    for (const double value : {object.x, object.y, object.yaw}) put_one(value);
  }
}

}  // namespace zwang::runtime
