#include "robot/urdf_excerpt.hpp"

#include <cstddef>

#include "robot/xml_numbers.hpp"

namespace zwang::lang {

namespace {

class UrdfExcerpt {
 public:
  explicit UrdfExcerpt(const std::vector<XmlElement>& elements)
      : elements_(elements), children_(elements.size()) {
    for (std::size_t i = 1; i < elements.size(); ++i)
      children_[static_cast<std::size_t>(elements[i].parent)].push_back(i);
  }

  std::string write() {
    open(elements_[0], {"name"});
    for (const std::size_t i : children_[0]) {
      if (elements_[i].name == "link") write_link(i);
      if (elements_[i].name == "joint") write_joint(i);
    }
    close("robot");
    return std::move(text_);
  }

 private:
  using Names = std::initializer_list<const char*>;

  void write_link(std::size_t link) {
    open(elements_[link], {"name"});
    for (const std::size_t i : children_[link]) {
      const std::string& name = elements_[i].name;
      if (name == "inertial") write_inertial(i);
      if (name == "visual" || name == "collision") write_shape(i);
    }
    close("link");
  }

  void write_inertial(std::size_t inertial) {
    open(elements_[inertial], {});
    write_first(inertial, "origin", {"xyz", "rpy"});
    write_first(inertial, "mass", {"value"});
    write_first(inertial, "inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
    close("inertial");
  }

  /// Meshes are left out, and shapes that cannot be read: nothing that moves depends on them.
  void write_shape(std::size_t shape) {
    const std::size_t* const geometry = child(shape, "geometry");
    const std::size_t* const origin = child(shape, "origin");
    if (geometry == nullptr ||
        (origin != nullptr && !(has_numbers(*origin, "xyz", 3) && has_numbers(*origin, "rpy", 3))))
      return;
    for (const std::size_t i : children_[*geometry]) {
      const std::string& name = elements_[i].name;
      const bool is_known =
          (name == "box" && gives_numbers(i, "size", 3)) ||
          (name == "sphere" && gives_numbers(i, "radius", 1)) ||
          (name == "cylinder" && gives_numbers(i, "radius", 1) && gives_numbers(i, "length", 1));
      if (!is_known) continue;
      open(elements_[shape], {});
      write_first(shape, "origin", {"xyz", "rpy"});
      text_ += "<geometry>";
      open(elements_[i], {"size", "radius", "length"});
      close(name);
      text_ += "</geometry>";
      close(elements_[shape].name);
      return;
    }
  }

  void write_joint(std::size_t joint) {
    open(elements_[joint], {"name", "type"});
    write_first(joint, "origin", {"xyz", "rpy"});
    write_first(joint, "parent", {"link"});
    write_first(joint, "child", {"link"});
    if (elements_[joint].find("type")->value != "fixed") {
      const std::size_t* const axis = child(joint, "axis");
      if (axis != nullptr && elements_[*axis].find("xyz") != nullptr) write_first(joint, "axis", {"xyz"});
      write_limit(joint);
      write_dynamics(joint);
    }
    close("joint");
  }

  /// 0 is how URDFs say that they do not know a joint's effort or velocity; some say nothing.
  void write_limit(std::size_t joint) {
    const std::size_t* const limit = child(joint, "limit");
    if (limit == nullptr) return;
    text_ += "<limit";
    write_attributes(elements_[*limit], {"lower", "upper", "effort", "velocity"});
    for (const char* name : {"effort", "velocity"}) {
      if (elements_[*limit].find(name) == nullptr) text_ += std::string(" ") + name + "=\"0\"";
    }
    text_ += "/>";
  }

  /// Of numbers that can be read, or not at all: no friction is taken from them.
  void write_dynamics(std::size_t joint) {
    const std::size_t* const dynamics = child(joint, "dynamics");
    if (dynamics == nullptr || !has_numbers(*dynamics, "damping", 1) ||
        !has_numbers(*dynamics, "friction", 1))
      return;
    const XmlElement& element = elements_[*dynamics];
    if (element.find("damping") != nullptr || element.find("friction") != nullptr)
      write_first(joint, "dynamics", {"damping", "friction"});
  }

  const std::size_t* child(std::size_t parent, std::string_view name) const {
    for (const std::size_t& i : children_[parent]) {
      if (elements_[i].name == name) return &i;
    }
    return nullptr;
  }

  /// The numbers, or nothing at all.
  bool has_numbers(std::size_t i, std::string_view attribute, std::size_t count) const {
    return elements_[i].find(attribute) == nullptr || gives_numbers(i, attribute, count);
  }
  bool gives_numbers(std::size_t i, std::string_view attribute, std::size_t count) const {
    const XmlAttribute* text = elements_[i].find(attribute);
    return text != nullptr && read_numbers(text->value, count).has_value();
  }

  void write_first(std::size_t parent, std::string_view name, Names attributes) {
    const std::size_t* const found = child(parent, name);
    if (found == nullptr) return;
    open(elements_[*found], attributes);
    close(elements_[*found].name);
  }

  void open(const XmlElement& element, Names attributes) {
    text_ += "<" + element.name;
    write_attributes(element, attributes);
    text_ += ">";
  }

  /// As they stand in the file, which quotes them with the mark that they do not hold.
  void write_attributes(const XmlElement& element, Names attributes) {
    for (const char* name : attributes) {
      const XmlAttribute* attribute = element.find(name);
      if (attribute == nullptr) continue;
      const char quote = attribute->value.find('"') == std::string::npos ? '"' : '\'';
      text_ += std::string(" ") + name + "=" + quote + attribute->value + quote;
    }
  }

  void close(const std::string& name) { text_ += "</" + name + ">"; }

  const std::vector<XmlElement>& elements_;
  std::vector<std::vector<std::size_t>> children_;
  std::string text_;
};

}  // namespace

std::string urdf_excerpt(const std::vector<XmlElement>& elements) {
  return UrdfExcerpt(elements).write();
}

}  // namespace zwang::lang
