#include "log/foxglove.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace zwang::runtime::foxglove {

namespace {

using nlohmann::ordered_json;
using solver::Vector3;

constexpr double fallback_height = 0.2;  // [m] of a body above its footprint, where no bumper says more
constexpr double link_thickness = 0.04;  // [m]
constexpr double tyre_share = 0.6;       // width of a wheel, of its radius
constexpr int line_strip = 0, line_loop = 1;

ordered_json xyz(const Vector3& v) {
  return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}};
}

ordered_json quaternion(const solver::Matrix3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

ordered_json pose_json(const solver::Pose& pose) {
  return {{"position", xyz(pose.position)}, {"orientation", quaternion(pose.rotation)}};
}

ordered_json colour(double r, double g, double b, double a) {
  return {{"r", r}, {"g", g}, {"b", b}, {"a", a}};
}
const ordered_json of_robot = colour(0.18, 0.49, 0.88, 0.55), of_other = colour(0.55, 0.43, 0.31, 0.9),
                   of_tyre = colour(0.14, 0.15, 0.18, 1.0), of_link = colour(0.85, 0.51, 0.17, 1.0),
                   of_object = colour(0.60, 0.65, 0.71, 0.9), of_region = colour(0.69, 0.45, 0.0, 1.0),
                   of_force = colour(0.78, 0.16, 0.16, 1.0);

ordered_json entity(double time, const std::string& frame, const std::string& id) {
  ordered_json one = {{"timestamp", stamp(time)},
                      {"frame_id", frame},
                      {"id", id},
                      {"lifetime", {{"sec", 0}, {"nsec", 0}}},  // until the end
                      {"frame_locked", true}};
  for (const char* part :
       {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"})
    one[part] = ordered_json::array();
  return one;
}

ordered_json line(int type, const std::vector<Vector3>& points, double thickness, const ordered_json& of) {
  ordered_json corners = ordered_json::array();
  for (const Vector3& point : points) corners.push_back(xyz(point));
  return {{"type", type},
          {"pose", pose_json({})},
          {"thickness", thickness},
          {"scale_invariant", false},
          {"points", corners},
          {"color", of},
          {"colors", ordered_json::array()},
          {"indices", ordered_json::array()}};
}

/// The footprint as a prism, by the triangles of its top and its sides.
ordered_json prism(const std::vector<Vector3>& footprint, double low, double high, const ordered_json& of) {
  ordered_json points = ordered_json::array();
  const auto put = [&](const Vector3& corner, double z) {
    points.push_back(xyz({corner.x(), corner.y(), z}));
  };
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vector3 &a = footprint[i], &b = footprint[(i + 1) % footprint.size()];
    put(a, low), put(b, low), put(b, high);
    put(a, low), put(b, high), put(a, high);
    if (i > 0 && i + 1 < footprint.size()) put(footprint[0], high), put(a, high), put(b, high);
  }
  return {{"pose", pose_json({})},
          {"points", points},
          {"color", of},
          {"colors", ordered_json::array()},
          {"indices", ordered_json::array()}};
}

ordered_json cylinder(const solver::Pose& pose, double radius, double height, const ordered_json& of) {
  return {{"pose", pose_json(pose)},
          {"size", xyz({2.0 * radius, 2.0 * radius, height})},
          {"bottom_scale", 1.0},
          {"top_scale", 1.0},
          {"color", of}};
}

void add_body(const lang::Robot& robot, const ordered_json& of, ordered_json& one) {
  const double high = robot.bumper_height > 0.0 ? 1.3 * robot.bumper_height : fallback_height;
  if (robot.footprint.size() > 2) one["triangles"].push_back(prism(robot.footprint, 0.2 * high, high, of));
}

void add_links(double time, const lang::Robot& robot, ordered_json& entities) {
  const std::vector<solver::Body>& bodies = robot.model.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    ordered_json one = entity(time, bodies[b].name, "link " + bodies[b].name);
    const auto rolls = [&](const solver::Wheel& wheel) { return wheel.body == static_cast<int>(b); };
    const auto wheel = std::ranges::find_if(robot.model.wheels(), rolls);
    if (b == 0) add_body(robot, of_robot, one);
    if (wheel != robot.model.wheels().end()) {
      solver::Pose along_axle;
      along_axle.rotation = solver::rotation_between(Vector3::UnitZ(), bodies[b].joint.axis);
      one["cylinders"].push_back(cylinder(along_axle, wheel->radius, tyre_share * wheel->radius, of_tyre));
    }
    for (const solver::Body& child : bodies) {
      const auto is_wheel = [&](const solver::Wheel& w) {
        return &bodies[static_cast<std::size_t>(w.body)] == &child;
      };
      if (child.parent == static_cast<int>(b) && &child != &bodies[0] &&
          std::ranges::none_of(robot.model.wheels(), is_wheel))
        one["lines"].push_back(
            line(line_strip, {Vector3::Zero(), child.pose_in_parent.position}, link_thickness, of_link));
    }
    entities.push_back(one);
  }
}

ordered_json object_entity(double time, const lang::SceneObject& object) {
  ordered_json one = entity(time, frame_of(object.name), "object " + object.name);
  const auto [a, b, c] = object.size;
  solver::Pose middle;
  middle.position.z() = c / 2.0;
  if (object.shape == lang::ShapeKind::cylinder) {
    one["cylinders"].push_back(cylinder(middle, a, c, of_object));
  } else {
    const bool is_wall = object.shape == lang::ShapeKind::wall;  // its face is at its origin, along y
    if (is_wall) middle.position.x() = b / 2.0;
    const Vector3 size = is_wall ? Vector3(b, a, c) : Vector3(a, b, c);
    one["cubes"].push_back({{"pose", pose_json(middle)}, {"size", xyz(size)}, {"color", of_object}});
  }
  return one;
}

ordered_json region_entity(double time, const lang::Region& region, const std::string& frame) {
  constexpr int corners_of_a_circle = 48;
  constexpr double thickness = 0.02;
  std::vector<Vector3> corners;
  for (const auto& corner : region.polygon) corners.emplace_back(corner[0], corner[1], 0.01);
  for (int i = 0; i < corners_of_a_circle && region.radius > 0.0; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners_of_a_circle;
    corners.emplace_back(region.centre[0] + region.radius * std::cos(angle),
                         region.centre[1] + region.radius * std::sin(angle), 0.01);
  }
  ordered_json one = entity(time, frame, "region " + region.name);
  one["lines"].push_back(line(line_loop, corners, thickness, of_region));
  return one;
}

/// An arc as chords of 5 deg at most.
ordered_json path_entity(double time, const lang::Path& path, const std::string& frame) {
  constexpr double thickness = 0.02, chord = std::numbers::pi / 36.0, above_floor = 0.01;
  std::vector<Vector3> points = path.points(chord);
  for (Vector3& point : points) point.z() = above_floor;
  ordered_json one = entity(time, frame, "path " + path.name);
  one["lines"].push_back(line(line_strip, points, thickness, of_region));
  return one;
}

// Each definition holds the fields that the messages of a log have. Foxglove refuses a channel whose
// definition has an object without `properties`, a field of two types, or an array of no type.
ordered_json of_type(const char* type) {
  return {{"type", type}};
}
ordered_json object(const ordered_json& properties) {
  return {{"type", "object"}, {"properties", properties}};
}
ordered_json array_of(const ordered_json& items) {
  return {{"type", "array"}, {"items", items}};
}
ordered_json numbers(std::initializer_list<const char*> names) {
  ordered_json properties = ordered_json::object();
  for (const char* name : names) properties[name] = of_type("number");
  return object(properties);
}

ordered_json of_time() {
  return object({{"sec", of_type("integer")}, {"nsec", of_type("integer")}});
}
ordered_json of_point() {
  return numbers({"x", "y", "z"});
}
ordered_json of_colour() {
  return numbers({"r", "g", "b", "a"});
}
ordered_json of_pose() {
  return object({{"position", of_point()}, {"orientation", numbers({"x", "y", "z", "w"})}});
}

std::string definition(const std::string& title, const ordered_json& properties) {
  ordered_json whole = {{"title", title}};
  whole.update(object(properties));
  return whole.dump();
}

std::string of_transforms() {
  return definition("foxglove.FrameTransforms",
                    {{"transforms", array_of(object({{"timestamp", of_time()},
                                                     {"parent_frame_id", of_type("string")},
                                                     {"child_frame_id", of_type("string")},
                                                     {"translation", of_point()},
                                                     {"rotation", numbers({"x", "y", "z", "w"})}}))}});
}

std::string of_scene() {
  ordered_json entity_fields = {{"timestamp", of_time()},
                                {"frame_id", of_type("string")},
                                {"id", of_type("string")},
                                {"lifetime", of_time()},
                                {"frame_locked", of_type("boolean")}};
  const ordered_json nothing = ordered_json::object();  // no message has one
  for (const char* part : {"metadata", "spheres", "texts", "models"})
    entity_fields[part] = array_of(object(nothing));
  entity_fields["arrows"] = array_of(object({{"pose", of_pose()},
                                             {"shaft_length", of_type("number")},
                                             {"shaft_diameter", of_type("number")},
                                             {"head_length", of_type("number")},
                                             {"head_diameter", of_type("number")},
                                             {"color", of_colour()}}));
  const ordered_json points = array_of(of_point()), colours = array_of(of_colour()),
                     indices = array_of(of_type("integer"));
  entity_fields["cubes"] =
      array_of(object({{"pose", of_pose()}, {"size", of_point()}, {"color", of_colour()}}));
  entity_fields["cylinders"] = array_of(object({{"pose", of_pose()},
                                                {"size", of_point()},
                                                {"bottom_scale", of_type("number")},
                                                {"top_scale", of_type("number")},
                                                {"color", of_colour()}}));
  entity_fields["lines"] = array_of(object({{"type", of_type("integer")},
                                            {"pose", of_pose()},
                                            {"thickness", of_type("number")},
                                            {"scale_invariant", of_type("boolean")},
                                            {"points", points},
                                            {"color", of_colour()},
                                            {"colors", colours},
                                            {"indices", indices}}));
  entity_fields["triangles"] = array_of(object({{"pose", of_pose()},
                                                {"points", points},
                                                {"color", of_colour()},
                                                {"colors", colours},
                                                {"indices", indices}}));
  const ordered_json deletion =
      object({{"timestamp", of_time()}, {"type", of_type("integer")}, {"id", of_type("string")}});
  return definition("foxglove.SceneUpdate",
                    {{"deletions", array_of(deletion)}, {"entities", array_of(object(entity_fields))}});
}

std::string of_log() {
  return definition("foxglove.Log", {{"timestamp", of_time()},
                                     {"level", of_type("integer")},
                                     {"message", of_type("string")},
                                     {"name", of_type("string")},
                                     {"file", of_type("string")},
                                     {"line", of_type("integer")}});
}

}  // namespace

