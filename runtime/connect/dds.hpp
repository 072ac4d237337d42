/// Topics of ROS 2 over DDS. Only dds.cpp knows Fast DDS.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "sender.hpp"
#include "service.hpp"
#include "zwang/lang/connection.hpp"

namespace zwang::connect {

/// A message as it came.
struct Payload {
  std::span<const std::uint8_t> bytes;
  Sender sender{};
};

/// Puts messages on one topic. As long as its participant lives.
class Writer {
 public:
  virtual ~Writer() = default;
  /// Hands the payload to a thread that sends it; false where that would have to be waited for by more than a
  /// millisecond.
  virtual bool write(std::span<const std::uint8_t> payload) noexcept = 0;
  virtual int readers() const noexcept = 0;  ///< that have found this topic
};

class Participant {
 public:
  /// Throws std::runtime_error where DDS does not start.
  Participant(int domain, lang::Reach reach, const std::string& name);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// `on_payload` is called on threads of DDS, for one topic one call at a time. It must not throw. With
  /// `Reach::machine` it hears processes of this machine only.
  void subscribe(const std::string& topic, lang::MessageType type,
                 std::function<void(const Payload&)> on_payload);
  /// Messages that came from another machine, and were not taken.
  std::uint64_t foreign() const noexcept;
  std::unique_ptr<Writer> advertise(const std::string& topic, lang::MessageType type);
  /// Of a topic whose last message late subscribers get, too. `type`: as `std_msgs/String`.
  std::unique_ptr<Writer> advertise_last(const std::string& topic, const std::string& type);
  /// Answers a service of the type std_srvs/Trigger. `answer` is called on a thread of its own, one request
  /// at a time. It must not throw.
  void serve_trigger(const std::string& service, std::function<TriggerReply()> answer);
  /// No request is answered any more when this returns.
  void stop_serving() noexcept;
  /// No callback runs any more when this returns.
  void close() noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::connect
