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
enum Topic : std::size_t { transforms, fixed_transforms, scene, log, forces };
std::vector<LogChannel> channels();

/// `time` [s] since the start of the clock that the run accepts.
nlohmann::ordered_json stamp(double time);
/// Puts transforms together, as text: 50 messages a second through objects of JSON took a quarter of the
/// log's processor time. Keeps its memory from message to message.
class TransformsText {
 public:
  void begin(double time);
  void add(std::string_view parent, std::string_view child, const solver::Pose& pose);
  const std::string& end();

 private:
  std::string text_, stamp_;
};
nlohmann::ordered_json log_message(double time, Level level, const std::string& message,
                                   const std::string& name);

/// What an object presses on the robot with.
struct ForceArrow {
  std::string object;
  solver::Vector3 at = solver::Vector3::Zero();  ///< [m] in the world
  double heading = 0.0;                          ///< [rad] of the force on the robot
  double force = 0.0;                            ///< [N]
};
/// [m] A length that grows as the logarithm: 1 N is seen, 1 kN stays in the picture. The page draws the same
/// (`forceLength` of web/src/world.ts).
double length_of_force(double force);
/// All arrows at a time, in the place of those before: a viewer that jumps to a time sees the last message
/// alone, and none that is over.
nlohmann::ordered_json forces_update(double time, const std::vector<ForceArrow>& arrows);
/// How high above the floor the bumper of the robot meets what stands there. [m]
double height_of_contact(const lang::Robot& robot);

/// The frame of a scene's object or robot. No link can have this name.
std::string frame_of(const std::string& object);
/// One entity for each link, object, robot and region, in its own frame. They stay until the end of the log.
nlohmann::ordered_json scene_update(double time, const lang::Program& program);

}  // namespace zwang::runtime::foxglove
