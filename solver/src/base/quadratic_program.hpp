/// min 1/2 z'Hz - g'z,  E z = e,  lo <= z <= hi,  with H = V'V + diag(R) positive semidefinite, from a
/// feasible start.
///
/// A primal active-set method in reduced form (Wolfe; the basic / superbasic split of Murtagh and Saunders
/// 1978). A variable is basic, superbasic or parked. As many are basic as E has independent rows; they follow
/// the others so that E z stays. A superbasic variable is free to move. A parked one stays at a bound, or
/// where it started. Variables that start between their bounds start superbasic, so that one step settles all
/// rows that need no bound. The objective falls at every step that moves:
///
///   price   the minimum over the superbasic variables is reached: the steepest parked variable joins them
///   step    go to the new minimum; without curvature, go along the line on which the objective falls
///   block   a variable that meets a bound parks there; if it was basic, a superbasic one takes its place
///
/// Without equations, blocks of variables are tried first (block_pivoting.cpp).
///
/// Singular H and dependent rows need no regularisation. A variable joins only while it adds curvature or a
/// way down, and a way down without curvature ends at a bound. So the superbasic set always has a positive
/// definite reduced Hessian.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "linear/cholesky.hpp"
#include "linear/pairs.hpp"

namespace zwang::solver {

class QuadraticProgram {
 public:
  QuadraticProgram(int variable_capacity, int curvature_capacity, int equality_capacity);

  /// Sizes the problem: `variables` columns; V has `curvature_rows` rows, E `equality_rows`. With equations
  /// everything is 0 and bounds are left to set; without, everything is.
  void resize(int variables, int curvature_rows, int equality_rows) noexcept;

  /// A column of V: `scale` times the `count` numbers of `x`, the rest 0. Its length is to be 1.
  void set_V(int variable, int count, double scale, const double* x) noexcept;
  double* E(int variable) noexcept { return &E_(variable, 0); }  ///< a column of E
  double& R(int variable) noexcept { return R_(variable); }
  double& g(int variable) noexcept { return g_(variable); }
  double& lo(int variable) noexcept { return lo_(variable); }
  double& hi(int variable) noexcept { return hi_(variable); }
  double& z(int variable) noexcept { return z_(variable); }
  double z(int variable) const noexcept { return z_(variable); }
  /// At a solution: the rate at which the objective changes with a parked variable; 0 for the others.
  double reduced_gradient(int variable) const noexcept { return reduced_(variable); }
  /// Of an equation, y:  reduced gradient = gradient - E'y.
  double multiplier(int equation) const noexcept {
    const auto place = std::find(rows_.begin(), rows_.end(), equation);
    return place == rows_.end() ? 0.0 : multipliers_(place - rows_.begin());
  }
  bool is_free(int variable) const noexcept { return place_[index(variable)] != Place::parked; }
  double gradient_tolerance() const noexcept { return tolerance_; }

  /// False when `max_iterations` did not suffice: z is feasible all the same. Adds to `iterations`.
  bool solve(int max_iterations, int& iterations) noexcept;

 private:
  enum class Place : char { parked, basic, superbasic };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  static constexpr double relative_gradient_tolerance = 1e-12;
  static constexpr double slope_tolerance = 1e3;  ///< times the gradient tolerance
  static constexpr double ample_curvature =
      1e-6;  ///< a pivot's share of the diagonal, of a variable that starts free
  static constexpr double curvature_tolerance = 1e-12;  ///< the same share, below which there is none
  static constexpr int max_refinements = 4;

  bool pivot_blocks(int max_rounds, int& iterations) noexcept;
  const double* V(int variable) const noexcept { return &V_(variable, 0); }
  /// An entry of H.
  double hessian(int k, int l) const noexcept {
    if (k == l) return curvature_(k);
    return dot(std::min(extents_[index(k)], extents_[index(l)]), V(k), V(l));
  }
  void compute_image() noexcept;
  /// A row of H z, by way of V z.
  double pull_on(int k) const noexcept {
    return dot(extents_[index(k)], V(k), image_.data()) + R_(k) * z_(k);
  }
  void compute_gradient() noexcept;
  void factorise_free() noexcept;
  void step_free() noexcept;
  bool is_out_of_place(int variable) const noexcept;
  void divide_by_free(double* x) const noexcept;
  void solve_free() noexcept;
  bool set_free() noexcept;
  int flat_one_that_wants_away() const noexcept;
  bool has_room(int variable) const noexcept;
  bool slide(int flat) noexcept;
  void park_flat_ones() noexcept;
  void change_places() noexcept;
  double slope_of_curved() const noexcept;

  void choose_basis() noexcept;
  void choose_superbasics() noexcept;
  bool factorise_basis() noexcept;
  void compute_reduced_gradient() noexcept;
  double slope_of_superbasics() const noexcept;
  int price(bool first_that_helps) const noexcept;
  struct Curvature {
    double own = 0.0;   ///< of the reduced Hessian's diagonal
    double left = 0.0;  ///< of it, what the superbasic variables before leave
  };
  Curvature add_superbasic(int s) noexcept;
  Curvature factorise_row(int s) noexcept;
  void reduce() noexcept;
  void newton_step() noexcept;
  void flat_line() noexcept;
  void set_direction() noexcept;
  bool goes_down() noexcept;
  int longest_step(double& length) const noexcept;
  bool take_step(double length, int blocking) noexcept;
  void replace_basic(int leaving) noexcept;
  void park(int variable) noexcept;

  int variables_ = 0, curvature_rows_ = 0, equality_rows_ = 0, rank_ = 0;
  RowMajorMatrix V_, E_;  ///< transposed: a row a variable
  Eigen::VectorXd R_, g_, lo_, hi_, z_;
  Eigen::VectorXd gradient_, reduced_, direction_, multipliers_, work_, step_;
  RowMajorMatrix eliminated_;     ///< scratch of the elimination
  RowMajorMatrix inverse_basis_;  ///< rank x rank
  RowMajorMatrix follow_;         ///< how the basic variables follow, a row a superbasic one
  RowMajorMatrix reduced_V_;      ///< a row a superbasic variable
  RowMajorMatrix hessian_;        ///< the reduced Hessian; lower triangle
  RowMajorMatrix factor_;         ///< its Cholesky factor; of the blocks G, and D on its diagonal
  Eigen::VectorXd curvature_;     ///< the diagonal of H
  Eigen::VectorXd inverse_D_;     ///< of the blocks' factor: 1 over its diagonal
  int factorised_ = 0;            ///< rows of the blocks' factor that are those of the free variables
  bool curved_ = true;            ///< the newest superbasic variable adds curvature
  Eigen::VectorXd image_;         ///< V z
  std::vector<int> extents_;      ///< of the columns of V: the rest is 0
  std::vector<Place> place_;
  std::vector<char> stuck_;
  std::vector<int> basics_, superbasics_, rows_;
  double largest_g_ = 0.0;
  double tolerance_ = 0.0;
};

}  // namespace zwang::solver
