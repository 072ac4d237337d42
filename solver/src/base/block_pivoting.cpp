// QuadraticProgram without equations: block principal pivoting (Kostreva 1978; Judice and Pires 1994).
//
//   solve for the free variables, the others at their bounds;  who is beyond a bound parks there, who is
//   parked and wants away joins;  all at once, until nobody moves
//
// Mostly two or three rounds, where an active set takes a step for every variable. Rounds that do not lower
// the number of those that move are allowed a few times in a row; then only the last one moves (Murty 1974),
// which ends for sure where H is definite. Variables that add no curvature to the free ones stay where they
// are; if one of them wants away there is more than one way, and the active set decides.
#include <algorithm>
#include <cmath>

#include "base/quadratic_program.hpp"
#include "pairs.hpp"

namespace zwang::solver {

namespace {
constexpr int patience = 3;  // rounds in a row that may not lower the number of those that move
}

/// H = V'V + R, both triangles.
void QuadraticProgram::form_hessian() noexcept {
  for (int k = 0; k < variables_; ++k) {
    for (int l = 0; l < k; ++l) hessian_(k, l) = hessian_(l, k) = dot(curvature_rows_, V(k), V(l));
    hessian_(k, k) = dot(curvature_rows_, V(k), V(k)) + R_(k);
  }
}

/// reduced_ = H z - g, and the size of what is rounding in it.
void QuadraticProgram::compute_gradient() noexcept {
  double scale = largest_g_;
  for (int k = 0; k < variables_; ++k) {
    const double pull = dot(variables_, &hessian_(k, 0), z_.data());
    scale = std::max(scale, std::abs(pull));
    reduced_(k) = pull - g_(k);
  }
  tolerance_ = relative_gradient_tolerance * scale;
}

/// Cholesky's factor of the free variables' part of H, column by column: what a column leaves of the others
/// is taken off at once. inverse_root_ is 0 for a variable without curvature of its own, which stays where it
/// is.
void QuadraticProgram::factorise_free() noexcept {
  const auto n = static_cast<int>(superbasics_.size());
  for (int s = 0; s < n; ++s) {
    const double* const line = &hessian_(superbasics_[index(s)], 0);
    for (int t = 0; t <= s; ++t) factor_(s, t) = line[superbasics_[index(t)]];
  }
  const Eigen::Index stride = factor_.outerStride();
  double* const w = work_.data();
  for (int c = 0; c < n; ++c) {
    const int variable = superbasics_[index(c)];
    const double pivot = factor_(c, c);
    const bool is_curved = pivot > ample_curvature * hessian_(variable, variable);
    const double inverse = is_curved ? 1.0 / std::sqrt(pivot) : 0.0;
    inverse_root_(c) = inverse;
    for (int s = c + 1; s < n; ++s) factor_(s, c) = w[s] = inverse * factor_(s, c);
    add_square(c + 1, n, -1.0, w, factor_.data(), stride);
  }
}

/// One Newton step of the free variables: z -= H_FF^-1 reduced.
void QuadraticProgram::step_free() noexcept {
  const auto n = static_cast<int>(superbasics_.size());
  double* const x = step_.data();
  for (int s = 0; s < n; ++s) {
    double rest = -reduced_(superbasics_[index(s)]);
    const double* const line = &factor_(s, 0);
    for (int t = 0; t < s; ++t) rest -= line[t] * x[t];
    x[s] = rest * inverse_root_(s);
  }
  for (int s = n - 1; s >= 0; --s) {
    const double value = x[s] * inverse_root_(s);
    add_multiple(s, -value, &factor_(s, 0), x);
    z_(superbasics_[index(s)]) += value;
  }
}

/// A free variable beyond a bound, or a parked one that wants away from its own.
bool QuadraticProgram::is_out_of_place(int k) const noexcept {
  if (place_[index(k)] == Place::superbasic) return z_(k) < lo_(k) || z_(k) > hi_(k);
  if (std::abs(reduced_(k)) <= tolerance_) return false;
  return reduced_(k) < 0.0 ? z_(k) < hi_(k) : z_(k) > lo_(k);
}

/// True when it found the solution; else z is where it was.
bool QuadraticProgram::pivot_blocks(int max_rounds, int& iterations) noexcept {
  std::copy_n(z_.data(), variables_, direction_.data());
  form_hessian();
  superbasics_.clear();
  for (int k = 0; k < variables_; ++k) {
    const bool is_inside = z_(k) > lo_(k) && z_(k) < hi_(k);
    place_[index(k)] = is_inside ? Place::superbasic : Place::parked;
    if (is_inside) superbasics_.push_back(k);
  }
  compute_gradient();
  int fewest = variables_ + 1;
  int tries = patience;
  for (int round = 0; round < max_rounds; ++round) {
    ++iterations;
    if (!solve_free()) break;
    rows_.clear();  // those that are out of place
    for (int k = 0; k < variables_; ++k) {
      if (is_out_of_place(k)) rows_.push_back(k);
    }
    if (rows_.empty()) return true;
    const auto moving = static_cast<int>(rows_.size());
    if (moving < fewest) {
      fewest = moving;
      tries = patience;
    } else if (--tries < 0) {
      rows_.front() = rows_.back();
      rows_.resize(1);
    }
    change_places();
  }
  std::copy_n(direction_.data(), variables_, z_.data());
  return false;
}

/// To the minimum over the free variables. Those without curvature of their own park where they are; false
/// when one of them wants away.
bool QuadraticProgram::solve_free() noexcept {
  factorise_free();
  for (int refinement = 0; refinement <= max_refinements; ++refinement) {
    step_free();
    compute_gradient();
    if (slope_of_curved() <= slope_tolerance * tolerance_) break;
  }
  int curved = 0;
  for (int s = 0; s < static_cast<int>(superbasics_.size()); ++s) {
    const int k = superbasics_[index(s)];
    superbasics_[index(curved)] = k;
    if (inverse_root_(s) > 0.0) {
      ++curved;
      continue;
    }
    place_[index(k)] = Place::parked;
    if (is_out_of_place(k)) return false;
  }
  superbasics_.resize(index(curved));
  return true;
}

/// Of the rows_. Who wants away most joins first: of two limits along one axis the nearer one pushes.
void QuadraticProgram::change_places() noexcept {
  std::sort(rows_.begin(), rows_.end(), [this](int k, int l) {
    const double one = std::abs(reduced_(k)), other = std::abs(reduced_(l));
    return one > other || (one == other && k < l);
  });
  const auto leaves = [this](int k) { return std::find(rows_.begin(), rows_.end(), k) != rows_.end(); };
  superbasics_.erase(std::remove_if(superbasics_.begin(), superbasics_.end(), leaves), superbasics_.end());
  for (const int k : rows_) {
    if (place_[index(k)] == Place::parked) {
      place_[index(k)] = Place::superbasic;
      superbasics_.push_back(k);
    } else {
      place_[index(k)] = Place::parked;
      z_(k) = std::clamp(z_(k), lo_(k), hi_(k));
    }
  }
  compute_gradient();
}

double QuadraticProgram::slope_of_curved() const noexcept {
  double slope = 0.0;
  for (int s = 0; s < static_cast<int>(superbasics_.size()); ++s) {
    if (inverse_root_(s) > 0.0) slope = std::max(slope, std::abs(reduced_(superbasics_[index(s)])));
  }
  return slope;
}

}  // namespace zwang::solver
