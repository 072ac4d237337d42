#include "live_hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;

constexpr double strongest_push = 500.0;   // [N]
constexpr double farthest_push = 5.0;      // [m] from the base's origin
constexpr double farthest_object = 100.0;  // [m] from the world's origin

double number_at(const nlohmann::json& request, const char* key) {
  const auto found = request.find(key);
  return found != request.end() && found->is_number() ? found->get<double>()
                                                      : std::numeric_limits<double>::quiet_NaN();
}

/// NaN where there is none.
std::array<double, 2> pair_at(const nlohmann::json& request, const char* key) {
  std::array<double, 2> two{std::nan(""), std::nan("")};
  const auto found = request.find(key);
  if (found == request.end() || !found->is_array() || found->size() != 2) return two;
  for (std::size_t i = 0; i < two.size(); ++i) {
    if ((*found)[i].is_number()) two[i] = (*found)[i].get<double>();
  }
  return two;
}

/// The place of the name that a request has; as many as there are: none has it.
std::size_t named_by(const nlohmann::json& request, const std::vector<std::string>& names) {
  const auto name = request.find("name");
  if (name == request.end() || !name->is_string() || name->get<std::string>().empty()) return names.size();
  return static_cast<std::size_t>(std::ranges::find(names, name->get<std::string>()) - names.begin());
}

}  // namespace

LiveHand::LiveHand(const lang::Program& program)
    : signals_(program.signals.size()),
      switches_(runtime::fault_switches(program.robot)),
      hand_(runtime::idle_hand(program)) {
  for (const std::size_t i : runtime::given_signals(program)) signals_[i] = program.signals[i].name;
  // One on a hinge or a slide goes its own way.
  for (const lang::SceneObject& object : program.scene->objects)
    objects_.push_back(object.guide ? std::string() : object.name);
}

ordered_json LiveHand::choices() const {
  ordered_json signals = ordered_json::array(), faults = ordered_json::array(),
               objects = ordered_json::array();
  for (const std::string& signal : signals_) {
    if (!signal.empty()) signals.push_back(signal);
  }
  for (const std::string& object : objects_) {
    if (!object.empty()) objects.push_back(object);
  }
  for (const runtime::FaultSwitch& one : switches_) {
    ordered_json fault = {{"name", one.name}};
    if (one.words.empty()) {
      fault["unit"] = one.unit;
      fault["low"] = one.low;
      fault["high"] = one.high;
    } else {
      fault["words"] = one.words;
    }
    faults.push_back(fault);
  }
  return {{"signals", signals}, {"faults", faults}, {"objects", objects}};
}

ordered_json LiveHand::in_force() const {
  ordered_json blocked = ordered_json::array(), faults = ordered_json::object();
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    if (hand_.blocked[i]) blocked.push_back(signals_[i]);
  }
  for (std::size_t i = 0; i < switches_.size(); ++i) {
    const runtime::FaultSwitch& one = switches_[i];
    const double value = hand_.faults[i];
    if (one.words.empty() && !std::isnan(value)) faults[one.name] = value;
    if (!one.words.empty() && value > 0.0) faults[one.name] = one.words[static_cast<std::size_t>(value)];
  }
  return {{"blocked", blocked}, {"faults", faults}};
}

std::string LiveHand::obey(const nlohmann::json& request) {
  const auto what = request.find("do");
  if (what == request.end()) return {};
  if (*what == "push") return press(request);
  if (*what == "block") return block(request);
  if (*what == "fault") return put_fault(request);
  if (*what == "move") return move_object(request);
  return {};
}

std::string LiveHand::press(const nlohmann::json& request) {
  const auto at = pair_at(request, "at"), force = pair_at(request, "force");
  const bool is_near = std::hypot(at[0], at[1]) <= farthest_push;
  if (!is_near || !(std::hypot(force[0], force[1]) <= strongest_push))
    return "nobody pushes as hard, or as far from the base";
  hand_.push = {{at[0], at[1]}, {force[0], force[1]}};
  return {};
}

std::string LiveHand::block(const nlohmann::json& request) {
  const std::size_t signal = named_by(request, signals_);
  const auto value = request.find("value");
  if (signal == signals_.size() || value == request.end() || !value->is_boolean())
    return "the scene gives no signal of this name";
  hand_.blocked[signal] = value->get<bool>();
  return {};
}

std::string LiveHand::put_fault(const nlohmann::json& request) {
  const auto name = request.find("name"), value = request.find("value");
  const auto is_it = [&](const runtime::FaultSwitch& one) { return *name == one.name; };
  const auto found = name == request.end() ? switches_.end() : std::ranges::find_if(switches_, is_it);
  if (found == switches_.end() || value == request.end()) return "no fault has this name";
  double asked = found->nothing();
  if (value->is_number() && found->words.empty()) {
    asked = value->get<double>();
  } else if (!value->is_null()) {
    const auto word =
        std::ranges::find_if(found->words, [&](const std::string& one) { return *value == one; });
    if (word == found->words.end()) return "the fault has no such word";
    asked = static_cast<double>(word - found->words.begin());
  }
  if (!found->has(asked)) return "the value is outside the range of the fault";
  hand_.faults[static_cast<std::size_t>(found - switches_.begin())] = asked;
  return {};
}

std::string LiveHand::move_object(const nlohmann::json& request) {
  const std::size_t object = named_by(request, objects_);
  if (object == objects_.size()) return "the scene has no object of this name that can be moved";
  const auto to = pair_at(request, "to");
  const double yaw = number_at(request, "yaw");
  const bool is_near = std::abs(to[0]) <= farthest_object && std::abs(to[1]) <= farthest_object;
  if (!is_near || !std::isfinite(yaw)) return "an object goes no farther than 100 m from the origin";
  hand_.sent = {static_cast<int>(object), to, yaw};
  return {};
}

}  // namespace zwang::cli
