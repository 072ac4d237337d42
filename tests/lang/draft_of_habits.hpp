// Small URDFs with the habits of exporters, and what is said of their drafts.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

class DraftOfHabits : public testing::Test {
 protected:
  std::optional<RobotDraft> draft(const std::filesystem::path& urdf) {
    Diagnostics diagnostics;
    std::optional<RobotDraft> draft = draft_robot(urdf, urdf.filename().string(), diagnostics);
    EXPECT_TRUE(draft) << test::rendered(diagnostics);
    return draft;
  }
  std::string said_of(const std::string& text) {
    Diagnostics diagnostics;
    load_robot(folder_.write("robot.yaml", text), diagnostics);
    return test::rendered(diagnostics);
  }

  test::Folder folder_;
};

inline std::string inertial_element(const std::string& mass, const std::string& moments) {
  return "<inertial><mass value='" + mass + "'/><inertia " + moments +
         " ixy='0' ixz='0' iyz='0'/></inertial>";
}

/// Of 1 kg and 80 mm, at `xyz` of its parent.
inline std::string wheel_at(const std::string& name, const std::string& parent, const std::string& xyz,
                            const std::string& more = "<limit effort='8' velocity='9'/>") {
  return "<link name='" + name + "'>" + inertial_element("1", "ixx='.002' iyy='.003' izz='.002'") +
         "<collision><origin rpy='1.5707963 0 0'/><geometry><cylinder radius='.08' length='.04'/></geometry>"
         "</collision></link><joint name='" +
         name + "_joint' type='continuous'><parent link='" + parent + "'/><child link='" + name +
         "'/><origin xyz='" + xyz + "'/><axis xyz='0 1 0'/>" + more + "</joint>";
}

/// Of 20 kg, its middle at the height of the link.
inline std::string chassis() {
  return "<link name='chassis'>" + inertial_element("20", "ixx='.3' iyy='.5' izz='.6'") +
         "<collision><geometry><box size='.6 .4 .1'/></geometry></collision></link>";
}

/// Two wheels below `chassis`, and what is drawn above it.
inline std::string below_world(const std::string& above) {
  return "<robot name='r'>" + above + chassis() + wheel_at("left_wheel", "chassis", "0 .2 0") +
         wheel_at("right_wheel", "chassis", "0 -.2 0") + "</robot>";
}

inline std::string two_wheels_and(const std::string& parts) {
  return "<robot name='r'>" + chassis() + wheel_at("left_wheel", "chassis", "0 .2 0") +
         wheel_at("right_wheel", "chassis", "0 -.2 0") + parts + "</robot>";
}

}  // namespace zwang::lang
