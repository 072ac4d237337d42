#include "base/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::solver {

namespace {
constexpr double least_pivot = 1e-11;  // of a basic variable's rate, relative to the largest
constexpr double rounding = 1e-13;     // of a sum, relative to the sum of its terms' sizes
constexpr double infinite_step = std::numeric_limits<double>::infinity();
}  // namespace

QuadraticProgram::QuadraticProgram(int n, int d, int m)
    : V_(RowMajorMatrix::Zero(n, d)),
      E_(RowMajorMatrix::Zero(n, m)),
      R_(Eigen::VectorXd::Zero(n)),
      g_(Eigen::VectorXd::Zero(n)),
      lo_(Eigen::VectorXd::Zero(n)),
      hi_(Eigen::VectorXd::Zero(n)),
      z_(Eigen::VectorXd::Zero(n)),
      gradient_(Eigen::VectorXd::Zero(n)),
      reduced_(Eigen::VectorXd::Zero(n)),
      direction_(Eigen::VectorXd::Zero(n)),
      multipliers_(Eigen::VectorXd::Zero(m)),
      work_(Eigen::VectorXd::Zero(std::max(n, d))),
      step_(Eigen::VectorXd::Zero(n)),
      eliminated_(RowMajorMatrix::Zero(m, std::max(n, 2 * m))),
      inverse_basis_(RowMajorMatrix::Zero(m, m)),
      follow_(RowMajorMatrix::Zero(n, m)),
      reduced_V_(RowMajorMatrix::Zero(n, d)),
      hessian_(RowMajorMatrix::Zero(n, n)),
      factor_(RowMajorMatrix::Zero(n, n)),
      curvature_(Eigen::VectorXd::Zero(n)),
      inverse_D_(Eigen::VectorXd::Zero(n)),
      image_(Eigen::VectorXd::Zero(d)),
      place_(index(n)),
      stuck_(index(n)) {
  basics_.reserve(index(std::max(n, m)));
  superbasics_.reserve(index(std::max(n, m)));
  rows_.reserve(index(std::max(n, m)));
  extents_.resize(index(n));
}

void QuadraticProgram::resize(int variables, int curvature_rows, int equality_rows) noexcept {
  variables_ = variables;
  curvature_rows_ = curvature_rows;
  equality_rows_ = equality_rows;
  if (equality_rows == 0) return;
  for (int k = 0; k < variables; ++k) {
    extents_[index(k)] = 0;
    set_zero(curvature_rows, &V_(k, 0));
    set_zero(equality_rows, E(k));
    R_(k) = g_(k) = z_(k) = 0.0;
  }
}

void QuadraticProgram::set_V(int variable, int count, double scale, const double* x) noexcept {
  extents_[index(variable)] = count;
  scaled_copy(count, scale, x, &V_(variable, 0));
  set_zero(curvature_rows_ - count, &V_(variable, 0) + count);
}

bool QuadraticProgram::solve(int max_iterations, int& iterations) noexcept {
  largest_g_ = 0.0;
  for (int k = 0; k < variables_; ++k) largest_g_ = std::max(largest_g_, std::abs(g_(k)));
  constexpr int rounds = 20;
  if (equality_rows_ == 0 && pivot_blocks(std::min(max_iterations, rounds), iterations)) return true;
  choose_basis();
  if (!factorise_basis()) return false;
  choose_superbasics();
  bool at_minimum = superbasics_.empty();
  int refinements = 0;
  int idle = 0;  // steps of length zero in a row: then take the first way down, so that no cycle can form
  for (int i = 0; i < max_iterations; ++i) {
    compute_reduced_gradient();
    // Rounding, or a curvature near nothing, can leave a slope: step again before pricing.
    if (at_minimum && slope_of_superbasics() > slope_tolerance * tolerance_ &&
        refinements < max_refinements) {
      at_minimum = false;
      ++refinements;
    }
    if (at_minimum) {
      refinements = 0;
      const int entering = price(idle > variables_);
      if (entering < 0) return true;
      place_[index(entering)] = Place::superbasic;
      superbasics_.push_back(entering);
      const Curvature curvature = add_superbasic(static_cast<int>(superbasics_.size()) - 1);
      curved_ = curvature.left > curvature_tolerance * curvature.own;
    }
    ++iterations;
    curved_ ? newton_step() : flat_line();
    if (!curved_ && !goes_down()) {
      park(superbasics_.back());
      at_minimum = superbasics_.empty();
      continue;
    }
    double length = curved_ ? 1.0 : infinite_step;
    const int blocking = longest_step(length);
    if (length ==
        infinite_step) {  // no bound on the way: the caller gave an infinite one to a row that cannot hold
      stuck_[index(superbasics_.back())] = 1;
      park(superbasics_.back());
      continue;
    }
    idle = length > 0.0 ? 0 : idle + 1;
    if (!take_step(length, blocking)) return false;
    at_minimum = blocking < 0 || superbasics_.empty();
  }
  return false;
}

