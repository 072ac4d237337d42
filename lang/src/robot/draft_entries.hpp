/// Entries of a drafted robot file that depend on few things.
#pragma once

#include <string>

#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

/// As precise as a drawing.
std::string in_millimetres(double metres);

/// `mimic`: joints that the file names elsewhere, and that follow another one. Empty where none does.
std::string mimic_entry(const Urdf& urdf, const FoundWheels& found);

/// `stop`, at this deceleration [m/s^2], of a mass [kg]; 0: not known.
std::string stop_entry(double mass, double deceleration);

/// The deceleration [m/s^2], rounded down, within which no model of the draft tips over (W640). Infinite
/// where nothing is known to carry the base.
double steady_deceleration(const RobotDraft& draft);

}  // namespace zwang::lang
