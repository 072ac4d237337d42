/// Algorithm 1 as a plain call: equality constraints in, torques and accelerations out. For users of the
/// solver alone.
///
/// Of all accelerations with A_N' Xdd = b_N it finds the one of least constraint (Gauss's Zwang). No bounds,
/// no levels, no motors: `Solver` has those.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/solver.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// One column of A_N and its entry of b_N: a . Xdd_body - a_reference . Xdd_reference = b.
struct AccelerationRow {
  int body = 0;
  ForceVector a;            ///< unit constraint force on the body, in its coordinates and about its origin
  int reference_body = -1;  ///< -1: the world
  ForceVector a_reference;  ///< in the reference body's coordinates
  double b = 0.0;           ///< [m/s^2] or [rad/s^2] of spatial acceleration
};

/// Sized for a model by its constructor, which throws std::invalid_argument on a capacity below 1. qdd,
/// tau_control and constraint_torque have one entry a joint; nu and residual have one entry a row.
struct ZWANG_EXPORT ConstrainedMotion {
  explicit ConstrainedMotion(const Model& model, int row_capacity = 64);

  Eigen::VectorXd qdd;                     ///< [rad/s^2] or [m/s^2]
  std::vector<MotionVector> acceleration;  ///< Xdd: spatial, of each body, in its coordinates
  Eigen::VectorXd nu;           ///< multipliers [N] or [N m]; the first `rows` count. +A nu acts on the body
  Eigen::VectorXd residual;     ///< a . Xdd - b by row [m/s^2] or [rad/s^2]
  Eigen::VectorXd tau_control;  ///< feed-forward plus J'A nu [N m] or [N]: with it (and `base_wrench` on a
                                ///< floating base) plain forward dynamics gives the same qdd
  ForceVector base_wrench;      ///< the part of J'A nu on a floating base, in base coordinates
  Eigen::VectorXd constraint_torque;  ///< line 23's S'A nu, A projected through the joints beyond: not a
                                      ///< torque to command
  int rank = 0;                       ///< of L, over all rows, the ground's included
};

/// Solves for one model. Throws std::invalid_argument from its constructors only.
class ZWANG_EXPORT PopovVereshchagin {
 public:
  struct Settings {
    int row_capacity = 64;  ///< above 0
    double damping =
        0.0;  ///< lambda: L + lambda^2 1 instead of L; 0: the rank is found and nu is the one of least norm
  };

  /// Throws std::invalid_argument on an invalid setting.
  explicit PopovVereshchagin(const Model& model) : PopovVereshchagin(model, Settings{}) {}
  PopovVereshchagin(const Model& model, const Settings& settings);
  ~PopovVereshchagin();
  PopovVereshchagin(PopovVereshchagin&&) noexcept;
  PopovVereshchagin& operator=(PopovVereshchagin&&) noexcept;

  /// With true accelerations: the model's gravity acts as a force. On a model with a ground its rows are held
  /// besides the given ones. Does not allocate, lock, throw or print. On any status but `ok` the result is
  /// untouched.
  [[nodiscard]] Status solve(const State& state, const std::vector<AccelerationRow>& rows,
                             ConstrainedMotion& result) noexcept;
  /// The textbook form on a fixed base: the base accelerates with Xdd_0 (minus gravity, for a base at rest),
  /// in base coordinates [rad/s^2, m/s^2]. The model's gravity is left out. So all accelerations, b included,
  /// are measured against free fall. On any other base the status is `invalid_input`.
  [[nodiscard]] Status solve(const State& state, const std::vector<AccelerationRow>& rows,
                             const MotionVector& base_acceleration, ConstrainedMotion& result) noexcept;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace zwang::solver
