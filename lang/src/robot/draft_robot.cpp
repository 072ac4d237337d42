#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "diagnostic/wordings_physics.hpp"
#include "robot/load_robot.hpp"
#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

namespace {

enum class Drive { none, differential, rollers_or_skid, swivels, other };

/// As precise as a drawing.
std::string in_millimetres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g mm", metres * 1e3);
  return text;
}

/// What stands in the open places.
struct Filling {
  std::string radius = fill_in, effort = fill_in, other_effort = fill_in, stop = fill_in, push = fill_in,
              footprint = fill_in;
  std::string holds = std::string("holds: ") + fill_in;  ///< of four wheels that may have rollers
  bool mecanum = false;
};

/// Of a link and all that is fixed to it, in the link's frame.
solver::RigidInertia carried_inertia(const Urdf& urdf, const std::string& link) {
  solver::RigidInertia inertia = urdf.find_link(link)->inertia;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.parent != link || joint.joint.type != solver::JointType::fixed) continue;
    inertia = inertia + carried_inertia(urdf, joint.child).expressed_in(joint.origin);
  }
  return inertia;
}

/// Links behind moving joints that have no mass, or no inertia about some axis through their centre of mass.
std::vector<std::string> without_inertia(const Urdf& urdf) {
  std::vector<std::string> names;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.joint.type == solver::JointType::fixed) continue;
    const solver::RigidInertia inertia = carried_inertia(urdf, joint.child);
    bool is_good = inertia.mass > 0.0;
    if (is_good) {
      const solver::Matrix3 c = solver::skew(inertia.first_moment / inertia.mass);
      const solver::Matrix3 at_com = inertia.rotational + inertia.mass * c * c;
      is_good = (at_com.diagonal().array() > 0.0).all() && at_com.determinant() > 0.0;
    }
    if (!is_good) names.push_back(joint.child);
  }
  return names;
}

/// What the URDF leaves open, closed: joints between base and wheels stand still, links that move and have no
/// inertia are balls of 5 cm, of 0.1 kg where they have no mass.
Urdf completed(Urdf urdf, const FoundWheels& found) {
  for (UrdfJoint& joint : urdf.joints) {
    const bool stands = std::find(found.in_between.begin(), found.in_between.end(), joint.joint.name) !=
                        found.in_between.end();
    if (stands) joint.joint.type = solver::JointType::fixed;
  }
  const std::vector<std::string> open = without_inertia(urdf);
  for (UrdfLink& link : urdf.links) {
    if (std::find(open.begin(), open.end(), link.name) == open.end()) continue;
    const double mass = link.inertia.mass > 0.0 ? link.inertia.mass : 0.1;
    const solver::Vector3 com = link.inertia.first_moment / mass;
    link.inertia =
        solver::RigidInertia::from_com(mass, com, 0.4 * mass * 0.05 * 0.05 * solver::Matrix3::Identity());
  }
  return urdf;
}

class Drafter {
 public:
  Drafter(const Urdf& urdf, FoundWheels found, std::string named_as)
      : urdf_(urdf), found_(std::move(found)), named_as_(std::move(named_as)), drive_(drive()) {}

  RobotDraft draft() {
    RobotDraft draft;
    draft.name = urdf_.name;
    draft.base = found_.base;
    draft.drive = drive_in_words();
    for (const UrdfLink& link : urdf_.links) draft.mass += link.inertia.mass;
    draft.wheels = found_.wheels;
    draft.casters = found_.casters;
    draft.supports = found_.supports;
    draft.missing = missing();
    draft.text = text(Filling{});
    return draft;
  }

  /// The kinds that the wheels may be, each with all places filled.
  std::vector<std::pair<std::string, std::string>> assumed_texts() const {
    if (drive_ == Drive::none) return {};
    Filling filling;
    filling.radius = wording::figure(assumed_radius(), "m");
    filling.effort = "1 N m";
    filling.stop = "1 m/s^2";
    filling.push = "100 N";
    filling.footprint = corners();
    if (drive_ != Drive::rollers_or_skid) return {{drive_in_words(), text(filling)}};
    std::vector<std::pair<std::string, std::string>> texts;
    filling.holds = "holds: [rolling]";
    texts.emplace_back("with plain wheels that skid", text(filling));
    filling.mecanum = true;
    texts.emplace_back("with mecanum wheels", text(filling));
    return texts;
  }

