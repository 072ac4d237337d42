/// A checked task file as numbers: what the runtime runs. Everything is SI, every name an index, and every
/// part remembers the place in the text that it came from.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/path.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

/// A number, or a parameter's present value times a sign.
struct Value {
  double constant = 0.0;  ///< SI
  int parameter = -1;     ///< index into Program::parameters; -1 for a constant
  double sign = 1.0;
  int signal = -1;  ///< index of a number signal that gives the value instead; -1: none

  double evaluate(const std::vector<double>& parameters) const {
    return parameter < 0 ? constant : sign * parameters[static_cast<std::size_t>(parameter)];
  }
};

/// Both ends of a range; they may be parameters.
struct ValueRange {
  Value low;
  Value high;
};

/// A value of the task file that can be set before and during a run.
struct Parameter {
  std::string name;
  double value = 0.0;                  ///< SI
  std::optional<solver::Range> range;  ///< SI
  std::string unit;                    ///< as the author wrote it, for messages and reports
  double unit_scale = 1.0;             ///< SI value of one `unit`
  std::string help;
  Span span;
};

/// The kind of thing that a frame hangs on.
enum class FrameParent { world, body, frame, signal };

/// Frame 0 is the world, then follow the frames of the robot, then the declared ones (parents before
/// children).
struct FrameDeclaration {
  std::string name;
  FrameParent parent = FrameParent::world;
  int parent_index = -1;  ///< body of the model, index of the parent frame, or of the pose signal
  solver::Pose pose;      ///< in the parent
  Span span;
};

enum class SignalType { boolean, number, pose, wrench };

/// One number of a wrench: a force along an axis, a torque about it, or the norm of x and y.
enum class WrenchPart { x, y, z, rx, ry, rz, plane };

/// How what a pose signal sees goes on between two samples.
enum class SignalTwist {
  none,      ///< it stands where it was seen; a sample's own twist counts as its velocity
  measured,  ///< with the twist of its last sample
  fitted,    ///< along the line through the samples of the last `twist_window`
};

/// A value that is measured outside of zwang.
struct Signal {
  std::string name;
  SignalType type = SignalType::boolean;
  double unit_scale = 1.0;      ///< SI value of one unit of a number signal
  bool measures_force = false;  ///< a number signal whose unit is that of a force
  int in = 0;                   ///< frame that a pose or a wrench is seen from
  Value stale_after;            ///< [s] the age at which it counts as invalid
  SignalTwist twist = SignalTwist::none;
  double twist_window = 0.0;  ///< [s] of a twist that is fitted
  /// Of a latch: while it is true, the frame of the base that does not move in the world. -1: none.
  int holds = -1;
  Span span;
};

/// An output of the robot besides its motion: a gripper, a lamp. Tasks set it, and the host carries it out.
struct Output {
  std::string name;
  bool is_number = false;      ///< else true or false: 1 or 0
  double unit_scale = 1.0;     ///< SI value of one unit of a number
  std::string unit;            ///< as the author wrote it
  double start = 0.0;          ///< SI
  std::optional<double> stop;  ///< SI, from the end of the run or a stop on; none: what it was
  Span span;
};

/// A stretch of floor: a polygon that need not be convex, or a circle.
struct Region {
  std::string name;
  int parent = 0;                              ///< frame
  std::vector<std::array<double, 2>> polygon;  ///< [m] corners in the parent, counter-clockwise
  std::array<double, 2> centre{};              ///< [m] of a circle, in the parent
  double radius = 0.0;                         ///< [m] 0: a polygon
  Span span;
};

enum class FeatureKind { distance, angle, direction, bearing };

/// A coordinate that is not an axis of one frame.
struct Feature {
  std::string name;
  FeatureKind kind = FeatureKind::distance;
  /// Frames: the two ends, the two owners of the axes, `move` and `in`, or who looks and what is looked at.
  int first = 0, second = 0;
  solver::Axis first_axis = solver::Axis::x, second_axis = solver::Axis::x;  ///< of an angle: x, y or z
  std::array<double, 6> direction{};  ///< coefficients of x, y, z, rx, ry, rz, as written
  bool turns = false;                 ///< measured in rad rather than in m
  Span span;
};