/// Along the direction. The variable that blocks it stands at its bound then, and is free no more. False when
/// the basis lost its rank.
bool QuadraticProgram::take_step(double length, int blocking) noexcept {
  for (const int k : basics_) z_(k) += length * direction_(k);
  for (const int k : superbasics_) z_(k) += length * direction_(k);
  if (blocking >= 0) {
    z_(blocking) = direction_(blocking) > 0.0 ? hi_(blocking) : lo_(blocking);
    if (place_[index(blocking)] == Place::basic) {
      replace_basic(blocking);
      if (!factorise_basis()) return false;
      reduce();
    } else {
      park(blocking);
    }
  }
  for (const int k : basics_) z_(k) = std::clamp(z_(k), lo_(k), hi_(k));
  for (const int k : superbasics_) z_(k) = std::clamp(z_(k), lo_(k), hi_(k));
  return true;
}

/// gradient = V'(V z) + R z - g;  y from E_B' y = gradient_B;  reduced = gradient - E'y.
void QuadraticProgram::compute_reduced_gradient() noexcept {
  double* const p = work_.data();
  std::fill_n(p, curvature_rows_, 0.0);
  for (int k = 0; k < variables_; ++k) {
    if (z_(k) != 0.0) add_multiple(curvature_rows_, z_(k), V(k), p);
  }
  double scale = largest_g_;
  for (int k = 0; k < variables_; ++k) {
    const double pull = dot(curvature_rows_, V(k), p) + R_(k) * z_(k);
    scale = std::max(scale, std::abs(pull));
    gradient_(k) = pull - g_(k);
  }
  tolerance_ = relative_gradient_tolerance * scale;
  if (rank_ == 0) {
    std::copy_n(gradient_.data(), variables_, reduced_.data());
    return;
  }
  std::fill_n(multipliers_.data(), rank_, 0.0);
  for (int k = 0; k < rank_; ++k) {
    add_multiple(rank_, gradient_(basics_[index(k)]), &inverse_basis_(k, 0), multipliers_.data());
  }
  for (int k = 0; k < variables_; ++k) {
    double value = gradient_(k);
    double size = std::abs(value);
    for (int i = 0; i < rank_; ++i) {
      const double term = E_(k, rows_[index(i)]) * multipliers_(i);
      value -= term;
      size += std::abs(term);
    }
    // Where the basis is nearly singular, rounding can be more than the tolerance.
    const bool is_nothing = place_[index(k)] == Place::basic || std::abs(value) <= rounding * size;
    reduced_(k) = is_nothing ? 0.0 : value;
  }
}

double QuadraticProgram::slope_of_superbasics() const noexcept {
  double slope = 0.0;
  for (const int k : superbasics_) slope = std::max(slope, std::abs(reduced_(k)));
  return slope;
}

int QuadraticProgram::price(bool first_that_helps) const noexcept {
  int entering = -1;
  double best = tolerance_;
  for (int k = 0; k < variables_; ++k) {
    if (place_[index(k)] != Place::parked || stuck_[index(k)] != 0) continue;
    const bool down = reduced_(k) < 0.0 ? z_(k) < hi_(k) : z_(k) > lo_(k);
    if (down && std::abs(reduced_(k)) > best) {
      entering = k;
      if (first_that_helps) return entering;
      best = std::abs(reduced_(k));
    }
  }
  return entering;
}

/// Row s of the superbasic variables, and of the factor of the reduced Hessian:
///   follow = E_B^-1 E_s;  reduced V = V_s - V_B follow
///   reduced H = (reduced V)'(reduced V) + R_s + follow' R_B follow
QuadraticProgram::Curvature QuadraticProgram::add_superbasic(int s) noexcept {
  const int variable = superbasics_[index(s)];
  double* const follow = &follow_(s, 0);
  double* const column = &reduced_V_(s, 0);
  std::copy_n(V(variable), curvature_rows_, column);
  for (int i = 0; i < rank_; ++i) {
    double value = 0.0;
    double size = 0.0;
    for (int k = 0; k < rank_; ++k) {
      const double term = inverse_basis_(i, k) * E_(variable, rows_[index(k)]);
      value += term;
      size += std::abs(term);
    }
    if (std::abs(value) <= rounding * size) value = 0.0;
    follow[i] = value;
    add_multiple(curvature_rows_, -value, V(basics_[index(i)]), column);
  }
  for (int t = 0; t <= s; ++t) {
    double h = dot(curvature_rows_, column, &reduced_V_(t, 0));
    for (int i = 0; i < rank_; ++i) h += R_(basics_[index(i)]) * follow[i] * follow_(t, i);
    hessian_(s, t) = h;
  }
  hessian_(s, s) += R_(variable);
  return factorise_row(s);
}

