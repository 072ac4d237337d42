#include "robot_side.hpp"

#include <algorithm>

#include "inbox.hpp"
#include "outbox.hpp"
#include "signal_sample.hpp"

namespace zwang::connect {

RobotSide::RobotSide(const lang::Connection& connection, const lang::Program& program, double stamps_ahead)
    : connection_(connection),
      program_(program),
      order_(joints_in_order(connection.command, program.robot.model)),
      mail_(CommandMail{runtime::Command(program.robot.model.joint_count()), 0.0}),
      zeros_(program.robot.model.joint_count()),
      given_(program.robot.model.joint_count()),
      outputs_(program.outputs.size()),
      stamps_ahead_(stamps_ahead) {
  for (int j = 0; j < program.robot.model.joint_count(); ++j)
    joint_state_.names.push_back(connection.joints.name_of(program.robot.model.joint(j).name));
  odometry_.child_frame = program.robot.base_frame;
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i] = program.outputs[i].start;
  given_.outputs.resize(outputs_.size());
  now();
}

void RobotSide::join(Participant& participant) {
  joints_ =
      participant.advertise(connection_.joints.topic.name, lang::to_string(lang::MessageType::joint_state));
  if (connection_.base)
    base_ = participant.advertise(connection_.base->name, lang::to_string(lang::MessageType::odometry));
  if (connection_.fix)
    fix_ = participant.advertise(connection_.fix->name,
                                 lang::to_string(lang::MessageType::pose_with_covariance_stamped));
  if (connection_.fix_frames)
    fix_ = participant.advertise("/tf", lang::to_string(lang::MessageType::tf_message));
  if (connection_.wrench)
    wrench_ =
        participant.advertise(connection_.wrench->name, lang::to_string(lang::MessageType::wrench_stamped));
  for (const lang::SignalSource& source : connection_.signals) {
    for (std::size_t i = 0; i < program_.signals.size(); ++i) {
      if (program_.signals[i].name != source.name) continue;
      signals_.push_back(
          {i, &source, participant.advertise(source.topic.name, lang::to_string(source.type))});
    }
  }
  if (connection_.clock)
    clock_ = participant.advertise(connection_.clock->name, lang::to_string(lang::MessageType::clock));
  if (connection_.clock) {
    const auto take = [this](const Payload& payload) {
      if (const auto message = decode<ClockMessage>(payload.bytes)) ticked_ = message->time();
    };
    participant.subscribe(ticked_topic(connection_), lang::to_string(lang::MessageType::clock), take);
  }
  subscribe_outputs(participant);
  const lang::CommandSink& sink = connection_.command;
  participant.subscribe(sink.topic.name, lang::to_string(sink.type), [this, &sink](const Payload& payload) {
    const double arrival = now();
    // The last zeros of a drive come from a writer of their own, in the same process.
    Sender process = payload.sender;
    std::fill(process.begin() + 12, process.end(), std::uint8_t{0});
    CommandMail& draft = mail_.draft();
    if (!commander_.admits(process, arrival)) return;
    if (!read_command(sink, order_, payload.bytes, draft.command)) return;
    draft.arrival = time();
    draft.has_come = true;
    mail_.put();
  });
}

void RobotSide::subscribe_outputs(Participant& participant) {
  for (const lang::OutputSink& sink : connection_.outputs) {
    const auto output = std::ranges::find(program_.outputs, sink.name, &lang::Output::name);
    if (output == program_.outputs.end()) continue;
    std::atomic<double>& value = outputs_[static_cast<std::size_t>(output - program_.outputs.begin())];
    const auto take = [&value, type = sink.type](const Payload& payload) {
      if (const auto read = read_output(type, payload.bytes)) value = *read;
    };
    participant.subscribe(sink.topic.name, lang::to_string(sink.type), take, Late::gets_last);
  }
}

void RobotSide::tell_time(double time) {
  if (!clock_) return;
  told_time_ = time;
  const Header header = header_at(time);
  encode(ClockMessage{header.seconds, header.nanoseconds}, bytes_);
  clock_->write(bytes_);
}

