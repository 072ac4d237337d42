#include "zwang/runtime/event.hpp"

#include <array>

namespace zwang::runtime {

namespace {

struct EventWords {
  EventCode code;
  const char* name;
  const char* words;
};
/// In the order of the codes.
constexpr std::array event_words{
    EventWords{EventCode::none, "none", "none"},
    EventWords{EventCode::bad_sample, "bad_sample",
               "a sample with a number that cannot be, or of the wrong size"},
    EventWords{EventCode::lost_ticks, "lost_ticks",
               "too long without a good sample, or a clock that jumped ahead"},
    EventWords{EventCode::frozen, "frozen",
               "the motors should have moved the robot, and a position of it does not change"},
    EventWords{EventCode::bad_torque, "bad_torque", "a commanded torque is not finite"},
    EventWords{EventCode::solver, "solver", "the solver gave no solution"},
    EventWords{EventCode::plant, "plant", "the robot does not answer"},
    EventWords{EventCode::requested, "requested", "requested"},
    EventWords{EventCode::watchdog, "watchdog", "the control thread was blocked"},
    EventWords{EventCode::torque_lost, "torque_lost", "a motor's torque does not arrive"},
    EventWords{EventCode::torque_stuck, "torque_stuck", "a motor's torque does not follow its command"},
    EventWords{EventCode::torque_flipped, "torque_flipped", "a motor turns the wrong way"},
    EventWords{EventCode::joint_travel, "joint_travel", "an arm's joint is about to leave its travel"},
    EventWords{EventCode::joint_speed, "joint_speed", "an arm's joint is faster than it may be"},
    EventWords{
        EventCode::runaway, "runaway",
        "the base gets faster while its motors are told to brake: something pushes it, or a motor turns "
        "the wrong way"},
    EventWords{EventCode::rate_contradicts, "rate_contradicts",
               "the rate of a joint is not that of its position"},
    EventWords{EventCode::wheel_reversed, "wheel_reversed", "a wheel's encoder counts the wrong way round"},
    EventWords{EventCode::motors_reversed, "motors_reversed",
               "the base accelerates against what its motors are told"},
    EventWords{EventCode::clock_back, "clock_back", "the samples' clock went back"},
    EventWords{EventCode::clock_stands, "clock_stands",
               "the samples' clock stands while their values change"},
    EventWords{EventCode::clock_rate, "clock_rate",
               "the samples' clock runs at another rate than the control period"},
    EventWords{EventCode::wrench_impossible, "wrench_impossible",
               "a wrench from outside is larger than anything can press with; it counts as 0"},
    EventWords{EventCode::not_followed, "not_followed",
               "the base, or a wheel, does not move as the drive is told"},
    EventWords{EventCode::frozen_base, "frozen_base",
               "the wheels roll, and the measured base stays as it was"},
    EventWords{EventCode::effort_lost, "effort_lost",
               "the measured torque of a motor is not what its velocity loop must give"},
    EventWords{EventCode::clock_refused, "clock_refused", "a sample's time was refused"},
    EventWords{EventCode::clock_drift, "clock_drift",
               "the samples' clock and the control period differ by more than a tenth"},
    EventWords{EventCode::sample_lost, "sample_lost", "no sample arrived"},
    EventWords{EventCode::sensor_bias, "sensor_bias", "a force is measured before anything has moved"},
    EventWords{EventCode::slip, "slip", "a wheel slides that should roll"},
    EventWords{EventCode::wrench_refused, "wrench_refused",
               "a force from outside lies along an axis whose force is limited; the solver is not told"},
    EventWords{EventCode::entry_refused, "entry_refused",
               "a task is not entered: what it requires does not hold, or a pose that is set is not known"},
    EventWords{EventCode::signal_refused, "signal_refused",
               "samples of a signal come by another clock, or with numbers that are none"},
    EventWords{EventCode::probed, "probed",
               "no encoder counted where the motors should have moved the base; told to move back, it did"},
    EventWords{EventCode::outside, "outside", "a frame stands outside of its range or region"},
    EventWords{EventCode::not_at_rest, "not_at_rest", "the stop's time is over, and the base may still move"},
    EventWords{EventCode::overrun, "overrun",
               "this computer is late: five control cycles were skipped within a second"},
    EventWords{
        EventCode::motor_obeyed, "motor_obeyed",
        "in the stop's brake this motor obeyed: a mass that is not the model's, or a push, looked like "
        "its fault"},
    EventWords{EventCode::drive_at_limit, "drive_at_limit", "the measured torque of a motor is at its limit"},
};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < event_words.size(); ++i) {
    if (event_words[i].code != static_cast<EventCode>(i)) return false;
  }
  return event_words.back().code == last_event_code;
}
static_assert(is_in_order(), "event_words has a line for each EventCode");

}  // namespace

const char* to_string(EventCode code) noexcept {
  const auto line = static_cast<std::size_t>(code);
  return line < event_words.size() ? event_words[line].name : "?";
}

const char* describe(EventCode code) noexcept {
  const auto line = static_cast<std::size_t>(code);
  return line < event_words.size() ? event_words[line].words : "?";
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
