// What an editor is offered at a place in a text.
#include "features.hpp"

namespace zwang::lsp {
namespace {

namespace fs = std::filesystem;
using test::Editor;
using test::Features;
using test::json;
using test::labels;
using test::replaced;
using test::slurp;

class Completion : public Features {};

TEST_F(Completion, KnowsKeysNamesAndUnits) {
  const fs::path task = open("hospital.yaml");
  EXPECT_TRUE(proposed(task, "margin: 10 cm", "ma").contains("margin"));
  EXPECT_FALSE(proposed(task, "margin: 10 cm", "ma").contains("goto"));
  const auto frames = proposed(task, "in: $target", "in: ");
  for (const char* frame : {"pharmacy", "ward", "base_link", "world"})
    EXPECT_TRUE(frames.contains(frame)) << frame;
  EXPECT_TRUE(proposed(task, "inside: corridor", "inside: ").contains("corridor"));
  EXPECT_TRUE(proposed(task, "{use: drive_to", "{use: ").contains("drive_to"));
  const auto ends = proposed(task, "goto: pause}", "goto: p");
  for (const char* end : {"pause", "load", "done", "failed", "back"}) EXPECT_TRUE(ends.contains(end)) << end;
  const auto given = proposed(task, "velocity: [0 m/s, $speed]", "velocity: [0 m/s, $s");
  for (const char* name : {"speed", "soft", "patience"}) EXPECT_TRUE(given.contains(name)) << name;
  const auto condition = proposed(task, "when: loaded", "when: l");
  for (const char* name : {"loaded", "stand", "elapsed", "moved"})
    EXPECT_TRUE(condition.contains(name)) << name;
  EXPECT_TRUE(proposed(task, "when: stop_key", "when: estimated.").contains("force"));
  EXPECT_EQ(proposed(task, "when: stop_key", "when: estimated.force."),
            (std::set<std::string>{"x", "y", "z", "rx", "ry", "rz"}));
  EXPECT_EQ(proposed(task, "x:  {velocity: 0 m/s, force: +-$soft}", "x:  {velocity: 0 "),
            (std::set<std::string>{"m/s", "cm/s", "mm/s"}));
  EXPECT_TRUE(proposed(task, "rz: {velocity: 0 rad/s", "rz: {velocity: 0 r").contains("deg/s"));
}

TEST_F(Completion, InAConditionKnowsWhatIsCompared) {
  const fs::path task = open("wall_align.yaml");
  const std::set<std::string> speeds{"m/s", "cm/s", "mm/s"}, lengths{"m", "cm", "mm", "um", "km"};
  EXPECT_EQ(proposed(task, "when: elapsed > 2 s", "when: elapsed > 2 "),
            (std::set<std::string>{"s", "ms", "us", "min", "h"}));
  EXPECT_EQ(proposed(task, "when: elapsed > 2 s", "when: elapsed > 2 s and moved(base) > 2 "), lengths);
  EXPECT_EQ(proposed(task, "when: elapsed > 2 s", "when: contact.x.velocity >= -2 "), speeds);
  EXPECT_EQ(proposed(task, "when: elapsed > 2 s", "when: abs(contact.x.velocity) < 2 "), speeds);
  EXPECT_EQ(proposed(task, "when: elapsed > 2 s", "when: abs(estimated.force.rz) < 2 "),
            (std::set<std::string>{"N m"}));
}

TEST_F(Completion, KnowsTheUnitsOfSignals) {
  const fs::path task = open("hospital.yaml");
  const std::set<std::string> lengths{"m", "cm", "mm", "um", "km"};
  EXPECT_EQ(proposed(task, "when: stop_key", "when: nearest > 3 "), lengths);
  EXPECT_EQ(proposed(task, "when: stop_key", "when: not stop_key and abs(nearest) < 3 "), lengths);
  // A part of a wrench.
  EXPECT_EQ(proposed(task, "when: stop_key", "when: felt.rz > 3 "), (std::set<std::string>{"N m"}));
}

TEST_F(Completion, KnowsTheUnitsOfParameters) {
  const fs::path task = open("wall_align.yaml");
  const std::set<std::string> forces{"N", "kN", "MN", "mN"}, turns{"rad/s", "deg/s"};
  EXPECT_EQ(proposed(task, "{value: 20 N, range", "{value: 20 "), forces);
  EXPECT_EQ(proposed(task, "[5 N, 40 N]", "[5 N, 40 "), forces);
  EXPECT_EQ(
      proposed(task, "{value: 20 N, range: [5 N, 40 N], help: how hard to press against the wall}", "20 "),
      forces);
  EXPECT_TRUE(proposed(task, "{value: 40 s, range", "{value: 40 ").contains("min"));
  EXPECT_EQ(proposed(task, "{value: 0.5 deg/s, range", "{value: 0.5 "), turns);
  EXPECT_EQ(proposed(task, "set: {frames.wall: base}", "set: {params.push: 3 "), forces);
  const auto unused = proposed(task, "  push:    {value: 20 N", "  idle: 3 ");
  for (const char* unit : {"N", "deg/s", "kg"}) EXPECT_TRUE(unused.contains(unit)) << unit;
  // The statement stands in a template.
  const fs::path hospital = open("hospital.yaml");
  const std::set<std::string> speeds{"m/s", "cm/s", "mm/s"};
  EXPECT_EQ(proposed(hospital, "pace: $speed", "pace: 3 "), speeds);
  EXPECT_EQ(proposed(hospital, "speed:    {value: 0.60 m/s", "speed:    {value: 0.60 "), speeds);
}

TEST_F(Completion, InAScenarioKnowsTheUnitsOfTheTasksParameters) {
  EXPECT_EQ(proposed(open("scenarios/wall_align.yaml"), "20 N", "20 "),
            (std::set<std::string>{"N", "kN", "MN", "mN"}));
}

TEST_F(Completion, BeginsAFile) {
  const auto at_end_of = [&](const std::string& name, const std::string& text) -> std::set<std::string> {
    const fs::path path = fs::canonical(folder_.path() / "specs") / name;
    editor_.open(path, text);
    const json answer = editor_.ask(
        "textDocument/completion",
        {{"textDocument", {{"uri", uri_of(path)}}}, {"position", Editor::position(text, text.size())}});
    return answer.is_null() ? std::set<std::string>{} : labels(answer);
  };
  const std::set<std::string> empty = at_end_of("empty.yaml", "");
  for (const char* key : {"zwang", "zwang_scene", "robot", "tasks", "signals", "start"})
    EXPECT_TRUE(empty.contains(key)) << key;
  EXPECT_EQ(at_end_of("word.yaml", "# mine\n---\nzw"), empty);
  const std::set<std::string> begun = at_end_of("begun.yaml", "zwang: 1\n");
  for (const char* key : {"robot", "scene", "params", "frames", "signals", "tasks", "always", "start"})
    EXPECT_TRUE(begun.contains(key)) << key;
  EXPECT_FALSE(begun.contains("zwang_scene"));
  // Other programs' files.
  EXPECT_EQ(at_end_of("other.yaml", "services:\n"), std::set<std::string>{});
  EXPECT_EQ(at_end_of("empty.urdf", ""), std::set<std::string>{});
}

TEST_F(Completion, KnowsTheRobotOfATaskThatWasNeverWhole) {
  const fs::path path = fs::canonical(folder_.path() / "specs") / "new.yaml";
  const std::string text =
      "zwang: 2\nrobot: robots/mecanum_base.yaml  # mine\ntasks:\n  go:\n    constraints:\n"
      "      a: {move: ";
  editor_.open(path, text);
  const auto frames =
      labels(editor_.ask("textDocument/completion", {{"textDocument", {{"uri", uri_of(path)}}},
                                                     {"position", Editor::position(text, text.size())}}));
  for (const char* frame : {"base_link", "world", "footprint"}) EXPECT_TRUE(frames.contains(frame)) << frame;
}

TEST_F(Completion, KnowsFilesTypesAndWhatIsSet) {
  const fs::path task = open("wall_align.yaml");
  const auto robots = proposed(task, "robot: robots/mecanum_base.yaml", "robot: robots/mec");
  EXPECT_TRUE(robots.contains("robots/mecanum_base.yaml"));
  EXPECT_TRUE(robots.contains("robots/feels/mecanum_effort_50_hz.yaml"));
  EXPECT_FALSE(robots.contains("scenes/wall.yaml"));
  EXPECT_TRUE(proposed(task, "scene: scenes/wall.yaml", "scene: ").contains("scenes/wall.yaml"));
  const auto keys = proposed(task, "set: {frames.wall: base}", "set: {fra");
  EXPECT_EQ(keys, (std::set<std::string>{"frames.wall", "params.push", "params.timeout", "params.still"}));
  EXPECT_TRUE(proposed(task, "set: {frames.wall: base}", "set: {frames.wall: ").contains("base_link"));
  const fs::path scenario = open("scenarios/wall_align.yaml");
  EXPECT_TRUE(proposed(scenario, "task: ../wall_align.yaml", "task: ").contains("../hospital.yaml"));
  const std::string connection = "zwang_connection: 1\nsignals:\n  bump: {topic: /bump, type: std_msgs/Bo";
  const fs::path path = scenario.parent_path().parent_path() / "connection.yaml";
  editor_.open(path, connection);
  const json answer =
      editor_.ask("textDocument/completion", {{"textDocument", {{"uri", uri_of(path)}}},
                                              {"position", Editor::position(connection, connection.size())}});
  EXPECT_TRUE(labels(answer).contains("std_msgs/Bool"));
  // The whole type stands in the place of what is written of it.
  for (const json& item : answer["items"]) {
    if (item["label"] != "std_msgs/Bool") continue;
    EXPECT_EQ(Editor::edited(connection, json::array({item["textEdit"]})),
              "zwang_connection: 1\nsignals:\n  bump: {topic: /bump, type: std_msgs/Bool");
  }
}

TEST_F(Completion, OfFilesFollowsTheFolder) {
  const fs::path task = open("wall_align.yaml");
  const auto scenes = [&] { return proposed(task, "scene: scenes/wall.yaml", "scene: "); };
  EXPECT_FALSE(scenes().contains("scenes/new.yaml"));
  const fs::path added = task.parent_path() / "scenes/new.yaml";
  std::ofstream(added) << "zwang_scene: 1\n";
  EXPECT_TRUE(scenes().contains("scenes/new.yaml"));
  std::ofstream(added) << "zwang_robot: 1\nurdf: a.urdf\n";
  EXPECT_FALSE(scenes().contains("scenes/new.yaml"));
  editor_.open(added, "zwang_scene: 1\n");
  EXPECT_TRUE(scenes().contains("scenes/new.yaml"));
  editor_.close(added);
  fs::remove(added);
  EXPECT_FALSE(scenes().contains("scenes/new.yaml"));
}

}  // namespace
}  // namespace zwang::lsp
