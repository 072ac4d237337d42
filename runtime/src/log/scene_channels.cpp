// Where everything stands and what happens, as messages beside the records of a log.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "log/contact_place.hpp"
#include "log/foxglove.hpp"
#include "log/pace.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime {

namespace {

using foxglove::Level;
using nlohmann::ordered_json;
using solver::Pose;
using solver::Vector3;

constexpr double transforms_every = 0.02;  // [s]
constexpr const char* world = "world";

std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// How high the base's origin is above the floor on which its wheels stand. [m]
double height_of(const lang::Robot& robot) {
  const std::vector<solver::Body>& bodies = robot.model.bodies();
  double height = 0.0;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    double z = 0.0;
    for (auto b = static_cast<std::size_t>(wheel.body); b > 0; b = static_cast<std::size_t>(bodies[b].parent))
      z += bodies[b].pose_in_parent.position.z();
    height = std::max(height, wheel.radius - z);
  }
  return height;
}

class SceneChannels : public LogChannels {
 public:
  explicit SceneChannels(const lang::Program& program)
      : program_(program), channels_(foxglove::channels()), height_(height_of(program.robot)) {}

  const std::vector<LogChannel>& channels() const override { return channels_; }

  void open(const std::vector<Column>& columns) override {
    columns_ = columns;
    const std::string base = place_of("truth.base.x") < columns_.size() ? "truth.base" : "base";
    base_ = places_of(base);
    lean_ = {place_of(base + ".roll"), place_of(base + ".pitch")};
    for (int j = 0; j < program_.robot.model.joint_count(); ++j)
      joints_.push_back(place_of(program_.robot.model.joint(j).name + ".q"));
    if (program_.scene) {
      const double height = foxglove::height_of_contact(program_.robot);
      for (const lang::SceneObject& object : program_.scene->objects) {
        add_mover(object.name);
        add_touched(object.name, planar(object.at[0], object.at[1], object.yaw),
                    touched_outline(object, height));
      }
      for (const lang::SceneRobot& robot : program_.scene->robots) {
        add_mover(robot.name);
        if (robot.program)
          add_touched(robot.name, planar(robot.at[0], robot.at[1], robot.yaw),
                      robot.program->robot.footprint);
      }
    }
    for (const char* name : {"task", "event", "event.signal", "switch", "switch.exit", "switch.refusal"})
      words_.push_back(place_of(name));
  }

  void take(std::span<const double> values, const Put& put) override {
    time_ = values.front();
    if (!has_begun_) {
      put(foxglove::fixed_transforms, fixed_transforms());
      put(foxglove::scene, text_of(foxglove::scene_update(time_, program_)));
    }
    has_begun_ = true;
    if (pace_.is_due(time_)) {
      put(foxglove::transforms, moving_transforms(values));
      tell_forces(values, put);
    }
    tell_task(values, put);
    tell_event(values, put);
  }

  void conclude(const std::map<std::string, std::string>& facts, const Put& put) override {
    const auto outcome = facts.find("outcome");
    if (outcome == facts.end()) return;
    const auto report = facts.find("report");
    const ordered_json json =
        report == facts.end() ? ordered_json() : ordered_json::parse(report->second, nullptr, false);
    const bool has_verdict = json.is_object() && json.contains("verdict") && json["verdict"].is_string();
    const Level level = outcome->second == "done" ? Level::info : Level::error;
    tell(level, has_verdict ? json["verdict"].get<std::string>() : outcome->second, "run", put);
  }

 private:
  /// The columns of x, y and yaw.
  using Places = std::array<std::size_t, 3>;
  struct Mover {
    std::string name;
    Places places;
  };

  /// What the plant measures a force at.
  struct Touched {
    std::string name;
    std::size_t force;
    Places places;
    Pose pose;  ///< of one that stays
    std::vector<Vector3> outline;
  };

