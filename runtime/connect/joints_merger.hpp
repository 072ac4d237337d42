/// The state of all joints, from messages that hold a part of them each.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "message.hpp"
#include "sender.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::connect {

/// The last position and rate of each joint are kept.
class JointsMerger {
 public:
  /// A robot that `feels` by effort has to tell that of each wheel's motor, too.
  JointsMerger(const lang::JointsSource& source, const lang::Robot& robot)
      : model_(robot.model), with_efforts_(robot.drive.feels.by == lang::Feels::By::effort) {
    const solver::Model& model = robot.model;
    const int n = model.joint_count();
    for (int j = 0; j < n; ++j) index_[source.name_of(model.joint(j).name)] = j;
    is_told_.assign(static_cast<std::size_t>(n), false);
    has_effort_.assign(static_cast<std::size_t>(n), true);
    for (const solver::Wheel& wheel : model.wheels()) {
      if (with_efforts_) has_effort_[static_cast<std::size_t>(wheel.body - 1)] = false;
    }
    publishers_.resize(static_cast<std::size_t>(n));
    q_ = qd_ = effort_ = Eigen::VectorXd::Zero(n);
  }

  /// Whether it comes from the publisher that has told of these joints before.
  bool admits(const JointState& message, const Sender& sender, double arrival) {
    return std::all_of(message.names.begin(), message.names.end(), [&](const std::string& name) {
      const auto joint = index_.find(name);
      return joint == index_.end() ||
             publishers_[static_cast<std::size_t>(joint->second)].admits(sender, arrival);
    });
  }

  /// False: the message is no good, and nothing is taken.
  bool take(const JointState& message) {
    const std::size_t n = message.names.size();
    const bool fits = message.positions.size() == n && message.velocities.size() == n;
    if (!fits || !are_finite(message.positions) || !are_finite(message.velocities)) return false;
    const bool has_efforts = with_efforts_ && !message.efforts.empty();
    if (has_efforts && (message.efforts.size() != n || !are_finite(message.efforts))) return false;
    for (std::size_t i = 0; i < n; ++i) {
      const auto joint = index_.find(message.names[i]);
      if (joint == index_.end()) continue;
      is_told_[static_cast<std::size_t>(joint->second)] = true;
      q_(joint->second) = message.positions[i];
      qd_(joint->second) = message.velocities[i];
      if (!has_efforts) continue;
      effort_(joint->second) = message.efforts[i];
      has_effort_[static_cast<std::size_t>(joint->second)] = true;
    }
    return true;
  }
  bool is_whole() const {
    for (int j = 0; j < model_.joint_count(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      if (model_.joint(j).actuated && !(is_told_[at] && has_effort_[at])) return false;
    }
    return true;
  }
  const Eigen::VectorXd& q() const { return q_; }
  const Eigen::VectorXd& qd() const { return qd_; }
  const Eigen::VectorXd& effort() const { return effort_; }  ///< [N m]; zeros without efforts

 private:
  const solver::Model& model_;
  bool with_efforts_;
  std::map<std::string, int> index_;
  std::vector<bool> is_told_, has_effort_;
  std::vector<OnePublisher> publishers_;  // of each joint
  Eigen::VectorXd q_, qd_, effort_;
};

}  // namespace zwang::connect