std::vector<LogChannel> channels() {
  return {{"/tf", "foxglove.FrameTransforms", of_transforms()},
          {"/tf_static", "foxglove.FrameTransforms", of_transforms()},
          {"/scene", "foxglove.SceneUpdate", of_scene()},
          {"/log", "foxglove.Log", of_log()},
          {"/forces", "foxglove.SceneUpdate", of_scene()}};
}

ordered_json stamp(double time) {
  const auto nanoseconds = time > 0.0 ? static_cast<std::int64_t>(std::llround(time * 1e9)) : 0;
  return {{"sec", nanoseconds / 1'000'000'000}, {"nsec", nanoseconds % 1'000'000'000}};
}

namespace {

void append_quoted(std::string& text, std::string_view name) {
  const bool is_plain =
      std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
  if (is_plain) {
    text.append(1, '"').append(name).append(1, '"');
  } else {
    text += ordered_json(name).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  }
}

void append_numbers(std::string& text, std::string_view names, std::initializer_list<double> values) {
  text += '{';
  std::size_t i = 0;
  for (const double value : values) {
    if (i > 0) text += ',';
    text.append(1, '"').append(1, names[i++]).append("\":");
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  text += '}';
}

}  // namespace

void TransformsText::begin(double time) {
  text_ = R"({"transforms":[)";
  stamp_ = stamp(time).dump();
}

void TransformsText::add(std::string_view parent, std::string_view child, const solver::Pose& pose) {
  if (text_.back() == '}') text_ += ',';
  text_.append(R"({"timestamp":)").append(stamp_).append(R"(,"parent_frame_id":)");
  append_quoted(text_, parent);
  text_ += R"(,"child_frame_id":)";
  append_quoted(text_, child);
  text_ += R"(,"translation":)";
  append_numbers(text_, "xyz", {pose.position.x(), pose.position.y(), pose.position.z()});
  text_ += R"(,"rotation":)";
  const Eigen::Quaterniond q(pose.rotation);
  append_numbers(text_, "xyzw", {q.x(), q.y(), q.z(), q.w()});
  text_ += '}';
}

const std::string& TransformsText::end() {
  return text_.append("]}");
}

ordered_json log_message(double time, Level level, const std::string& message, const std::string& name) {
  return {{"timestamp", stamp(time)},
          {"level", static_cast<int>(level)},
          {"message", message},
          {"name", name},
          {"file", ""},
          {"line", 0}};
}

double height_of_contact(const lang::Robot& robot) {
  return robot.bumper_height > 0.0 ? robot.bumper_height : fallback_height;
}

double length_of_force(double force) {
  return 0.25 * std::log10(1.0 + 2.0 * force);
}

ordered_json forces_update(double time, const std::vector<ForceArrow>& arrows) {
  constexpr int all_of_the_topic = 1;
  constexpr double most_head = 0.12, head_diameter = 0.08, shaft_diameter = 0.03;  // [m]
  ordered_json entities = ordered_json::array();
  for (const ForceArrow& arrow : arrows) {
    const double length = length_of_force(arrow.force), head = std::min(most_head, length / 2.0);
    solver::Pose pose;
    pose.position = arrow.at;
    pose.rotation = solver::rotation_from_rpy(0.0, 0.0, arrow.heading);
    ordered_json one = entity(time, "world", "force " + arrow.object);
    one["arrows"].push_back({{"pose", pose_json(pose)},
                             {"shaft_length", length - head},
                             {"shaft_diameter", shaft_diameter},
                             {"head_length", head},
                             {"head_diameter", head_diameter},
                             {"color", of_force}});
    entities.push_back(one);
  }
  const ordered_json gone = {{"timestamp", stamp(time)}, {"type", all_of_the_topic}, {"id", ""}};
  return {{"deletions", ordered_json::array({gone})}, {"entities", entities}};
}

std::string frame_of(const std::string& object) {
  return "scene/" + object;
}

ordered_json scene_update(double time, const lang::Program& program) {
  ordered_json entities = ordered_json::array();
  add_links(time, program.robot, entities);
  for (const lang::Region& region : program.regions) {
    const std::string& frame = program.frames[static_cast<std::size_t>(region.parent)].name;
    entities.push_back(region_entity(time, region, frame));
  }
  for (const lang::Path& path : program.paths) {
    const std::string& frame = program.frames[static_cast<std::size_t>(path.frame)].name;
    entities.push_back(path_entity(time, path, frame));
  }
  if (program.scene) {
    for (const lang::SceneObject& object : program.scene->objects)
      entities.push_back(object_entity(time, object));
    for (const lang::SceneRobot& robot : program.scene->robots) {
      ordered_json one = entity(time, frame_of(robot.name), "robot " + robot.name);
      if (robot.program) add_body(robot.program->robot, of_other, one);
      entities.push_back(one);
    }
  }
  return {{"deletions", ordered_json::array()}, {"entities", entities}};
}

}  // namespace zwang::runtime::foxglove
