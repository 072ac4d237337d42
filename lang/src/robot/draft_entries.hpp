/// Entries of a drafted robot file that depend on few things.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "robot/draft_bodies.hpp"
#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

/// [a, b]
std::string in_brackets(const std::vector<std::string>& names);

/// `fixed`: joints that the draft holds. Empty where there is none.
std::string fixed_entry(const std::vector<std::string>& joints);

/// A steering gets as much rotor inertia as it turns, and as much as its strength goes with: a servo has that
/// behind its gear. Without it a push on a light wheel turns the steering, and wheels that toe hold the base
/// from 0.5 deg on.
/// Empty where two driven wheels on the swivel hold it, and where the URDF has no masses. `bodies`: links to
/// which the draft gives another inertia.
std::string steering_rotor(const Urdf& urdf, const FoundWheels& found, const std::vector<DraftBody>& bodies,
                           const std::string& joint);

/// [rad] Of steered swivels whose wheels do not roll ahead as they are drawn: where they do.
std::map<std::string, double> steered_ahead(const Urdf& urdf, const FoundWheels& found);

inline constexpr const char* effort_note =
    "\n# effort: the largest torque on the joint's side, as `2 N m`; without it the URDF's. Add gear and\n# "
    "rotor_inertia, as {gear: 20, rotor_inertia: 2 kg mm^2}: they are often larger than the wheel's own "
    "inertia.\n";

/// The friction of the URDF's <dynamics>, as a comment: many URDFs have numbers that calm a simulator. Empty
/// where no joint with a motor has any. `held`: joints of `fixed`.
std::string friction_note(const Urdf& urdf, const FoundWheels& found, const std::vector<std::string>& held);

/// As precise as a drawing.
std::string in_millimetres(double metres);

/// A comment line for each wheel or steering joint that the URDF lacks. `has_none`: no wheel was found.
std::vector<std::string> missing_of_joints(const Urdf& urdf, const FoundWheels& found, bool has_none);

/// Of a joint in that comment: it stands nowhere in the file.
inline constexpr const char* stands_nowhere = "` is not here: the URDF has it ";
/// A comment for each joint that is called a wheel, where others turn.
std::string stuck_wheels_note(const FoundWheels& found);

/// `mimic`: joints that the file names elsewhere, and that follow another one. Empty where none does.
std::string mimic_entry(const Urdf& urdf, const FoundWheels& found);

/// `stop`, at this deceleration [m/s^2], of a mass [kg]; 0: not known, and the force is `open`.
std::string stop_entry(double mass, double deceleration, const std::string& open);

/// Says in `missing` that the mass lies on the edge of what carries the base, where it does.
void add_edge_note(RobotDraft& draft);

/// The deceleration [m/s^2], rounded down, within which no model of the draft tips over (W640). Infinite
/// where nothing is known to carry the base.
double steady_deceleration(const RobotDraft& draft);

}  // namespace zwang::lang
