// The statics of bases: by hand.
#include "zwang/lang/footing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "../temporary_folder.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

constexpr double g = 9.81;

/// 20 kg at `com`, two wheels of 1 kg beside it, 10 cm above the floor; a support of no mass 0.3 m ahead.
std::optional<Footing> footing_with(const std::string& com, const std::string& supports,
                                    std::string* code = nullptr,
                                    const std::string& ball = R"(<link name="ball"/>)",
                                    const std::string& ball_at = "0.3 0 0") {
  const zwang::test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  std::ofstream urdf(folder / "base.urdf");
  urdf
      << R"(<robot name="base"><link name="base_link"><inertial><origin xyz=")" << com
      << R"("/><mass value="20"/><inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.8"/></inertial></link>)";
  for (const auto& [name, y] : {std::pair("left", "0.2"), {"right", "-0.2"}}) {
    urdf
        << "<link name=\"" << name
        << R"(_link"><inertial><mass value="1"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/>)"
        << "</inertial></link><joint name=\"" << name
        << R"(" type="continuous"><parent link="base_link"/><child link=")" << name
        << R"(_link"/><axis xyz="0 1 0"/><limit effort="5" velocity="10"/><origin xyz="0 )" << y
        << " 0.1\"/></joint>";
  }
  urdf << ball
       << R"(<joint name="ball" type="fixed"><parent link="base_link"/><child link="ball"/><origin xyz=")"
       << ball_at << R"("/></joint></robot>)";
  urdf.close();
  std::ofstream(folder / "base.yaml")
      << "zwang_robot: 1\nurdf: base.urdf\nbase: base_link\n"
      << "wheels: [{joint: left, radius: 0.1 m}, {joint: right, radius: 0.1 m}]\nsupports: [" << supports
      << "]\nactuated: {left: {}, right: {}}\nstop: {deceleration: 1 m/s^2, force: 50 N}\n"
      << "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0.2 m], [-0.3 m, -0.2 m], [0.3 m, -0.2 m]]}\n";
  Diagnostics diagnostics;
  const std::optional<Robot> robot = load_robot(folder / "base.yaml", diagnostics);
  if (code != nullptr && !diagnostics.all().empty()) *code = diagnostics.all().front().code;
  if (!robot) return std::nullopt;
  return footing_of(*robot);
}

TEST(Footing, OnThreePoints) {
  const auto footing = footing_with("0.11 0 0.32", "ball");
  ASSERT_TRUE(footing);
  EXPECT_NEAR(footing->weight, 22.0 * g, 0.01);
  EXPECT_NEAR(footing->centre.x(), 0.1, 1e-9);                     // 20 x 0.11 / 22
  EXPECT_NEAR(footing->height, (20 * 0.32 + 2 * 0.1) / 22, 1e-9);  // 0.3 m
  // Behind lies the axle, 0.1 m away; the edges to the ball slope 0.2 in 0.3: (0.3 - 0.1) 0.2 / hypot.
  EXPECT_NEAR(footing->inside, 0.1, 1e-9);
  // Lever about the axle: the ball carries 0.1/0.3 of the weight, the wheels half of the rest each.
  EXPECT_NEAR(footing->most_carried({0.0, 0.0, 1.0}), footing->weight / 3.0, 1e-6);
  EXPECT_NEAR(footing->most_carried({1.0, 0.0, 0.0}), footing->weight / 3.0, 1e-6);
  EXPECT_NEAR(footing->tipping_acceleration(solver::Vector3::UnitX()),
              footing->weight / 22.0 * 0.1 / footing->height, 1e-9);
  EXPECT_NEAR(footing->tipping_push(solver::Vector3::UnitX(), 0.5), footing->weight * 0.1 / 0.5, 1e-9);
  // To brake tips it over the edges ahead, which lie askew: along x the ball's tip is 0.2 m off.
  EXPECT_NEAR(footing->tipping_acceleration(-solver::Vector3::UnitX()),
              footing->weight / 22.0 * 0.2 / footing->height, 1e-9);
}

