// The robots that people own and that ship: their files say what docs/robots.md says.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "support.hpp"
#include "words/units.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// SI; 0 where the text is no quantity.
double quantity_of(const std::string& text) {
  const QuantityResult read = parse_quantity(text);
  EXPECT_EQ(read.error, QuantityError::none) << text;
  return read.quantity.value;
}

/// Rows of the table under `## Five that ship`, by the robot file.
std::map<std::string, std::vector<std::string>> stated() {
  std::istringstream page(test::slurp(test::source_dir / "docs/robots.md"));
  std::map<std::string, std::vector<std::string>> rows;
  for (std::string line; std::getline(page, line);) {
    const std::size_t link = line.find("](../specs/robots/");
    if (!line.starts_with("| [") || link == std::string::npos) continue;
    rows[line.substr(3, link - 3)] = cells_of(line);
  }
  return rows;
}

TEST(OwnedRobots, have_the_mass_the_wheels_and_the_speeds_of_the_page) {
  const auto rows = stated();
  EXPECT_EQ(rows.size(), 5U);
  for (const auto& [name, cells] : rows) {
    ASSERT_EQ(cells.size(), 8U) << name;
    Diagnostics diagnostics;
    const auto robot = load_robot(test::source_dir / "specs/robots" / (name + ".yaml"), diagnostics);
    ASSERT_TRUE(robot) << test::rendered(diagnostics);
    EXPECT_NEAR(robot->model.total_mass(), quantity_of(cells[4]), 0.05) << name;
    double left = 0.0, right = 0.0;
    const solver::State state = start_state(*robot);
    for (const solver::Wheel& wheel : robot->model.wheels()) {
      EXPECT_NEAR(wheel.radius, quantity_of(cells[5]), 1e-9) << name;
      double y = 0.0;  // at 0 the bodies above a wheel are not turned, but for omni wheels about themselves
      for (int b = wheel.body; b > 0; b = robot->model.bodies()[static_cast<std::size_t>(b)].parent)
        y += robot->model.bodies()[static_cast<std::size_t>(b)].pose_in_parent.position.y();
      left = std::max(left, y);
      right = std::min(right, y);
    }
    EXPECT_NEAR(left - right, quantity_of(cells[6]), 5e-5) << name;
    const std::size_t comma = cells[7].find(", ");
    const std::map<solver::Axis, double> fastest{{solver::Axis::x, quantity_of(cells[7].substr(0, comma))},
                                                 {solver::Axis::rz, quantity_of(cells[7].substr(comma + 2))}};
    int compared = 0;
    for (const BaseLimit& limit : robot->limits) {
      const auto at = fastest.find(limit.axis);
      if (limit.quantity != solver::Quantity::velocity || at == fastest.end()) continue;
      EXPECT_NEAR(limit.range.high, at->second, 1e-9) << name;
      ++compared;
    }
    EXPECT_EQ(compared, 2) << name;
  }
}

TEST(OwnedRobots, have_the_drive_of_the_page) {
  for (const auto& [name, cells] : stated()) {
    Diagnostics diagnostics;
    const auto robot = load_robot(test::source_dir / "specs/robots" / (name + ".yaml"), diagnostics);
    ASSERT_TRUE(robot) << test::rendered(diagnostics);
    const std::string kind = robot->drive.is_blind()        ? "blind"
                             : robot->drive.feels_contact() ? "feels by effort"
                                                            : "limited";
    EXPECT_EQ(cells[3].substr(0, cells[3].find(',')), kind) << name;
    EXPECT_EQ(robot->drive.takes_twist, cells[3].find("twist") != std::string::npos) << name;
    EXPECT_EQ(robot->drive.rate, quantity_of(cells[3].substr(cells[3].rfind(", ") + 2))) << name;
  }
}

// One file of another, and what it says itself.
TEST(BasedOn, leaves_every_key_to_the_other_file_that_it_does_not_say) {
  Diagnostics diagnostics;
  const auto folder = test::source_dir / "specs/robots";
  const auto base = load_robot(folder / "mecanum_base.yaml", diagnostics);
  const auto robot = load_robot(folder / "feels/mecanum_wrench_50_hz.yaml", diagnostics);
  ASSERT_TRUE(base && robot) << test::rendered(diagnostics);
  EXPECT_EQ(robot->model.total_mass(), base->model.total_mass());
  EXPECT_EQ(robot->footprint.size(), base->footprint.size());
  EXPECT_EQ(robot->limits.size(), base->limits.size());
  EXPECT_FALSE(base->drive.takes_velocity);
  EXPECT_TRUE(robot->drive.feels_contact());
  EXPECT_EQ(diagnostics.sources().size(), 3U) << "two robot files and their URDF";
}

TEST(BasedOn, a_nearer_file_goes_first_with_all_of_its_value) {
  const test::Folder place;
  place.write("far/base.urdf", test::slurp(test::source_dir / "specs/robots/mecanum_base.urdf"));
  std::string text = test::slurp(test::source_dir / "specs/robots/mecanum_base.yaml");
  text.replace(text.find("mecanum_base.urdf"), 17, "base.urdf");
  place.write("far/far.yaml", text);
  place.write("middle.yaml",
              "zwang_robot: 1\nbased_on: far/far.yaml\nstop: {deceleration: 0.5 m/s^2, force: 40 N}\n");
  const auto near =
      place.write("near.yaml", "zwang_robot: 1\nbased_on: middle.yaml\nlimits: {velocity: {x: +-0.3 m/s}}\n");
  Diagnostics diagnostics;
  const auto robot = load_robot(near, diagnostics);
  ASSERT_TRUE(robot) << test::rendered(diagnostics);
  EXPECT_EQ(robot->stop.force, 40.0);
  ASSERT_EQ(robot->limits.size(), 1U);
  EXPECT_EQ(robot->limits.front().range.high, 0.3);
}

TEST(BasedOn, a_chain_ends) {
  const test::Folder place;
  for (int i = 0; i < 12; ++i)
    place.write("r" + std::to_string(i) + ".yaml",
                "zwang_robot: 1\nbased_on: r" + std::to_string(i + 1) + ".yaml\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(load_robot(place.write("first.yaml", "zwang_robot: 1\nbased_on: r0.yaml\n"), diagnostics));
  EXPECT_EQ(test::count(diagnostics, "E816"), 1) << test::rendered(diagnostics);
  Diagnostics of_folder;
  EXPECT_FALSE(load_robot(place.write("up.yaml", "zwang_robot: 1\nbased_on: ../../up.yaml\n"), of_folder));
  EXPECT_TRUE(of_folder.has_errors());
}

}  // namespace
}  // namespace zwang::lang
