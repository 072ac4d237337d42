#include "robot/urdf_check.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_standing.hpp"
#include "robot/urdf.hpp"
#include "robot/xml_numbers.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang {

namespace {

struct NumberRule {
  std::string_view element;
  std::string_view attribute;
  std::size_t count;
};

/// The numbers that dynamics and frames come from; what only draws a picture is not zwang's business.
constexpr std::array number_rules{
    NumberRule{"mass", "value", 1},   NumberRule{"inertia", "ixx", 1},    NumberRule{"inertia", "ixy", 1},
    NumberRule{"inertia", "ixz", 1},  NumberRule{"inertia", "iyy", 1},    NumberRule{"inertia", "iyz", 1},
    NumberRule{"inertia", "izz", 1},  NumberRule{"origin", "xyz", 3},     NumberRule{"origin", "rpy", 3},
    NumberRule{"axis", "xyz", 3},     NumberRule{"limit", "lower", 1},    NumberRule{"limit", "upper", 1},
    NumberRule{"limit", "effort", 1}, NumberRule{"limit", "velocity", 1},
};

/// Smaller than a grain of dust; 1 mg of mass 1 um across has 1e-18 kg m^2.
constexpr double least_mass = 1e-9;      // [kg]
constexpr double least_inertia = 1e-18;  // [kg m^2]
/// A thousand tonnes, a kilometre across.
constexpr double most_inertia = 1e12;  // [kg m^2]
constexpr double most_distance = 1e3;  // [m]

/// No quantity of a robot lies beyond these two. Exporters write rounding errors of 1e-33, and 1e38 for no
/// limit.
constexpr double least_number = 1e-100;
constexpr double most_number = 1e40;
constexpr double most_angle = 1e3;  // [rad] of an `rpy`

/// Numbers that only a size is asked of: a wheel's radius, a footprint and friction come from them.
constexpr std::array sized_rules{
    NumberRule{"cylinder", "radius", 1},  NumberRule{"cylinder", "length", 1},
    NumberRule{"sphere", "radius", 1},    NumberRule{"box", "size", 3},
    NumberRule{"dynamics", "damping", 1}, NumberRule{"dynamics", "friction", 1},
};

bool is_beyond_numbers(double number) {
  const double size = std::abs(number);
  return size > most_number || (size > 0.0 && size < least_number);
}

class UrdfChecker {
 public:
  UrdfChecker(const std::vector<XmlElement>& elements, Diagnostics& diagnostics)
      : elements_(elements), diagnostics_(diagnostics), children_(elements.size()) {
    for (std::size_t i = 1; i < elements.size(); ++i) {
      children_[static_cast<std::size_t>(elements[i].parent)].push_back(i);
    }
  }

  std::optional<UrdfFindings> check() {
    if (elements_[0].name != "robot") {
      complain(wording::not_urdf(elements_[0].span, elements_[0].name));
      return std::nullopt;
    }
    for (const XmlElement& element : elements_) {
      check_sizes(element);
      // Without its prefix a newer xacro leaves it as it is, and a joint has no origin.
      if (element.name.starts_with("xacro:") || element.name == "insert_block")
        complain_of_macro(element.span, element.name);
    }
    for (const std::size_t i : children_[0]) {
      const XmlElement& element = elements_[i];
      if (element.name == "link") check_link(i);
      if (element.name == "joint") check_joint(i);
    }
    if (links_.size() > most_links) complain(wording::too_many_links(elements_[0].span, most_links));
    if (links_.empty()) complain(wording::no_links(elements_[0].span));
    judge_tiny_masses();
    judge_impossible_inertias();
    if (is_good_) check_tree();
    if (!is_good_) return std::nullopt;
    return std::move(findings_);
  }

 private:
  void complain(Diagnostic diagnostic) {
    diagnostics_.add(std::move(diagnostic));
    is_good_ = false;
  }

  /// Of a file that nobody expanded the first place says it all.
  void complain_of_macro(const Span& span, const std::string& text) {
    if (!has_macros_) complain(wording::unexpanded_macro(span, text));
    has_macros_ = true;
  }

  std::optional<std::size_t> child(std::size_t parent, std::string_view name) const {
    for (const std::size_t i : children_[parent]) {
      if (elements_[i].name == name) return i;
    }
    return std::nullopt;
  }

