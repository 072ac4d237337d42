#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "diagnostic/wordings_physics.hpp"
#include "robot/draft_frames.hpp"
#include "robot/drive_kind.hpp"
#include "robot/load_robot.hpp"
#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "robot/weightless_links.hpp"
#include "robot/wheel_search.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

namespace {

/// As precise as a drawing.
std::string in_millimetres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g mm", metres * 1e3);
  return text;
}

/// What stands in the open places.
struct Filling {
  std::string radius = fill_in, effort = fill_in, footprint = fill_in, back = fill_in;
  std::string holds = std::string("holds: ") + fill_in;  ///< of four wheels that may have rollers
  bool mecanum = false;
};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The first two digits, the next above.
double rounded_up(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / step - 1e-9) * step;
}

class Drafter {
 public:
  Drafter(const Urdf& urdf, FoundWheels found, std::string named_as, bool with_hook)
      : urdf_(urdf),
        found_(std::move(found)),
        named_as_(std::move(named_as)),
        drive_(drive_of(found_.wheels)),
        frames_(urdf_, found_, drive_, with_hook) {
    const std::vector<std::string> open = without_inertia(urdf_);
    held_ = found_.in_between;
    for (const std::string& name : found_.others) {
      const UrdfJoint& joint = *urdf_.find_joint(name);
      if (joint.mimic || contains(open, joint.child)) held_.push_back(name);
    }
    for (const std::string& link : open) {
      if (!contains(held_, urdf_.joint_above(link)->joint.name)) weightless_.push_back(link);
    }
  }

  RobotDraft draft() {
    RobotDraft draft;
    draft.name = urdf_.name;
    draft.base = found_.base;
    draft.drive = in_words(drive_, found_.wheels);
    draft.mass = urdf_.mass();
    draft.wheels = found_.wheels;
    draft.casters = found_.casters;
    draft.supports = found_.supports;
    draft.wheels_that_stand = found_.wheels_that_stand;
    draft.outline = frames_.outline();
    draft.outline_is_known = frames_.outline_is_known();
    draft.arm_reach = found_.arm_reach;
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
    filling.footprint = frames_.around_wheels();
    filling.back = "-0.5 m";
    if (drive_ != DriveKind::rollers_or_skid) return {{in_words(drive_, found_.wheels), text(filling)}};
    std::vector<std::pair<std::string, std::string>> texts;
    filling.holds = "holds: [rolling]";
    texts.emplace_back("with plain wheels that skid", text(filling));
    filling.mecanum = true;
    texts.emplace_back("with mecanum wheels", text(filling));
    return texts;
  }

  /// Links that move, lack mass or inertia, and are not held.
  const std::vector<std::string>& weightless() const { return weightless_; }

  std::vector<std::string> assumptions() const {
    std::vector<std::string> lines;
    const bool any_effort = any([](const DraftWheel& w) { return !w.effort; });
    if (any_lacks_radius()) lines.push_back("wheels of radius " + wording::figure(assumed_radius(), "m"));
    if (any_effort) lines.push_back("1 N m of torque where the URDF gives none");
    for (const std::string& joint : held_) lines.push_back("`" + joint + "` does not move");
    if (!weightless_.empty()) lines.push_back("balls of 5 cm for links that move and have no inertia");
    return lines;
  }

 private:
  template <typename Test>
  bool any(const Test& test) const {
    return std::any_of(found_.wheels.begin(), found_.wheels.end(), test);
  }

  static bool lacks_radius(const DraftWheel& wheel) { return !wheel.radius; }

