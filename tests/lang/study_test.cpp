// Studies: what is drawn has its distribution, cells are drawn alone, and each draw arrives where it belongs.
#include "zwang/lang/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support.hpp"

namespace zwang::lang {
namespace {

constexpr std::size_t many = 4000;

/// Kolmogorov and Smirnov: the largest distance of the drawn values from their distribution is above
/// 1.95 / sqrt(n) in one of a thousand (Smirnov 1948: 2 exp(-2 1.95^2) = 0.001).
template <typename Share>
void expect_drawn_from(const Distribution& distribution, Sequence sequence, const Share& share_below) {
  std::vector<double> values;
  for (std::size_t cell = 0; cell < many; ++cell)
    values.push_back(distribution.quantile(drawn_share(sequence, 7, cell, 3)));
  std::sort(values.begin(), values.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < many; ++i) {
    const double below = share_below(values[i]);
    const auto n = static_cast<double>(many);
    distance = std::max({distance, std::abs(below - static_cast<double>(i) / n),
                         std::abs(below - static_cast<double>(i + 1) / n)});
  }
  EXPECT_LT(distance, 1.95 / std::sqrt(static_cast<double>(many)));
}

TEST(Draws, HaveTheirDistributions) {
  for (const Sequence sequence : {Sequence::random, Sequence::halton}) {
    expect_drawn_from({Spread::uniform, -2.0, 6.0, {}}, sequence, [](double x) { return (x + 2.0) / 8.0; });
    expect_drawn_from({Spread::log_uniform, 2e3, 1e6, {}}, sequence,
                      [](double x) { return std::log(x / 2e3) / std::log(1e6 / 2e3); });
    expect_drawn_from({Spread::normal, 1.0, 0.1, {}}, sequence,
                      [](double x) { return 0.5 * std::erfc(-(x - 1.0) / 0.1 / std::numbers::sqrt2); });
  }
}

TEST(Draws, ChooseEachAsOften) {
  const Distribution choice{Spread::choice, 0.0, 0.0, {1.0, 2.0, 5.0}};
  for (const Sequence sequence : {Sequence::random, Sequence::halton}) {
    std::map<double, double> found;
    for (std::size_t cell = 0; cell < many; ++cell)
      found[choice.quantile(drawn_share(sequence, 1, cell, 0))] += 1.0 / many;
    ASSERT_EQ(found.size(), 3u);
    // Four standard deviations of the binomial distribution.
    for (const auto& [value, share] : found)
      EXPECT_NEAR(share, 1.0 / 3.0, 4.0 * std::sqrt(2.0 / 9.0 / many)) << value;
  }
}

/// Abramowitz, Stegun, table 26.5 and 26.6.
TEST(Draws, OfANormalDistributionHaveItsQuantiles) {
  const Distribution normal{Spread::normal, 0.0, 1.0, {}};
  EXPECT_EQ(normal.quantile(0.5), 0.0);
  EXPECT_NEAR(normal.quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal.quantile(0.001), -3.090232306167813, 1e-13);
  EXPECT_NEAR(normal.quantile(1e-9), -5.997807015007687, 1e-12);
}

/// Of b^k cells in a row each b-adic interval of length b^-k has one: what a low discrepancy is.
TEST(Halton, FillsTheUnitIntervalEvenly) {
  const std::size_t bases[] = {2, 3, 5};
  const std::size_t counts[] = {256, 243, 125};
  for (std::size_t draw = 0; draw < 3; ++draw) {
    std::vector<double> shares;
    for (std::size_t cell = 0; cell < counts[draw]; ++cell)
      shares.push_back(drawn_share(Sequence::halton, 9, cell, draw));
    std::sort(shares.begin(), shares.end());
    constexpr double rounding = 1e-12;
    for (std::size_t i = 0; i < counts[draw]; ++i) {
      const double length = 1.0 / static_cast<double>(counts[draw]);
      EXPECT_GE(shares[i], static_cast<double>(i) * length - rounding) << bases[draw];
      EXPECT_LE(shares[i], static_cast<double>(i + 1) * length + rounding) << bases[draw];
    }
  }
}

/// Of fewer than b^k points each has a digit among the first k that is not the zero's. From both ends it is
/// b^-k / (b - 1) away at least. A cell at an end would draw what no robot is.
TEST(Halton, HasNoCellAtAnEnd) {
  const std::size_t bases[] = {2, 3, 5};
  const double powers[] = {128.0, 243.0, 125.0};
  for (std::size_t draw = 0; draw < 3; ++draw) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
      for (std::size_t cell = 0; cell < 100; ++cell) {
        const double share = drawn_share(Sequence::halton, seed, cell, draw);
        const double least = 1.0 / (powers[draw] * static_cast<double>(bases[draw] - 1)) - 1e-12;
        EXPECT_GE(std::min(share, 1.0 - share), least) << "base " << bases[draw] << ", cell " << cell;
      }
    }
  }
}

