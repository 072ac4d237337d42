// Rotations against their definition: R'R = I, det R = 1, R from = to, and the angle between both where it is
// the smallest.
#include "zwang/solver/spatial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace zwang::solver {
namespace {

Vector3 drawn_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random)).normalized();
}

void expect_takes(const Vector3& from, const Vector3& to) {
  const Matrix3 R = rotation_between(from, to);
  EXPECT_LT((R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  EXPECT_LT((R * from - to).norm(), 1e-12) << from.transpose() << " to " << to.transpose();
}

TEST(RotationBetween, TakesOneDirectionToTheOtherByTheSmallestAngle) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 from = drawn_direction(random), to = drawn_direction(random);
    expect_takes(from, to);
    const double c = std::clamp(from.dot(to), -1.0, 1.0);
    if (c > -0.9) {
      EXPECT_NEAR(rotation_between(from, to).trace(), 1.0 + 2.0 * c, 1e-12);
    }
  }
}

TEST(RotationBetween, TakesOneDirectionToTheOppositeOneAndToItsNeighbours) {
  std::mt19937_64 random(4);
  for (const double lean : {0.0, 1e-15, 1e-9, 1e-5, 1e-3, 0.04, 0.06}) {
    const Vector3 from = drawn_direction(random);
    expect_takes(from, (-from + lean * from.unitOrthogonal()).normalized());
    expect_takes(from, (from + lean * from.unitOrthogonal()).normalized());
  }
}

}  // namespace
}  // namespace zwang::solver
