/// The motion of the base that the wheels report.
#pragma once

#include <cstddef>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/frame.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// The twist of the base by its wheels, and their contradiction.
struct WheelTwist {
  MotionVector
      twist;     ///< planar, of the base, in base coordinates and at its origin; 0 along what no wheel tells
  int rank = 0;  ///< planar freedoms that the wheels tell of: 3 for most, 2 where all slide sideways
  double slip = 0.0;  ///< [m/s] root mean square of what the held directions contradict each other by
};

/// The planar twist (vx, vy, wz) with the smallest slip: the sum of squares along all held directions of all
/// wheels. Where the wheels leave the twist open, it is the one of least norm. u is a held direction at the
/// contact point P, and s the velocity that the joints alone give that point:
///   u . (v + w z x P) = -u . s,   a line of J V = r with V = (vx, vy, l w)
/// The length l gives the three columns of J one scale, and V = (J'J)^+ J'r.
class ZWANG_EXPORT WheelOdometry {
 public:
  explicit WheelOdometry(const Model& model);

  /// Reads q and qd of the state only, which is sized for the model. Does not allocate, lock, throw or print.
  WheelTwist twist(const State& state) noexcept;

 private:
  /// A held direction of a wheel, at rest in the body that the wheel turns on.
  struct Held {
    int carrier = 0;
    int joint = 0;  ///< the wheel's
    Vector3 centre, axis;
    double radius = 0.0;
    double rolling = 0.0, sideways = 0.0;  ///< the direction's parts
  };
  struct Line {
    Vector3 direction;             ///< (u_x, u_y, (z x P) . u), lengths in m
    Vector3 held;                  ///< u
    Vector3 carried;               ///< velocity of P, but for the wheel's turning, that the joints give it
    Vector3 rim;                   ///< velocity of P for each rad/s of the wheel
    double square_distance = 0.0;  ///< of P from the base's origin

    double slip_of_joints(double wheel_rate) const { return held.dot(carried + wheel_rate * rim); }
  };
  /// (J'J)^+ and what goes with it.
  struct Normal {
    Matrix3 pseudo_inverse = Matrix3::Zero();
    int rank = 0;
    double length = 1.0;  ///< l [m]
  };
  void find_lines(const State& state) noexcept;
  static Line line(const Held& held, const FrameMotion& carrier) noexcept;
  Normal normal() const noexcept;

  Model model_;
  std::vector<Held> held_;
  bool is_rigid_ = true;  ///< all wheels turn on the base itself: J never changes
  Normal rigid_normal_;
  std::vector<Line> lines_;  ///< of the held directions, at the last state if they move
};

}  // namespace zwang::solver
