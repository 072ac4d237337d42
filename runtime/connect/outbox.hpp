/// The messages to the robot.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dds.hpp"
#include "message.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/command.hpp"

namespace zwang::connect {

class Outbox {
 public:
  /// The participant outlives it.
  Outbox(const lang::Connection& connection, const lang::Program& program, Participant& participant);

  /// One message; false where it could not be handed over within a millisecond.
  bool send(const runtime::Command& command, double stamp) noexcept;
  /// The program's outputs, in its order: each when it changes, and the first time. A late subscriber gets
  /// the last value.
  void send_outputs(std::span<const double> values) noexcept;
  /// The last word to the motors: zeros, five times within 50 ms. By a writer of its own, so that a thread
  /// that hangs in `send` cannot keep it back.
  void send_zeros(double stamp) noexcept;
  /// From now on outputs are those of this program, in its order.
  void write_for(const lang::Program& program);
  /// By a published clock: the time of a tick whose commands have gone out. A simulation waits for it.
  void tell_tick(double time) noexcept;
  int readers() const noexcept { return writer_->readers(); }

 private:
  bool send_by(Writer& writer, const runtime::Command& command, double stamp, Bytes& bytes) const;

  const lang::CommandSink& sink_;
  std::vector<int> order_;
  std::unique_ptr<Writer> writer_, last_writer_, ticked_;
  runtime::Command zeros_;
  struct OutputWriter {
    std::string name;  ///< of the output
    lang::MessageType type;
    std::unique_ptr<Writer> writer;
    std::optional<std::size_t> index;  ///< in Program::outputs; none: the program has no such output
    std::optional<double> last;        ///< that was sent
  };
  std::vector<OutputWriter> outputs_;
  Bytes bytes_;
};

/// Where `zwang drive` tells its ticks by a published clock.
std::string ticked_topic(const lang::Connection& connection);
/// Drops the command behind a payload of the sink's type into `command`; false for a bad one.
bool read_command(const lang::CommandSink& sink, const std::vector<int>& order,
                  std::span<const std::uint8_t> payload, runtime::Command& command);
/// The joints of `CommandSink::order` in the model.
std::vector<int> joints_in_order(const lang::CommandSink& sink, const solver::Model& model);

}  // namespace zwang::connect
