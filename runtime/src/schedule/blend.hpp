/// The sets of constraints in force, and the shares that their solutions have.
///
/// A switch blends solutions, not rows. The set of the new task and the sets that were in force before are
/// each solved whole, at full strength, and with progress going from 0 to 1
///
///   tau = progress tau_new + (1 - progress) tau_before
///
/// An equality that all sets meet is met exactly at every instant. A constraint that enters, leaves or
/// changes below it has no effect on it. A range or a sum that all sets keep is kept. So
///
///   a statement of `always`   is in every set, with its present values;
///   a range that enters       joins the sets before at once, as the tighter of both where the axis has one,
///                             with a horizon that shrinks during the blend: a motion beyond it can stop;
///   a range that leaves       stays in the sets before.
///
/// A set before keeps the constraints as they were put last. A switch in the middle of a blend makes a third
/// set.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "zwang/runtime/scheduler.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::runtime {

/// A frame by its name, and how often it was set. Without one, frames that coincide are the same.
struct FrameKey {
  int frame = -1;
  int settings = 0;
};

/// A constraint that the active task or `always` wants, with its present values.
struct Wanted {
  solver::AxisConstraint constraint;
  Origin origin;
  FrameKey move, in;
  bool always = false;    ///< persists as itself, whatever the tasks say of its axis
  bool fence = false;     ///< one of a boundary's: its ranges come and go with its distance
  bool measured = false;  ///< its value or its axes are a signal's: new ones are no switch
  bool lost = false;      ///< that signal is not known
  bool far = false;       ///< not in force now, though nothing was switched: a boundary out of reach
};

/// The ranges of a constraint, one bit a quantity.
inline constexpr unsigned position_bit = 1U;
inline constexpr unsigned velocity_bit = 2U;
inline constexpr unsigned acceleration_bit = 4U;
inline constexpr unsigned force_bit = 8U;  ///< of a force range alone; beside a driver it is the driver's
inline constexpr unsigned all_bits = position_bit | velocity_bit | acceleration_bit | force_bit;

/// Most rows that a constraint can become.
int row_bound(const solver::AxisConstraint& constraint) noexcept;

/// One set of constraints, and what of it is in force.
struct BlendedSet {
  solver::ConstraintSet constraints;
  std::vector<InForce> in_force;  ///< parallel to the constraints
  double share = 1.0;
};

class Blend {
 public:
  static constexpr std::size_t most_sets = 3;

  /// Of a task, `most_wanted` constraints at most, and `most_rows` rows in force at a time; limits act within
  /// `horizon` [s].
  Blend(std::size_t most_wanted, int most_rows, double horizon = solver::limit_horizon);

  /// Blends what is in force with `wanted`, over `duration` [s]; 0 switches at once. `wanted` keeps its
  /// length until the next switch.
  void start(const std::vector<Wanted>& wanted, double duration) noexcept;
  /// Whether `renew` has the effect of `put`, if no wanted constraint came into reach or went out of it since
  /// the last `put`.
  bool stays_put(double progress) const noexcept { return is_put_ && (count_ == 1 || progress < 1.0); }
  /// Writes those of `wanted` that have new values, by their indices, and what the progress changes.
  void renew(const std::vector<Wanted>& wanted, const std::vector<int>& renewed, double progress) noexcept;
  /// Puts the sets in force at `progress` (0 to 1, > 0).
  void put(const std::vector<Wanted>& wanted, double progress) noexcept;

  /// The newest first.
  std::span<BlendedSet> sets() noexcept { return {sets_.data(), count_}; }
  std::span<const BlendedSet> sets() const noexcept { return {sets_.data(), count_}; }
  BlendedSet& set(int i) noexcept { return sets_[static_cast<std::size_t>(i)]; }
  /// Most constraints of a set.
  std::size_t capacity() const noexcept { return sets_[0].in_force.capacity(); }
  static constexpr int rows_of_a_set(int most_rows) noexcept { return 4 * most_rows; }