/// The operation of a node of a condition.
enum class Op {
  constant,          ///< `number`
  parameter,         ///< `index`
  elapsed,           ///< [s] since the task was entered
  coordinate,        ///< `index` group, `axis` index into Group::axes, `what`
  of_frame,          ///< `function` of the frame `index`
  of_task,           ///< `function` of the task `index`
  signal,            ///< `index`: a number in SI, or true and false; of a wrench its part `axis`
  valid,             ///< whether the signal `index` is fresh
  output,            ///< `index`: a number in SI, or true and false
  feature,           ///< `index`
  estimated_force,   ///< on the base at its origin along its axis `axis`: 0 x, 1 y [N], 2 rz [N m]
  estimated_wrench,  ///< on the frame `index` at its origin, in its axes: the part `axis`
  abs,
  negate,
  add,
  subtract,
  multiply,
  divide,
  less,
  less_equal,
  greater,
  greater_equal,
  logical_and,
  logical_or,
  logical_not,
};

/// The value of an axis that a condition asks for. SI
enum class CoordinateQuantity { position, velocity, force, residual, saturated };

/// A node of an expression tree. Operands stand before it in the list: `left`, `right` are their indices.
struct ExpressionNode {
  Op op = Op::constant;
  double number = 0.0;
  int index = -1;
  int axis = -1;           ///< of a wrench a WrenchPart
  int function = -1;       ///< index into `condition_functions()`
  bool in_always = false;  ///< the group `index` is one of Program::always, not of the task
  CoordinateQuantity what = CoordinateQuantity::position;
  int left = -1;
  int right = -1;
};

/// An operand of `and`, `or` and `not`: a comparison, or a name that is true or false.
struct ConditionTerm {
  int node = -1;     ///< index into Condition::nodes
  std::string text;  ///< as written, in one line
  std::string unit;  ///< SI, of what it compares; empty of a pure number and of a name
};

/// A dimension-checked condition, or an expression that has a value; the last node is its root.
struct Condition {
  std::vector<ExpressionNode> nodes;
  std::vector<ConditionTerm> terms;  ///< in the order of the text
  std::string text;                  ///< as written
  Span span;
};

/// Where a position range or a region gives no `return`. [m/s] or [rad/s]
inline constexpr double default_return_speed = 0.1;

/// A driver that gives way to a force like a mass with a damper: dds = (F~ - D ds)/M. F~ is the part of F
/// beyond the dead band.
struct Yield {
  Condition force;  ///< F, an expression [N] or [N m]
  Value mass;       ///< M [kg] or [kg m^2]
  Value damping;    ///< D [N s/m] or [N m s/rad]
  Value dead_band;  ///< [N] or [N m]
};

/// The statements about one axis of a group.
struct AxisStatements {
  std::string name;  ///< "contact.x"
  solver::Axis axis = solver::Axis::x;
  std::optional<solver::Quantity> driver;
  Value target;
  bool here = false;  ///< a position driver at the value it has on entry
  std::optional<ValueRange> position, velocity, acceleration, force;
  Value time_constant{.constant = 0.5};
  std::optional<Value> stiffness;  ///< of a position driver with `damping` [N/m] or [N m/rad]
  std::optional<Value> damping;    ///< [N s/m] or [N m s/rad]
  std::optional<Yield> yield;      ///< its `driver` is an acceleration, without `target`
  /// Of a driver of position or velocity: the time in which it adds its error once more to its target. [s]
  std::optional<Value> build_up;
  std::optional<Value> weight;  ///< of a soft row [kg] or [kg m^2]; none: as strict as the others
  /// Of a position range: how fast the axis comes back from outside of it [m/s] or [rad/s].
  Value return_speed{.constant = default_return_speed};
  int level = 1;
  bool is_planar = false;                 ///< `speed`: the range `velocity` is for the planar velocity's norm
  Span span;                              ///< the axis's key
  std::array<Span, 4> statement_spans{};  ///< by solver::Quantity
};

enum class GroupKind {
  axes,    ///< statements about axes of `move` in `in`
  inside,  ///< `move` stays inside `region`
  feature  ///< statements about `feature`: one entry of `axes`, whose `axis` means nothing
};

