/// Tells others where the base is: the odometry and the transform that the connection's `publish` asks for.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "dds.hpp"
#include "frozen_base.hpp"
#include "mailbox.hpp"
#include "message.hpp"

namespace zwang::connect {

class BaseTeller {
 public:
  /// `base_frame`: where no transform names one. The participant outlives it.
  BaseTeller(const lang::BasePublication& publication, const std::string& base_frame,
             Participant& participant);
  ~BaseTeller();
  BaseTeller(const BaseTeller&) = delete;
  BaseTeller& operator=(const BaseTeller&) = delete;

  /// Of the control thread: neither waits nor allocates. `stamp` [s]
  void note(double stamp, const solver::State& state) noexcept;

 private:
  void tell(const BaseSample& base);
  void tell_each_period();

  double period_;  ///< [s]
  Odometry odometry_;
  TransformStamped transform_;
  std::unique_ptr<Writer> odometry_writer_, transform_writer_;
  Mailbox<BaseSample> mail_;
  Bytes bytes_;
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

}  // namespace zwang::connect
