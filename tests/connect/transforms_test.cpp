// Chains of transforms, by the closed form of planar poses: X_ac = X_ab X_bc turns by the sum of the angles.
#include "transforms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace zwang::connect {
namespace {

constexpr Sender robot{1}, other{2};

TransformStamped planar(const std::string& parent, const std::string& child, double stamp, double x, double y,
                        double yaw) {
  return {header_at(stamp, parent), child, {x, y, 0.0, 0.0, 0.0, std::sin(yaw / 2), std::cos(yaw / 2)}};
}

TEST(Transforms, AreMultipliedFromParentToChild) {
  TransformChain chain("map", "base_link");
  chain.take(planar("base_footprint", "base_link", 0.0, 0.1, 0.0, 0.0), true, robot, 1.0);
  chain.take(planar("map", "odom", 10.5, 2.0, 1.0, M_PI / 2), false, robot, 1.0);
  EXPECT_FALSE(chain.find());  // odom does not lead to the base yet
  chain.take(planar("odom", "base_footprint", 10.0, 3.0, 0.0, M_PI / 2), false, robot, 1.0);
  const auto found = chain.find();
  ASSERT_TRUE(found);
  // (2, 1) + 3 m along y, then 0.1 m along -x; the stamp of the robot's own motion.
  EXPECT_NEAR(found->pose.position.x(), 2.0 - 0.1, 1e-12);
  EXPECT_NEAR(found->pose.position.y(), 1.0 + 3.0, 1e-12);
  EXPECT_NEAR(found->pose.rotation(0, 0), -1.0, 1e-12);
  EXPECT_EQ(found->stamp, 10.0);
  EXPECT_FALSE(chain.find());  // nothing has changed since
}

TEST(Transforms, NeedOneThatMoves) {
  TransformChain chain("map", "base_link");
  chain.take(planar("map", "base_link", 5.0, 1.0, 0.0, 0.0), true, robot, 1.0);
  EXPECT_FALSE(chain.find());
}

TEST(Transforms, OfOneFrameAreThoseOfItsFirstPublisher) {
  using Verdict = TransformChain::Verdict;
  TransformChain chain("/map", "base_link");
  EXPECT_EQ(chain.take(planar("map", "base_link", 1.0, 1.0, 0.0, 0.0), false, robot, 1.0), Verdict::taken);
  EXPECT_EQ(chain.take(planar("map", "base_link", 1.1, 9.0, 0.0, 0.0), false, other, 1.1),
            Verdict::of_another);
  EXPECT_EQ(chain.find()->pose.position.x(), 1.0);
  const double later = 1.2 + OnePublisher::silence;
  EXPECT_EQ(chain.take(planar("map", "base_link", later, 9.0, 0.0, 0.0), false, other, later),
            Verdict::taken);
  EXPECT_EQ(chain.find()->pose.position.x(), 9.0);
}

TEST(Transforms, WithNumbersThatCannotBeAreNotTaken) {
  TransformChain chain("map", "base_link");
  TransformStamped none = planar("map", "base_link", 1.0, 1.0, 0.0, 0.0);
  none.transform = {};  // no rotation
  EXPECT_EQ(chain.take(none, false, robot, 1.0), TransformChain::Verdict::bad);
  none = planar("map", "base_link", 1.0, std::numeric_limits<double>::infinity(), 0.0, 0.0);
  EXPECT_EQ(chain.take(none, false, robot, 1.0), TransformChain::Verdict::bad);
  EXPECT_FALSE(chain.find());
}

TEST(Transforms, InACircleLeadNowhere) {
  TransformChain chain("map", "base_link");
  chain.take(planar("odom", "base_link", 1.0, 1.0, 0.0, 0.0), false, robot, 1.0);
  chain.take(planar("base_link", "odom", 1.0, 1.0, 0.0, 0.0), false, robot, 1.0);
  EXPECT_FALSE(chain.find());
}

TEST(Transforms, OfEndlesslyManyFramesTakeNoMoreMemory) {
  TransformChain chain("map", "base_link");
  for (std::size_t i = 0; i < TransformChain::most_frames; ++i)
    chain.take(planar("map", "frame" + std::to_string(i), 1.0, 0.0, 0.0, 0.0), false, robot, 1.0);
  chain.take(planar("map", "base_link", 1.0, 1.0, 0.0, 0.0), false, robot, 1.0);
  EXPECT_FALSE(chain.find());  // the frame that came too late
}

}  // namespace
}  // namespace zwang::connect
