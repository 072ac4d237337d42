/// The messages of Foxglove's schemas that a log has, as JSON (https://docs.foxglove.dev/docs/sdk/schemas).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/log_channels.hpp"

namespace zwang::runtime::foxglove {

enum class Level { unknown = 0, debug = 1, info = 2, warning = 3, error = 4 };

/// Topics and schemas, in the order of `Topic`.
enum Topic : std::size_t { transforms, fixed_transforms, scene, log };
std::vector<LogChannel> channels();

/// `time` [s] since the begin of the clock that the run accepts.
nlohmann::ordered_json stamp(double time);
nlohmann::ordered_json transform(double time, const std::string& parent, const std::string& child,
                                 const solver::Pose& pose);
nlohmann::ordered_json log_message(double time, Level level, const std::string& message,
                                   const std::string& name);

/// The frame of a scene's object or robot. No link can have this name.
std::string frame_of(const std::string& object);
/// One entity for each link, object, robot and region, in its own frame. They stay until the end of the log.
nlohmann::ordered_json scene_update(double time, const lang::Program& program);

}  // namespace zwang::runtime::foxglove
