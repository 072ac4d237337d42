#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "check/room.hpp"
#include "robot/urdf.hpp"
#include "support.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {
namespace {

using test::rendered;

/// Robots of other makers: read-only test data that is not part of the project.
class RealRobots : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not here";
  }
  static inline const std::filesystem::path folder = test::source_dir / "../shared/robots";
};

TEST_F(RealRobots, are_read_as_one_tree) {
  int read = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".urdf") continue;
    Diagnostics diagnostics;
    const auto urdf = read_urdf(file.path(), {}, diagnostics);
    if (file.path().stem() == "husky_bullet") continue;  // holds macros
    ASSERT_TRUE(urdf) << file.path() << rendered(diagnostics);
    EXPECT_EQ(urdf->joints.size() + 1, urdf->links.size()) << file.path();
    EXPECT_NE(urdf->find_link(urdf->root), nullptr);
    EXPECT_EQ(urdf->joint_above(urdf->root), nullptr);
    ++read;
  }
  EXPECT_GE(read, 18);
}

TEST_F(RealRobots, an_unexpanded_macro_is_refused_at_its_place) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_urdf(folder / "husky_bullet.urdf", {}, diagnostics));
  ASSERT_FALSE(diagnostics.all().empty());
  for (const Diagnostic& d : diagnostics.all()) {
    EXPECT_EQ(d.code, "E855") << rendered(diagnostics);
    EXPECT_EQ(d.span.begin.line, 97);
  }
}

// Grippers whose fingers follow one of them, in a file of another maker: read with what each follows.
TEST_F(RealRobots, fingers_that_mimic_another_are_read_with_their_leader) {
  Diagnostics diagnostics;
  const auto urdf = read_urdf(folder / "eddie.urdf", {}, diagnostics);
  ASSERT_TRUE(urdf) << rendered(diagnostics);
  int followers = 0;
  for (const UrdfJoint& joint : urdf->joints) {
    if (!joint.mimic) continue;
    ++followers;
    EXPECT_NE(joint.joint.type, solver::JointType::fixed);
    EXPECT_NE(urdf->find_joint(joint.mimic->joint), nullptr) << joint.joint.name;
    EXPECT_GT(joint.mimic->span.begin.line, joint.span.begin.line);
  }
  EXPECT_EQ(followers, 10);
}

TEST(Friction, is_read_in_the_units_of_its_joint) {
  Diagnostics diagnostics;
  const auto robot =
      load_robot(test::source_dir / "tests/conformance/robot_ok_E202_friction.yaml", diagnostics);
  ASSERT_TRUE(robot) << rendered(diagnostics);
  const auto friction_of = [&](const char* joint) {
    return robot->friction.at(static_cast<std::size_t>(*robot->model.find_joint(joint)));
  };
  const JointFriction lift = friction_of("lift"), left = friction_of("left"), boom = friction_of("boom");
  EXPECT_DOUBLE_EQ(lift.coulomb, 12.0);
  EXPECT_DOUBLE_EQ(lift.presliding, 2e-4);
  EXPECT_DOUBLE_EQ(lift.viscous, 30.0);
  EXPECT_DOUBLE_EQ(lift.compensate, 0.8);
  EXPECT_DOUBLE_EQ(left.coulomb, 0.1);
  EXPECT_DOUBLE_EQ(left.presliding, 2e-4);
  EXPECT_DOUBLE_EQ(left.viscous, 0.01);
  EXPECT_EQ(boom.coulomb, 0.0);
}

// An angle of two corridors 1 wide: the deepest point is as far from the outer walls as from the inner
// corner, r = sqrt(2) (1 - r). Of a square it is the middle.
TEST(Room, ends_at_the_deepest_point) {
  const Corners angle{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const double deepest = std::sqrt(2.0) / (1.0 + std::sqrt(2.0));
  EXPECT_TRUE(has_room(angle, deepest - 1e-3));
  EXPECT_FALSE(has_room(angle, deepest + 1e-3));
  EXPECT_FALSE(is_convex(angle));
  const Corners square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  EXPECT_TRUE(has_room(square, 1.0 - 1e-3));
  EXPECT_FALSE(has_room(square, 1.0 + 1e-3));
  EXPECT_TRUE(is_convex(square));
  EXPECT_NEAR(circle_within({{0.3, 0.2, 0}, {-0.3, 0.2, 0}, {-0.3, -0.2, 0}, {0.3, -0.2, 0}}), 0.2, 1e-12);
}

}  // namespace
}  // namespace zwang::lang
