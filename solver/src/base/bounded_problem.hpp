/// Phase 3 of the sweeps, at the base: all multipliers, bounded and by level, and the torques that make them.
///
/// The whitened space of WhitenedRows holds all quantities; its dimension is the mobility. Row i of the task
/// has the direction B_i there, motor j the direction T_j. p is the sum of the constraint forces. The rows
/// accelerate with g_i + B_i.p, and Gauss's principle with bounded multipliers reads, with d = b - g,
///
///   min 1/2 |p|^2 - d' nu + 1/2 nu' R nu
///   p = sum B_i nu_i = sum T_j tau_j,   lo <= nu <= hi,   |tau| <= limit
///
/// Levels are lexicographic. Before level k, the results of the equality and force rows above are frozen:
/// B_i.p stays, as each row closes its direction. Higher one-sided rows are posed again and stay as well kept
/// as they were. Within a level the force rows come first: phi is as near to 1 as the motors allow, then
/// fixed.
///
/// A sum S bounds the force that is pressed along its axis. If the world blocked that axis and nothing else,
/// it would have to answer with B_S.p / |B_S|^2. A row along the same axis adds its nu to that force, and any
/// other row its share B_S.B_i / |B_S|^2. From the level of S on, each addition to p keeps the force inside
/// [lo, hi].
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/quadratic_program.hpp"
#include "linear/cholesky.hpp"
#include "linear/pairs.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::solver {

/// The divisor that makes the length 1; a length of 0 stays.
inline double nonzero(double length) noexcept {
  return length > 0.0 ? length : 1.0;
}

class BoundedProblem {
 public:
  BoundedProblem(int row_capacity, int motor_capacity, int dimension_capacity);

  /// The motors by their directions, which stay where they are, until they are cleared again.
  void clear_motors(int dimension) noexcept;
  void add_motor(const double* T) noexcept { T_[static_cast<std::size_t>(motors_++)] = T; }
  void factorise_motors() noexcept;
  void limit_motor(int motor, double lowest, double highest) noexcept;

  /// The rows follow one after the other, each with its d = b - g. They stay where they are, and so does B,
  /// until the next problem.
  void resize(int rows) noexcept;
  /// With |B|^2 below `least_square`, nothing moves along the row.
  void set_row(int row, const Row& source, double d, const double* B, double least_square) noexcept;
  /// A row with the same B as an earlier one, the first of these.
  void set_twin(int row, const Row& source, double d, int first) noexcept {
    Entry& e = entry(row);
    e.twin = e.axis = first;
    take_row(row, source, d);
  }
  /// Writes the rows' solutions, which stay where they are until the next problem. False when an active set
  /// met its iteration cap; all results stay inside their bounds.
  bool solve(int max_iterations, std::span<RowSolution> solutions) noexcept;

  double tau(int motor) const noexcept { return tau_(motor); }
  /// The force of the torques on the motions, T'tau.
  const double* p() const noexcept { return p_.data(); }
  int iterations() const noexcept { return iterations_; }
  int opposing(int row, std::span<int> out) noexcept;

 private:
  static constexpr int no_level = std::numeric_limits<int>::min();  ///< a row may be of any other

  /// The findings of the stages about a row.
  struct Standing {
    double reach = 0.0;  ///< |V_i|, at the present level
    double inverse_reach = 0.0;
    /// K B_i: what the levels above leave of the row, and the motion that a unit force along it makes
    const double* V = nullptr;
    double largest_force = -1.0;  ///< that the motors make along the row; negative before it is known
    double above = 0.0;           ///< of a sum: B_S.p / |B_S|^2 of the levels above
    double offset = 0.0;          ///< how far beyond b its own level left a violated one-sided row
    double nu = 0.0, phi = 0.0;
    double plain_nu = 0.0;        ///< nu, while a plain level is sought
    int reach_extent = 0;         ///< of V_i
    int projected_at = no_level;  ///< level of V_i
    int limit_before = -1;        ///< on the same side of the same axis
    bool has_bounds = false;      ///< lo and hi are finite, but on a sum
    bool blocked = false;         ///< the levels above leave it no freedom
    bool motor_limited = false;   ///< a motor stood at its limit when the row's level was solved
    bool sum_limited = false;     ///< and so did a sum against it