TEST(Draws, DoNotGoWithEachOther) {
  for (const Sequence sequence : {Sequence::random, Sequence::halton}) {
    for (std::size_t draw = 0; draw < 32; draw += 5) {
      double sum = 0.0;
      for (std::size_t cell = 0; cell < many; ++cell)
        sum +=
            (drawn_share(sequence, 1, cell, draw) - 0.5) * (drawn_share(sequence, 1, cell, draw + 1) - 0.5);
      // Of n products of two uniform shares: 4.5 standard deviations, each 1/12 sqrt(n).
      EXPECT_LT(std::abs(sum), 4.5 / 12.0 * std::sqrt(static_cast<double>(many))) << draw;
    }
  }
}

TEST(Draws, OfAnotherSeedAreOthers) {
  EXPECT_NE(drawn_share(Sequence::random, 1, 5, 2), drawn_share(Sequence::random, 2, 5, 2));
  EXPECT_NE(drawn_share(Sequence::halton, 1, 5, 9), drawn_share(Sequence::halton, 2, 5, 9));
  EXPECT_NE(seed_of_cell(0, 1), seed_of_cell(0, 2));
}

class Studies : public testing::Test {
 protected:
  Studies() {
    for (const char* name :
         {"wall_align.yaml", "robots/mecanum_base.yaml", "robots/mecanum_base.urdf", "robots/diff_base.yaml",
          "robots/diff_base.urdf", "robots/car_base.yaml", "robots/car_base.urdf", "scenes/wall.yaml"})
      folder_.write(name, test::slurp(test::source_dir / "specs" / name));
  }
  std::optional<Study> load(const std::string& draws) {
    const auto path = folder_.write(
        "study.yaml", "zwang_study: 1\ntask: wall_align.yaml\nscene: scenes/wall.yaml\nruns: 10\n" + draws +
                          "expect: [{outcome: done}]\n");
    return load_study(path, diagnostics_);
  }
  /// That a study with these lines is refused, and why.
  void expect_refused(const std::string& draws, const std::string& why) {
    diagnostics_ = {};
    EXPECT_FALSE(load(draws)) << draws;
    EXPECT_NE(test::rendered(diagnostics_).find(why), std::string::npos)
        << draws << test::rendered(diagnostics_);
  }
  /// The middle of each draw.
  ScenarioRun middle(const Study& study, StudyCell& cell) {
    cell = draw_cell(study, std::vector<double>(study.draws.size() + 1, 0.5));
    Diagnostics of_study, of_task;
    auto run = load_run(study, cell, of_study, of_task);
    EXPECT_TRUE(run && run->program) << test::rendered(of_study) << test::rendered(of_task);
    return run ? std::move(*run) : ScenarioRun();
  }

  test::Folder folder_;
  Diagnostics diagnostics_;
};

