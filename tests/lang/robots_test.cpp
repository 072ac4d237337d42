#include <gtest/gtest.h>

#include "robot/urdf.hpp"
#include "support.hpp"

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
    if (file.path().extension() != ".urdf" || file.path().stem() == "husky_bullet") continue;
    Diagnostics diagnostics;
    const auto urdf = read_urdf(file.path(), {}, diagnostics);
    ASSERT_TRUE(urdf) << rendered(diagnostics);
    EXPECT_EQ(urdf->joints.size() + 1, urdf->links.size()) << file.path();
    EXPECT_NE(urdf->find_link(urdf->root), nullptr);
    EXPECT_EQ(urdf->joint_above(urdf->root), nullptr);
    ++read;
  }
  EXPECT_GE(read, 9);
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

}  // namespace
}  // namespace zwang::lang
