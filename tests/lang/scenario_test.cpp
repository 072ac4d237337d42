// Scenario files: the matrix multiplied out, and mistakes found where they are written.
#include "zwang/lang/scenario.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support.hpp"

namespace zwang::lang {
namespace {

using test::rendered;

const char* const good = R"(zwang_scenario: 1
task: wall_align.yaml
scene: scenes/wall.yaml
time_limit: 60 s
matrix:
  start_yaw: [-5 deg, 5 deg]
  params.push: [10 N, 20 N, 30 N]
  faults: [none, slip]
faults:
  slip: [{at: 1 s, for: 0.5 s, floor_friction: 0.05}]
expect:
  - outcome: done
  - {at: end, that: abs(truth.wall.force - $push) < 0.2 N}
  - {within: 3 s, of: truth.wall.touched, that: abs(truth.base.yaw) < 0.1 deg}
  - {always: speed(bumper) < 1 m/s and truth.base.torque <= 1}
)";

/// The shipped task, robot and scene, with a scenario of the test's own beside them.
class Shelf {
 public:
  explicit Shelf(const std::string& scenario) {
    for (const char* name : {"wall_align.yaml", "robots/mecanum_base.yaml", "robots/mecanum_base.urdf",
                             "robots/diff_base.yaml", "robots/diff_base.urdf", "scenes/wall.yaml"})
      folder_.write(name, test::slurp(test::source_dir / "specs" / name));
    std::string many = "zwang: 1\nrobot: robots/mecanum_base.yaml\nstart: go\nparams:\n";
    for (int i = 0; i < 64; ++i) many += "  p" + std::to_string(i) + ": 1 m\n";
    folder_.write("many.yaml",
                  many +
                      "tasks:\n  go:\n    constraints:\n      go: {move: base_link, in: base_link, "
                      "x: {velocity: 0.1 m/s}}\n    timeout: {after: 1 s, goto: done}\n");
    path = folder_.write("scenario.yaml", scenario);
  }
  std::filesystem::path path;

