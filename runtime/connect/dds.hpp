/// Topics of ROS 2 over DDS. Only dds.cpp knows Fast DDS.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "zwang/lang/connection.hpp"

namespace zwang::connect {

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

  /// `on_payload` is called on threads of DDS, for one topic one call at a time. It must not throw.
  void subscribe(const std::string& topic, lang::MessageType type,
                 std::function<void(std::span<const std::uint8_t>)> on_payload);
  std::unique_ptr<Writer> advertise(const std::string& topic, lang::MessageType type);
  /// No callback runs any more when this returns.
  void close() noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::connect
