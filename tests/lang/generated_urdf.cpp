// A drive lays its wheels out on the ground; how each is written is the exporter's habit.
#include "generated_urdf.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "urdf_drawing.hpp"

namespace zwang::lang::test {

namespace {

enum class Drive { differential, four, six, omni, steered, twin, car, tricycle };
constexpr const char* drive_names[] = {"differential", "four wheels", "six wheels", "omni",
                                       "steered",      "twin wheels", "car",        "tricycle"};

enum class Flaw { none, macro, comma, stuck, stops, two_roots, coupled, millimetres, nameless };

/// One robot in ten has one. `coupled` and `nameless` look like flaws: a belt is read, and where neither name
/// nor shape tells a wheel, its place does.
Flaw flaw_of(int number) {
  return number % 10 == 9 ? static_cast<Flaw>(1 + number / 10 % 8) : Flaw::none;
}

class Drawing : private UrdfDrawing {
 public:
  explicit Drawing(int number)
      : UrdfDrawing(number, flaw_of(number) == Flaw::millimetres ? 1e3 : 1.0),
        flaw_(flaw_of(number)),
        drive_(flaw_ == Flaw::coupled ? Drive::four : static_cast<Drive>(number % 8)) {
    robot_.about = drive_names[static_cast<int>(drive_)];
    choose_habits(flaw_ == Flaw::nameless ? Named::nowhere
                  : flaw_ == Flaw::none   ? Named::by_lot
                                          : Named::always);
    if (flaw_ == Flaw::stuck) joints_ = Joints::fixed;
    if (flaw_ == Flaw::stops) joints_ = Joints::revolute;
    if (flaw_ == Flaw::coupled) joints_ = Joints::coupled;
    // A caster behind the wheels carries, too.
    if (drive_ == Drive::differential) com_ahead_ = -0.2 * length_;
  }

  GeneratedUrdf draw() {
    draw_roots();
    draw_drive();
    if (dice_.one_of(4)) draw_arm();
    if (dice_.one_of(4)) draw_antenna();
    draw_flaw();
    if (flaw_ == Flaw::coupled) couple_third();
    robot_.text = text_.robot("drawn");
    return robot_;
  }

 private:
  void draw_drive() {
    robot_.freedoms = drive_ == Drive::differential                    ? Freedoms::two
                      : drive_ == Drive::omni || drive_ == Drive::twin ? Freedoms::all
                                                                       : Freedoms::steered;
    if (drive_ == Drive::differential) draw_differential();
    if (drive_ == Drive::four || drive_ == Drive::six) draw_rows(drive_ == Drive::four ? 2 : 3);
    if (drive_ == Drive::omni) draw_omni(3 + dice_.below(2));
    if (drive_ == Drive::steered) draw_steered();
    if (drive_ == Drive::twin) draw_twin();
    if (drive_ == Drive::car) draw_car();
    if (drive_ == Drive::tricycle) draw_tricycle();
  }

  void draw_differential() {
    put_on_body("1", {0.0, track_, 0.0}, true);
    put_on_body("2", {0.0, -track_, 0.0}, true);
    const int layout = dice_.below(3);
    if (layout == 0) return put_caster("1", {-length_, 0.0, 0.0});
    const double aside = layout == 1 ? 0.0 : 0.6 * track_;
    int number = 1;
    for (const double x : {-length_, length_}) {
      put_caster(std::to_string(number++), {x, aside, 0.0});
      if (aside > 0.0) put_caster(std::to_string(number++), {x, -aside, 0.0});
    }
  }

  void draw_rows(int rows) {
    robot_.kind = rows == 2 && dice_.one_of(2) ? "mecanum" : "skid";
    robot_.freedoms = robot_.kind == "mecanum" ? Freedoms::all : Freedoms::skid;
    int number = 1;
    for (int row = 0; row < rows; ++row) {
      const double x = length_ * (1.0 - 2.0 * row / (rows - 1));
      for (const double side : {1.0, -1.0})
        put_on_body(std::to_string(number++), {x, side * track_, 0.0}, true);
    }
  }

  void draw_omni(int count) {
    const double first = std::numbers::pi / 6.0 * dice_.below(3);
    for (int i = 0; i < count; ++i) {
      const double angle = first + 2.0 * std::numbers::pi * i / count;
      put_on_body(std::to_string(i + 1),
                  {length_ * std::cos(angle), length_ * std::sin(angle), angle - std::numbers::pi / 2.0},
                  true);
    }
  }

  static std::vector<Place> corners(double x, double y) {
    return {{x, y, 0.0}, {x, -y, 0.0}, {-x, y, 0.0}, {-x, -y, 0.0}};
  }

