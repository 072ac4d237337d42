/// Notices that a control loop no longer runs: a blocked thread cannot stop the robot by itself.
#pragma once

#include <functional>
#include <memory>

#include "zwang/export.hpp"

namespace zwang::runtime {

/// Give it to your own loop: feed it on every tick, and let `on_expiry` take the torque from the motors.
class ZWANG_EXPORT Watchdog {
 public:
  /// Waits from now on. `on_expiry` is called once, on the watchdog's own thread, when `feed` was not called
  /// for `limit` [s]; what it throws is swallowed. Throws std::invalid_argument on a limit that is not
  /// positive.
  Watchdog(double limit, std::function<void()> on_expiry);
  ~Watchdog();

  /// Too late expires it as well: a thread that slept through the limit need not outrun the watchdog's. Does
  /// not allocate, lock, throw or print.
  void feed() noexcept;
  /// Latched.
  bool expired() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace zwang::runtime
