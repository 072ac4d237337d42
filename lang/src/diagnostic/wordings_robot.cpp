#include <cmath>

#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/text.hpp"
#include "words/units.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang::wording {

Diagnostic not_positive(const Span& span, const std::string& what, bool zero_allowed) {
  return error("E105", span, what + (zero_allowed ? " cannot be below 0" : " must be above 0"));
}

Diagnostic fixed_joint(const Span& span, const std::string& joint, const Span& declared) {
  return with_related(error("E801", span, "joint `" + joint + "` is fixed: it cannot move"), declared,
                      "it is declared here");
}

Diagnostic ignored_part(const Span& span, const std::string& part, const std::string& link,
                        const Span& ignored) {
  return with_related(error("E801", span,
                            in_ticks(part) + (part == link ? " is left out by `ignore`"
                                                           : " belongs to link " + in_ticks(link) +
                                                                 ", which `ignore` leaves out")),
                      ignored, "it is left out here");
}

Diagnostic sliding_wheel(const Span& span, const std::string& joint, const Span& declared) {
  return with_related(error("E802", span, "a wheel turns, but joint `" + joint + "` slides"), declared,
                      "it is declared here");
}

Diagnostic doubled_wheel(const Span& span, const std::string& joint) {
  return error("E802", span, "joint `" + joint + "` carries two wheels");
}

Diagnostic no_wheels(const Span& span) {
  return error("E802", span, "`wheels` holds no wheel");
}

Diagnostic roller_angle(const Span& span, const std::string& what) {
  return error(
      "E802", span, what + "'s rollers lie along its axis: it could drive nothing",
      "give the angle from the wheel's axis to the roller's at the ground: about `45 deg` on a mecanum "
      "wheel, `90 deg` on an omni wheel");
}

Diagnostic holds_and_roller(const Span& span, const std::string& what) {
  return error("E802", span, what + " gives both `roller` and `holds`",
               "a wheel with rollers holds the direction of the roller's axis only");
}

Diagnostic unknown_direction(const Span& span, const std::string& text) {
  return error("E802", span, "a wheel cannot hold " + in_ticks(text), "it holds `rolling` and `sideways`");
}

Diagnostic base_below_joint(const Span& span, const std::string& base, const std::string& joint) {
  return error("E803", span, "base `" + base + "` hangs on the moving joint `" + joint + "`",
               "name the link that carries the wheels and hangs on nothing that moves");
}

Diagnostic no_effort(const Span& span, const std::string& joint, const Span& declared) {
  return with_related(error("E804", span, "nobody says how strong the motor of joint `" + joint + "` is",
                            "add `effort: .. N m`; the URDF gives no effort above 0"),
                      declared, "the joint is declared here");
}

Diagnostic compensation_too_large(const Span& span, const std::string& what) {
  return error("E805", span, what + " must stay below 100 %: it would push the robot by itself");
}

Diagnostic limit_without_rest(const Span& span, const std::string& what) {
  return error("E806", span, what + " does not allow standing still", "the range must hold 0");
}

Diagnostic too_few_corners(const Span& span, const std::string& what) {
  return error("E807", span, "the polygon of `" + what + "` needs at least three corners");
}

Diagnostic flat_polygon(const Span& span, const std::string& what) {
  return error("E807", span, "the polygon of `" + what + "` encloses no area");
}

Diagnostic posture_outside(const Span& span, const std::string& what, const Span& joint) {
  return with_related(error("E809", span, what + " is outside the joint's limits"), joint,
                      "they are given here");
}

Diagnostic impossible_model(const Span& span, const std::string& reason) {
  const std::string_view origin = "model: ";
  return error("E808", span,
               "this robot cannot move as described: " +
                   (reason.starts_with(origin) ? reason.substr(origin.size()) : reason),
               "give every link that moves a mass above 0 and the inertia of a real body");
}

Diagnostic control_period_outside(const Span& span, double period) {
  const auto ms = [](double time) { return figure(time * 1e3, "ms"); };
  const std::string longest = ms(longest_control_period);
  return error("E811", span,
               "a control period of " + ms(period) + " is not between " + ms(shortest_control_period) +
                   " and " + longest,
               "limits of speed brake within " + longest + ": torques must come as often");
}

Diagnostic encoder_step_outside(const Span& span, double step) {
  return error("E813", span,
               "an encoder that counts every " + figure(step, "rad") + " is coarser than " +
                   figure(longest_encoder_step, "rad"),
               "give the least change of the wheel's angle that the robot reports: 2 pi by the counts of one "
               "turn of the wheel, gear included");
}

