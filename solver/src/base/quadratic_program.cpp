#include "base/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::solver {

namespace {
constexpr double relative_gradient_tolerance = 1e-12;
constexpr double curvature_tolerance = 1e-12;  // of a reduced Hessian's pivot, relative to its diagonal
constexpr double rank_tolerance = 1e-9;        // of E's columns, which are of length 1
constexpr double slope_tolerance = 1e3;        // times the gradient tolerance
constexpr double least_pivot = 1e-11;          // of a basic variable's rate, relative to the largest
constexpr int max_refinements = 4;
constexpr double infinite_step = std::numeric_limits<double>::infinity();
}  // namespace

QuadraticProgram::QuadraticProgram(int n, int d, int m)
    : V_(Eigen::MatrixXd::Zero(d, n)),
      E_(Eigen::MatrixXd::Zero(m, n)),
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
      eliminated_(Eigen::MatrixXd::Zero(m, std::max(n, 2 * m))),
      inverse_basis_(Eigen::MatrixXd::Zero(m, m)),
      follow_(Eigen::MatrixXd::Zero(m, n)),
      reduced_V_(Eigen::MatrixXd::Zero(d, n)),
      cholesky_(Eigen::MatrixXd::Zero(n, n)),
      place_(index(n)),
      stuck_(index(n)) {
  basics_.reserve(index(std::max(n, m)));
  superbasics_.reserve(index(std::max(n, m)));
  rows_.reserve(index(m));
}

void QuadraticProgram::resize(int variables, int curvature_rows, int equality_rows) noexcept {
  variables_ = variables;
  curvature_rows_ = curvature_rows;
  equality_rows_ = equality_rows;
  V_.topLeftCorner(curvature_rows, variables).setZero();
  E_.topLeftCorner(equality_rows, variables).setZero();
  R_.head(variables).setZero();
  g_.head(variables).setZero();
  z_.head(variables).setZero();
}

bool QuadraticProgram::solve(int max_iterations, int& iterations) noexcept {
  choose_basis();
  superbasics_.clear();
  bool at_minimum = true;
  int refinements = 0;
  int idle = 0;  // steps of length zero in a row: then take the first way down, so that no cycle can form
  for (int i = 0; i < max_iterations; ++i) {
    if (!factorise_basis()) return false;
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
    }
    ++iterations;
    const bool curved = reduced_direction();
    if (!curved && !goes_down()) {
      park(superbasics_.back());
      at_minimum = superbasics_.empty();
      continue;
    }
    double length = curved ? 1.0 : infinite_step;
    const int blocking = longest_step(length);
    if (length ==
        infinite_step) {  // no bound on the way: the caller gave an infinite one to a row that cannot hold
      stuck_[index(superbasics_.back())] = 1;
      park(superbasics_.back());
      continue;
    }
    for (const int k : basics_) z_(k) += length * direction_(k);
    for (const int k : superbasics_) z_(k) += length * direction_(k);
    idle = length > 0.0 ? 0 : idle + 1;
    if (blocking >= 0) {
      z_(blocking) = direction_(blocking) > 0.0 ? hi_(blocking) : lo_(blocking);
      if (place_[index(blocking)] == Place::basic) replace_basic(blocking);
      park(blocking);
    }
    for (const int k : basics_) z_(k) = std::clamp(z_(k), lo_(k), hi_(k));
    for (const int k : superbasics_) z_(k) = std::clamp(z_(k), lo_(k), hi_(k));
    at_minimum = blocking < 0 || superbasics_.empty();
  }
  return false;
}