TEST_F(Studies, PutEachDrawWhereItBelongs) {
  const auto study = load(R"(draw:
  params.push: {uniform: [10 N, 30 N]}
  start.x: {uniform: [-20 cm, 0 cm]}
  start.yaw: {uniform: [0 deg, 10 deg]}
  robot.mass: {uniform: [1, 1.2], times: true}
  robot.inertia: {uniform: [1, 1.4], times: true}
  robot.centre_of_mass: {uniform: [0 cm, 2 cm]}
  robot.friction: {uniform: [1, 2], times: true}
  robot.wheel_radius: {uniform: [1, 1.02], times: true}
  scene.floor.friction: {uniform: [0.4, 0.8]}
  scene.wall.stiffness: {log_uniform: [10 kN/m, 1 MN/m]}
  scene.wall.damping: {uniform: [1, 2], times: true}
  state.delay: {choice: [0 ms, 5 ms, 10 ms]}
)");
  ASSERT_TRUE(study) << test::rendered(diagnostics_);
  StudyCell cell;
  const ScenarioRun run = middle(*study, cell);
  ASSERT_TRUE(run.program);
  const Scene& scene = *run.program->scene;
  EXPECT_NEAR(run.program->parameters.front().value, 20.0, 1e-12);
  EXPECT_NEAR(scene.start_at[0], -0.1, 1e-12);
  EXPECT_EQ(scene.start_at[1], 0.0);
  EXPECT_NEAR(scene.start_yaw, 5.0 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_NEAR(scene.floor_friction, 0.6, 1e-12);
  EXPECT_NEAR(scene.objects[0].stiffness, 1e5, 1e-6);
  EXPECT_NEAR(scene.objects[0].damping, 0.3 * 1.5, 1e-12);
  EXPECT_EQ(scene.state.delay, 5e-3);
  EXPECT_NEAR(cell.cell().deviation.friction, 1.5, 1e-12);
  EXPECT_NEAR(cell.cell().deviation.wheel_radius, 1.01, 1e-12);
  std::map<FaultKind, double> faults;
  for (const Fault& fault : scene.faults) faults[fault.kind] = fault.value;
  EXPECT_NEAR(faults[FaultKind::payload], 0.1 * run.program->robot.model.bodies()[0].inertia.mass, 1e-9);
  EXPECT_NEAR(faults[FaultKind::inertia], 0.2, 1e-12);
  EXPECT_NEAR(faults[FaultKind::centre_of_mass], 0.01, 1e-12);
}

TEST_F(Studies, MoveTheOnsetOfASet) {
  const auto study = load(R"(draw:
  faults: {choice: [slips]}
  faults.slips.at: {uniform: [2 s, 4 s]}
faults: {slips: [{at: 1 s, for: 0.1 s, floor_friction: 0.1}, {at: 1.5 s, for: 0.1 s, samples: lost}]}
)");
  ASSERT_TRUE(study) << test::rendered(diagnostics_);
  StudyCell cell;
  middle(*study, cell);
  ASSERT_EQ(cell.cell().faults.size(), 2u);
  EXPECT_NEAR(cell.cell().faults[0].at, 3.0, 1e-12);
  EXPECT_NEAR(cell.cell().faults[1].at, 3.5, 1e-12);
}

/// The robot is drawn as a cell of the matrix, and the same cell is the same whoever asks.
TEST_F(Studies, DrawTheRobotAndEachCellAlone) {
  const auto study = load(R"(seed: 3
draw:
  robot: {choice: [robots/mecanum_base.yaml, robots/diff_base.yaml]}
  params.push: {uniform: [10 N, 30 N]}
)");
  ASSERT_TRUE(study) << test::rendered(diagnostics_);
  ASSERT_EQ(study->scenario.cells.size(), 2u);
  std::size_t differential = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const StudyCell cell = draw_cell(*study, i);
    differential += cell.matrix_cell;
    EXPECT_EQ(cell.drawn, draw_cell(*study, i).drawn);
    EXPECT_EQ(cell.scenario.seed, seed_of_cell(3, i));
    EXPECT_EQ(*cell.cell().robot, *study->scenario.cells[cell.matrix_cell].robot);
  }
  EXPECT_GT(differential, 70u);
  EXPECT_LT(differential, 130u);
}

TEST_F(Studies, TakeTheCellsOfAScenario) {
  folder_.write(
      "scenario.yaml",
      "zwang_scenario: 1\ntask: wall_align.yaml\nmatrix: {start_yaw: [5 deg, 10 deg], params.push: [20 N]}\n"
      "expect: [{outcome: done}, {always: elapsed < 60 s}]\n");
  const auto path = folder_.write(
      "of_scenario.yaml",
      "zwang_study: 1\nscenario: scenario.yaml\nruns: 5\nprobability: 90 %\nconfidence: 90 %\n");
  const auto study = load_study(path, diagnostics_);
  ASSERT_TRUE(study) << test::rendered(diagnostics_);
  EXPECT_EQ(study->scenario.cells.size(), 2u);
  ASSERT_EQ(study->claims.size(), 2u);
  EXPECT_EQ(study->claims[1].text, "always: elapsed < 60 s");
  EXPECT_EQ(study->claims[1].probability, 0.9);
  EXPECT_EQ(study->claims[1].confidence, 0.9);
  EXPECT_EQ(test::count(diagnostics_, "W934"), 1);  // 0.9^5 > 0.1
  const auto one = folder_.write(
      "one.yaml", "zwang_study: 1\nscenario: scenario.yaml\ncell: 'start_yaw 5 deg, push 20 N'\nruns: 5\n");
  const auto of_one = load_study(one, diagnostics_);
  ASSERT_TRUE(of_one) << test::rendered(diagnostics_);
  EXPECT_EQ(of_one->scenario.cells.size(), 1u);
}

/// A car cannot align itself to a wall (E601): it is the last of four robots, and 900 N are the second of
/// four.
TEST_F(Studies, LookAtEachChoice) {
  expect_refused(
      "draw: {robot: {choice: [robots/mecanum_base.yaml, robots/diff_base.yaml, "
      "robots/mecanum_base.yaml, robots/car_base.yaml]}}\n",
      "error E912: ");
  expect_refused("draw: {params.push: {choice: [5 N, 900 N, 6 N, 7 N]}}\n", "error E912: ");
}