/// Row s of the reduced Hessian's factor.
QuadraticProgram::Curvature QuadraticProgram::factorise_row(int s) noexcept {
  std::copy_n(&hessian_(s, 0), s + 1, &factor_(s, 0));
  const double diagonal = hessian_(s, s);
  const double pivot = eliminate_row(factor_, s);
  const double least = curvature_tolerance * std::max(diagonal, std::numeric_limits<double>::min());
  factor_(s, s) = std::sqrt(std::max(pivot, least));
  return {diagonal, pivot};
}

/// All rows anew, over another basis.
void QuadraticProgram::reduce() noexcept {
  for (int s = 0; s < static_cast<int>(superbasics_.size()); ++s) add_superbasic(s);
  curved_ = true;
}

/// To the minimum over the superbasic variables.
void QuadraticProgram::newton_step() noexcept {
  const int n = static_cast<int>(superbasics_.size());
  for (int s = 0; s < n; ++s) step_(s) = -reduced_(superbasics_[index(s)]);
  solve_lower(factor_, n, step_.data());
  solve_upper(factor_, n, step_.data());
  set_direction();
}

/// The newest superbasic variable adds no curvature: the line on which it moves and the others keep their
/// minimum, G_11' x = -G_21' for a unit of it.
void QuadraticProgram::flat_line() noexcept {
  const int last = static_cast<int>(superbasics_.size()) - 1;
  step_(last) = reduced_(superbasics_[index(last)]) > 0.0 ? -1.0 : 1.0;
  for (int s = 0; s < last; ++s) step_(s) = -factor_(last, s) * step_(last);
  solve_upper(factor_, last, step_.data());
  set_direction();
}

void QuadraticProgram::set_direction() noexcept {
  const int n = static_cast<int>(superbasics_.size());
  for (const int k : basics_) direction_(k) = 0.0;
  for (int s = 0; s < n; ++s) {
    direction_(superbasics_[index(s)]) = step_(s);
    for (int i = 0; i < rank_; ++i) direction_(basics_[index(i)]) -= follow_(s, i) * step_(s);
  }
}

/// Turns a line without curvature the way that the objective falls; false when it is level.
bool QuadraticProgram::goes_down() noexcept {
  double slope = 0.0;
  for (const int k : superbasics_) slope += reduced_(k) * direction_(k);
  if (std::abs(slope) <= tolerance_) return false;
  if (slope > 0.0) {
    for (const int k : superbasics_) direction_(k) = -direction_(k);
    for (const int k : basics_) direction_(k) = -direction_(k);
  }
  return true;
}

/// The variable that meets its bound first within `length`, and how far the step may go; -1 when none does.
int QuadraticProgram::longest_step(double& length) const noexcept {
  double largest = 0.0;
  for (const int k : basics_) largest = std::max(largest, std::abs(direction_(k)));
  for (const int k : superbasics_) largest = std::max(largest, std::abs(direction_(k)));
  int blocking = -1;
  // A basic variable that hardly follows would leave a basis without rank if it made way.
  const auto consider = [&](int k, double least_rate) {
    const double rate = direction_(k);
    if (std::abs(rate) <= least_rate * largest) return;
    const double room = std::max(0.0, rate > 0.0 ? hi_(k) - z_(k) : z_(k) - lo_(k));
    const double reach = room / std::abs(rate);
    const bool earlier = reach < length;
    const bool firmer = blocking >= 0 && reach == length && std::abs(rate) > std::abs(direction_(blocking));
    if (earlier || firmer) {
      length = reach;
      blocking = k;
    }
  };
  for (const int k : basics_) consider(k, least_pivot);
  for (const int k : superbasics_) consider(k, 1e-14);
  return blocking;
}

/// A superbasic variable parks: without it the others have curvature as before. The rows of those that joined
/// after it move up, and their part of the factor is made anew.
void QuadraticProgram::park(int variable) noexcept {
  place_[index(variable)] = Place::parked;
  const auto place = std::find(superbasics_.begin(), superbasics_.end(), variable);
  const int gap = static_cast<int>(place - superbasics_.begin());
  superbasics_.erase(place);
  for (int s = gap; s < static_cast<int>(superbasics_.size()); ++s) {
    std::copy_n(&reduced_V_(s + 1, 0), curvature_rows_, &reduced_V_(s, 0));
    std::copy_n(&follow_(s + 1, 0), rank_, &follow_(s, 0));
    const double* const below = &hessian_(s + 1, 0);
    std::copy_n(below, gap, &hessian_(s, 0));
    std::copy_n(below + gap + 1, s + 1 - gap, &hessian_(s, gap));
    factorise_row(s);
  }
  curved_ = true;
}

}  // namespace zwang::solver