    /// The values before the first level. The fields that a level writes for every row that it looks at may
    /// stay. (Field by field: for a whole struct GCC 12 emits a string instruction, which is slow to start.)
    void reset() noexcept {
      reach = above = offset = nu = phi = 0.0;
      largest_force = -1.0;
      projected_at = no_level;
      limit_before = -1;
      has_bounds = blocked = motor_limited = sum_limited = false;
    }
  };
  struct Entry : Standing {
    const Row* source = nullptr;
    bool is_posed = false;  ///< what stands below is that of `source`; else only B, twin and axis are
    RowKind kind = RowKind::driver;
    Quantity quantity = Quantity::velocity;
    int level = 1;
    double lo = 0.0, hi = 0.0;   ///< of nu, in its own unit; with has_bounds finite
    bool bounded_below = false;  ///< by the row's own lo, not by what the motors can do
    bool bounded_above = false;
    double force = 0.0;     ///< f
    double softness = 0.0;  ///< R at the row's own level; what was reached is kept firmly below it
    const double* B = nullptr;
    int extent = 0;         ///< of B_i: the rest is 0
    int twin = -1;          ///< an earlier row with the same B
    int axis = 0;           ///< the first row with this B
    bool is_limit = false;  ///< one-sided
    double length = 0.0;    ///< |B_i|
    double inverse_length = 0.0;
    bool reachable = false;  ///< the ground leaves some of it
    bool out = false;        ///< unreachable: takes no part
    RowStatus status = RowStatus::held;
  };
  using Vector = Eigen::VectorXd;
  /// B_i . p, the acceleration that p makes along row i.
  double along(int i, const Vector& p) const noexcept {
    const Entry& e = entries_[static_cast<std::size_t>(i)];
    return dot(e.extent, e.B, p.data());
  }
  /// p += V_i nu
  void push(int i, double nu, Vector& p) const noexcept {
    const Entry& e = entries_[static_cast<std::size_t>(i)];
    add_multiple(e.reach_extent, nu, e.V, p.data());
  }
  void copy(const Vector& from, Vector& to) const noexcept {
    std::copy_n(from.data(), dimension_, to.data());
  }
  const double* B(int i) const noexcept { return entries_[static_cast<std::size_t>(i)].B; }
  const double* V(int i) const noexcept { return entries_[static_cast<std::size_t>(i)].V; }
  const double* T(int motor) const noexcept { return T_[static_cast<std::size_t>(motor)]; }
  Entry& entry(int i) noexcept { return entries_[static_cast<std::size_t>(i)]; }
  bool is_one_sided(int i) const noexcept { return entries_[static_cast<std::size_t>(i)].is_limit; }
  bool is_limit_above(int i, int level) noexcept { return is_one_sided(i) && entry(i).level < level; }
  bool is_soft(int i) noexcept { return entry(i).softness > 0.0; }
  /// A row takes part in a stage while something of it is left free.
  bool takes_part(int i) const noexcept {
    const Entry& e = entries_[static_cast<std::size_t>(i)];
    return !e.out && e.reach > 0.0;
  }
  /// Below its own level a row holds what it reached with whatever that takes.
  Range bounds_at(int i, int level) const noexcept {
    const Entry& e = entries_[static_cast<std::size_t>(i)];
    if (e.level == level) return {e.lo, e.hi};
    return {e.kind == RowKind::lower ? 0.0 : -infinity, e.kind == RowKind::upper ? 0.0 : infinity};
  }
  double softness_at(int i, int level) const noexcept {
    const Entry& e = entries_[static_cast<std::size_t>(i)];
    return e.level == level ? e.softness : 0.0;
  }
  int extent_of(const double* x) const noexcept;
  void take_source(int i) noexcept;
  double largest_demand() noexcept;
  double largest_force(int row) noexcept;

  /// Limits are posed where a level is not plain.
  void take_row(int i, const Row& row, double d) noexcept {
    Entry& e = entry(i);
    d_[i] = d;
    e.source = &row;
    if (row.level != last_level_) note_level(row.level);
    e.is_posed = false;
    if (is_limit(row.kind)) {
      limits_[static_cast<std::size_t>(limit_count_++)] = i;
      note_limit(i);
    } else {
      list_drive(i);
    }
  }
  void list_drive(int i) noexcept;
  std::span<const int> limits() const noexcept {
    return {limits_.data(), static_cast<std::size_t>(limit_count_)};
  }
  bool can_be_idle(int i) const noexcept;
  int& last_beside(int i) noexcept;
  bool is_beyond_another(int i) noexcept;
  void list_limit(int i) noexcept;
  void pose_limits() noexcept;
  void note_level(int level) noexcept;
  bool idle_limits_rest(int level) noexcept;
  void wake_idle_limits(int level) noexcept;
  void bound_rows() noexcept;
  /// Before a row's bounds are read.
  void bound(int i) noexcept {
    if (!entry(i).has_bounds) bound_row(i);
  }
  void bound_row(int i) noexcept;
  bool solve_levels(int max_iterations, bool& exact) noexcept;
  void project_rows(int level) noexcept;
  void project_row(int i, int level) noexcept;
  void take_out_frozen(double* x) const noexcept;
  bool solve_forces(int level, int max_iterations) noexcept;
  bool solve_motion(int level, int max_iterations) noexcept;
  bool least_multipliers(int level, int max_iterations) noexcept;
  void freeze(int level) noexcept;
  bool least_torques(int max_iterations) noexcept;

