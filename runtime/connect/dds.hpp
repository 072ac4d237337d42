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

/// The samples of a topic that a late subscriber gets.
enum class Late { gets_nothing, gets_last };

class Participant {
 public:
  /// Throws std::runtime_error where DDS does not start.
  Participant(const lang::Connection& connection, const std::string& name);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Of a topic and its type, as `std_msgs/String`. `on_payload` is called on threads of DDS, for one topic
  /// one call at a time. It must not throw. With `Reach::machine` it hears processes of this machine only.
  void subscribe(const std::string& topic, const std::string& type,
                 std::function<void(const Payload&)> on_payload, Late late = Late::gets_nothing);
  /// Messages that came from another machine, and were not taken.
  std::uint64_t foreign() const noexcept;
  std::unique_ptr<Writer> advertise(const std::string& topic, const std::string& type,
                                    Late late = Late::gets_nothing);
  /// Answers a service. `type`: as `std_srvs/srv/Trigger`. `handler` is called on a thread of the service's
  /// own, one request at a time.
  void serve(const std::string& service, const std::string& type, Handler handler);
  /// No request is answered any more when this returns.
  void stop_serving() noexcept;
  /// No callback runs any more when this returns.
  void close() noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::connect
