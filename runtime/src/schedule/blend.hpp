/// The constraints in force, and their way from one task's to the next one's.
///
/// At a switch every constraint in force is looked up among those of the new task by (moved frame, axes
/// frame, axis, level, kind of driver). Where it is found again it persists: its driver goes from the old to
/// the new one, and a bound that tightens does so at once while one that loosens goes there with the blend.
/// What is not found fades out from the alpha it has, what is new fades in. With p going from 0 to 1, what
/// leaves has alpha (1 - p) of what it had and what enters has p, so that nothing steps and the alphas sum to
/// at most 1, also when a switch comes in the middle of a blend.
#pragma once

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
  bool always = false;  ///< persists as itself, whatever the tasks say of its axis
  bool far = false;     ///< not in force now, though nothing was switched: a boundary out of reach
};

/// Most rows that a constraint can become.
int row_bound(const solver::AxisConstraint& constraint) noexcept;

class Blend {
 public:
  /// `force_scale` and `torque_scale` stand for an infinite bound while one fades: about what the motors can
  /// do. Of what leaves, the faintest is dropped when its rows exceed `leaving_row_capacity`.
  Blend(std::size_t most_wanted, int leaving_row_capacity, double force_scale, double torque_scale);

  /// Fades from what is in force to `wanted`, over `duration` [s]; 0 switches at once. `wanted` keeps its
  /// length until the next switch. `set`: as the last `put` left it.
  void start(const std::vector<Wanted>& wanted, double duration, const solver::ConstraintSet& set) noexcept;
  /// Whether nothing fades, and the last `put` says so: until what is wanted comes into reach or goes out of
  /// it, `renew` does what `put` would do.
  bool rests() const noexcept { return settled_ && is_put_; }
  /// Writes those of `wanted` that have new values, by their indices.
  void renew(const std::vector<Wanted>& wanted, const std::vector<int>& renewed,
             solver::ConstraintSet& set) const noexcept;
  /// Puts the constraints in force at `progress` (0 to 1, > 0) into `set`.
  void put(const std::vector<Wanted>& wanted, double progress, solver::ConstraintSet& set,
           std::vector<InForce>& in_force) noexcept;

  std::size_t capacity() const noexcept { return parts_.capacity(); }

 private:
  /// One bit a quantity.
  using Ranges = unsigned;
  struct Part {
    solver::AxisConstraint old;      ///< as it was when the blend began
    solver::AxisConstraint present;  ///< as it was put last; until a switch asks, only the set may know
    int place = -1;                  ///< in the set, as of the last tick; -1: not in force
    Origin origin;
    FrameKey move, in;
    bool always = false;
    bool far = false;
    int wanted = -1;  ///< index of what it becomes; -1: it leaves
    bool drives = false;
    bool persists = false;  ///< its driver and its ranges start from `old`
    Ranges ranges = 0;      ///< those of the wanted constraint that this part carries
    double alpha_from = 0.0;
    bool entering = false;
  };

  static Part part_of(const std::vector<Wanted>& wanted, int index) noexcept;
  void settle(const std::vector<Wanted>& wanted) noexcept;
  void recall(const solver::ConstraintSet& set) noexcept;
  void recall_what_goes_far(const std::vector<Wanted>& wanted, const solver::ConstraintSet& set) noexcept;
  void add_entering(const std::vector<Wanted>& wanted, int index, bool drives, Ranges ranges) noexcept;
  void add_persisting(const std::vector<Wanted>& wanted, int index, const Part& from, bool drives,
                      Ranges ranges) noexcept;
  void add_leaving(const Part& from, bool drives, Ranges ranges) noexcept;
  void add(const Part& part) noexcept;
  void join(const std::vector<Wanted>& wanted, int index, const Part& from) noexcept;
  static bool is_match(const Part& part, const Wanted& wanted) noexcept;
  int match(const Wanted& wanted) const noexcept;
  void make_room() noexcept;
  void fade(const Part& part, double progress, solver::AxisConstraint& c) const noexcept;
  solver::Range loosened(const solver::Range& from, const solver::Range& to, double progress,
                         double scale) const noexcept;

  std::vector<Part> parts_;
  std::vector<Part> before_;
  std::vector<char> taken_;
  int leaving_row_capacity_;
  double force_scale_;
  double torque_scale_;
  double duration_ = 0.0;
  bool settled_ = true;  ///< nothing fades: one part for each that is wanted, in their order
  bool is_put_ = false;  ///< the parts, as they are
};

}  // namespace zwang::runtime
