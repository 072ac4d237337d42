// `fixed` and `ignore` of a robot file: what it takes from a URDF that stays as it is.
#include <gtest/gtest.h>

#include "robot/possible_inertia.hpp"
#include "robot/urdf.hpp"
#include "support.hpp"

namespace zwang::lang {
namespace {

const char* const urdf_text = R"~(<robot name="dropped">
  <link name="base_link"><inertial><origin xyz="0 0 0.1"/><mass value="20"/>
    <inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.8"/></inertial></link>
  <link name="drop"><inertial><mass value="2"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <link name="left_link"><inertial><mass value="1"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/></inertial></link>
  <link name="right_link"><inertial><mass value="1"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/></inertial></link>
  <link name="mast"><inertial><mass value="4"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <link name="camera"><inertial><mass value="0.5"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <joint name="spring" type="prismatic"><parent link="base_link"/><child link="drop"/>
    <origin xyz="0 0.2 0.08"/><axis xyz="0 0 1"/><limit lower="0.02" upper="0.04" effort="0" velocity="1"/></joint>
  <joint name="left" type="continuous"><parent link="drop"/><child link="left_link"/><axis xyz="0 1 0"/>
    <limit effort="5" velocity="10"/></joint>
  <joint name="right" type="continuous"><parent link="base_link"/><child link="right_link"/>
    <origin xyz="0 -0.2 0.1"/><axis xyz="0 1 0"/><limit effort="5" velocity="10"/></joint>
  <joint name="neck" type="revolute"><parent link="base_link"/><child link="mast"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="5" velocity="1"/></joint>
  <joint name="eye" type="fixed"><parent link="mast"/><child link="camera"/><origin xyz="0 0 1"/></joint>
</robot>
)~";

class AdaptedUrdf : public testing::Test {
 protected:
  std::optional<Robot> robot(const std::string& lines) {
    folder_.write("dropped.urdf", urdf_text);
    diagnostics_ = Diagnostics();
    return load_robot(
        folder_.write("robot.yaml", "zwang_robot: 1\nurdf: dropped.urdf\nbase: base_link\n" + lines +
                                        "wheels:\n  - {joint: left, radius: 0.1 m}\n"
                                        "  - {joint: right, radius: 0.1 m}\n"
                                        "actuated: {left: {}, right: {}}\n"
                                        "stop: {deceleration: 1 m/s^2, force: 50 N}\n"
                                        "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], "
                                        "[-0.3 m, -0.2 m], [0.3 m, -0.2 m]]}\n"),
        diagnostics_);
  }
  std::string said() { return test::rendered(diagnostics_); }

  test::Folder folder_;
  Diagnostics diagnostics_;
};

TEST_F(AdaptedUrdf, a_wheel_behind_a_spring_is_refused) {
  EXPECT_FALSE(robot("posture: {spring: 0.03 m}\n"));
  EXPECT_NE(said().find("list `spring` under `fixed`"), std::string::npos) << said();
}

// 0.08 m + 0.02 m: the wheel's centre, as high as the other one's.
TEST_F(AdaptedUrdf, a_held_joint_stands_at_the_end_of_its_travel_nearest_to_0) {
  const auto held = robot("fixed: [spring]\n");
  ASSERT_TRUE(held) << said();
  EXPECT_EQ(said(), "");
  EXPECT_EQ(held->model.joint_count(), 3);
  EXPECT_FALSE(held->model.find_joint("spring"));
  EXPECT_NEAR(held->model.total_mass(), 28.5, 1e-12);  // nothing is lost
}

TEST_F(AdaptedUrdf, an_ignored_link_goes_with_all_that_hangs_on_it) {
  const auto without = robot("fixed: [spring]\nignore: [mast]\n");
  ASSERT_TRUE(without) << said();
  EXPECT_NEAR(without->model.total_mass(), 24.0, 1e-12);
  EXPECT_EQ(without->model.joint_count(), 2);
  ASSERT_TRUE(robot("fixed: [spring]\nignore: [camera, mast]\n")) << said();  // one below the other
  ASSERT_TRUE(robot("fixed: [spring]\nignore: [mast, camera]\n")) << said();
}

TEST_F(AdaptedUrdf, what_is_used_cannot_be_left_out) {
  EXPECT_FALSE(robot("fixed: [spring]\nignore: [right_link]\n"));
  EXPECT_NE(said().find("`right` belongs to link `right_link`, which `ignore` leaves out"), std::string::npos)
      << said();
  EXPECT_FALSE(robot("fixed: [spring]\nignore: [base_link]\n"));
  EXPECT_NE(said().find("`base_link` is left out by `ignore`"), std::string::npos) << said();
}

// A sensor whose place is a macro, as on robots that one switches on by the environment.
TEST_F(AdaptedUrdf, nothing_is_asked_of_what_is_left_out) {
  std::string text = urdf_text;
  const std::string place = "<origin xyz=\"0 0 1\"/>";
  text.replace(text.find(place), place.size(), "<origin xyz=\"$(optenv CAMERA_XYZ 0 0 1)\"/>");
  const std::filesystem::path path = folder_.write("macro.urdf", text);
  Diagnostics refused, good;
  EXPECT_FALSE(read_urdf(path, {}, refused));
  EXPECT_EQ(refused.all().at(0).code, "E855");
  const auto urdf = read_urdf(path, {}, good, {{"camera"}, {}});
  ASSERT_TRUE(urdf) << test::rendered(good);
  EXPECT_EQ(urdf->links.size(), 5U);
  EXPECT_EQ(urdf->left_out.at("eye"), "camera");
}

TEST_F(AdaptedUrdf, a_held_wheel_is_told_where_it_is_held) {
  EXPECT_FALSE(robot("fixed: [spring, left]\n"));
  EXPECT_NE(said().find("E801"), std::string::npos) << said();
  EXPECT_NE(said().find("robot.yaml:4:"), std::string::npos) << said();
}

// (1, 1, 2.5) g m^2 lacks 0.5: a third of it, and a millionth of the largest against rounding, on each.
TEST(CorrectedInertia, is_the_nearest_that_keeps_the_triangle_rule) {
  const auto of = [](double izz) {
    return solver::RigidInertia::from_com(2.0, {0.1, 0.2, 0.3},
                                          solver::Vector3(1e-3, 1e-3, izz).asDiagonal());
  };
  const auto possible = corrected(of(2.5e-3));
  ASSERT_TRUE(possible);
  EXPECT_NEAR(possible->share, (0.5 / 2.5 + 1e-6) / 3.0, 1e-9);
  const solver::Matrix3 c = solver::skew(solver::Vector3(0.1, 0.2, 0.3));
  const solver::Matrix3 at_com = possible->inertia.rotational + 2.0 * c * c;
  const solver::Vector3 expected(1e-3 + 0.5e-3 / 3.0, 1e-3 + 0.5e-3 / 3.0, 2.5e-3 - 0.5e-3 / 3.0);
  EXPECT_LT((at_com - solver::Matrix3(expected.asDiagonal())).norm(), 2e-9);
  EXPECT_GE(at_com(0, 0) + at_com(1, 1), at_com(2, 2));
  EXPECT_FALSE(corrected(of(2.0e-3)));  // a disc
  EXPECT_FALSE(corrected(of(9.0e-3)));  // E808
}

}  // namespace
}  // namespace zwang::lang