  bool any_lacks_radius() const {
    return any(lacks_radius) || std::any_of(found_.casters.begin(), found_.casters.end(), lacks_radius);
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
    std::vector<std::string> lines;
    if (drive_ == DriveKind::none) {
      lines.push_back(
          "wheels: no joint turns without end about a level axle and is called a wheel or is round");
      for (const std::string& joint : found_.wheels_that_stand)
        lines.push_back("a `continuous` joint where the URDF has `" + joint + "`, which is `fixed`");
    }
    std::vector<DraftWheel> all = found_.wheels;
    all.insert(all.end(), found_.casters.begin(), found_.casters.end());
    add_missing(lines, "the radius, where the shape is a mesh: ", all, lacks_radius);
    add_missing(lines, "the largest torque: ", found_.wheels, [](const DraftWheel& w) { return !w.effort; });
    if (drive_ == DriveKind::rollers_or_skid) {
      lines.push_back("whether the wheels have rollers (mecanum) or skid: a URDF does not tell");
    }
    std::string links;
    for (const std::string& link : weightless_) links += (links.empty() ? "`" : ", `") + link + "`";
    if (!links.empty()) lines.push_back("masses and inertias of links that move: " + links);
    lines.push_back("gears and rotor inertias: often larger than the wheels' own");
    lines.push_back(found_.outline.empty() ? "`footprint`: the base has no simple collision shape"
                                           : "whether `stop` and `footprint`, which are proposed, are right");
    return lines;
  }

  bool may_have_rollers(const DraftWheel& wheel) const {
    return drive_ == DriveKind::rollers_or_skid && wheel.swivel.empty();
  }

  /// On a mecanum base: front left and rear right one way, the others the other way.
  static std::string mecanum_roller(const DraftWheel& wheel) {
    return (wheel.at[0] > 0.0) == (wheel.at[1] > 0.0) ? "roller: 45 deg" : "roller: -45 deg";
  }

  std::string wheel_entry(const DraftWheel& wheel, const Filling& filling) const {
    std::string entry = "  - {joint: " + wheel.joint +
                        ", radius: " + (wheel.radius ? in_millimetres(*wheel.radius) : filling.radius);
    if (may_have_rollers(wheel)) entry += ", " + (filling.mecanum ? mecanum_roller(wheel) : filling.holds);
    if (drive_ == DriveKind::omni) entry += ", roller: 90 deg";
    return entry + "}";
  }

  /// A line each; behind those that are open, in one column, what else they may be.
  std::string wheel_lines(const std::vector<DraftWheel>& wheels, const Filling& filling) const {
    std::size_t column = 0;
    for (const DraftWheel& wheel : wheels) column = std::max(column, wheel_entry(wheel, filling).size() + 2);
    std::string lines;
    for (const DraftWheel& wheel : wheels) {
      std::string line = wheel_entry(wheel, filling);
      if (may_have_rollers(wheel) && !filling.mecanum) {
        line.resize(column, ' ');
        line += "# mecanum: " + mecanum_roller(wheel);
      }
      lines += line + "\n";
    }
    return lines;
  }

  std::string actuated(const Filling& filling) const {
    std::string text = "actuated:\n";
    const auto line = [&](const std::string& name, const std::string& open) {
      const UrdfJoint* joint = urdf_.find_joint(name);
      const bool is_known = joint != nullptr && std::isfinite(joint->joint.max_effort);
      text += "  " + name + ": {" + (is_known ? "" : "effort: " + open) + "}\n";
    };
    for (const DraftWheel& wheel : found_.wheels) line(wheel.joint, filling.effort);
    // A swivel with one wheel is steered by a motor, one with two by the difference of theirs.
    for (const auto& [name, wheels] : swivels_of(found_.wheels)) {
      if (wheels == 1) line(name, filling.effort);
    }
    for (const std::string& name : found_.others) {
      const UrdfJoint* joint = urdf_.find_joint(name);
      if (contains(held_, name)) continue;
      const bool slides = joint->joint.type == solver::JointType::prismatic;
      line(name, filling.effort == fill_in ? fill_in : slides ? "1 N" : "1 N m");
    }
    return text;
  }

  /// A comment that names what only the URDF can be given.
  std::string weightless_links() const {
    if (weightless_.empty()) return "";
    std::string text =
        "# It is refused, too, until the URDF gives these links, which move, the mass and inertia of a "
        "body:\n";
    for (const std::string& link : weightless_) text += "#   " + link + "\n";
    return text;
  }