  std::string name_of(std::size_t i) {
    const XmlElement& element = elements_[i];
    const XmlAttribute* name = element.find("name");
    if (name == nullptr || trimmed(name->value).empty()) {
      complain(wording::unnamed_element(element.span, element.name));
      return {};
    }
    return name->value;
  }

  /// E105, wherever in the file they stand. Text that is no number is told where it is used.
  void check_sizes(const XmlElement& element) {
    const auto check = [&](const NumberRule& rule) {
      const XmlAttribute* attribute = element.name == rule.element ? element.find(rule.attribute) : nullptr;
      if (attribute == nullptr) return;
      const auto numbers = read_numbers(attribute->value, rule.count).value_or(std::vector<double>{});
      if (std::any_of(numbers.begin(), numbers.end(), is_beyond_numbers))
        complain(wording::number_out_of_range(attribute->span, attribute->value));
    };
    for (const NumberRule& rule : number_rules) {
      if (rule.element != "mass") check(rule);  // E858 tells of masses
    }
    for (const NumberRule& rule : sized_rules) check(rule);
  }

  /// The numbers of the attributes that an element must or may have; false when one cannot be read.
  bool check_numbers(std::size_t i) {
    bool is_good = true;
    for (const NumberRule& rule : number_rules) {
      if (elements_[i].name != rule.element) continue;
      const XmlAttribute* attribute = elements_[i].find(rule.attribute);
      if (attribute == nullptr || read_numbers(attribute->value, rule.count)) continue;
      is_good = false;
      const bool is_macro = attribute->value.find("${") != std::string::npos ||
                            attribute->value.find("$(") != std::string::npos;
      if (is_macro) {
        complain_of_macro(attribute->span, attribute->value);
      } else {
        complain(wording::bad_urdf_number(attribute->span, std::string(rule.attribute), attribute->value,
                                          rule.count));
      }
    }
    return is_good;
  }

  double number(std::size_t i, std::string_view attribute, double otherwise) const {
    const XmlAttribute* a = elements_[i].find(attribute);
    if (a == nullptr) return otherwise;
    const auto numbers = read_numbers(a->value, 1);
    return numbers ? numbers->front() : otherwise;
  }

  void check_link(std::size_t i) {
    const std::string name = name_of(i);
    if (name.empty()) return;
    if (!links_.emplace(name, i).second) complain(wording::doubled_in_urdf(elements_[i].span, "link", name));
    const std::optional<std::size_t> inertial = child(i, "inertial");
    if (inertial) check_inertial(*inertial, name);
  }

  void check_inertial(std::size_t i, const std::string& link) {
    const std::optional<std::size_t> mass = child(i, "mass");
    const std::optional<std::size_t> inertia = child(i, "inertia");
    if (!mass || elements_[*mass].find("value") == nullptr) {
      return complain(wording::incomplete_inertial(elements_[i].span, link, "mass"));
    }
    if (!inertia) return complain(wording::incomplete_inertial(elements_[i].span, link, "inertia"));
    for (const std::string_view entry : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
      if (elements_[*inertia].find(entry) == nullptr) {
        return complain(wording::incomplete_inertial(elements_[*inertia].span, link, std::string(entry)));
      }
    }
    const std::optional<std::size_t> origin = child(i, "origin");
    // Each is looked at, whatever the others are: all that is wrong is said at once.
    const bool mass_is_readable = check_numbers(*mass);
    const bool inertia_is_readable = check_numbers(*inertia);
    const bool origin_is_readable = !origin || check_numbers(*origin);
    if (origin && origin_is_readable) check_distance(*origin, link);
    if (!mass_is_readable || !inertia_is_readable || !origin_is_readable) return;
    const double kilograms = number(*mass, "value", 0.0);
    const Span span = elements_[*mass].find("value")->span;
    if (kilograms < 0.0 || kilograms > 1e6) return complain(wording::impossible_mass(span, link, kilograms));
    if (kilograms > 0.0 && kilograms < least_mass) {
      tiny_masses_.push_back({link, span, kilograms});
      return;
    }
    solver::Matrix3 m;
    const auto entry = [&](std::string_view key) { return number(*inertia, key, 0.0); };
    m << entry("ixx"), entry("ixy"), entry("ixz"), entry("ixy"), entry("iyy"), entry("iyz"), entry("ixz"),
        entry("iyz"), entry("izz");
    // All zero: a point, or a mass that only counts together with the body that it is fixed to.
    total_mass_ += kilograms;
    if (kilograms > 0.0 && !m.isZero(0.0)) check_inertia(m, kilograms, elements_[*inertia].span, link);
  }

