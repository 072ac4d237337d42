#include "urdf_drawing.hpp"

#include <cctype>
#include <cmath>
#include <numbers>
#include <vector>

namespace zwang::lang::test {

namespace {

constexpr Language languages[] = {
    {"English", "wheel", "caster", "caster_fork", "caster_ball", "suspension", "steering"},
    {"German", "antriebsrad", "lenkrolle", "lenkgabel", "stuetzkugel", "federbein", "lenkung"},
    {"French", "roue", "roue_folle", "chape", "bille", "amortisseur", "direction"},
    {"Spanish", "rueda", "rueda_loca", "horquilla", "bola", "amortiguador", "direccion"},
    {"Italian", "ruota", "ruota_pivottante", "forcella", "sfera", "molla", "sterzo"},
    {"no", "drive", "k", "q", "s", "f", "p"},
};

}  // namespace

void UrdfDrawing::choose_habits(Named names) {
  language_ = &languages[names == Named::nowhere ? 5 : dice_.below(names == Named::always ? 5 : 6)];
  robot_.size = std::vector{0.2, 0.5, 1.0, 1.0, 2.0, 4.0}[static_cast<std::size_t>(dice_.below(6))];
  radius_ = robot_.size * dice_.between(0.06, 0.1);
  track_ = robot_.size * dice_.between(0.2, 0.3);
  length_ = robot_.size * dice_.between(0.25, 0.35);
  density_ = robot_.size * robot_.size * robot_.size;
  frame_ = dice_.below(4);
  mirror_ = dice_.below(3);
  style_ = dice_.below(4);
  motors_ = static_cast<Motors>(dice_.below(4));
  caster_ = static_cast<Caster>(dice_.below(is_nameless() ? 3 : 4));
  spring_ = dice_.below(4);
  shape_ = names == Named::nowhere ? 3 : dice_.below(is_nameless() ? 2 : 5);
  root_ = dice_.below(6);
  base_height_ = root_ == 3 ? 0.0 : radius_ * dice_.between(0.5, 1.5);
  robot_.radius_is_drawn = shape_ != 3;
  const auto with = [&](const char* habit, int which) {
    robot_.about += std::string(", ") + habit + " " + std::to_string(which);
  };
  robot_.about += std::string(", ") + language_->about + " names";
  with("style", style_);
  with("frame", frame_);
  with("mirror", mirror_);
  with("motors", static_cast<int>(motors_));
  with("caster", static_cast<int>(caster_));
  with("spring", spring_);
  with("shape", shape_);
  with("root", root_);
}

std::string UrdfDrawing::named(const std::string& word, const std::string& number,
                               const std::string& what) const {
  const std::string snake = word + (number.empty() ? "" : "_" + number) + "_" + what;
  if (style_ == 1) {
    std::string camel;
    bool is_start = true;
    for (const char c : snake) {
      if (c != '_') camel += is_start ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
      is_start = c == '_';
    }
    return camel;
  }
  if (style_ == 2) return "robot1_" + snake;
  std::string dashed = snake;
  for (char& c : dashed) c = style_ == 3 && c == '_' ? '-' : c;
  return dashed;
}

void UrdfDrawing::put(const LinkShape& link) {
  text_.add(link);
  robot_.mass += link.mass;
}

void UrdfDrawing::fix(const std::string& parent, const std::string& child, const std::array<double, 3>& at) {
  text_.add(JointShape{child + "_fixed", "fixed", parent, child, at, {}, {}, "", ""});
}

LinkShape UrdfDrawing::body(const std::string& name) const {
  const double mass = 40.0 * density_, x = 2.0 * length_, y = 2.0 * track_, z = 2.0 * radius_;
  LinkShape link{name, mass, {}, {}, text_.box(x, 0.5 * y, z), true};
  link.inertia = {mass * (y * y + z * z) / 12.0, mass * (x * x + z * z) / 12.0,
                  mass * (x * x + y * y) / 12.0};
  // Above the middle of what carries it, also where a caster is behind the wheels alone.
  link.at = {com_ahead_, 0.0, 1.5 * radius_ - base_height_};
  return link;
}

void UrdfDrawing::draw_roots() {
  body_ = root_ == 2 || root_ == 4 ? "chassis" : "base_link";
  robot_.base = root_ == 2 ? body_ : "base_link";
  put(body(body_));
  if (root_ == 1 || root_ == 3) {
    const std::string above = root_ == 1 ? "base_footprint" : "dummy";
    text_.add(LinkShape{above, 0.0, {}, {}, "", false});
    fix(above, body_, {0.0, 0.0, base_height_});
  }
  if (root_ == 4) {
    text_.add(LinkShape{"base_link", 0.0, {}, {}, "", false});
    fix("base_link", body_, {0.0, 0.0, base_height_});
  }
  if (root_ == 5) draw_planar_chain();
}

void UrdfDrawing::draw_planar_chain() {
  const std::array<const char*, 4> links{"world", "along_x", "along_y", "base_link"};
  if (frame_ == 3) {  // the same, as one joint
    text_.add(LinkShape{links[0], 0.0, {}, {}, "", false});
    const char* type = mirror_ == 0 ? "planar" : "floating";
    text_.add(JointShape{"virtual", type, links[0], links[3], {}, {}, {0.0, 0.0, 1.0}, "", ""});
    return;
  }
  // Some simulators refuse links without a mass.
  const double mass = frame_ == 0 ? 0.0 : 1e-6 * density_, inertia = 1e-3 * mass;
  for (std::size_t i = 0; i < 3; ++i) {
    put({links[i], mass, {}, {inertia, inertia, inertia}, "", false});
    const std::string name = i == 0 ? "rail_x" : i == 1 ? "rail_y" : "turn";
    JointShape joint{name, i < 2 ? "prismatic" : "continuous", links[i], links[i + 1], {}, {}, {}, "", ""};
    joint.axis = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    if (i < 2) joint.limit = "lower=\"-100\" upper=\"100\" effort=\"0\" velocity=\"1\"";
    text_.add(joint);
    robot_.held.insert(name);
  }
}

std::string UrdfDrawing::limit_of(bool has_motor, double torque) const {
  const bool has_effort = (motors_ == Motors::efforts && has_motor) || motors_ == Motors::all_efforts;
  return has_effort ? "effort=\"" + UrdfText::number(motors_ == Motors::all_efforts ? 100.0 : torque) +
                          "\" velocity=\"20\""
         : frame_ % 2 == 0 ? "effort=\"0\" velocity=\"20\""
                           : "";
}

void UrdfDrawing::note_motor(const std::string& joint) {
  robot_.motors.insert(joint);
  if (motors_ == Motors::transmissions) say_motor(joint);
}

void UrdfDrawing::say_motor(const std::string& joint) {
  text_.add("  <transmission name=\"" + joint + "_trans\">\n    <type>SimpleTransmission</type>\n" +
            "    <joint name=\"" + joint + "\"/>\n  </transmission>\n");
}

std::string UrdfDrawing::put_spring(const std::string& number, const Place& place) {
  const std::string link = named(language_->spring, number, "link"),
                    joint = named(language_->spring, number, "joint");
  const double mass = 0.3 * density_, inertia = mass * radius_ * radius_;
  put({link, mass, {}, {inertia, inertia, inertia}, "", false});
  JointShape shape{joint,
                   spring_ == 1 ? "prismatic" : "revolute",
                   body_,
                   link,
                   {place.x, place.y, radius_ - base_height_},
                   {},
                   {},
                   "",
                   ""};
  shape.axis = spring_ == 1 ? std::array{0.0, 0.0, 1.0} : std::array{0.0, 1.0, 0.0};
  shape.limit = "lower=\"-0.01\" upper=\"0.02\" effort=\"1000\" velocity=\"1\"";
  text_.add(shape);
  robot_.held.insert(joint);
  return link;
}

void UrdfDrawing::turn(const Place& place, JointShape& joint) const {
  const bool is_right = place.is_right || place.y < 0.0;
  const double side = is_right && mirror_ == 1 ? -1.0 : 1.0;
  const double yaw = place.heading + (is_right && mirror_ == 2 ? std::numbers::pi : 0.0);
  if (frame_ == 0) joint.rpy = {0.0, 0.0, yaw};
  if (frame_ == 1) joint.rpy = {-std::numbers::pi / 2.0, 0.0, yaw};
  if (frame_ == 2) joint.rpy = {std::numbers::pi / 2.0, 0.0, yaw};
  if (frame_ == 3) joint.rpy = {0.0, 0.0, yaw + std::numbers::pi / 2.0};
  if (frame_ == 0) joint.axis = {0.0, side, 0.0};
  if (frame_ == 1) joint.axis = {0.0, 0.0, side};
  if (frame_ == 2) joint.axis = {0.0, 0.0, -side};
  if (frame_ == 3 && side < 0.0) joint.axis = {-1.0, 0.0, 0.0};  // 1 0 0 where none is written
}

LinkShape UrdfDrawing::disc(const std::string& name, double mass, double radius) const {
  const double along = 0.5 * mass * radius * radius, across = 0.3 * mass * radius * radius;
  LinkShape link{name, mass, {}, {across, along, across}, "", true};
  if (frame_ == 1 || frame_ == 2) link.inertia = {across, across, along};
  if (frame_ == 3) link.inertia = {along, across, across};
  std::array<double, 3> rpy{};
  if (frame_ == 0) rpy = {std::numbers::pi / 2.0, 0.0, 0.0};
  if (frame_ == 3) rpy = {0.0, std::numbers::pi / 2.0, 0.0};
  link.geometry = shape_ == 2   ? text_.sphere(radius)
                  : shape_ == 3 ? UrdfText::mesh("round_" + std::to_string(std::lround(1e6 * radius)))
                                : text_.cylinder(radius, 0.4 * radius, rpy);
  link.collides = shape_ != 1;
  return link;
}

std::string UrdfDrawing::put_wheel(const std::string& word, const std::string& number,
                                   const std::string& parent, const Place& place, double above, double radius,
                                   bool has_motor) {
  const std::string link = named(word, number, "link");
  JointShape joint{named(word, number, "joint"), "continuous", parent, link, {}, {}, {}, "", ""};
  joint.at = {place.x, place.y, -above};
  turn(place, joint);
  joint.limit = limit_of(has_motor, 60.0 * density_ * radius_);
  if (joints_ == Joints::fixed) joint.type = "fixed";
  if (joints_ == Joints::revolute) {
    joint.type = "revolute";
    joint.limit = "lower=\"-3.14\" upper=\"3.14\" effort=\"5\" velocity=\"10\"";
  }
  if (frame_ == 2 && joints_ == Joints::good && dice_.one_of(4)) {
    joint.type = "revolute";
    joint.limit = "lower=\"-1e16\" upper=\"1e16\" " + joint.limit;
    if (joint.limit.find("effort") == std::string::npos) joint.limit += "effort=\"0\" velocity=\"20\"";
  }
  if (joints_ == Joints::coupled && robot_.wheels.size() == 2) joint.mimic = first_wheel_;
  const double mass = 1.5 * density_ * std::pow(radius / (0.08 * robot_.size), 3);
  if (shape_ == 4) {  // the tyre is a link of its own
    LinkShape tyre = disc(named(word, number, "tyre"), 0.5 * mass, radius);
    LinkShape hub = tyre;
    hub.name = link;
    hub.geometry = "";
    put(hub);
    put(tyre);
    fix(link, tyre.name, {});
  } else {
    put(disc(link, mass, radius));
  }
  text_.add(joint);
  if (has_motor) note_motor(joint.name);
  robot_.wheels[joint.name] = radius;
  if (first_wheel_.empty()) first_wheel_ = joint.name;
  return joint.name;
}

void UrdfDrawing::put_on_body(const std::string& number, const Place& place, bool has_motor) {
  if (spring_ != 1 && spring_ != 2) {
    put_wheel(language_->wheel, number, body_, place, base_height_ - radius_, radius_, has_motor);
    return;
  }
  const std::string link = put_spring(number, place);
  put_wheel(language_->wheel, number, link, {0.0, 0.0, place.heading, place.y < 0.0}, 0.0, radius_,
            has_motor);
}

std::string UrdfDrawing::put_swivel(const std::string& word, const std::string& number, const Place& place,
                                    double radius, bool steers) {
  const std::string link = named(word, number, "link"), joint = named(word, number, "joint");
  const double mass = 0.5 * density_, inertia = mass * radius * radius;
  put({link, mass, {}, {inertia, inertia, inertia}, "", false});
  JointShape shape{joint, "continuous", body_, link, {place.x, place.y, radius - base_height_},
                   {},    {},           "",    ""};
  shape.axis = {0.0, 0.0, 1.0};
  shape.limit = limit_of(steers, 10.0 * density_ * radius_);
  text_.add(shape);
  if (steers) note_motor(joint);
  return link;
}

void UrdfDrawing::put_caster(const std::string& number, const Place& place) {
  const double radius = 0.5 * radius_;
  if (caster_ == Caster::ball) {
    const std::string link = named(language_->ball, number, "link");
    text_.add(LinkShape{link, 0.0, {}, {}, text_.sphere(radius), true});
    fix(body_, link, {place.x, place.y, radius - base_height_});
    robot_.supports.insert(link);
  } else if (caster_ == Caster::stiff) {
    const std::string joint =
        put_wheel(language_->caster, number, body_, place, base_height_ - radius, radius, false);
    robot_.wheels.erase(joint);
    robot_.held.insert(joint);
    robot_.supports.insert(named(language_->caster, number, "link"));
  } else {
    const std::string fork = put_swivel(language_->fork, number, place, radius, false);
    const double trail = -0.6 * radius;
    if (caster_ == Caster::swivel) {
      put_wheel(language_->caster, number, fork, {trail, 0.0, 0.0}, 0.0, radius, false);
    } else {
      put_wheel(language_->caster, number + "_1", fork, {trail, 0.3 * radius, 0.0}, 0.0, radius, false);
      put_wheel(language_->caster, number + "_2", fork, {trail, -0.3 * radius, 0.0}, 0.0, radius, false);
    }
  }
}

void UrdfDrawing::draw_arm() {
  const double mass = 0.5 * density_, inertia = 0.01 * mass * robot_.size * robot_.size;
  const auto add = [&](JointShape joint, bool has_motor) {
    put({joint.child, mass, {}, {inertia, inertia, inertia}, text_.box(0.02, 0.02, 0.02), true});
    joint.limit =
        "lower=\"-1\" upper=\"1\" effort=\"" + UrdfText::number(20.0 * density_) + "\" velocity=\"1\"";
    text_.add(joint);
    (has_motor ? robot_.motors : robot_.held).insert(joint.name);
  };
  const double up = 2.0 * radius_, out = 0.1 * robot_.size;
  add({"shoulder_joint", "revolute", body_, "arm_link", {0.0, 0.0, up}, {}, {0.0, 1.0, 0.0}, "", ""}, true);
  add({"finger_1", "prismatic", "arm_link", "finger_1_link", {out, 0.0, 0.0}, {}, {0.0, 1.0, 0.0}, "", ""},
      false);
  add({"finger_2",
       "prismatic",
       "arm_link",
       "finger_2_link",
       {out, 0.0, 0.0},
       {},
       {0.0, -1.0, 0.0},
       "",
       "finger_1"},
      false);
}

void UrdfDrawing::draw_antenna() {
  const double mass = 1e-5 * density_;
  put({"antenna", mass, {}, {1e-6, 1e-6, -1e-6}, text_.cylinder(0.3 * radius_, radius_, {}), true});
  fix(body_, "antenna", {0.1 * length_, 0.0, 2.5 * radius_});
}

}  // namespace zwang::lang::test
