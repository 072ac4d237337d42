/// A checked task file as numbers: what the runtime runs. Everything is SI, every name an index, and every
/// part remembers the place in the text that it came from.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

/// A number, or a parameter's present value times a sign.
struct Value {
  double constant = 0.0;  ///< SI
  int parameter = -1;     ///< index into Program::parameters; -1 for a constant
  double sign = 1.0;

  double evaluate(const std::vector<double>& parameters) const {
    return parameter < 0 ? constant : sign * parameters[static_cast<std::size_t>(parameter)];
  }
};

struct ValueRange {
  Value low;
  Value high;
};

struct Parameter {
  std::string name;
  double value = 0.0;                  ///< SI
  std::optional<solver::Range> range;  ///< SI
  std::string unit;                    ///< as the author wrote it, for messages and reports
  double unit_scale = 1.0;             ///< SI value of one `unit`
  std::string help;
  Span span;
};

enum class FrameParent { world, body, frame };

/// Frame 0 is the world, then follow the frames of the robot, then the declared ones (parents before
/// children).
struct FrameDeclaration {
  std::string name;
  FrameParent parent = FrameParent::world;
  int parent_index = -1;  ///< body of the model, or index of the parent frame
  solver::Pose pose;      ///< in the parent
  Span span;
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
  int level = 1;
  Span span;                              ///< the axis's key
  std::array<Span, 4> statement_spans{};  ///< by solver::Quantity
};

struct Group {
  std::string name;
  int move = 0;  ///< frame
  int in = 0;    ///< frame
  std::vector<AxisStatements> axes;
  Span span;
};

enum class Op {
  constant,    ///< `number`
  parameter,   ///< `index`
  elapsed,     ///< [s] since the task was entered
  coordinate,  ///< `index` group, `axis` index into Group::axes, `what`
  speed,       ///< of the frame `index` [m/s]
  moved,       ///< length of the path of the frame `index` since the task was entered [m]
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

enum class CoordinateQuantity { position, velocity, force, residual, saturated };

/// A node of an expression tree. Operands stand before it in the list: `left`, `right` are their indices.
struct ExpressionNode {
  Op op = Op::constant;
  double number = 0.0;
  int index = -1;
  int axis = -1;
  CoordinateQuantity what = CoordinateQuantity::position;
  int left = -1;
  int right = -1;
};

/// A dimension-checked condition; the last node is its root.
struct Condition {
  std::vector<ExpressionNode> nodes;
  std::string text;  ///< as written
  Span span;
};

enum class TargetKind { task, back, done, failed };

struct Target {
  TargetKind kind = TargetKind::done;
  int task = -1;
};

/// `set: {frames.touch: base_link}` gives the frame the pose that `source` has now; `set: {params.push: 10
/// N}`.
struct SetAction {
  bool sets_frame = true;
  int index = -1;   ///< frame or parameter to set
  int source = -1;  ///< frame
  Value value;
  Span span;
};

struct Exit {
  Condition when;
  Value dwell;  ///< `for` [s]
  Target target;
  std::vector<SetAction> set;
  std::string note;
  Span span;
};

struct Timeout {
  Value after;  ///< [s]
  Target target;
  Span span;
};

struct Task {
  std::string name;
  std::string about;
  Value blend{.constant = 0.2};  ///< [s]
  std::vector<SetAction> set_on_entry;
  std::vector<Group> groups;
  std::vector<Exit> exits;
  std::optional<Timeout> timeout;  ///< none: `never`, or not written
  Span span;
};

struct Program {
  std::string path;
  std::string about;
  Robot robot;
  std::optional<Scene> scene;
  std::vector<Parameter> parameters;
  std::vector<FrameDeclaration> frames;
  std::vector<Task> tasks;
  int start = 0;

  std::vector<double> parameter_values() const {
    std::vector<double> values;
    for (const Parameter& p : parameters) values.push_back(p.value);
    return values;
  }
};

/// What the command line may put in the place of the file's own words.
struct LoadOptions {
  std::optional<std::filesystem::path> robot;
  std::optional<std::filesystem::path> scene;
  std::map<std::string, std::string> parameters;  ///< name -> quantity as text, `20 N`
  /// Robots, scenes and URDFs are read from below this folder only; none: the nearest parent of the task file
  /// with a `.zwang-root` file, else the task file's own folder.
  std::optional<std::filesystem::path> root;
};

/// read, parse, check, lower. On any error nullopt, and the diagnostics say why; warnings do not stop it.
std::optional<Program> load(const std::filesystem::path& path, const LoadOptions& options,
                            Diagnostics& diagnostics);

}  // namespace zwang::lang
