/// How far a measured base went while somebody looked.
#pragma once

#include <optional>

#include "frozen_base.hpp"

namespace zwang::connect {

/// The way counts from the first odometry: joints may come before it, and a base whose odometry has not come
/// stands nowhere.
class BaseWay {
 public:
  /// `base` as `Inbox::base` gives it: nullptr where no odometry has come.
  void look(const BaseSample* base) {
    if (base == nullptr) return;
    if (!first_) first_ = base->pose;
    last_ = base->pose;
  }
  /// [m] In the axes that the base had first: ahead, to its left, up. None: no odometry has come.
  std::optional<solver::Vector3> way() const {
    if (!first_) return std::nullopt;
    return first_->rotation.transpose() * (last_.position - first_->position);
  }

 private:
  std::optional<solver::Pose> first_;
  solver::Pose last_;
};

}  // namespace zwang::connect