Diagnostic coarse_encoders(const Span& span, double step, double radius) {
  constexpr double acceleration = 1.0;  // [m/s^2]
  const double way = blind_steps * step * radius;
  if (way <= least_blind_way)
    return warning(
        "W813", span,
        "encoders that count every " + figure(step * 1e3, "mrad") +
            " do not see a wheel turn that a wall holds: while the base slides along the wall, the "
            "guard may take that wheel's encoder for dead and stop the base",
        "read the encoders with all of their edges, or on the motor's side of the gear");
  return warning("W813", span,
                 "the wheels' encoders count every " + figure(step * radius * 1e3, "mm") +
                     " of way: if they die as the base sets out, it goes on for " + figure(way * 1e3, "mm") +
                     ", at 1 m/s^2 to " + figure(std::sqrt(2.0 * acceleration * way), "m/s"),
                 "encoders of " + figure(least_blind_way / (blind_steps * radius) * 1e3, "mrad") +
                     " or less keep it to " + figure(least_blind_way * 1e3, "mm"));
}

Diagnostic estimate_without_torque(const Span& span, const std::string& name) {
  return error(
      "E634", span,
      in_ticks(name) + " needs the motors' torques, and a drive that takes velocities does not tell them",
      "ask whether a row is `saturated`, or measure the force with a signal");
}

Diagnostic unknown_drive_word(const Span& span, const std::string& key, const std::string& text,
                              const std::vector<std::string>& known) {
  std::string words;
  for (const std::string& word : known) words += (words.empty() ? "" : " or ") + in_ticks(word);
  return error("E815", span, "`" + key + "` of a drive cannot be " + in_ticks(text), "write " + words);
}

Diagnostic limit_beside_twist(const Span& span) {
  return error("E814", span, "a torque limit of each wheel cannot be sent with the base's twist",
               "command the wheels, `as: wheels`; or write `torque_limit: fixed`, and the base is blind");
}

Diagnostic twist_of_swivels(const Span& span, const std::string& joint, const Span& drive) {
  return with_related(error("E814", span,
                            "wheel " + in_ticks(joint) +
                                " swivels: twists for wheels that do not hang on the base are not built yet",
                            "command the wheels: `as: wheels`"),
                      drive, "this drive takes the base's twist");
}

Diagnostic drive_without_wheel(const Span& span, const std::string& joint, const Span& drive) {
  return with_related(
      error("E814", span,
            "joint " + in_ticks(joint) +
                " has a motor and turns no wheel: velocities for such a motor are not built yet",
            "hold the joint under `fixed`, or let the drive take torques"),
      drive, "this drive takes velocities of wheels");
}

Diagnostic drive_key_beside_torque(const Span& span, const std::string& key) {
  return error("E815", span, in_ticks(key) + " says nothing of a drive that takes torques",
               "remove it, or write `command: velocity`");
}

Diagnostic drive_too_slow(const Span& span, double rate) {
  return error("E815", span, "a drive that is told " + figure(rate, "Hz") + " is too slow",
               "zwang has been tried from " + figure(slowest_drive_rate, "Hz") + " on");
}

Diagnostic drive_too_late(const Span& span, double delay) {
  return error("E815", span, "a delay of " + figure(delay * 1e3, "ms") + " is too long",
               "zwang has been tried up to " + figure(longest_drive_delay * 1e3, "ms"));
}

Diagnostic xml_too_deep(const Span& span, int limit) {
  return error("E851", span, "elements are nested deeper than " + std::to_string(limit) + " levels");
}

Diagnostic too_many_attributes(const Span& span, std::size_t limit) {
  return error("E852", span, "this element has more than " + std::to_string(limit) + " attributes");
}

Diagnostic too_many_links(const Span& span, std::size_t limit) {
  return error("E853", span, "the robot has more than " + std::to_string(limit) + " links");
}

Diagnostic not_xml(const Span& span, const std::string& reason) {
  return error("E854", span, "this is not readable as XML: " + reason);
}

Diagnostic not_urdf(const Span& span, const std::string& root) {
  return error("E854", span, "a URDF's outermost element is <robot>, not <" + escaped(root) + ">");
}

Diagnostic unexpanded_macro(const Span& span, const std::string& text) {
  return error("E855", span, in_ticks(text) + " is an xacro expression that nobody expanded",
               "run xacro on the source and use what it writes");
}

Diagnostic bad_urdf_number(const Span& span, const std::string& attribute, const std::string& text,
                           std::size_t count) {
  return error("E856", span,
               "`" + attribute + "` must be " +
                   (count == 1 ? "a finite number" : std::to_string(count) + " finite numbers") + ", not " +
                   in_ticks(text),
               "decimal point, no unit, SI");
}

Diagnostic unnamed_element(const Span& span, const std::string& element) {
  return error("E857", span, "this <" + element + "> has no name");
}

