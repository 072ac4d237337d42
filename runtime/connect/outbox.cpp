#include "outbox.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace zwang::connect {

namespace {

using lang::CommandKind;

SixFields twist_of(const runtime::Command& command) {
  return {command.twist.x(), command.twist.y(), 0.0, 0.0, 0.0, command.twist.z()};
}

}  // namespace

std::vector<int> joints_in_order(const lang::CommandSink& sink, const solver::Model& model) {
  std::vector<int> order;
  for (const std::string& name : sink.order) order.push_back(model.find_joint(name).value());
  return order;
}

Outbox::Outbox(const lang::Connection& connection, const lang::Program& program, Participant& participant)
    : sink_(connection.command),
      order_(joints_in_order(connection.command, program.robot.model)),
      writer_(participant.advertise(sink_.topic.name, lang::to_string(sink_.type))),
      last_writer_(participant.advertise(sink_.topic.name, lang::to_string(sink_.type))),
      zeros_(program.robot.model.joint_count()) {
  for (const lang::OutputSink& sink : connection.outputs)
    outputs_.push_back({sink.name,
                        sink.type,
                        participant.advertise(sink.topic.name, lang::to_string(sink.type), Late::gets_last),
                        {},
                        {}});
  if (connection.clock)
    ticked_ = participant.advertise(ticked_topic(connection), lang::to_string(lang::MessageType::clock));
  write_for(program);
}

std::string ticked_topic(const lang::Connection& connection) {
  return connection.name + "/ticked";
}

void Outbox::tell_tick(double time) noexcept {
  if (!ticked_ || ticked_->readers() == 0) return;
  const Header header = header_at(time);
  encode(ClockMessage{header.seconds, header.nanoseconds}, bytes_);
  ticked_->write(bytes_);
}

void Outbox::write_for(const lang::Program& program) {
  for (OutputWriter& output : outputs_) {
    const auto found = std::ranges::find(program.outputs, output.name, &lang::Output::name);
    output.index.reset();
    if (found != program.outputs.end())
      output.index = static_cast<std::size_t>(found - program.outputs.begin());
  }
}

void Outbox::send_outputs(std::span<const double> values) noexcept {
  for (OutputWriter& output : outputs_) {
    if (!output.index || *output.index >= values.size() || output.last == values[*output.index]) continue;
    const double value = values[*output.index];
    output.type == lang::MessageType::float64 ? encode(Float64{value}, bytes_)
                                              : encode(Bool{value > 0.5}, bytes_);
    // A value that could not be handed over is sent with the next tick.
    if (output.writer->write(bytes_)) output.last = value;
  }
}

bool Outbox::send_by(Writer& writer, const runtime::Command& command, double stamp, Bytes& bytes) const {
  if (sink_.type == lang::MessageType::twist) {
    encode(Twist{twist_of(command)}, bytes);
  } else if (sink_.type == lang::MessageType::twist_stamped) {
    encode(TwistStamped{header_at(stamp, "base_link"), twist_of(command)}, bytes);
  } else {
    Float64MultiArray array;
    const Eigen::VectorXd& values = sink_.kind == CommandKind::effort ? command.torque : command.velocity;
    for (const int joint : order_) array.data.push_back(values(joint));
    encode(array, bytes);
  }
  return writer.write(bytes);
}

bool Outbox::send(const runtime::Command& command, double stamp) noexcept {
  return send_by(*writer_, command, stamp, bytes_);
}

void Outbox::send_zeros(double stamp) noexcept {
  Bytes bytes;
  for (int i = 0; i < 5; ++i) {
    send_by(*last_writer_, zeros_, stamp, bytes);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

bool read_command(const lang::CommandSink& sink, const std::vector<int>& order,
                  std::span<const std::uint8_t> payload, runtime::Command& command) {
  if (sink.kind == CommandKind::twist) {
    SixFields twist{};
    if (sink.type == lang::MessageType::twist) {
      const auto message = decode<Twist>(payload);
      if (!message) return false;
      twist = message->twist;
    } else {
      const auto message = decode<TwistStamped>(payload);
      if (!message) return false;
      twist = message->twist;
    }
    command.twist = {twist[0], twist[1], twist[5]};
    return command.twist.allFinite();
  }
  const auto message = decode<Float64MultiArray>(payload);
  if (!message || message->data.size() != order.size()) return false;
  Eigen::VectorXd& values = sink.kind == CommandKind::effort ? command.torque : command.velocity;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (!std::isfinite(message->data[i])) return false;
    values(order[i]) = message->data[i];
  }
  return true;
}

}  // namespace zwang::connect
