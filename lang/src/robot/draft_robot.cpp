#include <algorithm>
#include <cmath>
#include <map>

#include "diagnostic/wordings_physics.hpp"
#include "robot/check_push.hpp"
#include "robot/draft_bodies.hpp"
#include "robot/draft_entries.hpp"
#include "robot/draft_frames.hpp"
#include "robot/draft_motors.hpp"
#include "robot/drive_kind.hpp"
#include "robot/dropped_wheels.hpp"
#include "robot/each_wheel.hpp"
#include "robot/folded_arm.hpp"
#include "robot/joint_axes.hpp"
#include "robot/load_robot.hpp"
#include "robot/possible_bodies.hpp"
#include "robot/robot_file.hpp"
#include "robot/turned_joints.hpp"
#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

/// The text in the open places.
struct Filling {
  std::string radius = fill_in, effort = fill_in, footprint = fill_in, back = fill_in;
  std::string kind = fill_in;                       ///< of four wheels that may have rollers
  std::string base_mass = fill_in, mass = fill_in;  ///< of the base, of another link that moves
  std::string force = fill_in;                      ///< of the brake, where no mass is known
};

class Drafter {
 public:
  Drafter(const Urdf& urdf, const DraftOptions& options, FoundWheels found, std::string named_as)
      : urdf_(urdf),
        axes_(options.axes),
        turning_(options.turning),
        found_(std::move(found)),
        named_as_(std::move(named_as)),
        drive_(drive_of(holding_wheels(found_))),
        frames_(urdf_, found_, drive_, options) {
    std::vector<DraftWheel> on_the_ground = holding_wheels(found_);
    on_the_ground.insert(on_the_ground.end(), found_.casters.begin(), found_.casters.end());
    drops_ = drops_of(on_the_ground);
    hold_joints();
  }

  /// Holds them, too: a motor as weak as the URDF's does not.
  void hold_slides(std::vector<SinkingSlide> slides) {
    sinking_ = std::move(slides);
    hold_joints();
  }

  /// Proposes as hard a brake [m/s^2], where it is less.
  void brake_within(double deceleration) { deceleration_ = std::min(deceleration_, deceleration); }

  RobotDraft draft() {
    RobotDraft draft;
    draft.name = urdf_.name;
    draft.base = found_.base;
    draft.drive = drive_in_words();
    draft.mass = urdf_.mass();
    draft.wheels = found_.wheels;
    draft.idle = found_.idle;
    draft.casters = found_.casters;
    draft.supports = found_.supports;
    draft.stuck = found_.stuck;
    draft.outline = frames_.outline();
    draft.heading = frames_.heading();
    draft.base_ahead = frames_.base_ahead();
    draft.outline_is_known = frames_.outline_is_known();
    draft.arm_reach = folded_.reach;
    draft.has_own_base = found_.base != "base" && urdf_.find_link("base") != nullptr;
    draft.missing = missing();
    draft.text = text(Filling{});
    return draft;
  }

  /// The kinds that the wheels may be, each with all places filled.
  std::vector<std::pair<std::string, std::string>> assumed_texts() const {
    if (drive_ == DriveKind::none) return {};
    Filling filling;
    filling.radius = wording::figure(assumed_radius(), "m");
    filling.effort = "1 N m";
    filling.footprint = frames_.assumed_outline();
    filling.back = "-0.5 m";
    filling.base_mass = "10 kg";
    filling.mass = "0.1 kg";
    filling.force = "100 N";
    if (!is_kind_open()) return {{drive_in_words(), text(filling)}};
    std::vector<std::pair<std::string, std::string>> texts;
    filling.kind = "skid";
    texts.emplace_back("with plain wheels that skid", text(filling));
    filling.kind = "mecanum";
    texts.emplace_back("with mecanum wheels", text(filling));
    return texts;
  }

  std::vector<std::string> assumptions() const {
    std::vector<std::string> lines;
    if (any_lacks_radius()) lines.push_back("wheels of radius " + wording::figure(assumed_radius(), "m"));
    if (any(lacks_effort)) lines.push_back("1 N m of torque where the URDF gives none");
    for (const std::string& joint : held_) lines.push_back("`" + joint + "` does not move");
    if (!bodies_.empty())
      lines.push_back("discs and balls for links that move and have no inertia, or none that a body has");
    if (shares_mass_ || std::ranges::any_of(bodies_, &DraftBody::lacks_mass))
      lines.push_back("10 kg of the base and 0.1 kg of another link where the URDF gives no mass");
    return lines;
  }

