/// Diagnostics of a robot that stands before it moves, and of joints that cannot be what the robot file says.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// A <mimic> of the URDF.
struct Coupling {
  std::string joint;
  std::string leader;      ///< that it follows
  bool has_leader = true;  ///< false: the URDF has no joint of that name
  Span span;               ///< of `<mimic`
};
/// Of a wheel or a motor, named at `span` in the robot file.
Diagnostic coupled_joint(const Span& span, const Coupling& coupling);
/// `word` of `mimic: {joint: word}` in the robot file.
Diagnostic unknown_mimic(const Span& span, const std::string& word, const std::string& joint);
/// `joint` of `mimic` follows none. `following`: those that do.
Diagnostic no_mimic(const Span& span, const std::string& joint, const std::vector<std::string>& following);
/// `coupled` in the robot file, at `span`, of a joint that has a motor of its own.
Diagnostic coupled_motor(const Span& span, const Coupling& coupling);
/// `coupled` of a joint that the floor does not keep in step.
Diagnostic out_of_step(const Span& span, const Coupling& coupling);
/// Of joints that nothing drives. Not empty.
Diagnostic loose_couplings(const Span& span, const std::vector<Coupling>& couplings);

/// The joint stands at 0, which its travel from `lower` to `upper` does not hold. [rad], or [m] where it
/// slides
Diagnostic start_outside(const Span& span, const std::string& joint, bool slides, double lower, double upper,
                         const Span& declared);
/// A joint of an arm at the start. [rad], or [m] where it slides
struct NearEnd {
  std::string joint;
  bool slides = false;
  double left = 0.0, end = 0.0;
  double inside = 0.0;  ///< a place that is far enough
};
Diagnostic starts_near_an_end(const Span& span, const NearEnd& start);
/// `borne` by the joint at the start, more than its motor's `effort`. [N m], or [N] where it slides
Diagnostic arm_too_heavy(const Span& span, const std::string& joint, double borne, double effort,
                         bool slides);
Diagnostic wheel_without_trail(const Span& span, const std::string& wheel, const std::string& swivel);
Diagnostic upright_wheel(const Span& span, const std::string& joint, const Span& declared);
/// `carrier`: a joint between the base and the wheel that does not steer it.
Diagnostic loose_wheel(const Span& span, const std::string& wheel, const std::string& carrier,
                       const Span& declared);
/// `what`: the wheel, whose `holds` is empty.
Diagnostic holds_nothing(const Span& span, const std::string& what);
/// The wheel slides sideways, `holds: [rolling]`, and hangs on the moving joint `carrier`.
Diagnostic steered_skid(const Span& span, const std::string& wheel, const std::string& carrier,
                        const Span& declared);
/// The moving part that a support is, or hangs on.
enum class SupportOn { caster_wheel, ball, steered_link };
/// Of `supports`: a link that joint `carrier` moves.
Diagnostic moving_support(const Span& span, const std::string& link, const std::string& carrier,
                          SupportOn what, const Span& declared);
/// `above`: by how much the wheel's lowest point is higher than that of `other`. [m]
/// `drops`: of all wheels that end above the lowest one, by how much [m].
Diagnostic uneven_wheels(const Span& span, const std::string& wheel, const std::string& other, double above,
                         const Span& other_span, const std::vector<std::pair<std::string, double>>& drops);
