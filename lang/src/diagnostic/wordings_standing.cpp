#include "diagnostic/wordings_standing.hpp"

#include <cmath>
#include <numbers>

#include "diagnostic/make.hpp"
#include "diagnostic/wheel_places.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "words/text.hpp"

namespace zwang::lang::wording {

namespace {

std::string in_length(double metres) {
  return std::abs(metres) < 0.1 ? figure(metres * 1e3, "mm") : figure(metres, "m");
}

/// Each part that is told by itself, or the larger one.
std::string off_by(const Deviation& deviation) {
  std::string text;
  if (deviation.distance >= told_wheel_offset) text = in_length(deviation.distance);
  if (deviation.angle >= told_axis_angle)
    text += (text.empty() ? "" : " and ") + angle_in_degrees(deviation.angle);
  return text;
}

std::string follows(const Coupling& coupling) {
  return "joint " + in_ticks(coupling.joint) + " follows " + in_ticks(coupling.leader) +
         (coupling.has_leader ? " by a <mimic> of the URDF" : ", which the URDF does not have");
}

}  // namespace

Diagnostic coupled_joint(const Span& span, const Coupling& coupling) {
  const std::string reason = coupling.has_leader ? ", and zwang moves each joint by itself" : "";
  return with_related(
      error("E861", span, follows(coupling) + reason,
            "say `mimic: {" + coupling.joint +
                ": ignore}` if the joint moves by itself, `coupled` if a belt turns both wheels; "
                "else make it `fixed`"),
      coupling.span, "it is coupled here");
}

Diagnostic unknown_mimic(const Span& span, const std::string& word, const std::string& joint) {
  return error("E861", span, "a <mimic> cannot be " + in_ticks(word),
               "say `ignore` if `" + joint +
                   "` moves by itself, `coupled` if a belt turns both wheels; list it under `fixed` where it "
                   "stands");
}

Diagnostic no_mimic(const Span& span, const std::string& joint, const std::vector<std::string>& following) {
  Diagnostic diagnostic = unknown_name(span, "joint with a <mimic>", joint, following);
  diagnostic.code = "E861";
  return diagnostic;
}

Diagnostic coupled_motor(const Span& span, const Coupling& coupling) {
  return with_related(error("E861", span,
                            in_ticks(coupling.joint) + " is coupled to " + in_ticks(coupling.leader) +
                                " and has a motor of its own",
                            "leave it out of `actuated`, or say `mimic: {" + coupling.joint + ": ignore}`"),
                      coupling.span, "it is coupled here");
}

Diagnostic out_of_step(const Span& span, const Coupling& coupling) {
  return with_related(
      error("E861", span,
            "the floor does not keep " + in_ticks(coupling.joint) + " in step with " +
                in_ticks(coupling.leader) +
                ", and zwang simulates no other coupling: it needs two plain wheels in line, of one radius",
            "say `ignore`: each of the two moves by itself then; or list it under `fixed`"),
      coupling.span, "it is coupled here");
}

Diagnostic loose_couplings(const Span& span, const std::vector<Coupling>& couplings) {
  const std::size_t others = couplings.size() - 1;
  std::string message = follows(couplings.front());
  if (others > 0)
    message += ", and " + std::to_string(others) + (others > 1 ? " more do so" : " more does so");
  message += couplings.size() > 1 ? ": zwang couples no joints, they swing freely"
                                  : ": zwang couples no joints, it swings freely";
  Diagnostic result = warning("W862", span, std::move(message), "where that matters list them under `fixed`");
  for (const Coupling& coupling : couplings) {
    if (&coupling == &couplings.front() || !coupling.has_leader)
      result.related.push_back({coupling.span, follows(coupling)});
  }
  return result;
}

Diagnostic start_outside(const Span& span, const std::string& joint, bool slides, double lower, double upper,
                         const Span& declared) {
  const char* unit = slides ? "m" : "rad";
  const double middle = 0.5 * (lower + upper);
  return with_related(error("E809", span,
                            "joint " + in_ticks(joint) + " starts at 0, and its travel is " +
                                figure(lower, unit) + " to " + figure(upper, unit),
                            "say where it starts: `posture: {" + joint + ": " + figure(middle, unit) + "}`"),
                      declared, "its travel is given here");
}

Diagnostic starts_near_an_end(const Span& span, const NearEnd& start) {
  const auto text = [&](double q) { return start.slides ? in_length(q) : angle_in_degrees(q); };
  return warning("W809", span,
                 "joint " + in_ticks(start.joint) + " starts " + text(start.left) +
                     " from an end of its travel, " + text(start.end) +
                     ": the guard stops the robot as soon as the arm sways",
                 "start farther inside, as `posture: {" + start.joint + ": " + text(start.inside) + "}`");
}

Diagnostic arm_too_heavy(const Span& span, const std::string& joint, double borne, double effort,
                         bool slides) {
  const char* unit = slides ? "N" : "N m";
  return warning("W874", span,
                 "the motor of " + in_ticks(joint) + " cannot hold what hangs on it: that is " +
                     figure(borne, unit) + " at the start, and the motor has " + figure(effort, unit),
                 "write the motor's own torque, as `" + joint + ": {effort: " + figure(1.5 * borne, unit) +
                     "}`; or start the joint elsewhere by `posture`, or hold it under `fixed`");
}

Diagnostic wheel_without_trail(const Span& span, const std::string& wheel, const std::string& swivel) {
  return warning(
      "W877", span,
      "nothing turns the free swivel " + in_ticks(swivel) + ": wheel " + in_ticks(wheel) +
          " stands right below it, and holds the base sideways",
      "if it is a ball, list both joints under `fixed`, and the wheel's link under `supports` instead "
      "of `wheels`; else mend the wheel's <origin>: a caster's wheel stands behind its swivel");
}

Diagnostic upright_wheel(const Span& span, const std::string& joint, const Span& declared) {
  return with_related(
      error("E802", span, "a wheel rolls about a level axis, but joint " + in_ticks(joint) + "'s points up",
            "mend its <axis> or <origin> in the URDF; a swivel is not listed, only the wheel below it"),
      declared, "it is declared here");
}

Diagnostic loose_wheel(const Span& span, const std::string& wheel, const std::string& carrier,
                       const Span& declared) {
  return with_related(error("E802", span,
                            "wheel " + in_ticks(wheel) + " hangs on joint " + in_ticks(carrier) +
                                ", which moves and does not steer it",
                            "list " + in_ticks(carrier) +
                                " under `fixed`: zwang's bases stand level, without rockers and springs"),
                      declared, "it is declared here");
}

Diagnostic holds_nothing(const Span& span, const std::string& what) {
  return error("E802", span, what + " holds neither `rolling` nor `sideways`: it carries, and drives nothing",
               "delete `holds` for a plain wheel, or list its link under `supports`");
}

Diagnostic steered_skid(const Span& span, const std::string& wheel, const std::string& carrier,
                        const Span& declared) {
  return with_related(
      error("E802", span,
            "wheel " + in_ticks(wheel) + " slides sideways, and joint " + in_ticks(carrier) +
                " steers it: the simulated plant has friction for such wheels on the base only",
            "delete its `holds`: a wheel that is steered holds sideways, too"),
      declared, "it is steered here");
}

Diagnostic moving_support(const Span& span, const std::string& link, const std::string& carrier,
                          SupportOn what, const Span& declared) {
  std::string help =
      "a caster's wheel is one of `wheels`, without a motor: `{joint: " + carrier + ", radius: 50 mm}`";
  if (what == SupportOn::ball)
    help = "a ball stands as well without its joints: list " + in_ticks(carrier) + " under `fixed`";
  if (what == SupportOn::steered_link)
    help =
        "delete it: what a steered link carries is no support. Without supports, a base on two wheels "
        "stands on its `footprint`";
  return with_related(error("E802", span,
                            "a support stands still on the base, but " + in_ticks(link) + " hangs on joint " +
                                in_ticks(carrier),
                            help),
                      declared, "it is declared here");
}

Diagnostic uneven_wheels(const Span& span, const std::string& wheel, const std::string& other, double above,
                         const Span& other_span, const std::vector<std::pair<std::string, double>>& drops) {
  std::string lower = "`drop: " + in_length(above) + "`: it stands that much lower than the URDF draws it";
  if (drops.size() > 1) {
    lower = "how much lower than drawn each stands, as `drop: " + in_length(above) + "`:";
    for (const auto& [joint, drop] : drops)
      lower += (joint == drops.front().first ? " " : ", ") + in_ticks(joint) + " " + in_length(drop);
  }
  return with_related(
      error("E810", span,
            "the wheels do not stand on one level: " + in_ticks(wheel) + " ends " + in_length(above) +
                " above " + in_ticks(other),
            "mend a `radius`; or, if a spring, a rocker or the drawing holds it so high, write " + lower),
      other_span, "this one reaches lowest");
}

Diagnostic nearly_exact_wheels(const Span& span, const std::vector<Deviation>& deviations) {
  const Deviation& worst = deviations.front();
  const bool is_trail = worst.distance > most_wheel_offset;
  Diagnostic result =
      warning("W812", span,
              "joint " + in_ticks(worst.joint) + " is drawn " + off_by(worst) +
                  " off its exact place: zwang takes the wheel as if it stood there",
              "correct its <origin> in the URDF, or name a `base` that stands on the axle; zwang corrects " +
                  in_length(most_wheel_offset) + " and " + angle_in_degrees(most_axis_angle) + " at most" +
                  (is_trail ? ", and a tenth of the radius under a steering that cannot swing round" : ""));
  for (const Deviation& deviation : deviations) {
    result.related.push_back(
        {deviation.span, in_ticks(deviation.joint) + " is drawn here, " + off_by(deviation) + " off"});
  }
  return result;
}

Diagnostic mirrored_rollers(const Span& span, double lever, double mirrored) {
  return warning(
      "W868", span,
      "the wheels turn this base with a lever of " + figure(lever, "m") + ", with mirrored rollers it is " +
          figure(mirrored, "m"),
      "`roller` is that of the roller on the ground, which seen from above is mirrored: change its "
      "sign at every wheel");
}

Diagnostic mirrored_wheels(const std::vector<MirroredWheel>& wheels, int axis, double made, double other) {
  std::string names;
  for (std::size_t i = 0; i < wheels.size(); ++i)
    names += (i == 0 ? "" : i + 1 < wheels.size() ? ", " : " and ") + in_ticks(wheels[i].joint);
  const char* unit = axis == 2 ? "N m" : "N";
  const char* words[] = {"along x", "along y", "to turn with"};
  Diagnostic result = warning(
      "W868", wheels.front().span,
      "the rollers of " + names + " stand against the others: " + figure(made, unit) + " are left " +
          words[axis] + ", with them mirrored it is " + figure(other, unit),
      "change the sign of `roller` there: it is that of the roller on the ground, which seen from above is "
      "mirrored");
  for (std::size_t i = 1; i < wheels.size(); ++i)
    result.related.push_back({wheels[i].span, "this roller, too"});
  return result;
}

Diagnostic wheel_inertia_beyond_rim(const std::vector<HeavyWheel>& wheels) {
  const HeavyWheel& first = wheels.front();
  const std::string others =
      wheels.size() > 1 ? "; so it is with " + std::to_string(wheels.size() - 1) + " more" : std::string();
  return warning(
      "W870", first.span,
      "wheel " + in_ticks(first.joint) + " has " + figure(first.about_axle, "kg m^2") +
          " about its axle, and its mass, all of it on the rim, has " + figure(first.on_the_rim, "kg m^2") +
          others,
      "list its link under `inertias` in the robot file, as `LINK: {}`: it counts as a disc then, with " +
          figure(0.5 * first.on_the_rim, "kg m^2"));
}

Diagnostic unbalanced_wheels(const std::vector<UnbalancedWheel>& wheels) {
  const UnbalancedWheel& first = wheels.front();
  const std::string others =
      wheels.size() > 1 ? "; so it is with " + std::to_string(wheels.size() - 1) + " more" : std::string();
  return warning("W875", first.span,
                 "wheel " + in_ticks(first.joint) + " has its centre of mass " + in_length(first.beside) +
                     " beside its axle: its weight drives the base with up to " + figure(first.force, "N") +
                     others,
                 "list its link under `inertias` in the robot file, as `LINK: {}`: it counts as a disc about "
                 "its axle then");
}

Diagnostic negligible_masses(const std::vector<TinyMass>& links) {
  const TinyMass& first = links.front();
  const std::string others =
      links.size() > 1 ? "; so it is with " + std::to_string(links.size() - 1) + " more" : std::string();
  return warning("W863", first.span,
                 "link " + in_ticks(first.link) + " has " + figure(first.mass, "kg") +
                     ", less than a grain of dust: it counts as none" + others,
                 "list it under `ignore` in the robot file, and it is not there at all");
}

Diagnostic impossible_body(const Span& span, const std::string& reason, const InertiaEntry& entry) {
  std::string keys = entry.lacks_mass ? "mass: 1 kg" : "";
  if (entry.lacks_radius) keys += (keys.empty() ? "" : ", ") + std::string("radius: 0.1 m");
  return error("E808", span, "this robot cannot move as described: " + reason,
               "list the link under `inertias` in the robot file, as `" + entry.link + ": {" + keys +
                   "}`: it counts as a solid " + (entry.lacks_radius ? "ball" : "disc") +
                   " then; or mend its <inertial> in the URDF");
}

Diagnostic swivel_inertia_beyond_reach(const std::vector<HeavySwivel>& swivels) {
  const HeavySwivel& first = swivels.front();
  const std::string others =
      swivels.size() > 1 ? "; so it is with " + std::to_string(swivels.size() - 1) + " more" : std::string();
  return warning(
      "W870", first.span,
      "swivel " + in_ticks(first.joint) + " has " + figure(first.about_axis, "kg m^2") +
          " about its axis, and its mass, all of it " + in_length(first.reach) + " off, has " +
          figure(first.within, "kg m^2") + others,
      "list its link under `inertias` in the robot file, as `LINK: {radius: 50 mm}`: it counts as a "
      "solid ball then; the base seems much heavier while it turns such swivels");
}

Diagnostic push_beyond_floor(const Span& span, const std::string& joint, const Push& push) {
  const double slips = push.effort * push.holds / push.push;
  return warning("W872", span,
                 "the URDF's torques press with " + figure(push.push, "N") +
                     " against the floor, and no floor holds " + figure(push.holds, "N") + " of a robot of " +
                     figure(push.mass, "kg") + ": " + in_ticks(joint) + " has " + figure(push.effort, "N m"),
                 "write the motor's own torque, of its data sheet, as `" + joint +
                     ": {effort: 2 N m}`, or for all wheels `each_wheel: {effort: 2 N m}`; with " +
                     figure(slips, "N m") + " the wheel spins on every floor");
}

Diagnostic wheel_across(const Span& span, const std::string& wheel, const Span& declared) {
  return with_related(warning("W869", span,
                              "wheel " + in_ticks(wheel) +
                                  " turns about an axis across its own cylinder: it would "
                                  "roll over its edge",
                              "let the joint's `<axis>` point along the cylinder's z, in the link's axes"),
                      declared, "the joint is declared here");
}

Diagnostic beyond_all_bodies(const Span& span, const std::string& link, const std::string& what,
                             const std::string& value) {
  return error("E858", span, "link " + in_ticks(link) + " cannot have " + what + " of " + value,
               "look at the unit: a URDF is in kg, m and kg m^2");
}

Diagnostic limit_without_width(const Span& span, const std::string& what) {
  return error("E806", span, what + " allows nothing but standing still", "give the range a width");
}

Diagnostic starts_inside(const Span& span, const std::string& robot, const std::string& other, double depth) {
  return error("E913", span,
               robot + " starts inside " + in_ticks(other) + ": they overlap by " + in_length(depth),
               "move one of them: the footprint of a robot must be clear of what it could touch");
}

Diagnostic objects_overlap(const Span& span, const std::string& one, const std::string& other, double depth,
                           const Span& other_span) {
  return with_related(error("E913", span,
                            in_ticks(one) + " starts inside " + in_ticks(other) + ": they overlap by " +
                                in_length(depth) + ", and their contact throws them apart",
                            "move one of them by " + in_length(depth) + " at least"),
                      other_span, in_ticks(other) + " stands here");
}

Diagnostic plant_refuses(const Span& span, const std::string& reason) {
  return error("E915", span, "the simulated plant cannot start: " + reason,
               "change the part that it names: `run` and `test` start with the simulated plant");
}

Diagnostic return_without_range(const Span& span, const std::string& what) {
  return error("E104", span, in_ticks(what) + " gives a `return` and no range of positions to come back into",
               "give a range, `position: [low, high]`, or delete `return`");
}

Diagnostic starts_outside(const Span& span, const StartOutside& start) {
  const std::string of = start.region.empty() ? "its range" : "region " + in_ticks(start.region);
  const std::string by = start.turns ? figure(start.distance, "rad") : in_length(start.distance);
  const std::string speed = figure(start.speed, start.turns ? "rad/s" : "m/s");
  const std::string then =
      start.speed > 0.0 ? ": it returns at " + speed : ": nothing brings it back, as `return` is 0";
  return warning("W914", span, in_ticks(start.row) + " starts outside of " + of + " by " + by + then,
                 "start inside, or say with `return` how fast it may come back");
}

Diagnostic beyond_the_wheels(const Span& span, const TooFast& fast, const Span& wheel) {
  const char* unit = fast.turns ? "rad/s" : "m/s";
  return with_related(
      warning("W611", span,
              "`" + fast.axis + "` " + (fast.is_range ? "allows " : "asks for ") + figure(fast.asked, unit) +
                  ", and the wheels' motors turn fast enough for " + figure(fast.most, unit) +
                  (fast.in_any_direction ? " at best, whatever way the base heads: " : ": ") +
                  in_ticks(fast.wheel) + " makes " + figure(fast.wheel_most, "rad/s") + " at most",
              "stay within; zwang does not keep to a URDF's <limit velocity> by itself"),
      wheel, "this wheel, by the <limit velocity> of the URDF");
}

Diagnostic beyond_the_joints(const Span& span, const TooFast& fast, const Span& joint) {
  const char* unit = fast.turns ? "rad/s" : "m/s";
  return with_related(
      warning("W611", span,
              "`" + fast.axis + "` asks for " + figure(fast.asked, unit) +
                  ", and the joints are fast enough for " + figure(fast.most, unit) +
                  " at the joint angles that zwang looks at: " + in_ticks(fast.wheel) + " makes " +
                  figure(fast.wheel_most, fast.slides ? "m/s" : "rad/s") + " at most",
              "stay within: the guard stops an arm whose joint is faster"),
      joint, "this joint, by the <limit velocity> of the URDF");
}

Diagnostic based_on_itself(const Span& span, const std::string& file, int most) {
  if (most > 0)
    return error("E816", span,
                 "a chain of more than " + std::to_string(most) + " robot files, each based on the next",
                 "base this file on one that says more itself");
  return error("E816", span, "this robot file is based on itself, by " + in_ticks(file),
               "remove this `based_on`");
}

Diagnostic update_of_based_on(const Span& span, const std::string& file) {
  return error("E816", span,
               "`--update` adds to one file, and this one leaves what is not said here to " + in_ticks(file),
               "update that file, or a file without `based_on`");
}

Diagnostic update_unreadable(const Span& span) {
  return error("E816", span, "with what is added here the file could not be read; it was left as it was",
               "write each list and each section in lines of their own, without braces, and run it again");
}

}  // namespace zwang::lang::wording