TEST(Footing, WithoutSupportsTwoWheelsStandOnTheFootprint) {
  const auto footing = footing_with("0 0 0.1", "");
  ASSERT_TRUE(footing);
  EXPECT_EQ(footing->points.size(), 6U);
  EXPECT_NEAR(footing->inside, 0.2, 1e-9);
}

// A mass above the axle: the wheels may carry it all. A mass 0.1 m ahead of the axle: the corners 0.3 m ahead
// of it carry a third at least. The corners alone could carry it all.
TEST(Footing, LoadsThatStaticsDoesNotKnowAreBounded) {
  const std::vector<double> wheels{1.0, 1.0, 0.0, 0.0, 0.0, 0.0}, corners{0.0, 0.0, 1.0, 1.0, 1.0, 1.0};
  const auto above = footing_with("0 0 0.1", ""), ahead = footing_with("0.11 0 0.1", "");
  ASSERT_TRUE(above && ahead);
  EXPECT_NEAR(above->most_carried(wheels), above->weight, 1e-6);
  EXPECT_NEAR(ahead->most_carried(wheels), ahead->weight * 2.0 / 3.0, 1e-6);
  EXPECT_NEAR(ahead->most_carried(corners), ahead->weight, 1e-6);
}

TEST(Footing, AMassBehindTheSupportsIsRefused) {
  std::string code;
  EXPECT_FALSE(footing_with("-0.011 0 0.1", "ball", &code));
  EXPECT_EQ(code, "E640");
  code.clear();
  EXPECT_TRUE(footing_with("0.011 0 0.1", "ball", &code));
  EXPECT_EQ(code, "");
}

// Many URDFs leave a caster's link at the base's origin and draw its ball where it is.
TEST(Footing, ASupportStandsBelowItsBall) {
  const std::string ball =
      R"(<link name="ball"><collision><origin xyz="0.3 0 0.02"/><geometry><sphere radius="0.02"/></geometry>)"
      "</collision></link>";
  const auto at_origin = footing_with("0.11 0 0.32", "ball"),
             aside = footing_with("0.11 0 0.32", "ball", nullptr, ball, "0 0 0");
  ASSERT_TRUE(at_origin && aside);
  ASSERT_EQ(aside->points.size(), 3U);
  EXPECT_NEAR((aside->points[2] - at_origin->points[2]).norm(), 0.0, 1e-9);
  EXPECT_NEAR(aside->inside, at_origin->inside, 1e-9);
}

// A ball on the axle: of three points on a line every point is an edge, and a mass above it falls, too.
TEST(Footing, AMassBesideALineOfPointsIsRefused) {
  const std::string ball = R"(<link name="ball"/>)";
  std::string code;
  EXPECT_FALSE(footing_with("-0.1 0 0.1", "ball", &code, ball, "0 0 0"));
  EXPECT_EQ(code, "E640");
  code.clear();
  EXPECT_FALSE(footing_with("0 0 0.1", "ball", &code, ball, "0 0 0"));
  EXPECT_EQ(code, "E640");
}

// The 22 kg lie 20/22 of the first number ahead of the axle, 0.1 m high. A floor tips them from
// atan(inside / height) on: 0.5 deg are 0.873 mm.
TEST(Footing, AMassNextToTheEdgeIsTold) {
  const double least = 0.1 * std::tan(least_lean);
  for (const auto& [inside, expected] : {std::pair{0.0, "E640"}, {0.9 * least, "W640"}, {1.1 * least, ""}}) {
    std::string code;
    const auto footing = footing_with(std::to_string(inside * 1.1) + " 0 0.1", "ball", &code);
    EXPECT_EQ(code, expected) << inside;
    EXPECT_EQ(footing.has_value(), code != "E640");
    if (footing) {
      EXPECT_NEAR(footing->lean(), std::atan(inside / 0.1), 1e-4);
    }
  }
}

}  // namespace
}  // namespace zwang::lang