/// How far a wheel's joint, or the one that steers it, is drawn from its exact place.
struct Deviation {
  std::string joint;
  double distance = 0.0;  ///< [m]
  double angle = 0.0;     ///< [rad]
  Span span;              ///< of the joint in the URDF
};
/// Not empty, the worst first.
Diagnostic nearly_exact_wheels(const Span& span, const std::vector<Deviation>& deviations);
/// `lever`: with which the wheels turn the base, `mirrored`: that of the mirrored rollers. [m]
Diagnostic mirrored_rollers(const Span& span, double lever, double mirrored);
struct MirroredWheel {
  Span span;
  std::string joint;
};
/// Some wheels, not all. `axis`: 0 x, 1 y, 2 rz, of which most is lost; `made` of it and `other`, with those
/// mirrored. [N], [N m]
Diagnostic mirrored_wheels(const std::vector<MirroredWheel>& wheels, int axis, double made, double other);
struct HeavyWheel {
  Span span;
  std::string joint;
  double about_axle;  ///< [kg m^2]
  double on_the_rim;  ///< [kg m^2] what its mass has at its radius
};
/// Not empty: who draws one so draws all so.
Diagnostic wheel_inertia_beyond_rim(const std::vector<HeavyWheel>& wheels);
struct UnbalancedWheel {
  Span span;
  std::string joint;
  double beside;  ///< [m] of its centre of mass from its axle
  double force;   ///< [N] with which its weight drives the base at most
};
/// Not empty.
Diagnostic unbalanced_wheels(const std::vector<UnbalancedWheel>& wheels);
/// Of a link in the URDF.
struct TinyMass {
  std::string link;
  Span span;
  double mass = 0.0;  ///< [kg]
};
/// Not empty.
Diagnostic negligible_masses(const std::vector<TinyMass>& links);
/// The keys that a link's entry in `inertias` of the robot file needs.
struct InertiaEntry {
  std::string link;
  bool lacks_mass = false;
  bool lacks_radius = false;  ///< it is no wheel, whose radius the file has
};
/// E808 of a link in the URDF that moves, or that is fixed to what does. `reason`: why no model can move it.
Diagnostic impossible_body(const Span& span, const std::string& reason, const InertiaEntry& entry);
/// A joint that swivels a wheel and has more inertia than its mass can have.
struct HeavySwivel {
  Span span;
  std::string joint;
  double about_axis;  ///< [kg m^2]
  double within;      ///< [kg m^2] what its mass has that far from the axis:
  double reach;       ///< [m]
};
/// Not empty.
Diagnostic swivel_inertia_beyond_reach(const std::vector<HeavySwivel>& swivels);
struct Push {
  double effort = 0.0;  ///< [N m] of the first wheel
  double push = 0.0;    ///< [N] of all wheels at the floor
  double holds = 0.0;   ///< [N] the most that a floor takes up
  double mass = 0.0;    ///< [kg]
};
Diagnostic push_beyond_floor(const Span& span, const std::string& joint, const Push& push);
Diagnostic wheel_across(const Span& span, const std::string& wheel, const Span& declared);
/// `value` with its unit: no body has so much, or so little.
Diagnostic beyond_all_bodies(const Span& span, const std::string& link, const std::string& what,
                             const std::string& value);
/// A limit of the robot file allows no motion at all.
Diagnostic limit_without_width(const Span& span, const std::string& what);
/// `depth`: how far one of the two has to move for them to part. [m]
Diagnostic starts_inside(const Span& span, const std::string& robot, const std::string& other, double depth);
/// Two objects, of which one can be pushed at least. `depth` [m]
Diagnostic objects_overlap(const Span& span, const std::string& one, const std::string& other, double depth,
                           const Span& other_span);

/// The simulated plant refuses to start; `reason` says why.
Diagnostic plant_refuses(const Span& span, const std::string& reason);

/// Of an axis or a group.
Diagnostic return_without_range(const Span& span, const std::string& what);

/// A row whose frame starts outside of what holds it.
struct StartOutside {
  std::string row;        ///< "always.fence", "wait.back.x"
  std::string region;     ///< empty: a range of positions
  double distance = 0.0;  ///< [m] or [rad]
  double speed = 0.0;     ///< of the way back [m/s] or [rad/s]
  bool turns = false;
};
Diagnostic starts_outside(const Span& span, const StartOutside& start);

/// A speed that the wheels cannot turn to.
struct TooFast {
  std::string axis;
  bool turns = false;
  double asked = 0.0;             ///< [m/s] or [rad/s]
  double most = 0.0;              ///< [m/s] or [rad/s]
  std::string wheel;              ///< the joint that is at its limit first
  double wheel_most = 0.0;        ///< [rad/s]
  bool is_range = false;          ///< it is allowed, not asked for
  bool in_any_direction = false;  ///< `most` is that of the best one
  bool slides = false;            ///< the joint: its limit is in [m/s]
};
Diagnostic beyond_the_wheels(const Span& span, const TooFast& fast, const Span& wheel);
/// Of an arm: `fast.wheel` is the joint that adds most.
Diagnostic beyond_the_joints(const Span& span, const TooFast& fast, const Span& joint);

/// `most` 0: it leads back; else so many files are too many.
Diagnostic based_on_itself(const Span& span, const std::string& file, int most);
Diagnostic update_of_based_on(const Span& span, const std::string& file);
Diagnostic update_unreadable(const Span& span);

}  // namespace zwang::lang::wording
