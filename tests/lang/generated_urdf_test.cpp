// 200 URDFs drawn by number, each drafted as it was drawn, or refused for the flaw it was drawn with. The
// drawing says what is expected, never a draft.
#include "generated_urdf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "../is_long.hpp"
#include "support.hpp"
#include "zwang/lang/robot_draft.hpp"
#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {
namespace {

using test::GeneratedUrdf;
using test::RefusedAt;

constexpr int most_urdfs = 200;
/// Odd, so that the sample of every 9th has each drive and each tenth number, which is a flaw.
constexpr int sampled = 9;

std::string metres(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g m", value);
  return text;
}

/// The owner of the drawn robot fills in the open places.
std::string filled(std::string text, const GeneratedUrdf& drawn) {
  double driven = 0.0;
  for (const auto& [joint, radius] : drawn.wheels) {
    driven = std::max(driven, radius);
    const std::string entry = "joint: " + joint + ", radius: ";
    text = std::regex_replace(text, std::regex(entry + "FILL_IN"), entry + metres(radius));
  }
  const double half = 0.3 * drawn.size;
  const std::string ahead = metres(1.5 * half), left = metres(half);
  const std::pair<const char*, std::string> values[] = {
      {"radius: FILL_IN", "radius: " + metres(driven)},
      {"kind: FILL_IN", "kind: " + drawn.kind},
      {"effort: FILL_IN", "effort: 1 N m"},
      {"polygon: FILL_IN", "polygon: [[" + ahead + ", " + left + "], [-" + ahead + ", " + left + "], [-" +
                               ahead + ", -" + left + "], [" + ahead + ", -" + left + "]]"}};
  for (const auto& [open, value] : values) text = std::regex_replace(text, std::regex(open), value);
  return text;
}

class Drawn {
 public:
  explicit Drawn(int number) : drawn_(test::generated_urdf(number)) {
    urdf_ = folder_.write("drawn.urdf", drawn_.text);
  }

  const GeneratedUrdf& urdf() const { return drawn_; }

  void expect_right() {
    Diagnostics diagnostics;
    const std::optional<RobotDraft> draft = draft_robot(urdf_, "drawn.urdf", diagnostics);
    if (drawn_.refused_at == RefusedAt::urdf) {
      EXPECT_FALSE(draft);
      EXPECT_EQ(test::count(diagnostics, drawn_.reason), diagnostics.error_count())
          << test::rendered(diagnostics);
      return;
    }
    ASSERT_TRUE(draft) << test::rendered(diagnostics);
    if (!drawn_.held_wheel.empty()) return expect_turned_wheels(*draft);
    const std::string text = filled(draft->text, drawn_);
    Diagnostics said;
    const std::optional<Robot> robot = load_robot(folder_.write("robot.yaml", text), said);
    if (drawn_.refused_at == RefusedAt::robot_file) {
      EXPECT_FALSE(robot);
      EXPECT_EQ(test::count(said, drawn_.reason), said.error_count()) << test::rendered(said) << text;
      return;
    }
    ASSERT_TRUE(robot) << test::rendered(said) << text;
    EXPECT_EQ(draft->text.find("radius: FILL_IN") == std::string::npos, drawn_.radius_is_drawn) << text;
    expect_as_drawn(*robot, text);
  }

 private:
  void expect_turned_wheels(const RobotDraft& draft) const {
    EXPECT_FALSE(draft.wheels.empty()) << draft.text;
    const std::size_t turns = draft.text.find("\nturns: [");
    ASSERT_NE(turns, std::string::npos) << draft.text;
    const std::string line = draft.text.substr(turns + 1, draft.text.find('\n', turns + 1) - turns);
    EXPECT_NE(line.find(drawn_.held_wheel), std::string::npos) << line;
  }

  void expect_as_drawn(const Robot& robot, const std::string& text) const {
    EXPECT_EQ(robot.base_frame, drawn_.base) << text;
    EXPECT_NEAR(robot.model.total_mass(), drawn_.mass, 1e-6 * drawn_.mass) << text;
    std::map<std::string, double> wheels;
    for (const solver::Wheel& wheel : robot.model.wheels())
      wheels[robot.model.joint(wheel.body - 1).name] = wheel.radius;
    ASSERT_EQ(wheels.size(), drawn_.wheels.size()) << text;
    for (const auto& [joint, radius] : drawn_.wheels) {
      ASSERT_TRUE(wheels.contains(joint)) << joint << "\n" << text;
      EXPECT_NEAR(wheels.at(joint), radius, 1e-5 * radius) << joint;
    }
    std::set<std::string> motors, joints;
    for (int j = 0; j < robot.model.joint_count(); ++j) {
      joints.insert(robot.model.joint(j).name);
      if (robot.model.joint(j).actuated) motors.insert(robot.model.joint(j).name);
    }
    EXPECT_EQ(motors, drawn_.motors) << text;
    for (const std::string& joint : drawn_.held)
      EXPECT_FALSE(joints.contains(joint)) << joint << "\n" << text;
    EXPECT_EQ(std::set<std::string>(robot.supports.begin(), robot.supports.end()), drawn_.supports) << text;
    EXPECT_EQ(base_fit(robot).freedoms, drawn_.freedoms) << text;
  }

  GeneratedUrdf drawn_;
  test::Folder folder_;
  std::filesystem::path urdf_;
};

TEST(GeneratedUrdfs, are_drafted_as_they_were_drawn_or_refused_for_their_flaw) {
  int refused = 0;
  for (int number = 0; number < most_urdfs; number += zwang::test::is_long() ? 1 : sampled) {
    Drawn drawn(number);
    SCOPED_TRACE(std::to_string(number) + ": " + drawn.urdf().about);
    drawn.expect_right();
    refused += drawn.urdf().refused_at == RefusedAt::nowhere ? 0 : 1;
  }
  EXPECT_GE(refused, zwang::test::is_long() ? most_urdfs / 20 : 1);
}

}  // namespace
}  // namespace zwang::lang