  /// A wheel on each swivel, below it or behind it, and motors for both.
  void draw_steered() {
    const bool trails = dice_.one_of(2);
    if (trails) robot_.freedoms = Freedoms::all;
    int number = 1;
    for (const Place& place : corners(length_, track_)) {
      const std::string n = std::to_string(number++);
      const std::string fork =
          put_swivel(trails ? language_->fork : language_->steering, n, place, radius_, true);
      put_wheel(trails ? language_->caster : language_->wheel, n, fork,
                {trails ? -0.4 * radius_ : 0.0, 0.0, 0.0}, 0.0, radius_, true);
    }
  }

  /// Two driven wheels on each swivel turn it.
  void draw_twin() {
    const bool has_casters = dice_.one_of(2) && motors_ == Motors::efforts;
    std::vector<Place> places = corners(length_, track_);
    if (has_casters) places = {{length_, 0.0, 0.0}, {-length_, 0.0, 0.0}};
    if (caster_ == Caster::stiff) caster_ = Caster::swivel;
    int number = 1;
    for (const Place& place : places) {
      const std::string n = std::to_string(number++);
      const std::string link = put_swivel(language_->steering, n, place, radius_, false);
      if (motors_ == Motors::transmissions) say_motor(named(language_->steering, n, "joint"));
      for (const double side : {1.0, -1.0})
        put_wheel(language_->wheel, n + (side > 0.0 ? "_1" : "_2"), link,
                  {-0.3 * radius_, side * 0.5 * radius_, 0.0}, 0.0, radius_, true);
    }
    if (!has_casters) return;
    put_caster("1", {0.0, track_, 0.0});
    put_caster("2", {0.0, -track_, 0.0});
  }

  /// Driven behind, steered in front. Where the file does not tell them apart, all wheels have motors.
  void draw_car() {
    put_on_body("1", {-length_, track_, 0.0}, true);
    put_on_body("2", {-length_, -track_, 0.0}, true);
    if (tells_motors() && dice_.one_of(3)) {  // an axle that turns as a whole
      const std::string link = put_swivel(language_->steering, "1", {length_, 0.0, 0.0}, radius_, true);
      put_wheel(language_->wheel, "3", link, {0.0, track_, 0.0}, 0.0, radius_, false);
      put_wheel(language_->wheel, "4", link, {0.0, -track_, 0.0}, 0.0, radius_, false);
      return;
    }
    int number = 3;
    for (const double side : {1.0, -1.0}) {
      const std::string n = std::to_string(number++);
      const std::string link =
          put_swivel(language_->steering, n, {length_, side * track_, 0.0}, radius_, true);
      put_wheel(language_->wheel, n, link, {}, 0.0, radius_, !tells_motors());
    }
  }

  void draw_tricycle() {
    const std::string link = put_swivel(language_->steering, "1", {length_, 0.0, 0.0}, radius_, true);
    put_wheel(language_->wheel, "1", link, {}, 0.0, radius_, true);
    put_on_body("2", {-length_, track_, 0.0}, !tells_motors());
    put_on_body("3", {-length_, -track_, 0.0}, !tells_motors());
  }

  void draw_flaw() {
    const auto refuse = [&](RefusedAt at, const std::string& reason) {
      robot_.refused_at = at;
      robot_.reason = reason;
    };
    if (flaw_ == Flaw::macro) {
      text_.add("  <xacro:lidar parent=\"base_link\"/>\n");
      refuse(RefusedAt::urdf, "E855");
    }
    if (flaw_ == Flaw::comma) {
      text_.add(
          "  <link name=\"box\"/>\n  <joint name=\"box_joint\" type=\"fixed\"><origin xyz=\"0,1 0 0\"/>"
          "<parent link=\"" +
          body_ + "\"/><child link=\"box\"/></joint>\n");
      refuse(RefusedAt::urdf, "E856");
    }
    if (flaw_ == Flaw::two_roots) {
      text_.add("  <link name=\"lost\"/>\n");
      refuse(RefusedAt::urdf, "E857");
    }
    if (flaw_ == Flaw::millimetres) refuse(RefusedAt::urdf, "E858");
    if (flaw_ == Flaw::stuck || flaw_ == Flaw::stops) robot_.held_wheel = first_wheel_;
  }

  /// No flaw: a belt turns the third wheel, which is in line with the first and has no motor.
  void couple_third() {
    robot_.motors.erase(named(language_->wheel, "3", "joint"));
    robot_.kind = "skid";
    robot_.freedoms = Freedoms::skid;
  }

  Flaw flaw_;
  Drive drive_;
};

}  // namespace

GeneratedUrdf generated_urdf(int number) {
  return Drawing(number).draw();
}

}  // namespace zwang::lang::test