 private:
  /// One bit a quantity.
  using Ranges = unsigned;
  /// The ranges that a constraint said last, and how firm they are.
  struct Said {
    std::optional<solver::Range> position, velocity, acceleration, force;
    double weight = solver::infinity;
  };
  /// A constraint of a set. (It is small, because a switch copies each of them, mostly into a cold cache. So
  /// the constraint itself stays in the set, and is copied only if it fades.)
  struct Kept {
    int place = -1;  ///< in the set; -1: not in force
    int fades = -1;  ///< index in `fading_`; -1: it lives or joins, and its values are in what is wanted now
    Origin origin;
    FrameKey move, in;
    bool always = false;
    bool fence = false;
    bool lost = false;
    int index = -1;      ///< of what is wanted in its own set
    int becomes = -1;    ///< index of what is wanted now along the same axis; -1: nothing is
    bool lives = false;  ///< it is what is wanted now, with its present values
    Ranges joins = 0;    ///< it is these ranges of what is wanted now, and nothing else
    Said said;           ///< of `always`, when it was in force last, or listed
  };
  using KeptList = std::vector<Kept>;

  static Kept kept_of(const std::vector<Wanted>& wanted, std::size_t index) noexcept;
  int row_bound(std::size_t set) const noexcept;
  static Said said_by(const solver::AxisConstraint& constraint) noexcept;
  void make_room() noexcept;
  void drop(std::size_t set) noexcept;
  void recall(std::size_t set) noexcept;
  void start_from_always(const std::vector<Wanted>& wanted) noexcept;
  void push_front(const std::vector<Wanted>& wanted) noexcept;
  void relate(std::size_t set, const std::vector<Wanted>& wanted) noexcept;
  void join_ranges(std::size_t set, const std::vector<Wanted>& wanted) noexcept;
  int match(std::size_t set, const Kept& kept, const std::vector<Wanted>& wanted) const noexcept;
  bool is_unchanged(std::size_t set, const Kept& kept, const Wanted& wanted) const noexcept;
  void fade(std::size_t set, Kept& kept, const Wanted* now) noexcept;
  const solver::AxisConstraint& put_last(std::size_t set, const Kept& kept) const noexcept {
    return sets_[set].constraints.constraints()[static_cast<std::size_t>(kept.place)];
  }
  const solver::AxisConstraint& fading(std::size_t set, const Kept& kept) const noexcept {
    return fading_[set][static_cast<std::size_t>(kept.fades)];
  }
  void find_entering(const std::vector<Wanted>& wanted) noexcept;
  void advance(double progress) noexcept;
  void renew_newest(const std::vector<Wanted>& wanted, const std::vector<int>& renewed) noexcept;
  void renew_before(std::size_t set, const std::vector<Wanted>& wanted) noexcept;
  void put_newest(const std::vector<Wanted>& wanted) noexcept;
  void put_before(std::size_t set, const std::vector<Wanted>& wanted) noexcept;
  void carry_on(const Kept& kept, const solver::AxisConstraint& before, const Wanted& to,
                double share) noexcept;
  void make_present(const Kept& kept, const Wanted& to, solver::AxisConstraint& c) const noexcept;
  static int add(BlendedSet& set, const solver::AxisConstraint& constraint, const InForce& source) noexcept;
  void stretch(Ranges entering, solver::AxisConstraint& c) const noexcept;
  void tighten(const solver::AxisConstraint& wanted, Ranges entering,
               solver::AxisConstraint& c) const noexcept;

  std::array<BlendedSet, most_sets> sets_;
  std::array<KeptList, most_sets> kept_;  ///< of each set; of the newest one by what is wanted
  /// The constraints of each set before that are no more what is wanted, as they were put last.
  std::array<std::vector<solver::AxisConstraint>, most_sets> fading_;
  std::array<double, most_sets> share_from_{};  ///< of each set when the blend began
  std::size_t count_ = 0;
  int most_kept_rows_;
  std::vector<char> taken_;       ///< by what is wanted
  std::vector<char> is_renewed_;  ///< the same
  std::vector<Ranges> carried_;   ///< by what is wanted: its ranges that a set has
  std::vector<Ranges> entering_;  ///< by what is wanted: its ranges that the set before did not have
  double duration_ = 0.0;
  double horizon_ = solver::limit_horizon;  ///< [s] of ranges that enter
  bool is_put_ = false;
};

}  // namespace zwang::runtime
