/// The names that a study can draw, their dimensions, and the places of the drawn values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario_file.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::lang {

/// The part of a run that a draw sets.
enum class DrawnPart {
  parameter,
  start,  ///< x, y, yaw
  onset,  ///< of the faults of a set
  robot,  ///< how the simulated robot differs from the one that the task knows
  floor,
  thing,  ///< an object or another robot of the scene
  state,  ///< what the robot is told of itself
  signal,
};

/// `scene.wall.stiffness` in its parts.
struct Drawable {
  DrawnPart part = DrawnPart::parameter;
  std::string owner;  ///< `wall`
  std::string key;    ///< `stiffness`
  Dimension dimension{};
  bool is_factor_only = false;  ///< nobody says an absolute value
  bool can_be_factor = false;
};

/// By the shape of the name alone, without its dimension.
std::optional<Drawable> drawable_named(const std::string& name);
/// nullopt where nothing of this name is in the scenario and its program.
std::optional<Drawable> find_drawable(const std::string& name, const ScenarioFile& file,
                                      const Program& program);
/// All names that `find_drawable` knows, for messages.
std::vector<std::string> drawable_names(const ScenarioFile& file, const Program& program);

/// Why a name that an object or a signal could have cannot be drawn of this one; nullopt of other names.
std::optional<std::string> missing_number(const std::string& name, const Program& program);

/// Before the task is read. `start_at` is where the cell starts, where it does not say so itself.
void put_before(const Draw& draw, double value, const std::array<double, 2>& start_at, ScenarioCell& cell);
/// A value that cannot be.
struct BadValue {
  std::string why, help;
};
/// Into what was read, and into how the cell's robot differs from it. nullopt, or why the value cannot be.
std::optional<BadValue> put_after(const Draw& draw, double value, Program& program, ScenarioCell& cell);

}  // namespace zwang::lang
