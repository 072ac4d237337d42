/// The pose of one frame in another, from the transforms that ROS 2 nodes publish.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "message.hpp"
#include "sender.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::connect {

/// Keeps the newest transform of each frame, and multiplies those between `child` and its ancestor `parent`.
/// Any thread may call it.
class TransformChain {
 public:
  struct Found {
    double stamp = 0.0;  ///< [s] of the moving transform that is nearest to `child`
    solver::Pose pose;   ///< X_parent_child
  };
  enum class Verdict {
    taken,
    of_another,  ///< of another publisher than the one that tells of this frame
    bad,         ///< numbers that cannot be
  };

  TransformChain(std::string parent, std::string child);

  /// `is_static`: it came on /tf_static, and holds at every time. `arrival` [s].
  Verdict take(const TransformStamped& transform, bool is_static, const Sender& sender, double arrival);
  /// The pose, if something has changed since the last call, and the frames are linked.
  std::optional<Found> find();

  static constexpr std::size_t most_frames = 1000;  ///< those beyond are not kept

 private:
  struct Link {
    std::string parent;
    double stamp = 0.0;
    bool is_static = false;
    solver::Pose pose;
    OnePublisher publisher;
  };

  std::mutex mutex_;
  std::string parent_, child_;
  std::map<std::string, Link> links_;  ///< by the frame that each places
  bool is_changed_ = false;
};

/// The pose behind position and quaternion; nullopt for an invalid rotation and for non-finite numbers.
std::optional<solver::Pose> pose_of(const PoseFields& fields);

}  // namespace zwang::connect
