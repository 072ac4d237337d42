// Which variables of a QuadraticProgram follow from its equations: the basis, and its inverse.
#include <algorithm>
#include <cmath>

#include "base/quadratic_program.hpp"

namespace zwang::solver {

namespace {
constexpr double rank_tolerance = 1e-9;  // of E's columns, which are of length 1
}  // namespace

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
  M = E_.topLeftCorner(variables_, equality_rows_).transpose();
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

/// A variable between its bounds becomes superbasic at once if it adds curvature of its own. The curvature
/// has to exceed the rounding of the basic variables, which follow it and add or take away their own.
void QuadraticProgram::choose_superbasics() noexcept {
  superbasics_.clear();
  curved_ = true;
  const auto curvature_of = [this](int k) { return dot(curvature_rows_, V(k), V(k)) + R_(k); };
  double of_basics = 0.0;
  for (const int k : basics_) of_basics = std::max(of_basics, curvature_of(k));
  for (int k = 0; k < variables_; ++k) {
    if (place_[index(k)] != Place::parked || !(z_(k) > lo_(k) && z_(k) < hi_(k))) continue;
    const auto s = static_cast<int>(superbasics_.size());
    superbasics_.push_back(k);
    const Curvature curvature = add_superbasic(s);
    double moved = 0.0;
    for (int i = 0; i < rank_; ++i) moved = std::max(moved, follow_(s, i) * follow_(s, i));
    const double around = std::max(curvature_of(k), moved * of_basics);
    if (curvature.left > ample_curvature * around) {
      place_[index(k)] = Place::superbasic;
    } else {
      superbasics_.pop_back();
    }
  }
}

/// Gauss-Jordan with row pivoting on [basis | 1].
bool QuadraticProgram::factorise_basis() noexcept {
  if (rank_ == 0) return true;
  auto M = eliminated_.topLeftCorner(rank_, 2 * rank_);
  for (int i = 0; i < rank_; ++i) {
    for (int k = 0; k < rank_; ++k) {
      M(i, k) = E_(basics_[index(k)], rows_[index(i)]);
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

/// A basic variable met its bound: the superbasic one that moves it most takes its place.
void QuadraticProgram::replace_basic(int leaving) noexcept {
  const auto position = std::find(basics_.begin(), basics_.end(), leaving) - basics_.begin();
  std::size_t best = 0;
  for (std::size_t s = 1; s < superbasics_.size(); ++s) {
    if (std::abs(follow_(static_cast<Eigen::Index>(s), position)) >
        std::abs(follow_(static_cast<Eigen::Index>(best), position))) {
      best = s;
    }
  }
  const int entering = superbasics_[best];
  basics_[static_cast<std::size_t>(position)] = entering;
  place_[index(entering)] = Place::basic;
  place_[index(leaving)] = Place::parked;
  superbasics_.erase(superbasics_.begin() + static_cast<std::ptrdiff_t>(best));
}

}  // namespace zwang::solver
