/// Every frame of a program: where it hangs, where it is now, and how far it has come.
#pragma once

#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/solver/frame.hpp"

namespace zwang::runtime {

/// The frame that `parent` carries at `pose`.
solver::AttachedFrame carried(const solver::AttachedFrame& parent, const solver::Pose& pose) noexcept;

class FrameTable {
 public:
  /// Throws std::invalid_argument when a frame stands before its parent or on a body or signal
  /// that is not there.
  FrameTable(const std::vector<lang::FrameDeclaration>& declarations, const solver::Model& model,
             std::size_t signal_count);

  /// `moved` is asked of this frame: its path is measured.
  void follow(int frame) noexcept { entries_[static_cast<std::size_t>(frame)].is_followed = true; }
  /// Takes over the present state, which must stay as it is until the next one, and lengthens the paths.
  void update(const solver::Model& model, const solver::State& state) noexcept;
  /// Moves the frames that hang on a pose signal to where `seen`, a frame in the world, has them.
  void feed(int signal, const solver::AttachedFrame& seen) noexcept;
  /// Gives a frame the pose that `source` has now; its parent stays. Frames that hang on it come along.
  void set(int frame, int source) noexcept;
  /// Paths are measured from here.
  void start_paths() noexcept;
  /// For an interruption: keeps the paths' lengths, and goes on from them.
  void keep_paths() noexcept;
  void resume_paths() noexcept;

  const solver::AttachedFrame& attached(int frame) const noexcept { return entry(frame).attached; }
  solver::Pose pose(int frame) const noexcept { return motions_.of(attached(frame)).pose; }
  double speed(int frame) const noexcept { return motions_.of(attached(frame)).linear.norm(); }  ///< [m/s]
  double moved(int frame) const noexcept { return entry(frame).path; }                           ///< [m]
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
    bool is_followed = false;
    int signal = -1;
    int settings = 0;
    int settings_above = 0;  ///< of the parent, when last looked at
    double path = 0.0;
    double kept_path = 0.0;
    solver::Vector3 path_end = solver::Vector3::Zero();
  };
  const Entry& entry(int frame) const noexcept { return entries_[static_cast<std::size_t>(frame)]; }
  void attach(Entry& entry) const noexcept;

  mutable solver::BodyMotions motions_;
  std::vector<Entry> entries_;
  std::vector<solver::AttachedFrame> signals_;
};

}  // namespace zwang::runtime