  static constexpr double tie = 1e-9;  ///< relative: limits closer than that are equal
  /// Whether `one` is clearly beyond `other`, seen from inside the range that `side` (1: upper) bounds.
  static bool is_beyond(double one, double other, double side) noexcept {
    return side * (one - other) > tie * (std::abs(one) + std::abs(other));
  }

  /// The nearest limit of one side of an axis.
  struct End {
    double least = 0.0;  ///< the acceleration that leaves it clear room
    int row = -1;
    bool is_tied = false;  ///< another one is as near
    bool pushes = false;
  };
  struct Room {
    End lower{.least = -infinity}, upper{.least = infinity};
    int axis = -1, level = 0;
    int other = -1;  ///< of the same axis at another level
  };
  enum class Change { none, some, unclear };
  void start_room() noexcept;
  bool allow(int level) noexcept;
  void note_limit(int i) noexcept;
  bool join(End& end, const End& other, double side) const noexcept;
  bool limits_have_room(const Vector& p) const noexcept;
  bool push_plainly(int level, int max_rounds) noexcept;
  double parked_force(std::size_t k) noexcept;
  bool park_dependent(int k) noexcept;
  void list_free_rows() noexcept;
  bool factorise_plainly(int k) noexcept;
  Change drive_plainly() noexcept;
  Change change_drivers() noexcept;
  Change change_limits(int level) noexcept;
  void release(int limit) noexcept;
  bool let_push(End& end, int level) noexcept;
  bool find_plain_motion(int level, int max_rounds) noexcept;
  void settle(const Vector& p) noexcept;
  bool solve_plainly(int level, int max_rounds) noexcept;

  void report() noexcept;
  void report_row(int i, bool motor_at_limit) noexcept;
  void report_force(int i, bool motor_at_limit, RowSolution& row) noexcept;
  void report_sum(int i, RowSolution& row) noexcept;
  void report_motion(int i, bool motor_at_limit, RowSolution& row) noexcept;
  RowStatus status_of_missed(int i, int side, bool motor_at_limit, RowSolution& row) noexcept;
  bool is_at_limit(const Vector& tau) const noexcept;
  void note_limits(int level) noexcept;
  bool is_sum_at_bound(int i, double direction) noexcept;
  bool is_held_by_sum(int i, double wanted) noexcept;
  double opposition(int k, int i, double wanted, double miss) noexcept;

  void start_sums(int level) noexcept;
  bool sum_counts(int i, int level) const noexcept;
  double sum_of(int i, const Vector& p) noexcept;
  double sum_beyond(int i, const Vector& p) noexcept;
  bool sums_hold(int level, const Vector& p) noexcept;
  void list_sums(int level) noexcept;
  void let_limits_wait() noexcept;
  bool pose_broken(int level) noexcept;
  void take_felt(int n, int level) noexcept;
  bool limits_above_hold(int first) noexcept;
  bool limits_rest(int level) noexcept;
  /// How far a limit is from what it must keep, with its present multiplier; negative where it does not.
  double room_of(int i, const Vector& p) const noexcept {
    const Entry& e = entries_[static_cast<std::size_t>(i)];
    const double s = along(i, p) - d_(i) - e.offset;
    return e.kind == RowKind::upper ? -s : s;
  }
  bool brake(int forces, int level, int max_iterations) noexcept;
  bool share_torque(int forces, int level, int max_iterations) noexcept;

  /// A limit of each side of an axis; -1 for none.
  struct Sides {
    int upper = -1, lower = -1;
  };
  /// Rows along the same axis share it.
  std::size_t axis_of(int i) noexcept { return static_cast<std::size_t>(entry(i).axis); }
  double target_of(int i) const noexcept;
  bool is_firm_limit(int i, int level) noexcept;
  void find_nearest_above(int level) noexcept;
  bool gives_in(int i, int level) noexcept;
  void fold_limits(int level) noexcept;
  bool recall_limits() noexcept;
  void fold_driver_beyond(int limit) noexcept;
  bool has_clear_room(int i) noexcept;
  bool folded_limits_rest(std::size_t first) noexcept;
  void release_drivers() noexcept;
  void unfold_limits() noexcept;