  static std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return "[" + text + "]\n";
  }

  /// As hard as most bases brake, and the force that this takes.
  std::string stop() const {
    const double mass = urdf_.mass();
    const std::string force = mass > 0.0 ? wording::figure(rounded_up(mass), "N") : fill_in;
    return "\n# The one brake of `done`, `failed` and the protective stop. Proposed: 1 m/s^2, and the force "
           "that it "
           "takes,\n# " +
           wording::figure(mass, "kg") + " x 1 m/s^2.\nstop: {deceleration: 1 m/s^2, force: " + force + "}\n";
  }

  std::string text(const Filling& filling) const {
    std::string text =
        weightless_links() + "zwang_robot: 1\nurdf: " + named_as_ + "\n" + frames_.base_and_lead();
    if (!held_.empty())
      text +=
          "\n# They do not move here: they carry wheels and do not steer them, as rockers, springs and wheel "
          "drops do, "
          "follow\n# another joint by a <mimic>, or have no mass or inertia behind them.\nfixed: " +
          listed(held_);
    text += "\n";
    if (any_lacks_radius()) {
      text += "# radius: from the axle to the ground, as `75.9 mm`; a mesh does not tell.\n";
    }
    if (drive_ == DriveKind::rollers_or_skid) {
      text +=
          "# Wheels that skid: `holds: [rolling]`. Mecanum wheels: the `roller` that stands behind, in the "
          "place of "
          "`holds`\n"
          "# (from the wheel's axis to the roller's axis at the ground).\n";
    }
    text += "wheels:\n";
    text += wheel_lines(found_.wheels, filling);
    if (!found_.casters.empty())
      text += "  # Casters: they have no motor, and the swivel above each follows.\n";
    text += wheel_lines(found_.casters, filling);
    if (!found_.supports.empty())
      text += "\n# They stand on the ground and hold nothing.\nsupports: " + listed(found_.supports);
    text +=
        "\n# effort: the largest torque on the joint's side, as `2 N m`; without it the URDF's. Add gear "
        "and\n"
        "# rotor_inertia, as {gear: 20, rotor_inertia: 2 kg mm^2}: they are often larger than the wheel's "
        "own inertia.\n";
    text += actuated(filling);
    text += stop() + frames_.footprint(filling.footprint) + frames_.frames(filling.back);
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
  FoundWheels found_;
  std::string named_as_;
  DriveKind drive_;
  DraftFrames frames_;
  std::vector<std::string> held_;        ///< joints of `fixed`
  std::vector<std::string> weightless_;  ///< links
};

std::optional<Robot> build_from(const std::string& robot_file, const Urdf& urdf, Diagnostics& diagnostics) {
  const std::optional<Document> document =
      read(diagnostics.add_source({"robot file", robot_file}), diagnostics);
  if (!document) return std::nullopt;
  const std::optional<RobotFile> file = parse_robot_file(*document, diagnostics);
  if (!file) return std::nullopt;
  return build_robot(*file, urdf, 0, diagnostics);
}

}  // namespace

std::optional<RobotDraft> draft_robot(const std::filesystem::path& path, const std::string& named_as,
                                      Diagnostics& diagnostics, const DraftOptions& options) {
  const std::optional<Urdf> urdf = read_urdf(path, {}, diagnostics, options.ignored);
  if (!urdf) return std::nullopt;
  const FoundWheels found = find_wheels(*urdf);
  Drafter drafter(*urdf, found, named_as, options.with_hook);
  RobotDraft draft = drafter.draft();
  draft.assumption_notes = drafter.assumptions();
  const Urdf whole = completed(*urdf, drafter.weightless());
  for (const auto& [as, text] : drafter.assumed_texts()) {
    Diagnostics unheard;  // of a file that is not the user's; what the URDF lacks is
    std::optional<Robot> robot = build_from(text, whole, unheard);
    if (robot) {
      draft.assumed.push_back({as, std::move(*robot)});
    } else if (draft.assumed.empty()) {
      draft.missing.insert(draft.missing.begin(),
                           "a model that can move: " + unheard.sorted().front().message);
      break;
    }
  }
  return draft;
}

}  // namespace zwang::lang
