/// Every frame of a program: where it hangs, where it is now, and how far it has come.
#pragma once

#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::runtime {

class FrameTable {
 public:
  /// Throws std::invalid_argument when a frame stands before its parent or on a body that is not there.
  FrameTable(const std::vector<lang::FrameDeclaration>& declarations, const solver::Model& model);

  /// Takes over the present motion, and lengthens the paths.
  void update(const solver::Model& model, const solver::State& state) noexcept;
  /// Gives a frame the pose that `source` has now; its parent stays. Frames that hang on it come along.
  void set(int frame, int source, const solver::Model& model, const solver::State& state) noexcept;
  /// Paths are measured from here.
  void start_paths() noexcept;

  const solver::AttachedFrame& attached(int frame) const noexcept { return entry(frame).attached; }
  const solver::Pose& pose(int frame) const noexcept { return entry(frame).motion.pose; }
  double speed(int frame) const noexcept { return entry(frame).motion.linear.norm(); }  ///< [m/s]
  double moved(int frame) const noexcept { return entry(frame).path; }                  ///< [m]

 private:
  struct Entry {
    lang::FrameParent parent;
    int parent_index;
    solver::Pose pose_in_parent;
    solver::AttachedFrame attached;
    solver::FrameMotion motion;
    double path = 0.0;
    solver::Vector3 path_end = solver::Vector3::Zero();
  };
  const Entry& entry(int frame) const noexcept { return entries_[static_cast<std::size_t>(frame)]; }
  void attach(Entry& entry) const noexcept;

  std::vector<Entry> entries_;
};

}  // namespace zwang::runtime