/// Gaussian elimination with complete pivoting picks the independent rows of E and as many columns, those
/// first that have room to both sides.
void QuadraticProgram::choose_basis() noexcept {
  std::fill_n(place_.begin(), variables_, Place::parked);
  std::fill_n(stuck_.begin(), variables_, char{0});
  basics_.clear();
  rows_.clear();
  rank_ = 0;
  if (equality_rows_ == 0) return;
  auto M = eliminated_.topLeftCorner(equality_rows_, variables_);
  M = E_.topLeftCorner(equality_rows_, variables_);
  for (int k = 0; k < variables_; ++k) {
    const double room = std::min(hi_(k) - z_(k), z_(k) - lo_(k));
    const double width = hi_(k) - lo_(k);
    work_(k) = width > 0.0 ? (std::isfinite(width) ? 0.01 + room / width : 1.0) : 0.001;
  }
  for (int step = 0; step < std::min(equality_rows_, variables_); ++step) {
    int row = -1;
    int column = -1;
    double best = 0.0;
    for (int k = 0; k < variables_; ++k) {
      if (place_[index(k)] == Place::basic) continue;
      for (int i = 0; i < equality_rows_; ++i) {
        if (std::find(rows_.begin(), rows_.end(), i) != rows_.end()) continue;
        if (std::abs(M(i, k)) > rank_tolerance && std::abs(M(i, k)) * work_(k) > best) {
          best = std::abs(M(i, k)) * work_(k);
          row = i;
          column = k;
        }
      }
    }
    if (row < 0) break;
    place_[index(column)] = Place::basic;
    basics_.push_back(column);
    rows_.push_back(row);
    for (int i = 0; i < equality_rows_; ++i) {
      if (std::find(rows_.begin(), rows_.end(), i) != rows_.end()) continue;
      const double factor = M(i, column) / M(row, column);
      M.row(i) -= factor * M.row(row);
    }
  }
  rank_ = static_cast<int>(basics_.size());
}

/// Gauss-Jordan with row pivoting on [basis | 1].
bool QuadraticProgram::factorise_basis() noexcept {
  auto M = eliminated_.topLeftCorner(rank_, 2 * rank_);
  for (int i = 0; i < rank_; ++i) {
    for (int k = 0; k < rank_; ++k) {
      M(i, k) = E_(rows_[index(i)], basics_[index(k)]);
      M(i, rank_ + k) = i == k ? 1.0 : 0.0;
    }
  }
  for (int k = 0; k < rank_; ++k) {
    int pivot = k;
    for (int i = k + 1; i < rank_; ++i) {
      if (std::abs(M(i, k)) > std::abs(M(pivot, k))) pivot = i;
    }
    if (!(std::abs(M(pivot, k)) > 0.0)) return false;
    if (pivot != k) M.row(pivot).swap(M.row(k));
    M.row(k) /= M(k, k);
    for (int i = 0; i < rank_; ++i) {
      if (i != k) M.row(i) -= M(i, k) * M.row(k);
    }
  }
  inverse_basis_.topLeftCorner(rank_, rank_) = M.rightCols(rank_);
  return true;
}

