/// The parts of a drawn URDF, each put in the way that one exporter has.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "generated_urdf.hpp"
#include "urdf_text.hpp"

namespace zwang::lang::test {

/// splitmix64: the same numbers on every machine.
class Dice {
 public:
  explicit Dice(int number) : state_(0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(number + 1)) {}

  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11U) * 0x1p-53;
  }
  bool one_of(int count) { return below(count) == 0; }

 private:
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

struct Language {
  const char *about, *wheel, *caster, *fork, *ball, *spring, *steering;
};

/// How the file tells that a joint has a motor.
enum class Motors { efforts, transmissions, all_efforts, nobody };

enum class Caster { ball, swivel, twin_swivel, stiff };

/// Whether wheels can be told by their names. Nowhere: nor by their shapes.
enum class Named { by_lot, always, nowhere };

/// How the wheels' joints are written.
enum class Joints { good, fixed, revolute, coupled };

/// A wheel in the axes of what carries it: `heading` is the direction it rolls to. [m, rad]
struct Place {
  double x = 0.0, y = 0.0, heading = 0.0;
  bool is_right = false;
};

class UrdfDrawing {
 protected:
  UrdfDrawing(int number, double unit)
      : dice_(number), text_(std::array{2, 3, 4, 6, 12}[static_cast<std::size_t>(dice_.below(5))], unit) {}

  /// Drawn by lot, whatever the drive.
  void choose_habits(Named names);

  bool is_nameless() const { return language_->caster[1] == '\0'; }

  bool tells_motors() const { return motors_ == Motors::efforts || motors_ == Motors::transmissions; }

  /// As the author writes names.
  std::string named(const std::string& word, const std::string& number, const std::string& what) const;

  void put(const LinkShape& link);

  void fix(const std::string& parent, const std::string& child, const std::array<double, 3>& at);

  LinkShape body(const std::string& name) const;

  /// Draws the links above the body, and notes the base.
  void draw_roots();

  /// Simulators move a base along two rails and about an axis.
  void draw_planar_chain();

  std::string limit_of(bool has_motor, double torque) const;

  void note_motor(const std::string& joint);

  void say_motor(const std::string& joint);

  /// A spring below the body, and where the wheel is in it.
  std::string put_spring(const std::string& number, const Place& place);

  /// The frame of a wheel that rolls to `heading`: rpy and the axis in it, along the axle.
  void turn(const Place& place, JointShape& joint) const;

  /// Of a disc about the axis of its joint.
  LinkShape disc(const std::string& name, double mass, double radius) const;

  /// On `parent`, whose frame is `above` over the axle. Returns the joint.
  std::string put_wheel(const std::string& word, const std::string& number, const std::string& parent,
                        const Place& place, double above, double radius, bool has_motor);

  /// A wheel on the body, behind a spring where the exporter draws one.
  void put_on_body(const std::string& number, const Place& place, bool has_motor);

  /// A swivel whose frame is on the axle of the wheels it carries. Returns its link.
  std::string put_swivel(const std::string& word, const std::string& number, const Place& place,
                         double radius, bool steers);

  void put_caster(const std::string& number, const Place& place);

  /// A shoulder and two fingers, the second of which follows the first: zwang couples no joints, and both
  /// stand.
  void draw_arm();

  /// A milligram that no body has the inertia of, and round.
  void draw_antenna();

  Dice dice_;
  UrdfText text_;
  GeneratedUrdf robot_;
  const Language* language_ = nullptr;
  Joints joints_ = Joints::good;
  std::string body_, first_wheel_;
  double radius_ = 0.0, track_ = 0.0, length_ = 0.0;  ///< [m] of a wheel; half of the width, of the length
  double density_ = 1.0, base_height_ = 0.0, com_ahead_ = 0.0;
  int frame_ = 0, mirror_ = 0, style_ = 0, spring_ = 0, shape_ = 0, root_ = 0;
  Motors motors_ = Motors::efforts;
  Caster caster_ = Caster::ball;
};

}  // namespace zwang::lang::test
