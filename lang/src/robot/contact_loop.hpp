/// The loop that a virtual robot closes over a contact, and how heavy the robot must be for it.
#pragma once

#include <optional>

#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// A virtual robot: so many times as heavy as the real one; while something presses on it, its velocities
/// fade with `damping` [1/s].
struct VirtualMass {
  double factor = 1.0;   ///< alpha
  double damping = 0.0;  ///< gamma
};

/// The least `factor * damping` for which the loop is stable at every wall, and no disturbance grows in it
/// by more than `largest_peak`. That product is how slowly the base moves in contact. None: no pair will do.
std::optional<VirtualMass> choose_virtual_mass(const Drive& drive);
/// max 1/|1 + L| over all frequencies and walls; infinite where the loop is not stable.
double worst_peak(const Drive& drive, const VirtualMass& virtual_mass);
/// [s] from a force to what the wheels make of it: delay, cycle, filters.
double felt_after(const Drive& drive);
/// The longest `delay` [s] of the same drive for which a pair would do; none: not even 0.
std::optional<double> longest_felt_delay(const Drive& drive);
/// Of the low pass that the felt force goes through. [s]
double felt_filter(const Drive& drive);

inline constexpr double largest_peak = 3.0;
/// [1/s] of `factor * damping`: above it a base is too slow in contact to be of use, and W632 tells it
inline constexpr double slowest_in_contact = 32.0;
inline constexpr double slow_in_contact = 12.0;

}  // namespace zwang::lang
