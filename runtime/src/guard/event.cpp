#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

const char* to_string(EventCode code) noexcept {
  switch (code) {
    case EventCode::none:
      return "none";
    case EventCode::bad_sample:
      return "bad_sample";
    case EventCode::lost_ticks:
      return "lost_ticks";
    case EventCode::frozen:
      return "frozen";
    case EventCode::bad_torque:
      return "bad_torque";
    case EventCode::solver:
      return "solver";
    case EventCode::plant:
      return "plant";
    case EventCode::requested:
      return "requested";
    case EventCode::watchdog:
      return "watchdog";
    case EventCode::torque_lost:
      return "torque_lost";
    case EventCode::torque_stuck:
      return "torque_stuck";
    case EventCode::torque_flipped:
      return "torque_flipped";
    case EventCode::sensor_bias:
      return "sensor_bias";
    case EventCode::clock_refused:
      return "clock_refused";
    case EventCode::slip:
      return "slip";
  }
  return "?";
}

std::vector<std::string> event_signals(const solver::Model& model, const std::vector<std::string>& measured) {
  std::vector<std::string> names = {"time", "base.pose", "base.twist"};
  for (int j = 0; j < model.joint_count(); ++j) {
    for (const char* what : {".q", ".qd", ".tau_ff", ".tau"}) names.push_back(model.joint(j).name + what);
  }
  for (const solver::Body& body : model.bodies()) names.push_back(body.name + ".f_ext");
  names.insert(names.end(), measured.begin(), measured.end());
  return names;
}

}  // namespace zwang::runtime
