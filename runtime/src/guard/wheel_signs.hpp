/// Detects an encoder of a wheel that counts the wrong way round.
#pragma once

#include <optional>
#include <vector>

#include "zwang/runtime/event.hpp"
#include "zwang/solver/solver.hpp"
#include "zwang/solver/state.hpp"
#include "zwang/solver/wheel_odometry.hpp"

namespace zwang::runtime {

/// The ground allows some of the measured velocities and takes slip away from the others. Slip may vanish if
/// the rate of one wheel has the other sign, and stay so while the rates change. Then it is not slip: that
/// wheel is measured the wrong way round. The check needs more measured velocities, from the wheels or a
/// measured base, than the ground leaves free. It need not say which wheel it is. When a base with four
/// mecanum wheels goes straight ahead, turning any of them explains the slip. An encoder does not reverse
/// during the motion. So a wheel is never reported if it has agreed with the others while they rolled, and
/// would not have with the other sign. On ice, front wheels that spin and rear wheels that stand look for a
/// while as if one were reversed. Does not allocate, lock, throw or print after construction.
class WheelSigns {
 public:
  explicit WheelSigns(const solver::Model& model);

  /// While wheels do not slip; as `look`.
  void roll(solver::Solver& solver, const solver::State& measured, const solver::State& allowed,
            bool is_reckoned, double time) noexcept;
  /// While wheels seem to slip: `measured` and `allowed` are the sample before and after `solver` projected
  /// it. `is_reckoned`: the base's twist comes from the wheels. The event has the rate of the wheel.
  std::optional<Event> look(solver::Solver& solver, const solver::State& measured,
                            const solver::State& allowed, bool is_reckoned, double time) noexcept;

  static constexpr double look_every = 0.005;  ///< [s]
  static constexpr double window = 0.05;       ///< [s]
  static constexpr int windows = 3;            ///< in a row
  static constexpr double left = 0.04;         ///< of the squared slip: a fifth of its size
  static constexpr double seen = 0.02;         ///< [m/s] of slip that only the other sign would have made
  static constexpr int agreements = 20;        ///< in a row that tell that the sign is right

 private:
  struct Wheel {
    int joint = 0;
    double radius = 0.0;
    double square_slip = 0.0;  ///< [m^2/s^2] with its rate turned, a sum over the looks of the window
    int explains = 0;          ///< windows in a row
    int agrees = 0;            ///< looks at which its other sign would have slipped, and not this one
  };
  double square_slip(const solver::State& measured, const solver::State& allowed) const noexcept;
  std::optional<double> square_slip_turned(solver::Solver& solver, const Wheel& wheel,
                                           const solver::State& measured, bool is_reckoned) noexcept;
  void begin_window(double time) noexcept;

  solver::WheelOdometry odometry_;
  solver::State turned_;
  solver::State allowed_;
  std::vector<Wheel> wheels_;
  double square_slip_ = 0.0;  ///< [m^2/s^2] as measured, a sum over the looks of the window
  double began_ = 0.0;        ///< [s] the window
  double looked_ = 0.0;       ///< [s] last
  bool slips_ = false;
  std::size_t next_ = 0;  ///< wheel to be asked while none slips
};

}  // namespace zwang::runtime