  std::size_t place_of(const std::string& name) const {
    const auto found =
        std::ranges::find_if(columns_, [&](const Column& column) { return column.name == name; });
    return static_cast<std::size_t>(found - columns_.begin());
  }
  Places places_of(const std::string& name) const {
    return {place_of(name + ".x"), place_of(name + ".y"), place_of(name + ".yaw")};
  }
  void add_mover(const std::string& name) {
    const Places places = places_of("truth." + name);
    if (places[0] < columns_.size()) movers_.push_back({name, places});
  }
  void add_touched(const std::string& name, const Pose& pose, const std::vector<Vector3>& outline) {
    const std::size_t force = place_of("truth." + name + ".force");
    if (force < columns_.size() && outline.size() > 2 && program_.robot.footprint.size() > 2)
      touched_.push_back({name, force, places_of("truth." + name), pose, outline});
  }
  /// Zero where it is blank or not logged.
  static double value(std::span<const double> values, std::size_t place) {
    return place < values.size() && std::isfinite(values[place]) ? values[place] : 0.0;
  }
  std::string word(std::span<const double> values, std::size_t place) const {
    if (place >= values.size() || !(values[place] >= 0.0)) return "";
    const auto index = static_cast<std::size_t>(values[place]);
    return index < columns_[place].words.size() ? columns_[place].words[index] : "";
  }

  const std::string& moving_transforms(std::span<const double> values) {
    transforms_.begin(time_);
    const std::vector<solver::Body>& bodies = program_.robot.model.bodies();
    Pose base;
    base.position = {value(values, base_[0]), value(values, base_[1]), height_};
    base.rotation =
        solver::rotation_from_rpy(value(values, lean_[0]), value(values, lean_[1]), value(values, base_[2]));
    transforms_.add(world, bodies[0].name, base);
    for (std::size_t b = 1; b < bodies.size(); ++b) {
      const solver::Body& body = bodies[b];
      const double q = value(values, joints_[b - 1]);
      Pose pose = body.pose_in_parent;
      if (body.joint.type == solver::JointType::prismatic) {
        pose.position += pose.rotation * (q * body.joint.axis);
      } else {
        pose.rotation = pose.rotation * Eigen::AngleAxisd(q, body.joint.axis).toRotationMatrix();
      }
      transforms_.add(bodies[static_cast<std::size_t>(body.parent)].name, body.name, pose);
    }
    for (const Mover& mover : movers_) {
      const auto [x, y, yaw] = mover.places;
      transforms_.add(world, foxglove::frame_of(mover.name),
                      planar(value(values, x), value(values, y), value(values, yaw)));
    }
    return transforms_.end();
  }

  /// While something is touched, and once when nothing is any more.
  void tell_forces(std::span<const double> values, const Put& put) {
    std::vector<foxglove::ForceArrow> arrows;
    for (const Touched& one : touched_) {
      const double force = value(values, one.force);
      if (!(force > 0.0)) continue;
      const auto [x, y, yaw] = one.places;
      const Pose object =
          x < columns_.size() ? planar(value(values, x), value(values, y), value(values, yaw)) : one.pose;
      const Pose base = planar(value(values, base_[0]), value(values, base_[1]), value(values, base_[2]));
      ContactPlace place = contact_place(moved(program_.robot.footprint, base), moved(one.outline, object));
      place.at.z() = foxglove::height_of_contact(program_.robot);
      arrows.push_back({one.name, place.at, place.heading, force});
    }
    if (!arrows.empty() || shows_forces_)
      put(foxglove::forces, text_of(foxglove::forces_update(time_, arrows)));
    shows_forces_ = !arrows.empty();
  }

  static std::vector<Vector3> moved(const std::vector<Vector3>& outline, const Pose& pose) {
    std::vector<Vector3> points;
    for (const Vector3& point : outline)
      points.push_back(pose.position + pose.rotation * Vector3(point.x(), point.y(), 0.0));
    return points;
  }

  static Pose planar(double x, double y, double yaw) {
    Pose pose;
    pose.position = {x, y, 0.0};
    pose.rotation = solver::rotation_from_rpy(0.0, 0.0, yaw);
    return pose;
  }