 private:
  void hold_joints() {
    const std::vector<std::string> open = without_inertia(urdf_);
    held_ = found_.in_between;
    for (const SinkingSlide& slide : sinking_) held_.push_back(slide.joint);
    for (const std::string& name : found_.others) {
      const UrdfJoint& joint = *urdf_.find_joint(name);
      if (joint.mimic || contains(open, joint.child)) held_.push_back(name);
    }
    // A finger alone is no gripper: the one that leads stands with those that follow.
    for (const std::string& name : std::vector<std::string>(held_)) {
      const std::optional<UrdfMimic>& mimic = urdf_.find_joint(name)->mimic;
      if (mimic && contains(found_.others, mimic->joint) && !contains(held_, mimic->joint))
        held_.push_back(mimic->joint);
    }
    std::vector<std::string> arms;
    for (const std::string& name : found_.others) {
      if (!contains(held_, name)) arms.push_back(name);
    }
    folded_ = fold_arm(urdf_, found_.base, arms, frames_.outline());
    if (drive_ == DriveKind::swivels) folded_.posture.merge(steered_ahead(urdf_, found_));
    bodies_ = find_draft_bodies(urdf_, found_, open, held_, frames_.outline());
    shares_mass_ = share_mass(bodies_, found_.wheels);
  }

  template <typename Test>
  bool any(const Test& test) const {
    return std::any_of(found_.wheels.begin(), found_.wheels.end(), test);
  }

  template <typename Test>
  bool all(const Test& test) const {
    return std::all_of(found_.wheels.begin(), found_.wheels.end(), test);
  }

  /// Wheels with rollers are never coupled, and each has a motor.
  bool is_skid() const {
    return drive_ == DriveKind::rollers_or_skid && !(found_.coupled.empty() && found_.idle.empty());
  }
  bool is_kind_open() const { return drive_ == DriveKind::rollers_or_skid && !is_skid(); }

  std::string drive_in_words() const {
    if (is_skid()) return "skid steering: wheels in line that are coupled or have no motor";
    return in_words(drive_, holding_wheels(found_));
  }

  /// F = sum tau_i / R_i, as far as it is known. [N]
  double push() const {
    double sum = 0.0;
    for (const DraftWheel& wheel : found_.wheels)
      sum += wheel.effort.value_or(0.0) / wheel.radius.value_or(0.1);
    return sum;
  }

  /// [kg] Of the robot; 0: that of its body is still to be filled in.
  double known_mass() const { return lacks_body(bodies_) ? 0.0 : urdf_.mass(); }

  static bool lacks_effort(const DraftWheel& wheel) { return !wheel.effort; }
  static bool lacks_radius(const DraftWheel& wheel) { return !wheel.radius; }

  bool any_lacks_radius() const {
    return any(lacks_radius) || std::any_of(found_.idle.begin(), found_.idle.end(), lacks_radius) ||
           std::any_of(found_.casters.begin(), found_.casters.end(), lacks_radius);
  }

  double assumed_radius() const {
    for (const DraftWheel& wheel : found_.wheels) {
      if (wheel.radius) return *wheel.radius;
    }
    return 0.1;
  }

  template <typename Lacks>
  static void add_missing(std::vector<std::string>& lines, const std::string& what,
                          const std::vector<DraftWheel>& wheels, const Lacks& lacks) {
    std::string names;
    for (const DraftWheel& wheel : wheels) {
      if (lacks(wheel)) names += (names.empty() ? "`" : ", `") + wheel.joint + "`";
    }
    if (!names.empty()) lines.push_back(what + names);
  }

  std::vector<std::string> missing() const {
    std::vector<std::string> lines = missing_of_joints(urdf_, found_, drive_ == DriveKind::none);
    std::vector<DraftWheel> all = holding_wheels(found_);
    all.insert(all.end(), found_.casters.begin(), found_.casters.end());
    add_missing(lines, "the radius, where the shape is a mesh: ", all, lacks_radius);
    add_missing(lines, "the largest torque: ", found_.wheels, lacks_effort);
    if (is_kind_open()) {
      lines.push_back("whether the wheels have rollers (mecanum) or skid: a URDF does not tell");
    }
    for (const std::string& joint : wheels_without_axis(urdf_))
      lines.push_back("the axis of `" + joint +
                      "`: without an <axis> it is 1 0 0; if it is another, add `axes: {" + joint +
                      ": [0, 1, 0]}`");
    for (const std::string& line : missing_of_bodies(bodies_)) lines.push_back(line);
    if (known_mass() > 0.0 && push() > floor_holds(known_mass()))
      lines.push_back("the wheels' own torques: the URDF's press with " + wording::figure(push(), "N") +
                      ", and no floor holds that (W872); give `each_wheel: {effort: ..}`");
    for (const SinkingSlide& slide : sinking_)
      lines.push_back("a motor that holds `" + slide.joint + "`: it bears " +
                      wording::figure(slide.borne, "N") + ", the URDF's makes " +
                      wording::figure(slide.effort, "N") + ", so it stands in `fixed`");
    if (!friction_note(urdf_, found_, held_).empty())
      lines.push_back("friction that was measured: the URDF's <dynamics> stand in a comment of the draft");
    lines.push_back("gears and rotor inertias: often larger than the wheels' own");
    lines.push_back(found_.outline.empty() ? "`footprint`: the base has no simple collision shape"
                                           : "whether `stop` and `footprint`, which are proposed, are right");
    return lines;
  }