void RobotSide::leave() noexcept {
  joints_.reset(), base_.reset(), fix_.reset(), wrench_.reset(), clock_.reset();
  signals_.clear();
}

void RobotSide::tell_again() noexcept {
  last_fix_ = -1.0;
  for (SignalWriter& signal : signals_) signal.last_stamp = -1.0;
}

void RobotSide::publish(const runtime::Sensed& sensed, double stamp, double shift) {
  const solver::State& state = sensed.state;
  stamp += stamps_ahead_;
  shift += stamps_ahead_;
  if (base_) {
    odometry_.header = header_at(stamp, "odom");
    if (!holds_odometry_) {
      odometry_.pose = fields_of(state.base_pose);
      odometry_.twist = fields_of(state.base_twist);
    }
    encode(odometry_, bytes_);
    base_->write(bytes_);
  }
  if (fix_ && sensed.base_fix && sensed.base_fix->stamp != last_fix_) publish_fix(*sensed.base_fix, shift);
  for (SignalWriter& signal : signals_) {
    const runtime::SignalSample& sample = sensed.signals[signal.index];
    if (!sample.valid || sample.stamp == signal.last_stamp) continue;
    signal.last_stamp = sample.stamp;
    publish_signal(*signal.source, sample, shift, *signal.writer);
  }
  if (wrench_ && sensed.contact_wrench) {
    encode(
        WrenchStamped{header_at(stamp, program_.robot.drive.feels.frame), fields_of(*sensed.contact_wrench)},
        bytes_);
    wrench_->write(bytes_);
  }
  // Last: they are what the other side ticks by.
  joint_state_.header = header_at(stamp);
  joint_state_.positions.assign(state.q.begin(), state.q.end());
  joint_state_.velocities.assign(state.qd.begin(), state.qd.end());
  joint_state_.efforts.assign(sensed.effort.begin(), sensed.effort.end());
  encode(joint_state_, bytes_);
  joints_->write(bytes_);
}

void RobotSide::publish_fix(const runtime::MeasuredPose& fix, double shift) {
  last_fix_ = fix.stamp;
  const double stamp = fix.stamp + shift;
  if (const auto& frames = connection_.fix_frames) {
    encode(TransformsMessage{{{header_at(stamp, frames->parent), frames->child, fields_of(fix.pose)}}},
           bytes_);
  } else {
    encode(PoseWithCovarianceStamped{header_at(stamp, "map"), fields_of(fix.pose), {}}, bytes_);
  }
  fix_->write(bytes_);
}

void RobotSide::publish_signal(const lang::SignalSource& source, const runtime::SignalSample& sample,
                               double shift, Writer& writer) {
  const Header header = header_at(sample.stamp + shift);
  switch (source.type) {
    case lang::MessageType::boolean:
      encode(Bool{sample.boolean}, bytes_);
      break;
    case lang::MessageType::float64:
      encode(Float64{sample.number}, bytes_);
      break;
    case lang::MessageType::pose_stamped:
      encode(PoseStamped{header, fields_of(sample.pose)}, bytes_);
      break;
    case lang::MessageType::wrench_stamped:
      encode(WrenchStamped{header, fields_of(sample.wrench)}, bytes_);
      break;
    default: {
      const auto middle = static_cast<float>(0.5 * ((*source.nearest)[0] + (*source.nearest)[1]));
      LaserScan scan{header, {middle, middle, 0.01F, 0.0F, 0.0F, 0.0F, 100.0F}, {}, {}};
      scan.ranges = {static_cast<float>(sample.number)};
      encode(scan, bytes_);
    }
  }
  writer.write(bytes_);
}

const runtime::Command& RobotSide::command(double time) {
  mail_.take();
  const CommandMail& newest = mail_.value();
  const auto& timeout = connection_.command.timeout;
  const bool is_old = timeout && time - newest.arrival > *timeout;
  std::vector<double> outputs = std::move(given_.outputs);
  given_ = newest.has_come && !is_old ? newest.command : zeros_;
  given_.outputs = std::move(outputs);
  for (std::size_t i = 0; i < outputs_.size(); ++i) given_.outputs[i] = outputs_[i];
  return given_;
}

}  // namespace zwang::connect
