/// What a number measures.
#pragma once

#include <string>

namespace zwang::lang {

/// Powers of length, mass, time and angle. Angle counts as a dimension of its own, so that `deg/s` where
/// `m/s` belongs is found.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int angle = 0;

  bool operator==(const Dimension&) const = default;
  Dimension operator*(const Dimension& o) const {
    return {length + o.length, mass + o.mass, time + o.time, angle + o.angle};
  }
  Dimension operator/(const Dimension& o) const {
    return {length - o.length, mass - o.mass, time - o.time, angle - o.angle};
  }
  Dimension power(int n) const { return {length * n, mass * n, time * n, angle * n}; }
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension velocity{1, 0, -1, 0};
inline constexpr Dimension acceleration{1, 0, -2, 0};
inline constexpr Dimension mass{0, 1, 0, 0};
inline constexpr Dimension inertia{2, 1, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension frequency{0, 0, -1, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension angular_velocity{0, 0, -1, 1};
inline constexpr Dimension angular_acceleration{0, 0, -2, 1};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension torque{2, 1, -2, 0};
inline constexpr Dimension stiffness{0, 1, -2, 0};
inline constexpr Dimension damping{0, 1, -1, 0};
inline constexpr Dimension angular_stiffness{2, 1, -2, -1};
inline constexpr Dimension angular_damping{2, 1, -1, -1};
}  // namespace dimension

/// `a velocity`, `a plain number`; of an uncommon one `a quantity in kg^2 m`.
std::string describe(const Dimension& dimension);
/// The unit an author would write for it: `m/s`; empty for a plain number.
std::string usual_unit(const Dimension& dimension);

}  // namespace zwang::lang