  /// What all wheels lack stands once, in `each_wheel`. Wheels on tilted axles have different radii.
  bool share_radius() const {
    const auto height = [](const DraftWheel& a, const DraftWheel& b) { return a.at[2] < b.at[2]; };
    const auto [low, high] = std::minmax_element(found_.wheels.begin(), found_.wheels.end(), height);
    return all(lacks_radius) && (found_.wheels.empty() || share_mesh(found_.wheels) ||
                                 high->at[2] - low->at[2] < least_wheel_lift);
  }

  std::string each_wheel(const Filling& filling) const {
    std::string about, keys;
    const auto add = [&](const std::string& key, const std::string& value, const std::string& comment) {
      keys += (keys.empty() ? "" : ", ") + key + ": " + value;
      about += "# " + comment + "\n";
    };
    if (is_kind_open())
      add("kind", filling.kind,
          "kind: `skid` if the wheels slide sideways to turn, `mecanum` if they have rollers.");
    if (share_radius())
      add("radius", filling.radius,
          "radius: from the axle to the ground, as `75.9 mm`; a mesh does not tell.");
    if (share_effort(found_))
      add("effort", filling.effort, "effort: the largest torque of a wheel, as `2 N m`.");
    if (shares_mass_) add("mass", filling.mass, "mass: of each wheel, as `0.5 kg`; the URDF has none.");
    if (is_skid())
      add("kind", "skid", "kind: wheels that are coupled or have no motor have no rollers: they slide.");
    if (keys.empty()) return "";
    return "# each_wheel: of every wheel with a motor, where its own entry says nothing.\n" + about +
           "each_wheel: {" + keys + "}\n";
  }

  std::string wheel_entry(const DraftWheel& wheel, bool is_driven, bool slides_sideways,
                          const Filling& filling) const {
    std::string entry = "  - {joint: " + wheel.joint;
    if (wheel.radius) {
      entry += ", radius: " + in_millimetres(*wheel.radius);
    } else if (!is_driven || !share_radius()) {
      entry += ", radius: " + filling.radius;
    }
    const auto drop = drops_.find(wheel.joint);
    if (drop != drops_.end()) entry += ", drop: " + in_millimetres(drop->second);
    if (is_driven && drive_ == DriveKind::omni) entry += ", roller: 90 deg";
    if (slides_sideways) entry += ", holds: [rolling]";
    return entry + "}" + height_note(wheel, is_driven, filling) + "\n";
  }

  /// Of a radius that nobody knows: the axles' heights tell how the radii differ.
  std::string height_note(const DraftWheel& wheel, bool is_driven, const Filling& filling) const {
    if (wheel.radius || (is_driven && share_radius()) || filling.radius != fill_in) return "";
    double lowest = wheel.at[2];
    for (const std::vector<DraftWheel>* wheels : {&found_.wheels, &found_.idle, &found_.casters})
      for (const DraftWheel& other : *wheels) lowest = std::min(lowest, other.at[2]);
    if (wheel.at[2] - lowest < least_wheel_lift) return "";
    return "  # from the axle to the ground, measured; drawn " + in_millimetres(wheel.at[2] - lowest) +
           " higher than the lowest axle";
  }