  /// The force of a limit that pushes alone. Without a row, no single limit settles the motion.
  struct Push {
    int row = -1;
    double nu = 0.0;
  };
  Push push_alone(int first, int level, Vector& p) noexcept;
  bool one_limit_settles(int level) noexcept;
  void take_offsets(int level) noexcept;
  double least_room(int i) noexcept;
  void take_out_limits(const Vector& p) noexcept;
  bool find_motion(int level, int max_iterations) noexcept;
  void pose_rows() noexcept;
  void pose_limits_above() noexcept;
  /// Motors take part with all sums, sums with the limits above.
  enum class Posed { rows, sums, motors };
  void resize_program(int n, int level, int curvature_rows, Posed posed) noexcept;
  void pose_multiplier(int k, int level) noexcept;
  bool move_within_sums(int level, int max_iterations) noexcept;
  void pose_motion(int n, int level, Posed posed) noexcept;
  void pose_motors(int n) noexcept;
  void pose_kept(int n, int level, int variable, int equation) noexcept;
  void pose_sums(int n, int variable, int equation) noexcept;
  void take_p(int n) noexcept;
  void take_limits(int first) noexcept;
  void take_multipliers(int level) noexcept;
  void take_motors(int first) noexcept;
  bool factorise_gram(int count, double least_pivot) noexcept;
  bool torques_for(const Vector& p) noexcept;
  bool share(double* rest) noexcept;
  bool share_three(const double* p) noexcept;
  bool take_torque(int motor, double torque) noexcept;

  int rows_ = 0, motors_ = 0, dimension_ = 0, iterations_ = 0;
  RowMajorMatrix V_;  ///< of the rows on which the levels above have frozen something
  std::vector<const double*> T_;
  Vector d_, tau_, tau_lo_, tau_hi_, candidate_;
  Vector tau_slack_;     ///< by how much rounding may take a torque beyond its limits
  Vector motor_square_;  ///< |T_j|^2
  double motor_length(int motor) const noexcept { return std::sqrt(motor_square_(motor)); }
  std::vector<int> motor_extents_;
  /// A motor that alone drives a dimension, the last one of those still open.
  struct Sole {
    int motor = -1;
    double inverse = 0.0;  ///< 1 / T there
  };
  std::vector<Sole> soles_;
  std::vector<int> shared_motors_;  ///< the others
  int shared_dimensions_ = 0;       ///< which these drive
  std::vector<int> last_of_;        ///< by dimension: the motor whose last number stands there
  Vector p_;                        ///< sum of the constraint forces so far
  Vector fixed_;                    ///< its part that the present stage cannot change
  Vector work_, solved_;
  Vector felt_;            ///< the motion that rows feel where sums or limits above stand in the way
  RowMajorMatrix frozen_;  ///< orthonormal rows: the directions that the levels above have closed
  int frozen_count_ = 0;
  RowMajorMatrix gram_;    ///< T'T of the shared motors is G D G': G^-1, whose diagonal is 1 and not written
  Vector inverse_pivots_;  ///< 1 / D
  bool motors_reach_all_ = false;
  bool motors_drive_all_ = false;   ///< and each of them can push
  bool torques_are_least_ = false;  ///< tau_ are the least ones that make p_
  std::vector<Entry> entries_;
  std::span<RowSolution> solutions_;
  std::vector<int> sums_, drives_, limits_;  ///< all rows by what they are; drives_: drivers and forces
  int limit_count_ = 0;
  /// Once limits are posed: all rows that take part, and the limits that have nothing to do beside another
  /// one of their level.
  std::vector<int> awake_, idle_;
  bool are_limits_posed_ = false;
  std::vector<int> levels_;  ///< of all rows, the first one first
  int last_level_ = 0;       ///< of the row before
  std::vector<int> forces_, motions_,
      limits_above_;                 ///< rows of the present level that take part, by what they are
  std::vector<Sides> last_on_axis_;  ///< by axis: the last limit of each side
  std::vector<int> posed_;           ///< row of each variable of the present stage
  std::vector<int> posed_sums_;      ///< sums of the present stage that take part
  std::vector<int> folded_;          ///< rows of the present stage that need not be solved for
  std::vector<int> waiting_;         ///< limits that join it when it would break them
  std::vector<Sides> nearest_;  ///< by axis: of the firm limits of the levels above those with the least room
  std::vector<double> units_;   ///< force of a unit of each variable
  std::vector<int> tied_;       ///< rows of the present stage whose multipliers are not unique

  // Of plain levels.
  std::vector<Room> rooms_;  ///< by axis and level
  int room_count_ = 0;
  std::vector<int> first_room_;      ///< by axis
  std::vector<Room> room_;           ///< by axis: of the levels so far
  std::vector<int> limited_axes_;    ///< those with limits
  std::vector<int> pushing_;         ///< the limits that push
  std::vector<int> pushed_;          ///< those that pushed before the present level
  std::vector<signed char> parked_;  ///< by driver of the level: 1 at its upper bound, -1 at its lower one
  std::vector<int> free_rows_, later_motions_;
  RowMajorMatrix free_factor_;  ///< of these: G, of G D G'
  Vector free_inverse_D_, free_work_, free_nu_;
  bool are_levels_plain_ = false;  ///< all of the last solution
  bool is_axis_out_ = false;       ///< nothing moves along one of the axes
  QuadraticProgram program_;
};

}  // namespace zwang::solver