/// gradient = V'(V z) + R z - g;  y from E_B' y = gradient_B;  reduced = gradient - E'y.
void QuadraticProgram::compute_reduced_gradient() noexcept {
  const auto V = V_.topLeftCorner(curvature_rows_, variables_);
  auto p = work_.head(curvature_rows_);
  p.noalias() = V * z_.head(variables_);
  gradient_.head(variables_).noalias() = V.transpose() * p;
  gradient_.head(variables_).array() += R_.head(variables_).array() * z_.head(variables_).array();
  const double scale = std::max(gradient_.head(variables_).lpNorm<Eigen::Infinity>(),
                                g_.head(variables_).lpNorm<Eigen::Infinity>());
  tolerance_ = relative_gradient_tolerance * scale;
  gradient_.head(variables_) -= g_.head(variables_);

  for (int i = 0; i < rank_; ++i) {
    double y = 0.0;
    for (int k = 0; k < rank_; ++k) y += inverse_basis_(k, i) * gradient_(basics_[index(k)]);
    multipliers_(i) = y;
  }
  for (int k = 0; k < variables_; ++k) {
    double value = gradient_(k);
    for (int i = 0; i < rank_; ++i) value -= E_(rows_[index(i)], k) * multipliers_(i);
    reduced_(k) = place_[index(k)] == Place::basic ? 0.0 : value;
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

/// follow = E_B^-1 E_S; reduced V = V_S - V_B follow; reduced H = (reduced V)'(reduced V) + R_S + follow' R_B
/// follow. Newton's step where the newest superbasic variable adds curvature, else the line along which the
/// objective falls.
bool QuadraticProgram::reduced_direction() noexcept {
  const int n = static_cast<int>(superbasics_.size());
  for (int s = 0; s < n; ++s) {
    const int variable = superbasics_[index(s)];
    for (int i = 0; i < rank_; ++i) {
      double value = 0.0;
      for (int k = 0; k < rank_; ++k) value += inverse_basis_(i, k) * E_(rows_[index(k)], variable);
      follow_(i, s) = value;
    }
    auto column = reduced_V_.col(s).head(curvature_rows_);
    column = V_.col(variable).head(curvature_rows_);
    for (int i = 0; i < rank_; ++i) column -= follow_(i, s) * V_.col(basics_[index(i)]).head(curvature_rows_);
  }
  bool curved = true;
  for (int s = 0; s < n; ++s) {
    for (int t = 0; t <= s; ++t) {
      double h = reduced_V_.col(s).head(curvature_rows_).dot(reduced_V_.col(t).head(curvature_rows_));
      for (int i = 0; i < rank_; ++i) h += R_(basics_[index(i)]) * follow_(i, s) * follow_(i, t);
      if (s == t) h += R_(superbasics_[index(s)]);
      const double left = h - cholesky_.row(s).head(t).dot(cholesky_.row(t).head(t));
      if (s != t) {
        cholesky_(s, t) = left / cholesky_(t, t);
      } else if (left > curvature_tolerance * h) {
        cholesky_(s, s) = std::sqrt(left);
      } else if (s < n - 1) {
        cholesky_(s, s) = std::sqrt(curvature_tolerance * std::max(h, std::numeric_limits<double>::min()));
      } else {
        cholesky_(s, s) = 0.0;
        curved = false;  // only the newest can lack curvature
      }
    }
  }
  auto step = work_.head(n);
  if (curved) {
    for (int s = 0; s < n; ++s) {
      step(s) =
          (-reduced_(superbasics_[index(s)]) - cholesky_.row(s).head(s).dot(step.head(s))) / cholesky_(s, s);
    }
  } else {
    step(n - 1) = reduced_(superbasics_[index(n - 1)]) > 0.0 ? -1.0 : 1.0;
    for (int s = 0; s < n - 1; ++s) step(s) = -cholesky_(n - 1, s) * step(n - 1);
  }
  for (int s = (curved ? n : n - 1) - 1; s >= 0; --s) {
    const int last = curved ? n : n - 1;
    double rest = step(s);
    for (int t = s + 1; t < last; ++t) rest -= cholesky_(t, s) * step(t);
    step(s) = rest / cholesky_(s, s);
  }
  for (int s = 0; s < n; ++s) direction_(superbasics_[index(s)]) = step(s);
  for (int i = 0; i < rank_; ++i) {
    direction_(basics_[index(i)]) = -follow_.row(i).head(n).dot(step);
  }
  return curved;
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

/// A basic variable met its bound: the superbasic one that moves it most takes its place.
void QuadraticProgram::replace_basic(int leaving) noexcept {
  const auto position = std::find(basics_.begin(), basics_.end(), leaving) - basics_.begin();
  std::size_t best = 0;
  for (std::size_t s = 1; s < superbasics_.size(); ++s) {
    if (std::abs(follow_(position, static_cast<Eigen::Index>(s))) >
        std::abs(follow_(position, static_cast<Eigen::Index>(best)))) {
      best = s;
    }
  }
  const int entering = superbasics_[best];
  basics_[static_cast<std::size_t>(position)] = entering;
  place_[index(entering)] = Place::basic;
  superbasics_[best] = leaving;  // park() takes it out
}

void QuadraticProgram::park(int variable) noexcept {
  place_[index(variable)] = Place::parked;
  superbasics_.erase(std::find(superbasics_.begin(), superbasics_.end(), variable));
}

}  // namespace zwang::solver
