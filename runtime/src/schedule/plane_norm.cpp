#include "schedule/plane_norm.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "zwang/solver/base_analysis.hpp"

namespace zwang::runtime {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double side_angle = std::numbers::pi / PlaneNorm::most_sides;
// A point whose mass sideways is more than that often its mass ahead counts as one that rolls: 8 directions
// leave less than half of f ahead of it.
constexpr double most_ratio = 10.0;

Vector2d direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// 1 / the effective mass along each direction: n' W n. [1/kg]
Matrix2d mobility_of(const solver::Model& model, const solver::AttachedFrame& move,
                     const solver::AttachedFrame& in) {
  const solver::State state(model);
  const auto along = [&](double angle) {
    solver::AxisConstraint c;
    c.move = move;
    c.in = in;
    c.measure = solver::Measure::direction;
    const Vector2d n = direction(angle);
    c.coefficients = {n.x(), n.y(), 0.0, 0.0, 0.0, 0.0};
    const solver::AxisAnalysis axis = solver::analyse_axis(model, state, c);
    return axis.reachable && axis.effective_mass > 0.0 ? 1.0 / axis.effective_mass : 0.0;
  };
  const double x = along(0.0), y = along(0.5 * std::numbers::pi), between = along(0.25 * std::numbers::pi);
  const double mixed = between - 0.5 * (x + y);
  return Matrix2d{{x, mixed}, {mixed, y}};
}

/// The largest force that a wall feels, at any normal between those of sides 0 and 1. The push P is one that
/// both sides just allow:
///   f(n) = n'W P / n'W n,   f(n_0) = f(n_1) = 1
double most_between(const Matrix2d& W, double first) {
  const Vector2d n0 = direction(first), n1 = direction(first + side_angle);
  const Matrix2d A = (Matrix2d() << n0.transpose() * W, n1.transpose() * W).finished();
  const Vector2d P = A.inverse() * Vector2d(n0.dot(W * n0), n1.dot(W * n1));
  constexpr int steps = 64;
  double most = 1.0;
  for (int i = 0; i <= steps; ++i) {
    const Vector2d n = direction(first + side_angle * i / steps);
    most = std::max(most, n.dot(W * P) / n.dot(W * n));
  }
  return most;
}

}  // namespace

double mass_factor_of(double ratio) noexcept {
  const Matrix2d W = Eigen::Vector2d(1.0, 1.0 / ratio).asDiagonal();
  constexpr int orientations = 64;
  double most = 1.0;
  for (int i = 0; i < orientations; ++i)
    most = std::max(most, most_between(W, 2.0 * std::numbers::pi * i / orientations));
  return std::max(1.0, most * PlaneNorm::apothem);
}

bool limits_a_plane(const lang::AxisStatements& axis) noexcept {
  return axis.is_planar && (axis.acceleration || axis.force);
}

std::string PlaneNorm::name(int i) const {
  if (!rolls) return "side" + std::to_string(i + 1);
  return i == 0 ? "ahead" : "turn";
}

PlaneNorm plane_norm_of(const solver::Model& model, const solver::AttachedFrame& move,
                        const solver::AttachedFrame& in) {
  PlaneNorm norm;
  if (model.has_fixed_base()) return norm;
  Eigen::SelfAdjointEigenSolver<Matrix2d> W;
  W.computeDirect(mobility_of(model, move, in));
  const double least = W.eigenvalues()(0), most = W.eigenvalues()(1);
  if (!(most > 0.0)) return norm;
  const bool is_carried = in.body >= 0 && in.body == move.body;
  norm.rolls = is_carried && least * most_ratio < most;
  const Vector2d ahead = W.eigenvectors().col(1);
  norm.heading = std::atan2(ahead.y(), ahead.x());
  if (!norm.rolls)
    norm.mass_factor = mass_factor_of(std::min(most_ratio, most / std::max(least, 1e-12 * most)));
  return norm;
}

solver::AxisConstraint PlaneNorm::constraint(int i, const solver::AttachedFrame& move,
                                             const solver::AttachedFrame& in) const noexcept {
  solver::AxisConstraint c;
  c.move = move;
  c.in = in;
  c.measure = !rolls ? solver::Measure::side : i == 0 ? solver::Measure::direction : solver::Measure::turn;
  const double angle = rolls ? heading : side_angle * i;
  c.coefficients = {std::cos(angle), std::sin(angle), 0.0, 0.0, 0.0, 0.0};
  return c;
}

solver::Range ahead_of(double most, double across) noexcept {
  const double left = std::sqrt(std::max(0.0, most * most - across * across));
  return {-std::max(0.5 * most, left), left};
}

}  // namespace zwang::runtime
