/// The contact that holds the base, as it was felt while encoders counted.
#pragma once

#include <Eigen/Core>

#include "guard/blind_motion.hpp"

namespace zwang::runtime {

/// A hit stops a live wheel through counted steps while the world's wrench w grows; dead encoders stop at
/// once, with w = 0. So the felt contact is assumed to persist. In the plane of w and of its mean over a
/// longer while the world pushes as hard as needed to hold the base, and never pulls:
///   yd' = a + C' (l w + k w_mean),   l, k >= 0.
/// The motion may also use `widening` of the force that is held: the plane of two measured wrenches is a
/// little smaller than the contact's. The contact that a look found persists in the same way, as long as the
/// base is near the place. No other measurement feels a wall that is hit within a step of the encoder. A
/// latched hook holds its origin in x and y, both ways. Does not allocate, lock, throw or print after
/// construction.
class FeltContact {
 public:
  explicit FeltContact(const BlindMotion& motion);

  /// The first rate, over `gap` [s], that p will be taken from.
  void set_out(double gap, double step) noexcept { rate_error_ = step / gap; }
  /// Learns the world's force since the last sign of life, `gap` [s] ago: p beyond the motors' `told`. `step`
  /// [m] of the encoders, at the rims.
  void learn(BlindMotion& motion, const Eigen::VectorXd& p, const Eigen::VectorXd& told, double gap,
             double step) noexcept;
  void forget() noexcept;
  /// The motors' command did not move the base until it was reversed. So a contact holds the base along p of
  /// that time.
  void find(BlindMotion& motion, const Eigen::VectorXd& p) noexcept;
  /// The base has left the place of what was found.
  void leave() noexcept { is_found_ = false; }

  /// A step of `dt` [s]: `y` goes on with what the contact leaves of the model's acceleration.
  void step(const BlindMotion& motion, double dt, Eigen::VectorXd& y) noexcept;

  /// A hook at this point of the base [m] holds from now on.
  void tie(double x, double y) noexcept;
  void untie() noexcept { is_tied_ = false; }
  bool is_tied() const noexcept { return is_tied_; }

  static constexpr double quick = 0.02;      ///< [s] of w's low pass
  static constexpr double slow = 0.2;        ///< [s] of its mean's: a hit and its bounce
  static constexpr double share = 0.5;       ///< of what the motors give: less is an error of the model
  static constexpr double smallest = 0.015;  ///< the same, of the weakest motor's limit
  static constexpr double widening = 0.1;    ///< of the force that is held

 private:
  double least_force(const BlindMotion& motion) const noexcept;
  /// The largest share of the encoders' steps in `w_` by now.
  double force_of_steps(const BlindMotion& motion, double gap, double step) noexcept;
  void hold(int freedoms, Eigen::VectorXd& y) noexcept;
  void hold_hook(const BlindMotion& motion, Eigen::VectorXd& y) noexcept;

  Eigen::VectorXd w_, w_mean_, w_told_, w_now_, w_found_;
  Eigen::VectorXd first_, second_, rest_, force_;  ///< on the free motions
  // Of the bound on what steps add to w, as accelerations of a rim.
  double weight_ = 0.0;       ///< [1/s] of the last rate in it
  double rate_error_ = 0.0;   ///< [m/s] of that rate at most
  double older_error_ = 0.0;  ///< [m/s^2] of those before it
  bool is_felt_ = false;
  bool is_found_ = false;
  bool is_tied_ = false;
  double hook_x_ = 0.0, hook_y_ = 0.0;
};

}  // namespace zwang::runtime