/// The statements about one moved frame.
struct Group {
  std::string name;
  int move = 0;   ///< frame
  int in = 0;     ///< frame
  int path = -1;  ///< of axes: the path that they are measured along, in its frame `in`; -1: those of `in`
  std::vector<AxisStatements> axes;
  GroupKind kind = GroupKind::axes;
  int region = -1;               ///< of `inside`: index into Program::regions
  bool moves_footprint = false;  ///< of `inside`: the robot's whole footprint rather than the point `move`
  Value margin;                  ///< [m] of `inside`
  Value return_speed{.constant = default_return_speed};  ///< [m/s] of `inside`: of the way back into it
  int level = 1;                                         ///< of `inside`
  int feature = -1;                                      ///< index into Program::features; -1: none
  Span span;
};

enum class TargetKind { task, back, done, failed };

/// The end of an exit, of a timeout or of attempts.
struct Target {
  TargetKind kind = TargetKind::done;
  int task = -1;  ///< index into Program::tasks; -1: none
};

enum class SetKind { frame, parameter, output };

/// `set: {frames.touch: base_link}` gives the frame the pose that `source` has now; `set: {params.push: 10
/// N}` and `set: {outputs.gripper: true}` give a value.
struct SetAction {
  SetKind kind = SetKind::frame;
  int index = -1;   ///< what is set: index into the program's frames, parameters or outputs
  int source = -1;  ///< frame
  Value value;      ///< of a parameter or an output
  Span span;
};

/// A condition, and the target of the run once it has held for `dwell`.
struct Exit {
  Condition when;
  Value dwell;                   ///< `for` [s]
  std::optional<Value> release;  ///< once true, the comparison stays true until its left side passes this
  Target target;
  std::vector<SetAction> set;
  std::string note;
  Span span;
};

/// The target of the run once the task has lasted for `after`.
struct Timeout {
  Value after;  ///< [s]
  Target target;
  std::string note;
  Span span;
};

/// Entry number `most` + 1 since the start goes to `target` instead.
struct Attempts {
  int most = 1;
  Target target;
  std::string note;
  Span span;
};

/// The section that holds in every task: groups at level 0 and exits that interrupt.
struct Always {
  std::vector<Group> groups;
  std::vector<Exit> exits;
};

/// Groups with exits, and the actions on entry.
struct Task {
  std::string name;
  std::string about;
  std::optional<Condition> require;  ///< must be true on entry
  std::optional<Attempts> attempts;
  Value blend{.constant = 0.2};  ///< [s]
  std::vector<SetAction> set_on_entry;
  std::vector<Group> groups;
  std::vector<Exit> exits;
  std::optional<Timeout> timeout;  ///< none: `never`, or not written
  Span span;
};

/// A whole checked task file. Indices count from 0, in the lists of this struct.
struct Program {
  std::string path;
  std::string about;
  Robot robot;
  std::optional<Scene> scene;
  std::vector<Parameter> parameters;
  std::vector<FrameDeclaration> frames;
  std::vector<Signal> signals;
  std::vector<Output> outputs;
  std::vector<Region> regions;
  std::vector<Feature> features;
  std::vector<Path> paths;
  Always always;
  std::vector<Task> tasks;
  int start = 0;  ///< index into `tasks`

  /// The declared values, SI, parallel to `parameters`.
  std::vector<double> parameter_values() const {
    std::vector<double> values;
    for (const Parameter& p : parameters) values.push_back(p.value);
    return values;
  }
};

/// How the robot stands before anything moves: its joints in their posture, the base where the scene has it.
ZWANG_EXPORT solver::State start_state(const Robot& robot, const std::optional<Scene>& scene);

/// Options of the command line that replace words of the file.
struct LoadOptions {
  std::optional<std::filesystem::path> robot;
  std::optional<std::filesystem::path> scene;
  std::map<std::string, std::string> parameters;  ///< name -> quantity as text, `20 N`
  std::vector<GivenParameter> given;              ///< the same, where a scene says so
  /// Robots, scenes and URDFs are read from below this folder only. None: the nearest parent of the task file
  /// with a `.zwang-root` file, else the task file's own folder.
  std::optional<std::filesystem::path> root;
};

/// read, parse, check, lower. On any error nullopt, and the diagnostics say why; warnings do not stop it.
ZWANG_EXPORT std::optional<Program> load(const std::filesystem::path& path, const LoadOptions& options,
                                         Diagnostics& diagnostics);

}  // namespace zwang::lang
