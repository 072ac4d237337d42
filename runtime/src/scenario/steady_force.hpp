/// The force of a contact while the base keeps its momentum.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace zwang::runtime {

/// The mean force of half a second in touch without a break. The base has to be as fast at its end as at its
/// start. Then the base kept its momentum, whatever rattled in between, and the contact took all of the
/// motors' force. The remainder of m dv / T is 0.06 N with 57 kg.
class SteadyForce {
 public:
  /// `velocity`: planar twist of the base. `time` never goes back.
  void look(double force, bool in_touch, const Eigen::Vector3d& velocity, double time) noexcept;
  std::optional<double> now() const noexcept { return now_; }  ///< [N]

 private:
  static constexpr int parts = 5;
  static constexpr double length = 0.1;         // [s] of a part
  static constexpr double same_speed = 0.5e-3;  // [m/s]
  static constexpr double same_turn = 1e-3;     // [rad/s]

  struct Part {
    double mean = 0.0;                                   ///< [N]
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< at its beginning
  };
  void finish_part(const Eigen::Vector3d& velocity) noexcept;

  std::array<Part, parts> parts_{};  ///< the latest first
  int known_ = 0;
  double sum_ = 0.0, begin_ = 0.0;
  long count_ = 0;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  ///< at the beginning of the part under way
  std::optional<double> now_;
};

}  // namespace zwang::runtime