  /// Whether a body can have it (the triangle rule) is asked of whole moving bodies, where dynamics need it.
  void check_inertia(const solver::Matrix3& m, double mass, const Span& span, const std::string& link) {
    const double largest = m.cwiseAbs().maxCoeff();
    if (largest > most_inertia || largest < least_inertia) {
      const std::string figure = format_number(largest) + " kg m^2";
      impossible_inertias_.push_back(
          {link, span, mass, wording::beyond_all_bodies(span, link, "an inertia", figure)});
      return;
    }
    const solver::Vector3 moments = Eigen::SelfAdjointEigenSolver<solver::Matrix3>(m).eigenvalues();
    const double tolerance = 1e-6 * moments.cwiseAbs().maxCoeff();
    if (moments(0) < -tolerance)
      impossible_inertias_.push_back({link, span, mass, wording::impossible_inertia(span, link)});
  }

  /// Of a place that something is seen from it does not matter. A number that no robot has is a slip.
  void judge_tiny_masses() {
    std::vector<wording::TinyMass> negligible;
    for (const wording::TinyMass& tiny : tiny_masses_) {
      if (tiny.mass < least_number) {
        complain(
            wording::beyond_all_bodies(tiny.span, tiny.link, "a mass", format_number(tiny.mass) + " kg"));
        continue;
      }
      negligible.push_back(tiny);
      findings_.weightless.insert(tiny.link);
    }
    if (!negligible.empty()) diagnostics_.add(wording::negligible_masses(negligible));
  }

  /// No body has them. Of an antenna it does not matter.
  void judge_impossible_inertias() {
    for (ImpossibleInertia& inertia : impossible_inertias_) {
      const double share = inertia.mass / total_mass_;
      if (!is_fixed(inertia.link) || share > negligible_share) {
        complain(std::move(inertia.complaint));
        continue;
      }
      diagnostics_.add(wording::negligible_inertia(inertia.span, inertia.link, inertia.mass, share));
      findings_.point_masses.insert(inertia.link);
    }
  }

