/// The text of a URDF, link by link and joint by joint.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace zwang::lang::test {

struct LinkShape {
  std::string name;
  double mass = 0.0;                      ///< [kg]; 0: no inertial
  std::array<double, 3> at{}, inertia{};  ///< [m] of the centre of mass; [kg m^2] on the diagonal
  std::string geometry;                   ///< of what collides and what is seen
  bool collides = true;
};

struct JointShape {
  std::string name, type, parent, child;
  std::array<double, 3> at{}, rpy{}, axis{0.0, 0.0, 0.0};  ///< an axis of zeros is not written
  std::string limit;                                       ///< the attributes
  std::string mimic;                                       ///< the joint that leads
};

class UrdfText {
 public:
  /// Angles are written with as many digits behind the point; lengths in parts of a metre.
  UrdfText(int digits, double unit) : digits_(digits), unit_(unit) {}

  void add(const LinkShape& link) {
    text_ += "  <link name=\"" + link.name + "\">\n";
    if (link.mass > 0.0)
      text_ += "    <inertial>\n      <origin xyz=\"" + lengths(link.at) + "\"/>\n      <mass value=\"" +
               number(link.mass) + "\"/>\n      <inertia ixx=\"" + number(link.inertia[0]) +
               "\" ixy=\"0\" ixz=\"0\" iyy=\"" + number(link.inertia[1]) + "\" iyz=\"0\" izz=\"" +
               number(link.inertia[2]) + "\"/>\n    </inertial>\n";
    if (!link.geometry.empty()) {
      text_ += "    <visual>" + link.geometry + "</visual>\n";
      if (link.collides) text_ += "    <collision>" + link.geometry + "</collision>\n";
    }
    text_ += "  </link>\n";
  }

  void add(const JointShape& joint) {
    text_ += "  <joint name=\"" + joint.name + "\" type=\"" + joint.type + "\">\n    <origin xyz=\"" +
             lengths(joint.at) + "\" rpy=\"" + angles(joint.rpy) + "\"/>\n    <parent link=\"" +
             joint.parent + "\"/>\n    <child link=\"" + joint.child + "\"/>\n";
    if (joint.axis != std::array{0.0, 0.0, 0.0}) text_ += "    <axis xyz=\"" + numbers(joint.axis) + "\"/>\n";
    if (!joint.limit.empty()) text_ += "    <limit " + joint.limit + "/>\n";
    if (!joint.mimic.empty()) text_ += "    <mimic joint=\"" + joint.mimic + "\"/>\n";
    text_ += "  </joint>\n";
  }

  void add(const std::string& text) { text_ += text; }

  std::string cylinder(double radius, double length, const std::array<double, 3>& rpy) const {
    return "<origin xyz=\"0 0 0\" rpy=\"" + angles(rpy) + "\"/><geometry><cylinder radius=\"" +
           number(radius * unit_) + "\" length=\"" + number(length * unit_) + "\"/></geometry>";
  }
  std::string sphere(double radius) const {
    return "<geometry><sphere radius=\"" + number(radius * unit_) + "\"/></geometry>";
  }
  std::string box(double x, double y, double z) const {
    return "<geometry><box size=\"" + lengths({x, y, z}) + "\"/></geometry>";
  }
  static std::string mesh(const std::string& name) {
    return "<geometry><mesh filename=\"package://robot/meshes/" + name + ".stl\"/></geometry>";
  }

  static std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
  }

  std::string robot(const std::string& name) const {
    return "<?xml version=\"1.0\"?>\n<robot name=\"" + name + "\">\n" + text_ + "</robot>\n";
  }

 private:
  static std::string numbers(const std::array<double, 3>& v) {
    return number(v[0]) + " " + number(v[1]) + " " + number(v[2]);
  }
  std::string lengths(const std::array<double, 3>& v) const {
    return numbers({v[0] * unit_, v[1] * unit_, v[2] * unit_});
  }
  std::string angles(const std::array<double, 3>& v) const {
    const double step = std::pow(10.0, -digits_);
    return numbers(
        {std::round(v[0] / step) * step, std::round(v[1] / step) * step, std::round(v[2] / step) * step});
  }

  int digits_;
  double unit_;
  std::string text_;
};

}  // namespace zwang::lang::test