TEST_F(Studies, AreReadWhereTheFirstCellIsRefusedAsExpected) {
  const std::string begin = "zwang_study: 1\ntask: wall_align.yaml\nscene: scenes/wall.yaml\nruns: 10\n";
  const std::string end = "expect: [{diagnostic: E601, probability: 20 %}]\n";
  const auto some = folder_.write(
      "some.yaml",
      begin + "draw: {robot: {choice: [robots/car_base.yaml, robots/mecanum_base.yaml]}}\n" + end);
  EXPECT_TRUE(load_study(some, diagnostics_)) << test::rendered(diagnostics_);
  const auto all =
      folder_.write("all.yaml", begin + "draw: {robot: {choice: [robots/car_base.yaml]}}\n" + end);
  EXPECT_FALSE(load_study(all, diagnostics_));
  EXPECT_EQ(test::count(diagnostics_, "E931"), 1) << test::rendered(diagnostics_);
}

/// A normal distribution has no ends: what its cells draw has.
TEST_F(Studies, AreRefusedWhereACellDrawsWhatCannotBe) {
  constexpr std::size_t runs = 10;
  bool some_good = false, some_bad = false;
  for (const int deviation : {20, 40, 60, 80, 100, 120}) {
    double least = 1e5;
    const Distribution stiffness{Spread::normal, 1e5, 1e3 * deviation, {}};
    for (std::size_t cell = 0; cell < runs; ++cell)
      least = std::min(least, stiffness.quantile(drawn_share(Sequence::random, 0, cell, 0)));
    diagnostics_ = {};
    const bool is_good =
        load("draw: {scene.wall.stiffness: {normal: [100 kN/m, " + std::to_string(deviation) + " kN/m]}}\n")
            .has_value();
    EXPECT_EQ(is_good, least > 0.0) << deviation << " kN/m, least " << least << " N/m";
    (is_good ? some_good : some_bad) = true;
  }
  EXPECT_TRUE(some_good && some_bad);
}

TEST_F(Studies, DrawNothingThatHasNoEffect) {
  const std::string faults = "faults: {load: [{at: 1 s, payload: 3 kg}]}\n";
  expect_refused(faults + "draw: {faults.load.at: {uniform: [0 s, 2 s]}}\n", "no cell has the faults `load`");
  expect_refused(faults + "draw: {faults: {choice: [load]}, faults.load.at: {uniform: [-1 s, 2 s]}}\n",
                 "`faults.load.at` cannot be -1 s");
  expect_refused(faults + "draw: {faults: {choice: [load]}, robot.mass: {uniform: [1, 1.1], times: true}}\n",
                 "`robot.mass`: the run has another `payload`");
  expect_refused(
      "draw: {robot.payload: {uniform: [0 kg, 2 kg]}, robot.mass: {uniform: [1, 2], times: true}}\n",
      "`robot.mass`: the run has another `payload`");
}

TEST_F(Studies, SayAndDrawAValueOnce) {
  expect_refused("robot: robots/diff_base.yaml\ndraw: {robot: {choice: [robots/mecanum_base.yaml]}}\n",
                 "error E102: ");
  expect_refused("params: {push: 12 N}\ndraw: {params.push: {uniform: [10 N, 30 N]}}\n", "error E102: ");
  expect_refused("matrix: {params.push: [12 N, 13 N]}\ndraw: {params.push: {uniform: [10 N, 30 N]}}\n",
                 "error E102: ");
}

/// They are columns of one table, and SQL does not tell `push` from `Push`.
TEST_F(Studies, TellDrawsApartByMoreThanTheirCase) {
  folder_.write("scenes/wall.yaml", test::slurp(test::source_dir / "specs/scenes/wall.yaml") +
                                        "  Wall: {wall: {length: 1 m, thickness: 0.1 m, height: 1 m}, "
                                        "at: [-5 m, 0 m], fixed: true, stiffness: 1 kN/m}\n");
  expect_refused(
      "draw: {scene.wall.stiffness: {uniform: [1 kN/m, 2 kN/m]}, "
      "scene.Wall.stiffness: {uniform: [1 kN/m, 2 kN/m]}}\n",
      "differ in their case alone");
}

TEST_F(Studies, SayHowManyRunsTheMostDemandingExpectationTakes) {
  const auto path = folder_.write(
      "two.yaml",
      "zwang_study: 1\ntask: wall_align.yaml\nscene: scenes/wall.yaml\nruns: 10\nexpect:\n"
      "  - {outcome: done, probability: 99 %}\n  - {always: elapsed < 60 s, probability: 99.9 %}\n");
  ASSERT_TRUE(load_study(path, diagnostics_));
  EXPECT_EQ(test::count(diagnostics_, "W934"), 1);
  EXPECT_NE(test::rendered(diagnostics_).find("that takes 2995 without"),
            std::string::npos);  // 0.999^2995 < 5 %
}

}  // namespace
}  // namespace zwang::lang