  bool is_fixed(const std::string& link) const {
    return std::any_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
      return edge.child == link && elements_[edge.joint].find("type")->value == "fixed";
    });
  }

  void check_joint(std::size_t i) {
    const std::string name = name_of(i);
    if (name.empty()) return;
    const XmlElement& element = elements_[i];
    if (!joints_.emplace(name, i).second) complain(wording::doubled_in_urdf(element.span, "joint", name));
    const XmlAttribute* type = element.find("type");
    static const std::set<std::string, std::less<>> known{"fixed", "revolute", "continuous", "prismatic"};
    if (type == nullptr || known.find(type->value) == known.end()) {
      return complain(wording::joint_type(type != nullptr ? type->span : element.span, name,
                                          type != nullptr ? type->value : ""));
    }
    const std::string parent = linked(i, name, "parent");
    const std::string below = linked(i, name, "child");
    if (parent.empty() || below.empty()) return;
    edges_.push_back({i, parent, below});
    const std::optional<std::size_t> origin = child(i, "origin");
    if (origin && check_numbers(*origin)) check_distance(*origin, below);
    if (type->value != "fixed") check_motion(i, name, type->value);
  }

  void check_distance(std::size_t origin, const std::string& link) {
    check_each_within(elements_[origin].find("xyz"), link, most_distance, "a place", "m");
    check_each_within(elements_[origin].find("rpy"), link, most_angle, "an angle", "rad");
  }

  void check_each_within(const XmlAttribute* three, const std::string& link, double most, const char* what,
                         const std::string& unit) {
    const auto numbers = three != nullptr ? read_numbers(three->value, 3) : std::nullopt;
    for (const double number : numbers.value_or(std::vector<double>{})) {
      if (std::abs(number) <= most) continue;
      complain(wording::beyond_all_bodies(three->span, link, what, format_number(number) + " " + unit));
      return;
    }
  }

  std::string linked(std::size_t i, const std::string& joint, const std::string& role) {
    const std::optional<std::size_t> element = child(i, role);
    const XmlAttribute* link = element ? elements_[*element].find("link") : nullptr;
    if (link == nullptr || link->value.empty()) {
      complain(wording::joint_without_link(elements_[i].span, joint, role));
      return {};
    }
    return link->value;
  }

  void check_motion(std::size_t i, const std::string& name, const std::string& type) {
    const std::optional<std::size_t> axis = child(i, "axis");
    if (axis && check_numbers(*axis) && elements_[*axis].find("xyz") != nullptr) {
      const auto xyz = read_numbers(elements_[*axis].find("xyz")->value, 3);
      const double length = std::hypot((*xyz)[0], (*xyz)[1], (*xyz)[2]);
      if (length < 1e-6) complain(wording::zero_axis(elements_[*axis].span, name));
    }
    const std::optional<std::size_t> limit = child(i, "limit");
    if (!limit) {
      if (type != "continuous") complain(wording::joint_without_limit(elements_[i].span, name, type));
      return;
    }
    if (!check_numbers(*limit)) return;
    const Span span = elements_[*limit].span;
    const double lower = number(*limit, "lower", 0.0), upper = number(*limit, "upper", 0.0);
    if (lower > upper && type != "continuous")
      diagnostics_.add(wording::unordered_limits(span, name, lower, upper, type == "prismatic"));
    // Simulators write -1 where there is no limit.
    const auto is_negative = [](double value) { return value < 0.0 && value != -1.0; };
    if (is_negative(number(*limit, "effort", 0.0)) || is_negative(number(*limit, "velocity", 0.0))) {
      complain(wording::negative_limit(span, name));
    }
  }

  /// Every link has at most one joint above it, and all hang together below one root. Iterative: depth is
  /// the file's choice.
  void check_tree() {
    std::map<std::string, std::size_t> above;
    std::map<std::string, std::vector<std::string>> below;
    for (const Edge& edge : edges_) {
      const std::string joint = elements_[edge.joint].find("name")->value;
      for (const std::string& link : {edge.parent, edge.child}) {
        if (!links_.contains(link)) complain(wording::missing_link(elements_[edge.joint].span, joint, link));
      }
      if (!above.emplace(edge.child, edge.joint).second) {
        complain(wording::two_parents(elements_[edge.joint].span, edge.child));
      }
      below[edge.parent].push_back(edge.child);
    }
    if (!is_good_) return;
    std::vector<std::string> roots;
    for (const auto& [link, i] : links_) {
      if (!above.contains(link)) roots.push_back(link);
    }
    if (roots.empty()) return complain(wording::no_root(elements_[0].span));
    if (roots.size() > 1) {
      return complain(wording::two_roots(elements_[links_.at(roots[1])].span, roots[0], roots[1]));
    }
    std::vector<std::string> open{roots[0]};
    std::set<std::string> reached;
    while (!open.empty()) {
      const std::string link = open.back();
      open.pop_back();
      reached.insert(link);
      open.insert(open.end(), below[link].begin(), below[link].end());
    }
    for (const auto& [link, i] : links_) {
      if (!reached.contains(link))
        return complain(wording::unreached_link(elements_[i].span, link, roots[0]));
    }
  }

  struct Edge {
    std::size_t joint;
    std::string parent;
    std::string child;
  };

  struct ImpossibleInertia {
    std::string link;
    Span span;
    double mass;  ///< [kg]
    Diagnostic complaint;
  };

  const std::vector<XmlElement>& elements_;
  Diagnostics& diagnostics_;
  std::vector<std::vector<std::size_t>> children_;
  std::map<std::string, std::size_t> links_;
  std::map<std::string, std::size_t> joints_;
  std::vector<Edge> edges_;
  double total_mass_ = 0.0;  ///< [kg]
  std::vector<ImpossibleInertia> impossible_inertias_;
  std::vector<wording::TinyMass> tiny_masses_;
  UrdfFindings findings_;
  bool is_good_ = true, has_macros_ = false;
};

}  // namespace

std::optional<UrdfFindings> check_urdf(const std::vector<XmlElement>& elements, Diagnostics& diagnostics) {
  return UrdfChecker(elements, diagnostics).check();
}

}  // namespace zwang::lang