  std::string text(const Filling& filling) const {
    std::string text = "zwang_robot: 1\nurdf: " + named_as_ + "\n" + frames_.base_and_lead();
    text +=
        fixed_entry(held_) + turns_entry(turning_) + mimic_entry(urdf_, found_) + axes_entry(axes_) + "\n";
    text += each_wheel(filling) + stuck_wheels_note(found_) + "wheels:\n";
    for (const DraftWheel& wheel : found_.wheels) text += wheel_entry(wheel, true, false, filling);
    if (!found_.idle.empty()) text += "  # They have no motor, and roll along.\n";
    const bool slides = drive_ == DriveKind::rollers_or_skid;
    for (const DraftWheel& wheel : found_.idle) text += wheel_entry(wheel, false, slides, filling);
    if (!found_.casters.empty())
      text += "  # Casters: they have no motor, and the swivel above each follows.\n";
    for (const DraftWheel& caster : found_.casters) text += wheel_entry(caster, false, false, filling);
    if (!found_.supports.empty())
      text +=
          "\n# They stand on the ground and hold nothing.\nsupports: " + in_brackets(found_.supports) + "\n";
    text += each_joint_entry(urdf_, found_, held_, filling.effort) + effort_note +
            actuated_entry(urdf_, found_, held_, bodies_, filling.effort) +
            friction_note(urdf_, found_, held_);
    text += inertias_entry(bodies_, filling.base_mass, filling.mass) + posture_entry(urdf_, folded_) +
            stop_entry(known_mass(), deceleration_, filling.force) + frames_.footprint(filling.footprint) +
            frames_.frames(filling.back);
    text +=
        "\n# In force where a task gives none, as limits: {acceleration: {x: +-1 m/s^2}, velocity: {x: +-1 "
        "m/s}}.\n"
        "# How hard the first hit is depends on bumper: {stiffness: 20 kN/m, height: 0.15 m}.\n";
    return head(text) + text;
  }

  std::string head(const std::string& body) const {
    const bool is_open = body.find(fill_in) != std::string::npos;
    return "# The robot file of `" + urdf_.name + "`, drafted from its URDF. " +
           (is_open ? std::string("It is refused until every ") + fill_in + " is replaced.\n"
                    : "What is marked as proposed is yours to check.\n");
  }

  const Urdf& urdf_;
  std::vector<JointAxis> axes_;       ///< that the URDF lacks
  std::vector<std::string> turning_;  ///< joints of `turns`
  FoundWheels found_;
  std::string named_as_;
  DriveKind drive_;
  DraftFrames frames_;
  std::vector<std::string> held_;        ///< joints of `fixed`
  std::vector<SinkingSlide> sinking_;    ///< held, for the URDF's motor does not hold them
  std::map<std::string, double> drops_;  ///< [m] by the joint of a wheel
  std::vector<DraftBody> bodies_;        ///< links whose inertia is in the draft
  bool shares_mass_ = false;             ///< all wheels with a motor have one in `each_wheel`
  FoldedArm folded_;
  double deceleration_ = 1.0;  ///< [m/s^2] as hard as most bases brake
};

std::optional<Robot> build_from(const std::string& robot_file, const Urdf& urdf, Diagnostics& diagnostics) {
  const std::optional<Document> document =
      read(diagnostics.add_source({"robot file", robot_file}), diagnostics);
  if (!document) return std::nullopt;
  std::optional<RobotFile> file = parse_robot_file(*document, diagnostics);
  if (!file) return std::nullopt;
  place_rollers(*file, urdf);
  return build_robot(*file, urdf, 0, diagnostics);
}

RobotDraft with_assumptions(Drafter& drafter, const Urdf& urdf) {
  RobotDraft draft = drafter.draft();
  draft.assumption_notes = drafter.assumptions();
  for (const auto& [as, text] : drafter.assumed_texts()) {
    Diagnostics unheard;  // of a file that is not the user's; what the URDF lacks is
    std::optional<Robot> robot = build_from(text, urdf, unheard);
    if (robot) {
      draft.assumed.push_back({as, std::move(*robot)});
    } else if (draft.assumed.empty()) {
      draft.missing.insert(draft.missing.begin(),
                           "a model that can move: " + unheard.sorted().front().message);
      break;
    }
  }
  add_edge_note(draft);
  return draft;
}

}  // namespace

std::optional<RobotDraft> draft_robot(const std::filesystem::path& path, const std::string& named_as,
                                      Diagnostics& diagnostics, const DraftOptions& given) {
  DraftOptions options = given;
  std::optional<Urdf> urdf = read_urdf(path, {}, diagnostics, {options.ignored, options.turning});
  if (!urdf) return std::nullopt;
  options.axes = find_axes_of(*urdf, given.axes);
  FoundWheels found = find_wheels(*urdf);
  turn_wheels(path, *urdf, options, found);
  if (!has_wheels_in_metres(found, *urdf, diagnostics)) return std::nullopt;
  Drafter drafter(*urdf, options, found, named_as);
  RobotDraft draft = with_assumptions(drafter, *urdf);
  if (std::vector<SinkingSlide> slides = sinking_slides(draft, *urdf); !slides.empty()) {
    drafter.hold_slides(std::move(slides));
    draft = with_assumptions(drafter, *urdf);
  }
  const double steady = steady_deceleration(draft);
  if (steady >= 1.0) return draft;
  drafter.brake_within(steady);
  return with_assumptions(drafter, *urdf);
}

}  // namespace zwang::lang
