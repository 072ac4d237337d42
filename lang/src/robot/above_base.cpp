#include "robot/above_base.hpp"

#include <cstddef>
#include <map>
#include <set>

#include "robot/left_out.hpp"
#include "robot/urdf.hpp"
#include "robot/xml_numbers.hpp"

namespace zwang::lang {

namespace {

/// A joint of the root, by the index of its element. Nothing of it was checked yet.
struct JointAbove {
  std::size_t element = 0;
  std::string parent, child;
};

class ChainAboveBase {
 public:
  explicit ChainAboveBase(std::vector<XmlElement>& elements) : elements_(elements) {
    for (std::size_t i = 1; i < elements_.size(); ++i) note(i);
  }

  AboveBase drop() {
    const std::vector<JointAbove> chain = chain_to_last_free_joint();
    AboveBase above;
    std::set<std::size_t> gone;
    for (const JointAbove& joint : chain) {
      above.links.push_back(joint.parent);
      above.joints.push_back(value(elements_[joint.element], "name"));
      gone.insert({joint.element, links_.at(joint.parent)});
    }
    if (!gone.empty()) erase_elements(gone, elements_);
    return above;
  }

 private:
  static std::string value(const XmlElement& element, const char* name) {
    const XmlAttribute* attribute = element.find(name);
    return attribute != nullptr ? attribute->value : "";
  }

  void note(std::size_t i) {
    const XmlElement& element = elements_[i];
    const auto parent = static_cast<std::size_t>(element.parent);
    if (parent == 0 && element.name == "link") links_.emplace(value(element, "name"), i);
    if (parent == 0 && element.name == "joint") joints_[i].element = i;
    if (const auto joint = joints_.find(parent); joint != joints_.end()) {
      if (element.name == "parent") joint->second.parent = value(element, "link");
      if (element.name == "child") joint->second.child = value(element, "link");
    }
    if (element.name != "mass" || elements_[parent].name != "inertial") return;
    const auto numbers = read_numbers(value(element, "value"), 1);
    const double mass = numbers ? numbers->front() : 0.0;
    masses_[static_cast<std::size_t>(elements_[parent].parent)] = mass;
    total_mass_ += mass;
  }

  bool is_free(const JointAbove& joint) const {
    const std::string type = value(elements_[joint.element], "type");
    return type == "floating" || type == "planar";
  }

  /// The one joint below a link that weighs next to nothing.
  const JointAbove* only_joint(const std::string& link) const {
    const auto element = links_.find(link);
    if (element == links_.end()) return nullptr;
    const auto mass = masses_.find(element->second);
    if (mass != masses_.end() && mass->second > negligible_share * total_mass_) return nullptr;
    const JointAbove* below = nullptr;
    for (const auto& [i, joint] : joints_) {
      if (joint.parent != link) continue;
      if (below != nullptr) return nullptr;
      below = &joint;
    }
    return below;
  }

  /// From the root on; empty where no such joint is in the chain.
  std::vector<JointAbove> chain_to_last_free_joint() const {
    std::set<std::string> children;
    for (const auto& [i, joint] : joints_) children.insert(joint.child);
    std::vector<JointAbove> chain;
    std::size_t free = 0;  // joints up to the last free one
    for (const auto& [root, element] : links_) {
      if (children.contains(root)) continue;
      if (!chain.empty()) return {};  // two roots: told where the tree is checked
      std::string link = root;
      while (const JointAbove* below = only_joint(link)) {
        if (chain.size() == joints_.size()) break;
        chain.push_back(*below);
        if (is_free(*below)) free = chain.size();
        link = below->child;
      }
    }
    chain.resize(free);
    return chain;
  }

  std::vector<XmlElement>& elements_;
  std::map<std::string, std::size_t> links_;
  std::map<std::size_t, JointAbove> joints_;
  std::map<std::size_t, double> masses_;  ///< [kg] by the element of their link
  double total_mass_ = 0.0;               ///< [kg]
};

}  // namespace

AboveBase drop_above_base(std::vector<XmlElement>& elements) {
  return ChainAboveBase(elements).drop();
}

}  // namespace zwang::lang
