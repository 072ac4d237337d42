/// The plant's true values during a run: forces at objects, and which of them are hits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::cli {

/// The plant's true values at one object.
struct ObjectReport {
  std::string name;
  std::optional<double> touched;       ///< [s]
  std::optional<double> yaw_at_touch;  ///< [rad]
  double steady_force = 0.0;           ///< [N] mean of the last 0.5 s in which a task was active
  std::string steady_in;               ///< that task
  double peak_force = 0.0;             ///< [N]
  double peak_at = 0.0;                ///< [s]
  bool came = false;                   ///< the object was faster than the base when they met for that peak
  std::string peak_in;                 ///< the task that was active then
  double pushed_away = 0.0;  ///< [m] from where it stood when the base touched it; of objects with a mass
  std::optional<double> allowed;  ///< [N] what the rows allowed then, the way that it pressed; none: no bound
  std::optional<double> latched;  ///< [s] when the hook caught in its dock
  double pull = 0.0;              ///< [N] of the hook, outwards, when the last task ended

  bool is_hit() const;
};

/// Hands that pressed on the robot.
struct HandReport {
  std::optional<double> began;  ///< [s]
  double most = 0.0;            ///< [N]
};

/// A force driver that was in force when the last task ended.
struct AskedForce {
  std::string row;
  double force = 0.0;  ///< [N] or [N m]
  std::string unit;
};

std::vector<AskedForce> asked_forces(const runtime::Scheduler& scheduler);

/// Watches the plant's truth from tick to tick.
class TruthWatch {
 public:
  TruthWatch(const runtime::Truth& truth, const lang::Program& program, double period);
  /// `in_task`: a task is active, not the brake behind it.
  void look(const runtime::Truth& truth, const runtime::Scheduler& scheduler, bool in_task);
  std::vector<ObjectReport> objects(const runtime::Truth& truth, const runtime::Scheduler& scheduler) const;
  const HandReport& hand() const { return hand_; }

 private:
  struct Watched {
    std::vector<double> last_forces;  ///< a ring
    std::optional<double> yaw_at_touch;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< [m] at the last look
    std::optional<Eigen::Vector2d> place_at_touch;    ///< [m] of an object that a push moves
    bool can_be_pushed = false, touches = false, came = false, peak_came = false;
    double pull = 0.0;
    double peak = 0.0, peak_at = 0.0;
    int peak_in = -1;
    std::optional<double> allowed;
  };
  void meet(Watched& w, const runtime::ObjectTruth& object, const runtime::Truth& truth) const;

  std::vector<Watched> watched_;
  HandReport hand_;
  double period_;  ///< [s]
  std::size_t window_;
  std::size_t looks_ = 0;
  int last_task_ = -1;
};

}  // namespace zwang::cli
