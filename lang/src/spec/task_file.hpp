/// A task file as its author wrote it: words and quantities, nothing looked up yet.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "spec/expression.hpp"
#include "spec/value.hpp"
#include "tree/read.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

inline constexpr std::size_t most_tasks = 256;
inline constexpr std::size_t most_groups = 32;  ///< of a task

struct ParameterText {
  Word name;
  ValueText value;
  std::optional<StatementText> range;
  std::string help;
};

struct FrameText {
  Word name;
  Word parent;
  std::vector<double> at;   ///< [m]
  std::vector<double> rpy;  ///< [rad]
  Span span;
  bool is_path = false;  ///< the one that a path of this name begins in
};

struct SignalText {
  Word name;
  Word type;
  SignalTwist twist = SignalTwist::none;
  double twist_window = 0.0;  ///< [s]
  Span twist_span{};
  std::optional<Unit> unit;  ///< of a number
  Word in;
  std::optional<ValueText> stale_after;
  Word holds;  ///< a frame of the base, of a bool
  bool is_bad = false;
};

struct OutputText {
  Word name;
  bool is_number = false;
  std::optional<Unit> unit;              ///< of a number
  std::optional<ValueText> start, stop;  ///< true and false, too, are names here
  bool keeps = false;                    ///< `stop: keep`
  bool is_bad = false;
};

struct RegionText {
  Word name;
  Word parent;                                 ///< empty: the world
  std::vector<std::array<double, 2>> polygon;  ///< [m]
  std::array<double, 2> centre{};              ///< [m]
  double radius = 0.0;                         ///< [m]
};

/// A frame, or one of its axes: `hook`, `hook.x`.
struct FeatureText {
  Word name;
  FeatureKind kind = FeatureKind::distance;
  Word first, second;
  std::optional<solver::Axis> first_axis, second_axis;
  std::array<double, 6> direction{};
  bool is_bad = false;
};

/// The quantities that an axis may state, each once.
inline constexpr std::array quantities_of_axis{solver::Quantity::position, solver::Quantity::velocity,
                                               solver::Quantity::acceleration, solver::Quantity::force};

struct AxisText {
  Word name;  ///< x, y, z, rx, ry, rz, speed, plane; of a feature the group's name
  bool is_free = false;
  std::array<std::optional<StatementText>, 4> statements;  ///< by solver::Quantity
  std::optional<ValueText> time_constant, stiffness, damping, weight, return_speed, build_up;
  std::optional<ConditionText> yield;  ///< with `mass`, `damping` and perhaps `dead_band`
  std::optional<ValueText> mass, dead_band;
  Span yield_span{};  ///< its key
  std::optional<int> level;

  bool is_speed() const { return name.text == "speed"; }
  bool is_plane() const { return name.text == "plane"; }
  /// Stands for norms in the plane of x and y.
  bool is_norm() const { return is_speed() || is_plane(); }
  const std::optional<StatementText>& operator[](solver::Quantity q) const {
    return statements[static_cast<std::size_t>(q)];
  }
};

struct GroupText {
  Word name;
  GroupKind kind = GroupKind::axes;
  Word move;
  Word in;
  Word region;   ///< of `inside`
  Word feature;  ///< of a feature group
  std::vector<AxisText> axes;
  std::optional<ValueText> time_constant, weight, margin, return_speed;
  std::optional<int> level;
  bool is_incomplete = false;  ///< a key could not be read: what the group lacks may have been there
};

struct SetText {
  SetKind kind = SetKind::frame;
  Word name;
  Word source;      ///< of a frame
  ValueText value;  ///< of a parameter or an output
  Span span;
};

struct ExitText {
  ConditionText when;
  std::optional<ValueText> dwell;  ///< `for`
  std::optional<ValueText> release;
  Word target;
  std::vector<SetText> set;
  std::string note;
  Span span;
  bool is_incomplete = false;  ///< a key could not be read: what the exit lacks may have been there
};

struct TimeoutText {
  bool is_never = false;
  ValueText after;
  Word target;
  std::string note;
  Span span;
};

struct AttemptsText {
  int most = 1;
  Word target;
  std::string note;
  Span span;
};

struct TaskText {
  Word name;
  std::string about;
  std::optional<ConditionText> require;
  std::optional<AttemptsText> attempts;
  std::optional<ValueText> blend;
  std::vector<SetText> set_on_entry;
  std::vector<GroupText> groups;
  std::vector<ExitText> exits;
  std::optional<TimeoutText> timeout;
  bool is_bad = false;  ///< what the task says could not be read at all
};

/// A name that a use of a template gives for an argument.
struct NamedArgument {
  Word name;
  std::string argument;
  std::string kind;  ///< frame, task, feature, signal or region
};

struct TaskFile {
  Word robot;
  Word scene;
  std::string about;
  std::vector<ParameterText> parameters;
  std::vector<FrameText> frames;
  std::vector<SignalText> signals;
  std::vector<OutputText> outputs;
  std::vector<RegionText> regions;
  std::vector<FeatureText> features;
  std::vector<Path> paths;  ///< the frame of each is among `frames`, by its name; no pieces: it is bad
  std::vector<GroupText> always_groups;
  std::vector<ExitText> always_exits;
  Word start;
  std::vector<TaskText> tasks;
  std::vector<NamedArgument> named_arguments;
  bool is_incomplete = false;  ///< a section has a misspelt name: what it would declare is not known
};

const char* word_of(solver::Quantity quantity);
std::optional<solver::Axis> axis_named(std::string_view name);
bool is_rotation(solver::Axis axis);
/// The dimension of a statement about `quantity` of the axis.
Dimension dimension_of(solver::Axis axis, solver::Quantity quantity);

/// The shape of a task file: keys, kinds, quantities with units. nullopt: it is no task file at all. Parts
/// with errors are left out or marked bad.
std::optional<TaskFile> parse(const Document& document, Diagnostics& diagnostics);

}  // namespace zwang::lang