Diagnostic doubled_in_urdf(const Span& span, const std::string& kind, const std::string& name) {
  return error("E857", span, "there are two " + kind + "s named " + in_ticks(name));
}

Diagnostic no_links(const Span& span) {
  return error("E857", span, "this robot has no links");
}

Diagnostic joint_without_link(const Span& span, const std::string& joint, const std::string& role) {
  return error("E857", span, "joint " + in_ticks(joint) + " does not say its " + role + " link");
}

Diagnostic missing_link(const Span& span, const std::string& joint, const std::string& link) {
  return error("E857", span,
               "joint " + in_ticks(joint) + " joins the link " + in_ticks(link) + ", which is missing");
}

Diagnostic two_parents(const Span& span, const std::string& link) {
  return error("E857", span, "link " + in_ticks(link) + " hangs on two joints");
}

Diagnostic no_root(const Span& span) {
  return error("E857", span, "every link hangs on another: there is no root");
}

Diagnostic two_roots(const Span& span, const std::string& first, const std::string& second) {
  return error("E857", span,
               "links " + in_ticks(first) + " and " + in_ticks(second) + " both hang on nothing",
               "join them: a robot has one root");
}

Diagnostic unreached_link(const Span& span, const std::string& link, const std::string& root) {
  return error("E857", span, "no joints lead from " + in_ticks(root) + " to link " + in_ticks(link));
}

Diagnostic incomplete_inertial(const Span& span, const std::string& link, const std::string& missing) {
  return error("E858", span, "the inertial of link " + in_ticks(link) + " does not give `" + missing + "`");
}

Diagnostic impossible_mass(const Span& span, const std::string& link, double mass) {
  return error("E858", span, "link " + in_ticks(link) + " cannot weigh " + format_number(mass) + " kg");
}

Diagnostic impossible_inertia(const Span& span, const std::string& link) {
  return error("E858", span, "the inertia of link " + in_ticks(link) + " is negative about some axis");
}

Diagnostic negligible_inertia(const Span& span, const std::string& link, double mass, double share) {
  return warning("W863", span,
                 "no body has the inertia of link " + in_ticks(link) + ": it counts as a point of " +
                     figure(mass, "kg") + ", " + figure(100.0 * share, "%") + " of the robot",
                 "list it under `ignore` in the robot file, and it is not there at all");
}

Diagnostic corrected_inertia(const Span& span, const std::string& link, double share) {
  return warning("W871", span,
                 "no body has the inertia of link " + in_ticks(link) +
                     ": one moment is larger than the other two together; each counts as if it were " +
                     figure(100.0 * share, "%") + " of the largest off",
                 "correct the link's `<inertia>`; often a product has the wrong sign");
}

Diagnostic joint_type(const Span& span, const std::string& joint, const std::string& type) {
  return error("E859", span,
               type.empty() ? "joint " + in_ticks(joint) + " has no type"
                            : "joint " + in_ticks(joint) + " has the type " + in_ticks(type) +
                                  ", which zwang does not move",
               "known are fixed, revolute, continuous and prismatic");
}

Diagnostic zero_axis(const Span& span, const std::string& joint) {
  return error("E859", span, "the axis of joint " + in_ticks(joint) + " has no direction");
}

Diagnostic joint_without_limit(const Span& span, const std::string& joint, const std::string& type) {
  return error("E859", span, "the " + type + " joint " + in_ticks(joint) + " has no <limit>");
}

Diagnostic unordered_limits(const Span& span, const std::string& joint, double lower, double upper,
                            bool slides) {
  const auto limit = [&](double value) { return slides ? figure(value, "m") : figure(value, "rad"); };
  return warning("W876", span,
                 "the lower limit of joint " + in_ticks(joint) + ", " + limit(lower) +
                     ", is above its upper limit, " + limit(upper) + ": it counts as moving between both",
                 "exchange `lower` and `upper` in the URDF");
}

Diagnostic negative_limit(const Span& span, const std::string& joint) {
  return error("E859", span, "effort and velocity limits of joint " + in_ticks(joint) + " cannot be negative",
               "give the largest torque and speed; where there is no limit, 0 or -1");
}

Diagnostic urdf_refused(const Span& span, const std::string& message) {
  return error("E860", span,
               "the URDF library refuses this robot: " + (message.empty() ? "no reason given" : message));
}

Diagnostic one_shape(const Span& span, const std::string& what) {
  return error("E901", span, what + " needs exactly one shape", "give it a `box`, a `cylinder` or a `wall`");
}

Diagnostic fixed_with_mass(const Span& span, const std::string& what, const Span& mass) {
  return with_related(error("E902", span, what + " is fixed and has a mass", "keep one of them"), mass,
                      "`mass` is given here");
}

}  // namespace zwang::lang::wording
