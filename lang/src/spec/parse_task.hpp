/// The parts of a task file below `tasks`.
#pragma once

#include "spec/shape.hpp"
#include "spec/task_file.hpp"

namespace zwang::lang {

/// `body` is what the task says: the entry's own value, or a template's body put in its place.
TaskText parse_task(const Entry& entry, const Node& body, Diagnostics& diagnostics);
/// `[exit, ..]`
std::vector<ExitText> parse_exits(const Node& node, Diagnostics& diagnostics);
std::vector<SignalText> parse_signals(const Node& node, Diagnostics& diagnostics);
std::vector<OutputText> parse_outputs(const Node& node, Diagnostics& diagnostics);
std::vector<RegionText> parse_regions(const Node& node, Diagnostics& diagnostics);
std::vector<FeatureText> parse_features(const Node& node, Diagnostics& diagnostics);
/// Paths, and the frames that they begin in: into `file.paths` and `file.frames`.
void parse_paths(const Node& node, TaskFile& file, Diagnostics& diagnostics);
/// `at`, and `yaw` or `rpy`; empty where not given. [m, rad]
void parse_pose(MapReader& map, std::vector<double>& at, std::vector<double>& rpy, Diagnostics& diagnostics);

/// A frame of a task file or of a robot file.
FrameText parse_frame(const Entry& entry, Diagnostics& diagnostics);
/// Where the frame lies in its parent.
solver::Pose pose_of(const FrameText& frame);

}  // namespace zwang::lang
