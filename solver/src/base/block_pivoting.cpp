// QuadraticProgram without equations: block principal pivoting (Kostreva 1978; Judice and Pires 1994).
//
//   solve for the free variables, with the others at their bounds;
//   a variable beyond a bound parks there, and a parked one with a way down joins, all of them at once;
//   repeat until none moves.
//
// Mostly two to four rounds, where an active set takes a step for every variable. Rounds that do not lower
// the number of those that move are allowed a few times in a row; then only the last one moves (Murty 1974).
// Of variables without curvature of their own, as two limits along one axis, one is free at a time; the other
// changes places with it where they contradict. The active set takes over where this does not settle.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quadratic_program.hpp"
#include "linear/pairs.hpp"

namespace zwang::solver {

namespace {
constexpr int patience = 3;              // rounds in a row that may not lower the number of those that move
constexpr double flat_rate = 1e-9;       // of a variable that follows a flat one: below, it does not
constexpr double rounding_share = 0.01;  // of the gradient's tolerance: the slope after a good step
constexpr double infinite_step = std::numeric_limits<double>::infinity();
}  // namespace

/// V z
void QuadraticProgram::compute_image() noexcept {
  set_zero(curvature_rows_, image_.data());
  for (int k = 0; k < variables_; ++k) {
    if (z_(k) != 0.0) add_multiple(extents_[index(k)], z_(k), V(k), image_.data());
  }
}

/// reduced_ = H z - g, and the size of what is rounding in it.
void QuadraticProgram::compute_gradient() noexcept {
  compute_image();
  double scale = largest_g_;
  for (int k = 0; k < variables_; ++k) {
    const double pull = pull_on(k);
    scale = std::max(scale, std::abs(pull));
    reduced_(k) = pull - g_(k);
  }
  tolerance_ = relative_gradient_tolerance * scale;
}

/// H_FF = G D G' of the free variables, with G of diagonal 1, row by row; the first rows are those of the
/// round before where the variables are. D stands on the diagonal of factor_; inverse_D_ is 0 for a variable
/// without curvature of its own, which stays where it is. (Number by number: see CMakeLists.txt.)
void QuadraticProgram::factorise_free() noexcept {
  const auto n = static_cast<int>(superbasics_.size());
  double* const t = work_.data();  // G_s D
  for (int s = factorised_; s < n; ++s) {
    const int variable = superbasics_[index(s)];
    const double own = curvature_(variable);
    const int extent = extents_[index(variable)];
    int pairs = 0;
    for (; pairs + 2 <= s; pairs += 2) {
      dot_two(extent, V(variable), V(superbasics_[index(pairs)]), V(superbasics_[index(pairs + 1)]),
              t + pairs);
    }
    if (pairs < s) t[pairs] = dot(extent, V(variable), V(superbasics_[index(pairs)]));
    const double pivot = eliminate_row(factor_, inverse_D_, s, own, t);
    factor_(s, s) = pivot;
    inverse_D_(s) = pivot > ample_curvature * own ? 1.0 / pivot : 0.0;
  }
  factorised_ = n;
}

/// x := H_FF^-1 x
void QuadraticProgram::divide_by_free(double* x) const noexcept {
  substitute(factor_, inverse_D_, static_cast<int>(superbasics_.size()), x);
}

/// One Newton step of the free variables: z -= H_FF^-1 reduced.
void QuadraticProgram::step_free() noexcept {
  const auto n = static_cast<int>(superbasics_.size());
  for (int s = 0; s < n; ++s) step_(s) = reduced_(superbasics_[index(s)]);
  divide_by_free(step_.data());
  for (int s = 0; s < n; ++s) z_(superbasics_[index(s)]) -= step_(s);
}

/// A free variable beyond a bound, or a parked one that wants away from its own.
bool QuadraticProgram::is_out_of_place(int k) const noexcept {
  if (place_[index(k)] == Place::superbasic) return z_(k) < lo_(k) || z_(k) > hi_(k);
  return std::abs(reduced_(k)) > tolerance_ && has_room(k);
}

/// True when it found the solution; else z is where it was.
bool QuadraticProgram::pivot_blocks(int max_rounds, int& iterations) noexcept {
  std::copy_n(z_.data(), variables_, direction_.data());
  superbasics_.clear();
  factorised_ = 0;
  compute_image();
  for (int k = 0; k < variables_; ++k) {
    curvature_(k) = 1.0 + R_(k);
    step_(k) = R_(k) == 0.0 ? 1.0 : 1.0 / curvature_(k);
  }
  for (int k = 0; k < variables_; ++k) {
    const double start = z_(k);
    z_(k) = std::clamp(start + (g_(k) - pull_on(k)) * step_(k), lo_(k), hi_(k));
    add_multiple(extents_[index(k)], z_(k) - start, V(k), image_.data());
    const bool is_inside = z_(k) > lo_(k) && z_(k) < hi_(k);
    place_[index(k)] = is_inside ? Place::superbasic : Place::parked;
    if (is_inside) superbasics_.push_back(k);
  }
  int fewest = variables_ + 1;
  int tries = patience;
  for (int round = 0; round < max_rounds; ++round) {
    ++iterations;
    solve_free();
    const int flat = flat_one_that_wants_away();
    if (flat >= 0 && !slide(flat)) break;
    park_flat_ones();
    if (flat >= 0) continue;
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

/// To the minimum over the free variables.
void QuadraticProgram::solve_free() noexcept {
  factorise_free();
  const bool is_set = set_free();
  compute_gradient();
  for (int step = is_set ? 1 : 0; step <= max_refinements; ++step) {
    if (step > 0 && slope_of_curved() <= rounding_share * tolerance_) return;
    step_free();
    compute_gradient();
  }
}

/// Where each free variable has curvature of its own:  z_F = H_FF^-1 (g_F - V_F'V z_P), from what the parked
/// ones pull, which mostly is nothing.
bool QuadraticProgram::set_free() noexcept {
  const auto n = static_cast<int>(superbasics_.size());
  for (int s = 0; s < n; ++s) {
    if (inverse_D_(s) == 0.0) return false;
  }
  bool pulls = false;
  for (int k = 0; k < variables_; ++k) {
    if (place_[index(k)] == Place::superbasic || z_(k) == 0.0) continue;
    if (!pulls) set_zero(curvature_rows_, image_.data());
    pulls = true;
    add_multiple(extents_[index(k)], z_(k), V(k), image_.data());
  }
  for (int s = 0; s < n; ++s) {
    const int k = superbasics_[index(s)];
    step_(s) = g_(k);
    if (pulls) step_(s) -= dot(extents_[index(k)], V(k), image_.data());
  }
  divide_by_free(step_.data());
  for (int s = 0; s < n; ++s) z_(superbasics_[index(s)]) = step_(s);
  return true;
}

/// The place among the free ones of the first without curvature of its own that is not content; -1 for none.
int QuadraticProgram::flat_one_that_wants_away() const noexcept {
  for (int s = 0; s < static_cast<int>(superbasics_.size()); ++s) {
    const int k = superbasics_[index(s)];
    if (inverse_D_(s) == 0.0 && std::abs(reduced_(k)) > tolerance_ && has_room(k)) return s;
  }
  return -1;
}

/// Whether a variable can go the way that its gradient points down.
bool QuadraticProgram::has_room(int k) const noexcept {
  return reduced_(k) < 0.0 ? z_(k) < hi_(k) : z_(k) > lo_(k);
}

/// A flat variable moves down the slope until the first variable meets its bound, as where two limits
/// contradict each other. The others follow so that their gradient stays. If another variable meets its
/// bound, the flat one takes its place. False when none does. Also false where a little curvature or a slope
/// near zero asks for smaller steps.
bool QuadraticProgram::slide(int flat) noexcept {
  const int entering = superbasics_[index(flat)];
  const double left = factor_(flat, flat);  // of its curvature
  if (left > curvature_tolerance * curvature_(entering)) return false;
  if (std::abs(reduced_(entering)) <= slope_tolerance * tolerance_) return false;
  const auto n = static_cast<int>(superbasics_.size());
  for (int s = 0; s < n; ++s) step_(s) = hessian(superbasics_[index(s)], entering);
  divide_by_free(step_.data());
  const double way = reduced_(entering) > 0.0 ? 1.0 : -1.0;
  for (int s = 0; s < n; ++s) step_(s) *= way;
  step_(flat) = -way;
  int blocking = -1;
  double length = infinite_step;
  for (int s = 0; s < n; ++s) {
    const int k = superbasics_[index(s)];
    if (std::abs(step_(s)) <= flat_rate) continue;
    const double room = std::max(0.0, step_(s) > 0.0 ? hi_(k) - z_(k) : z_(k) - lo_(k));
    if (room < length * std::abs(step_(s))) {
      length = room / std::abs(step_(s));
      blocking = s;
    }
  }
  if (blocking < 0) return false;
  for (int s = 0; s < n; ++s) z_(superbasics_[index(s)]) += length * step_(s);
  const int parking = superbasics_[index(blocking)];
  z_(parking) = step_(blocking) > 0.0 ? hi_(parking) : lo_(parking);
  if (blocking != flat) inverse_D_(flat) = 1.0;  // it stays
  factorised_ = std::min(factorised_, flat);
  inverse_D_(blocking) = 0.0;
  compute_gradient();
  return true;
}

void QuadraticProgram::park_flat_ones() noexcept {
  int curved = 0;
  for (int s = 0; s < static_cast<int>(superbasics_.size()); ++s) {
    const int k = superbasics_[index(s)];
    if (inverse_D_(s) == 0.0) {
      place_[index(k)] = Place::parked;
      factorised_ = std::min(factorised_, s);
    } else {
      superbasics_[index(curved++)] = k;
    }
  }
  superbasics_.resize(index(curved));
}

/// Each of the rows_ changes its place. The steepest variable joins first: of two limits along one axis, the
/// nearer one pushes.
void QuadraticProgram::change_places() noexcept {
  std::sort(rows_.begin(), rows_.end(), [this](int k, int l) {
    const double one = std::abs(reduced_(k)), other = std::abs(reduced_(l));
    return one > other || (one == other && k < l);
  });
  for (const int k : rows_) {
    if (place_[index(k)] == Place::parked) {
      place_[index(k)] = Place::superbasic;
      superbasics_.push_back(k);
    } else {
      place_[index(k)] = Place::parked;
      z_(k) = std::clamp(z_(k), lo_(k), hi_(k));
    }
  }
  const auto is_parked = [this](int k) { return place_[index(k)] == Place::parked; };
  const auto first = std::find_if(superbasics_.begin(), superbasics_.end(), is_parked);
  factorised_ = std::min(factorised_, static_cast<int>(first - superbasics_.begin()));
  superbasics_.erase(std::remove_if(first, superbasics_.end(), is_parked), superbasics_.end());
}

double QuadraticProgram::slope_of_curved() const noexcept {
  double slope = 0.0;
  for (int s = 0; s < static_cast<int>(superbasics_.size()); ++s) {
    if (inverse_D_(s) > 0.0) slope = std::max(slope, std::abs(reduced_(superbasics_[index(s)])));
  }
  return slope;
}

}  // namespace zwang::solver
