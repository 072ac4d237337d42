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
    case EventCode::joint_travel:
      return "joint_travel";
    case EventCode::joint_speed:
      return "joint_speed";
    case EventCode::runaway:
      return "runaway";
    case EventCode::rate_contradicts:
      return "rate_contradicts";
    case EventCode::wheel_reversed:
      return "wheel_reversed";
    case EventCode::motors_reversed:
      return "motors_reversed";
    case EventCode::clock_back:
      return "clock_back";
    case EventCode::clock_stands:
      return "clock_stands";
    case EventCode::clock_rate:
      return "clock_rate";
    case EventCode::wrench_impossible:
      return "wrench_impossible";
    case EventCode::not_followed:
      return "not_followed";
    case EventCode::frozen_base:
      return "frozen_base";
    case EventCode::clock_drift:
      return "clock_drift";
    case EventCode::sensor_bias:
      return "sensor_bias";
    case EventCode::clock_refused:
      return "clock_refused";
    case EventCode::sample_lost:
      return "sample_lost";
    case EventCode::slip:
      return "slip";
    case EventCode::wrench_refused:
      return "wrench_refused";
    case EventCode::entry_refused:
      return "entry_refused";
    case EventCode::signal_refused:
      return "signal_refused";
    case EventCode::probed:
      return "probed";
    case EventCode::outside:
      return "outside";
    case EventCode::not_at_rest:
      return "not_at_rest";
  }
  return "?";
}

const char* describe(EventCode code) noexcept {
  switch (code) {
    case EventCode::none:
      return "none";
    case EventCode::bad_sample:
      return "a sample with a number that cannot be, or of the wrong size";
    case EventCode::lost_ticks:
      return "too long without a good sample, or a clock that jumped ahead";
    case EventCode::frozen:
      return "the motors should have moved the robot, and a position of it does not change";
    case EventCode::bad_torque:
      return "a commanded torque is not finite";
    case EventCode::solver:
      return "the solver gave no solution";
    case EventCode::plant:
      return "the robot does not answer";
    case EventCode::requested:
      return "requested";
    case EventCode::watchdog:
      return "the control thread was blocked";
    case EventCode::torque_lost:
      return "a motor's torque does not arrive";
    case EventCode::torque_stuck:
      return "a motor's torque does not follow its command";
    case EventCode::torque_flipped:
      return "a motor turns the wrong way";
    case EventCode::joint_travel:
      return "an arm's joint is about to leave its travel";
    case EventCode::joint_speed:
      return "an arm's joint is faster than it may be";
    case EventCode::runaway:
      return "the base gets faster than it may while its motors are told to brake";
    case EventCode::rate_contradicts:
      return "the rate of a joint is not that of its position";
    case EventCode::wheel_reversed:
      return "a wheel's encoder counts the wrong way round";
    case EventCode::motors_reversed:
      return "the base accelerates against what its motors are told";
    case EventCode::clock_back:
      return "the samples' clock went back";
    case EventCode::clock_stands:
      return "the samples' clock stands while their values change";
    case EventCode::clock_rate:
      return "the samples' clock runs at another rate than the control period";
    case EventCode::wrench_impossible:
      return "a wrench from outside is larger than anything can press with; it counts as 0";
    case EventCode::not_followed:
      return "the base, or a wheel, does not move as the drive is told";
    case EventCode::frozen_base:
      return "the wheels roll, and the measured base stays as it was";
    case EventCode::clock_drift:
      return "the samples' clock and the control period differ by more than a tenth";
    case EventCode::clock_refused:
      return "a sample's time was refused";
    case EventCode::sample_lost:
      return "no sample arrived";
    case EventCode::sensor_bias:
      return "a force is measured before anything has moved";
    case EventCode::slip:
      return "a wheel slides that should roll";
    case EventCode::wrench_refused:
      return "a force from outside lies along an axis whose force is limited; the solver is not told";
    case EventCode::entry_refused:
      return "a task is not entered: what it requires does not hold, or a pose that is set is not known";
    case EventCode::signal_refused:
      return "samples of a signal come by another clock, or with numbers that are none";
    case EventCode::probed:
      return "no encoder counted where the motors should have moved the base; told to move back, it did";
    case EventCode::outside:
      return "a frame stands outside of its range or region";
    case EventCode::not_at_rest:
      return "the stop's time is over, and the base may still move";
  }
  return "?";
}

std::vector<std::string> event_signals(const solver::Model& model, const std::vector<std::string>& measured,
                                       const std::vector<std::string>& rows) {
  std::vector<std::string> names = {"time", "base.pose", "base.twist"};
  for (int j = 0; j < model.joint_count(); ++j) {
    for (const char* what : {".q", ".qd", ".tau_ff", ".tau"}) names.push_back(model.joint(j).name + what);
  }
  for (const solver::Body& body : model.bodies()) names.push_back(body.name + ".f_ext");
  names.insert(names.end(), measured.begin(), measured.end());
  names.insert(names.end(), rows.begin(), rows.end());
  return names;
}

}  // namespace zwang::runtime