 private:
  test::Folder folder_;
};

TEST(Scenario, multiplies_its_matrix_out_with_the_last_key_fastest) {
  const Shelf shelf(good);
  Diagnostics diagnostics;
  const auto scenario = load_scenario(shelf.path, diagnostics);
  ASSERT_TRUE(scenario) << rendered(diagnostics);
  ASSERT_EQ(scenario->cells.size(), 12u);
  EXPECT_EQ(scenario->cells[0].name, "start_yaw -5 deg, push 10 N, faults none");
  EXPECT_EQ(scenario->cells[1].name, "start_yaw -5 deg, push 10 N, faults slip");
  EXPECT_EQ(scenario->cells[11].name, "start_yaw 5 deg, push 30 N, faults slip");
  EXPECT_NEAR(*scenario->cells[0].start_yaw, -5.0 * 3.14159265358979 / 180.0, 1e-12);
  EXPECT_EQ(scenario->cells[11].parameters.at("push"), "30 N");
  EXPECT_TRUE(scenario->cells[0].faults.empty());
  ASSERT_EQ(scenario->cells[1].faults.size(), 1u);
  EXPECT_EQ(scenario->cells[1].faults[0].kind, FaultKind::floor_friction);
  EXPECT_EQ(scenario->cells[1].faults[0].duration, 0.5);
}

TEST(Scenario, a_cell_has_the_robot_the_scene_and_the_start_of_the_matrix) {
  const Shelf shelf(R"(zwang_scenario: 1
task: wall_align.yaml
matrix:
  robot: [robots/mecanum_base.yaml, robots/diff_base.yaml]
  scene: [scenes/wall.yaml, scenes/far.yaml]
  start_at: [[0 m, 0 m], [-30 cm, 0.1 m]]
expect: [{outcome: done}]
)");
  const std::string wall = test::slurp(test::source_dir / "specs/scenes/wall.yaml");
  std::ofstream(shelf.path.parent_path() / "scenes/far.yaml")
      << test::replaced(wall, "at: [0.972 m", "at: [2 m");
  for (std::size_t cell = 0; cell < 8; ++cell) {
    Diagnostics of_scenario, of_task;
    const auto run = load_run(shelf.path, cell, of_scenario, of_task);
    ASSERT_TRUE(run && run->program) << rendered(of_scenario) << rendered(of_task);
    EXPECT_EQ(run->program->robot.name, cell < 4 ? "mecanum_base" : "diff_base") << cell;
    EXPECT_EQ(run->program->scene->objects.at(0).at[0], cell % 4 < 2 ? 0.972 : 2.0) << cell;
    EXPECT_NEAR(run->program->scene->start_at[0], cell % 2 == 0 ? 0.0 : -0.3, 1e-12) << cell;
    EXPECT_NEAR(run->program->scene->start_at[1], cell % 2 == 0 ? 0.0 : 0.1, 1e-12) << cell;
  }
}

TEST(Scenario, resolves_names_of_the_truth_in_the_cells_own_world) {
  const Shelf shelf(good);
  Diagnostics of_scenario, of_task;
  const auto run = load_run(shelf.path, 4, of_scenario, of_task);
  ASSERT_TRUE(run) << rendered(of_scenario) << rendered(of_task);
  ASSERT_TRUE(run->program);
  EXPECT_EQ(run->program->parameters[0].value, 30.0);
  ASSERT_EQ(run->expectations.size(), 4u);
  const std::vector<std::string> names = truth_names(*run->program);
  EXPECT_EQ(names[truth_yaw], "truth.base.yaw");
  const int touched = int{truth_base_count} + int{truth_touched};
  EXPECT_EQ(names[static_cast<std::size_t>(touched)], "truth.wall.touched");
  EXPECT_EQ(run->expectations[2].of, touched);
  EXPECT_EQ(run->expectations[2].text, "within 3 s of truth.wall.touched: abs(truth.base.yaw) < 0.1 deg");
}

TEST(Scenario, a_task_that_is_refused_is_no_mistake_of_the_scenario) {
  const Shelf shelf(R"(zwang_scenario: 1
task: wall_align.yaml
params: {push: 20 m}
expect: [{diagnostic: E202}]
)");
  Diagnostics of_scenario, of_task;
  const auto run = load_run(shelf.path, 0, of_scenario, of_task);
  ASSERT_TRUE(run);
  EXPECT_FALSE(run->program);
  EXPECT_FALSE(of_scenario.has_errors());
  EXPECT_EQ(test::count(of_task, "E202"), 1);
}

struct Mistake {
  const char* from;
  const char* to;
  const char* code;
  int line;
};

TEST(Scenario, mistakes_are_found_where_they_are_written) {
  const Mistake mistakes[] = {
      {"outcome: done", "outcome: don", "E903", 12},
      {"at: end", "at: start", "E904", 13},
      {"outcome: done", "always: true < 1", "E301", 12},
      {"within: 3 s", "wtihin: 3 s", "E101", 14},
      {"{at: end, that", "{at: end, always: truth.base.x < 3 m, that", "E904", 13},
      {"outcome: done", "{outcome: done, diagnostic: E404}", "E904", 12},
      {"outcome: done", "diagnostic: E999", "E301", 12},
      {"start_yaw: [-5 deg, 5 deg]", "start_yaw: []", "E905", 6},
      {"of: truth.wall.touched", "of: truth.wall.force", "E906", 14},
      {"of: truth.wall.touched", "of: truth.wal.touched", "E301", 14},
      {"floor_friction: 0.05", "samples: gone", "E907", 10},
      {"floor_friction: 0.05", "floor_friction: 0.05, payload: 3 kg", "E907", 10},
      {"floor_friction: 0.05", "torque: lost", "E103", 10},
      {"faults: [none, slip]", "faults: [none, slipp]", "E301", 8},
      {"start_yaw: [-5 deg, 5 deg]", "start_yaw: [-5 m, 5 deg]", "E202", 6},
      {"truth.wall.force - $push", "truth.wall.forc - $push", "E301", 13},
      {"abs(truth.base.yaw) < 0.1 deg", "abs(truth.base.yaw) < 0.1 m", "E202", 14},
      {"scene: scenes/wall.yaml", "scen: scenes/wall.yaml", "E101", 3},
      {"task: wall_align.yaml", "task: wall_alin.yaml", "E109", 2},
      {"zwang_scenario: 1", "zwang_scenario: 2", "E108", 1},
  };
  for (const Mistake& mistake : mistakes) {
    const Shelf shelf(test::replaced(good, mistake.from, mistake.to));
    Diagnostics of_scenario, of_task;
    EXPECT_FALSE(load_run(shelf.path, 0, of_scenario, of_task)) << mistake.to;
    ASSERT_GE(test::count(of_scenario, mistake.code), 1) << mistake.to << "\n" << rendered(of_scenario);
    EXPECT_EQ(of_scenario.error_count(), 1) << rendered(of_scenario);
    EXPECT_EQ(of_scenario.sorted()[0].span.begin.line, mistake.line) << rendered(of_scenario);
  }
}

TEST(Scenario, parameters_are_those_of_the_task_file) {
  const std::string alone = test::replaced(good, "  params.push: [10 N, 20 N, 30 N]\n", "");
  const std::pair<std::string, Mistake> mistakes[] = {
      {good, {"params.push: [10 N", "params.pusch: [10 N", "E301", 7}},
      {good, {"params.push: [10 N, 20 N", "params.push: [10 N, 20 m", "E202", 7}},
      {good, {"params.push: [10 N, 20 N", "params.push: [10 N, 20", "E201", 7}},
      {good, {"params.push: [10 N, 20 N", "params.push: [10 N, 200 N", "E204", 7}},
      {good, {"time_limit: 60 s", "params: {push: 20 N}", "E102", 7}},
      {alone, {"time_limit: 60 s", "params: {push: 20 N, pussh: 3 N}", "E301", 4}},
      {alone, {"time_limit: 60 s", "params: {push: 1 N}", "E204", 4}},
      {alone, {"time_limit: 60 s", "params: {push: 20 Nn}", "E203", 4}},
      {alone, {"time_limit: 60 s", "params: {push: $push}", "E105", 4}},
  };
  for (const auto& [text, mistake] : mistakes) {
    const Shelf shelf(test::replaced(text, mistake.from, mistake.to));
    Diagnostics diagnostics;
    EXPECT_FALSE(load_scenario(shelf.path, diagnostics)) << mistake.to;
    EXPECT_EQ(diagnostics.error_count(), 1) << rendered(diagnostics);
    EXPECT_EQ(test::count(diagnostics, mistake.code), 1) << mistake.to << "\n" << rendered(diagnostics);
    const Diagnostic said = diagnostics.sorted()[0];
    EXPECT_EQ(said.span.begin.line, mistake.line) << rendered(diagnostics);
    EXPECT_EQ(diagnostics.source(said.span.source).path, shelf.path.string());
    for (const RelatedSpan& related : said.related)
      EXPECT_TRUE(diagnostics.source(related.span.source).path.ends_with("wall_align.yaml"));
  }
}

TEST(Scenario, a_cell_that_is_refused_is_told_with_what_makes_it_so) {
  // The moving mass is about 60 kg at most: with 0.3 m/s^2 it presses with 18 N at most.
  const std::string task = test::replaced(test::slurp(test::source_dir / "specs/wall_align.yaml"),
                                          "{force: $push,", "{acceleration: +-0.3 m/s^2, force: $push,");
  const test::Folder folder;
  for (const char* name : {"robots/mecanum_base.yaml", "robots/mecanum_base.urdf", "scenes/wall.yaml"})
    folder.write(name, test::slurp(test::source_dir / "specs" / name));
  folder.write("task.yaml", test::replaced(task, "value: 20 N", "value: 10 N"));
  const auto path = folder.write("scenario.yaml", R"(zwang_scenario: 1
task: task.yaml
matrix:
  start_yaw: [0 deg, 5 deg]
  params.push: [12 N, 30 N]
expect: [{outcome: done}]
)");
  Diagnostics diagnostics;
  EXPECT_FALSE(check_scenario(path, diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1u) << rendered(diagnostics);
  EXPECT_EQ(diagnostics.all()[0].code, "E912");
  EXPECT_NE(diagnostics.all()[0].message.find("E601"), std::string::npos) << rendered(diagnostics);
  EXPECT_EQ(diagnostics.all()[0].span.begin.line, 5);
  EXPECT_EQ(diagnostics.all()[0].span.begin.column, 23) << "the value that is too much";
}

TEST(Scenario, a_task_that_is_refused_anyway_is_judged_on_its_own) {
  const Shelf shelf(test::replaced(good, "task: wall_align.yaml", "task: broken.yaml"));
  std::ofstream(shelf.path.parent_path() / "broken.yaml")
      << test::replaced(test::slurp(test::source_dir / "specs/wall_align.yaml"), "move: base", "move: bsae");
  Diagnostics diagnostics;
  EXPECT_TRUE(check_scenario(shelf.path, diagnostics)) << rendered(diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << rendered(diagnostics);
}

TEST(Scenario, checking_ends_however_many_cells_there_are) {
  std::string scenario = "zwang_scenario: 1\ntask: many.yaml\nexpect: [{outcome: done}]\nmatrix:\n";
  for (int i = 0; i < 9; ++i) scenario += "  params.p" + std::to_string(i) + ": [1 m, 2 m]\n";
  const Shelf shelf(scenario);
  Diagnostics diagnostics;
  EXPECT_TRUE(check_scenario(shelf.path, diagnostics)) << rendered(diagnostics);
  EXPECT_EQ(test::count(diagnostics, "N608"), 1);
}

/// Of so many keys with two values, and one with the given number.
std::string with_matrix(int keys, int last) {
  std::string text = "zwang_scenario: 1\ntask: many.yaml\nexpect: [{outcome: done}]\nmatrix:\n";
  for (int i = 0; i < keys; ++i) text += "  params.p" + std::to_string(i) + ": [1 m, 2 m]\n";
  text += "  start_yaw: [";
  for (int i = 0; i < last; ++i) text += (i > 0 ? ", " : "") + std::to_string(i) + " deg";
  return text + "]\n";
}

TEST(Scenario, a_matrix_has_a_thousand_cells_and_no_more) {
  Diagnostics good_ones, one_more, beyond_any_number;
  const auto scenario = load_scenario(Shelf(with_matrix(3, 125)).path, good_ones);
  ASSERT_TRUE(scenario) << rendered(good_ones);
  EXPECT_EQ(scenario->cells.size(), 1000u);
  EXPECT_FALSE(load_scenario(Shelf(with_matrix(3, 126)).path, one_more));
  EXPECT_EQ(test::count(one_more, "E905"), 1) << rendered(one_more);
  EXPECT_EQ(one_more.all()[0].span.begin.line, 8) << "the key that made them too many";
  // 2^64 is 0 to a number of 64 bits.
  EXPECT_FALSE(load_scenario(Shelf(with_matrix(64, 1)).path, beyond_any_number));
  EXPECT_EQ(test::count(beyond_any_number, "E905"), 1) << rendered(beyond_any_number);
  EXPECT_EQ(beyond_any_number.all()[0].span.begin.line, 14);
}

TEST(Scenario, few_cells_show_each_value_of_the_matrix) {
  Diagnostics diagnostics;
  const auto scenario = load_scenario(Shelf(with_matrix(3, 5)).path, diagnostics);
  ASSERT_TRUE(scenario) << rendered(diagnostics);
  std::set<std::string> values;
  std::size_t shown = 0;
  for (const ScenarioCell& cell : scenario->cells) {
    if (!cell.shows_each_value) continue;
    ++shown;
    std::istringstream labels(cell.name);
    for (std::string label; std::getline(labels, label, ',');)
      values.insert(label.substr(label.find_first_not_of(' ')));
  }
  EXPECT_EQ(shown, 5u) << "as many as the longest key has values";
  EXPECT_EQ(values.size(), 3u * 2u + 5u);
}

}  // namespace
}  // namespace zwang::lang