  std::vector<std::string> assumptions() const {
    std::vector<std::string> lines;
    const bool any_effort = any([](const DraftWheel& w) { return !w.effort; });
    if (any_lacks_radius()) lines.push_back("wheels of radius " + wording::figure(assumed_radius(), "m"));
    if (any_effort) lines.push_back("1 N m of torque where the URDF gives none");
    for (const std::string& joint : found_.in_between) lines.push_back("`" + joint + "` does not move");
    if (!without_inertia(urdf_).empty())
      lines.push_back("balls of 5 cm for links that move and have no inertia");
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

  Drive drive() const {
    const auto steered = std::count_if(found_.wheels.begin(), found_.wheels.end(),
                                       [](const DraftWheel& w) { return !w.swivel.empty(); });
    const auto count = static_cast<std::ptrdiff_t>(found_.wheels.size());
    if (count == 0) return Drive::none;
    if (steered == count) return Drive::swivels;
    if (steered == 0 && count == 2) return Drive::differential;
    if (steered == 0 && count == 4) return Drive::rollers_or_skid;
    return Drive::other;
  }

  std::map<std::string, int> swivels() const {
    std::map<std::string, int> count;
    for (const DraftWheel& wheel : found_.wheels) {
      if (!wheel.swivel.empty()) ++count[wheel.swivel];
    }
    return count;
  }

  std::string drive_in_words() const {
    const std::string wheels = std::to_string(found_.wheels.size()) + " wheels";
    switch (drive_) {
      case Drive::none:
        return "no wheels";
      case Drive::differential:
        return "differential: two plain wheels";
      case Drive::rollers_or_skid:
        return "four wheels that do not steer: mecanum or skid steering";
      case Drive::swivels: {
        const auto units = std::to_string(swivels().size());
        const bool pairs = swivels().size() * 2 == found_.wheels.size();
        return pairs ? units + " swivels with two driven wheels each" : units + " steered wheels";
      }
      case Drive::other:
        break;
    }
    return wheels;
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
    if (drive_ == Drive::none) {
      lines.push_back(
          "wheels: no joint turns without end about a level axle and is called a wheel or is round");
    }
    std::vector<DraftWheel> all = found_.wheels;
    all.insert(all.end(), found_.casters.begin(), found_.casters.end());
    add_missing(lines, "the radius, where the shape is a mesh: ", all, lacks_radius);
    add_missing(lines, "the largest torque: ", found_.wheels, [](const DraftWheel& w) { return !w.effort; });
    if (drive_ == Drive::rollers_or_skid) {
      lines.push_back("whether the wheels have rollers (mecanum) or skid: a URDF does not tell");
    }
    for (const std::string& joint : found_.in_between) {
      lines.push_back("what `" + joint +
                      "` does: it moves between the base and wheels; make it fixed, if it may be");
    }
    std::string coupled;
    for (const std::string& name : found_.others) {
      if (urdf_.find_joint(name)->mimic) coupled += (coupled.empty() ? "`" : ", `") + name + "`";
    }
    if (!coupled.empty())
      lines.push_back("what moves joints with a <mimic>, which zwang does not couple: " + coupled);
    std::string weightless;
    for (const std::string& link : without_inertia(urdf_))
      weightless += (weightless.empty() ? "`" : ", `") + link + "`";
    if (!weightless.empty()) lines.push_back("masses and inertias of links that move: " + weightless);
    lines.push_back("gears and rotor inertias: often larger than the wheels' own");
    lines.push_back("`stop` and `footprint`: yours to choose");
    return lines;
  }

  /// Around the wheels.
  std::array<double, 2> reach() const {
    std::array<double, 2> most{0.1, 0.1};
    for (const auto* wheels : {&found_.wheels, &found_.casters}) {
      for (const DraftWheel& wheel : *wheels) {
        most[0] = std::max(most[0], std::abs(wheel.at[0]) + wheel.radius.value_or(0.1));
        most[1] = std::max(most[1], std::abs(wheel.at[1]));
      }
    }
    return most;
  }

  std::string corners() const {
    const auto [x, y] = reach();
    const auto corner = [](double a, double b) {
      return "[" + wording::figure(a, "m") + ", " + wording::figure(b, "m") + "]";
    };
    return "[" + corner(x, y) + ", " + corner(-x, y) + ", " + corner(-x, -y) + ", " + corner(x, -y) + "]";
  }

  std::string wheel_line(const DraftWheel& wheel, const Filling& filling) const {
    std::string line = "  - {joint: " + wheel.joint +
                       ", radius: " + (wheel.radius ? in_millimetres(*wheel.radius) : filling.radius);
    if (drive_ == Drive::rollers_or_skid && wheel.swivel.empty()) {
      // Front left and rear right one way, the others the other way.
      const bool is_first_diagonal = (wheel.at[0] > 0.0) == (wheel.at[1] > 0.0);
      line += filling.mecanum ? std::string(", roller: ") + (is_first_diagonal ? "45 deg" : "-45 deg")
                              : ", " + filling.holds;
    }
    return line + "}\n";
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
    for (const auto& [name, wheels] : swivels()) {
      if (wheels == 1) line(name, filling.effort);
    }
    for (const std::string& name : found_.others) {
      const UrdfJoint* joint = urdf_.find_joint(name);
      if (joint->mimic) continue;  // a mechanism moves it, and no motor of its own
      const bool slides = joint->joint.type == solver::JointType::prismatic;
      line(name, filling.effort == fill_in ? fill_in : slides ? "1 N" : "1 N m");
    }
    return text;
  }

  /// A comment that names what only the URDF can be given.
  std::string weightless() const {
    const std::vector<std::string> links = without_inertia(urdf_);
    if (links.empty()) return "";
    std::string text =
        "# It is refused, too, until the URDF gives these links, which move, the mass and inertia of a "
        "body:\n";
    for (const std::string& link : links) text += "#   " + link + "\n";
    return text;
  }

  std::string text(const Filling& filling) const {
    const auto [x, y] = reach();
    std::string text = "# The robot file of `" + urdf_.name +
                       "`, drafted from its URDF. It is refused until every " + fill_in + " is replaced.\n" +
                       weightless() + "zwang_robot: 1\nurdf: " + named_as_ + "\nbase: " + found_.base +
                       "  # the link that floats\n\n";
    if (any_lacks_radius()) {
      text += "# radius: from the axle to the ground, as `75.9 mm`; a mesh does not tell.\n";
    }
    if (drive_ == Drive::rollers_or_skid) {
      text +=
          "# Mecanum wheels: `roller: 45 deg` in the place of `holds` at front left and rear right, `roller: "
          "-45 deg`\n"
          "# at front right and rear left (from the wheel's axis to the roller's axis at the ground).\n"
          "# Wheels that skid: `holds: [rolling]`.\n";
    }
    text += "wheels:\n";
    for (const DraftWheel& wheel : found_.wheels) text += wheel_line(wheel, filling);
    if (!found_.casters.empty())
      text += "  # Casters: they have no motor, and the swivel above each follows.\n";
    for (const DraftWheel& caster : found_.casters) text += wheel_line(caster, filling);
    if (!found_.supports.empty()) {
      text += "\n# They stand on the ground and hold nothing.\nsupports: [";
      for (std::size_t i = 0; i < found_.supports.size(); ++i)
        text += (i > 0 ? ", " : "") + found_.supports[i];
      text += "]\n";
    }
    text +=
        "\n# effort: the largest torque on the joint's side, as `2 N m`; without it the URDF's. Add gear "
        "and\n"
        "# rotor_inertia, as {gear: 20, rotor_inertia: 2 kg mm^2}: they are often larger than the wheel's "
        "own inertia.\n";
    text += actuated(filling);
    text +=
        "\n# The one brake of `done`, `failed` and the protective stop, as {deceleration: 1 m/s^2, force: 80 "
        "N}.\n";
    text += "stop: {deceleration: " + filling.stop + ", force: " + filling.push + "}\n";
    text += "\n# The outline from above, counter-clockwise. The wheels alone reach " +
            wording::figure(2.0 * x, "m") + " x " + wording::figure(2.0 * y, "m") +
            ":\n# polygon: " + corners() + "\n";
    text += "footprint: {polygon: " + filling.footprint + "}\n";
    text +=
        "\n# In force where a task gives none, as limits: {acceleration: {x: +-1 m/s^2}, velocity: {x: +-1 "
        "m/s}}.\n"
        "# How hard the first hit is depends on bumper: {stiffness: 20 kN/m, height: 0.15 m}.\n";
    return text;
  }

  const Urdf& urdf_;
  FoundWheels found_;
  std::string named_as_;
  Drive drive_;
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
                                      Diagnostics& diagnostics) {
  const std::optional<Urdf> urdf = read_urdf(path, {}, diagnostics);
  if (!urdf) return std::nullopt;
  const FoundWheels found = find_wheels(*urdf);
  Drafter drafter(*urdf, found, named_as);
  RobotDraft draft = drafter.draft();
  draft.assumption_notes = drafter.assumptions();
  const Urdf whole = completed(*urdf, found);
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
