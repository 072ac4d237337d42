#pragma once

namespace zwang::lang {

/// The units of what is said of an axis, which turns or slides.
struct AxisUnits {
  const char *force, *mass, *acceleration, *speed, *way;
};

inline AxisUnits axis_units(bool turns) {
  return turns ? AxisUnits{"N m", "kg m^2", "rad/s^2", "rad/s", "deg"}
               : AxisUnits{"N", "kg", "m/s^2", "m/s", "m"};
}

}  // namespace zwang::lang