  /// Of the robot's frames, of the task's own, and of objects that stay. A frame that a signal carries is in
  /// no record; one that a task sets is where the file has it.
  const std::string& fixed_transforms() {
    transforms_.begin(time_);
    std::set<std::string> known{world};
    const auto add = [&](const std::string& parent, const std::string& child, const Pose& pose) {
      if (known.insert(child).second) transforms_.add(parent, child, pose);
    };
    const std::vector<solver::Body>& bodies = program_.robot.model.bodies();
    for (const solver::Body& body : bodies) known.insert(body.name);
    for (const lang::FrameDeclaration& frame : program_.frames) {
      const auto index = static_cast<std::size_t>(std::max(0, frame.parent_index));
      if (frame.parent == lang::FrameParent::world) add(world, frame.name, frame.pose);
      if (frame.parent == lang::FrameParent::body) add(bodies[index].name, frame.name, frame.pose);
      if (frame.parent == lang::FrameParent::frame) add(program_.frames[index].name, frame.name, frame.pose);
    }
    if (!program_.scene) return transforms_.end();
    const auto moves = [&](const std::string& name) {
      return std::ranges::any_of(movers_, [&](const Mover& mover) { return mover.name == name; });
    };
    for (const lang::SceneObject& object : program_.scene->objects) {
      if (!moves(object.name))
        add(world, foxglove::frame_of(object.name), planar(object.at[0], object.at[1], object.yaw));
    }
    for (const lang::SceneRobot& robot : program_.scene->robots) {
      if (!moves(robot.name))
        add(world, foxglove::frame_of(robot.name), planar(robot.at[0], robot.at[1], robot.yaw));
    }
    return transforms_.end();
  }

  void tell(Level level, const std::string& message, const std::string& name, const Put& put) const {
    put(foxglove::log, text_of(foxglove::log_message(time_, level, message, name)));
  }

  void tell_task(std::span<const double> values, const Put& put) {
    const std::string task = word(values, words_[0]);
    if (task.empty() || task == task_) return;
    const std::string note = note_of_switch(values);
    tell(task == "failed" ? Level::error : Level::info,
         (task_.empty() ? task : task_ + " -> " + task) + (note.empty() ? "" : ": " + note), "task", put);
    task_ = task;
  }

  /// Of the exit or the timeout that ended `task_`. The log does not have the task that refused to be
  /// entered.
  std::string note_of_switch(std::span<const double> values) const {
    const std::string cause = word(values, words_[3]), refusal = word(values, words_[5]);
    const auto from = std::ranges::find(program_.tasks, task_, &lang::Task::name);
    if (from == program_.tasks.end() || refusal != to_string(Refusal::none)) return "";
    if (cause == to_string(Cause::timeout)) return from->timeout ? from->timeout->note : "";
    const std::vector<lang::Exit>& exits =
        cause == to_string(Cause::always) ? program_.always.exits : from->exits;
    const double number = value(values, words_[4]);  // counted from 1
    return number >= 1.0 && number <= static_cast<double>(exits.size())
               ? exits[static_cast<std::size_t>(number) - 1].note
               : "";
  }

  void tell_event(std::span<const double> values, const Put& put) const {
    const std::string event = word(values, words_[1]);
    if (event.empty() || event == "none") return;
    const std::string signal = word(values, words_[2]);
    std::string message = event;
    if (!signal.empty()) message += " " + signal;
    tell(Level::warning, message, "guard", put);
  }

  lang::Program program_;
  std::vector<LogChannel> channels_;
  double height_;  ///< [m] of the base's origin
  std::vector<Column> columns_;
  Places base_{};
  std::array<std::size_t, 2> lean_{};  ///< the columns of roll and pitch
  std::vector<std::size_t> joints_;
  std::vector<Mover> movers_;
  std::vector<Touched> touched_;
  bool shows_forces_ = false;
  std::vector<std::size_t> words_;
  bool has_begun_ = false;
  double time_ = 0.0;  ///< [s]
  Pace pace_{transforms_every};
  foxglove::TransformsText transforms_;
  std::string task_;
};

}  // namespace

std::unique_ptr<LogChannels> scene_channels(const lang::Program& program) {
  return std::make_unique<SceneChannels>(program);
}

}  // namespace zwang::runtime
