/// Every frame of a program: where it hangs, where it is now, and what conditions measure of its motion.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/solver/frame.hpp"

namespace zwang::runtime {

/// The frame that `parent` carries at `pose`.
ZWANG_EXPORT solver::AttachedFrame carried(const solver::AttachedFrame& parent,
                                           const solver::Pose& pose) noexcept;

class ZWANG_EXPORT FrameTable {
 public:
  /// Throws std::invalid_argument when a frame stands before its parent or on a body or signal
  /// that is not there.
  FrameTable(const std::vector<lang::FrameDeclaration>& declarations, const solver::Model& model,
             std::size_t signal_count);

  /// The function is asked of the frame: what it adds up, and the motion before, are kept. Allocates.
  void follow(const lang::ExpressionNode& call);
  /// Takes over the present state, which must stay as it is until the next one, dt [s] after the last one.
  void update(const solver::Model& model, const solver::State& state, double dt) noexcept;
  /// Moves the frames that hang on a pose signal to where `seen`, a frame in the world, has them: no motion.
  void feed(int signal, const solver::AttachedFrame& seen) noexcept;
  /// The same as their motion since the last tick.
  void carry_on(int signal, const solver::AttachedFrame& seen) noexcept;
  /// Gives a frame the pose that `source` has now; its parent stays. Frames that hang on it come along.
  void set(int frame, int source) noexcept;
  /// Sums start at 0 from here.
  void start_sums() noexcept;
  /// For an interruption: keeps the sums, and goes on from them.
  void keep_sums() noexcept;
  void resume_sums() noexcept;

  const solver::AttachedFrame& attached(int frame) const noexcept { return entry(frame).attached; }
  solver::Pose pose(int frame) const noexcept { return motions_.of(attached(frame)).pose; }
  /// SI, of a function that is followed; NaN otherwise.
  double measured(const lang::ExpressionNode& call) const noexcept;
  /// Of the bodies, at the present state.
  solver::BodyMotions& motions() const noexcept { return motions_; }
  /// The pose signal that the frame hangs on, over any number of frames; -1: none.
  int signal_of(int frame) const noexcept { return entry(frame).signal; }
  /// Counts how often the frame was set, itself or one that it hangs on.
  int settings_of(int frame) const noexcept { return entry(frame).settings; }

 private:
  struct Entry {
    lang::FrameParent parent = lang::FrameParent::world;
    int parent_index = -1;
    solver::Pose pose_in_parent;
    solver::AttachedFrame attached;
    int signal = -1;
    int settings = 0;
    int settings_above = 0;  ///< of the parent, when last looked at
  };
  /// A function of a frame.
  struct Followed {
    int frame = 0;
    int function = 0;
    solver::FrameMotion before, now;
    double sum = 0.0;
    double kept_sum = 0.0;
  };
  const Entry& entry(int frame) const noexcept { return entries_[static_cast<std::size_t>(frame)]; }
  void attach(Entry& entry) const noexcept;

  mutable solver::BodyMotions motions_;
  std::vector<Entry> entries_;
  std::vector<solver::AttachedFrame> signals_;
  std::vector<Followed> followed_;
  double dt_ = 0.0;  ///< [s]
};

}  // namespace zwang::runtime
