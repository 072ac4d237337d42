// The answers to an editor about a place in a text.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "../temporary_folder.hpp"
#include "editor.hpp"

namespace zwang::lsp {
namespace {

namespace fs = std::filesystem;
using test::Editor;
using test::json;
using test::replaced;
using test::slurp;

const fs::path specs = fs::path(ZWANG_SOURCE_DIR) / "specs";

bool contains(const json& answer, const std::string& words) {
  return answer.dump().find(words) != std::string::npos;
}

std::set<std::string> labels(const json& completion) {
  std::set<std::string> labels;
  for (const json& item : completion["items"]) labels.insert(item["label"]);
  return labels;
}

/// A copy of the shipped files, which a rename may change.
class Features : public ::testing::Test {
 protected:
  Features() {
    const fs::path copy = folder_.path() / "specs";
    fs::create_directories(copy / "scenarios");
    fs::create_directories(copy / "studies");
    for (const char* part :
         {"robots", "scenes", "docking.yaml", "hospital.yaml", "wall_align.yaml", "scenarios/hospital.yaml",
          "scenarios/wall_align.yaml", "studies/wall_align.yaml"})
      fs::copy(specs / part, copy / part, fs::copy_options::recursive);
    std::ofstream(copy / ".zwang-root");
  }

  fs::path open(const std::string& name) {
    const fs::path path = fs::canonical(folder_.path() / "specs" / name);
    editor_.open(path, slurp(path));
    return path;
  }
  /// The proposals where `written` stands in the place of `from`, with the cursor behind it.
  std::set<std::string> proposed(const fs::path& path, const std::string& from, const std::string& written) {
    const std::string text = replaced(slurp(path), from, written);
    editor_.change(path, text);
    const std::size_t at = slurp(path).find(from) + written.size();
    return labels(editor_.ask("textDocument/completion", {{"textDocument", {{"uri", uri_of(path)}}},
                                                          {"position", Editor::position(text, at)}}));
  }
  json rename(const fs::path& path, const std::string& words, std::size_t into, const std::string& name) {
    return editor_.at("textDocument/rename", path, words, into, {{"newName", name}});
  }
  /// Does the edits of a rename on the disk.
  void apply(const json& edit) {
    for (const auto& [uri, edits] : edit["changes"].items()) {
      const fs::path path = path_of(uri).value();
      const std::string text = Editor::edited(slurp(path), edits);
      std::ofstream(path, std::ios::binary) << text;
    }
  }

  const zwang::test::TemporaryFolder folder_;
  Editor editor_;
};

TEST_F(Features, HoverTellsWhatARowDoesOnThisRobot) {
  const fs::path task = open("wall_align.yaml");
  const json answer = editor_.at("textDocument/hover", task, "x:  {force: $push", 1);
  // The mass of the mecanum base with its wheels' inertia, and what its acceleration limit of 1 m/s^2 makes
  // of it.
  EXPECT_TRUE(contains(answer, "effective mass: 56.9 kg")) << answer.dump(1);
  EXPECT_TRUE(contains(answer, "56.9 N")) << answer.dump(1);
  EXPECT_TRUE(contains(answer, "mecanum_base.yaml:")) << answer.dump(1);
  EXPECT_TRUE(contains(answer, "parameter `push` = 20 N") ||
              contains(editor_.at("textDocument/hover", task, "$push", 2),
                       "parameter `push` = 20 N, from 5 N to 40 N"));
}

TEST_F(Features, HoverTellsSiUnitsAndKeys) {
  const fs::path task = open("hospital.yaml");
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "margin: 10 cm", 9), "`10 cm` = 0.1 m"));
  EXPECT_TRUE(
      contains(editor_.at("textDocument/hover", task, "margin", 2), "the distance kept from the border"));
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "$target", 3), "argument `target`"));
}

TEST_F(Features, CompletionKnowsKeysNamesAndUnits) {
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

TEST_F(Features, CompletionInAConditionKnowsWhatIsCompared) {
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

TEST_F(Features, CompletionKnowsTheRobotOfATaskThatWasNeverWhole) {
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

TEST_F(Features, CompletionKnowsFilesTypesAndWhatIsSet) {
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

TEST_F(Features, HoverTellsWhatAQuantityIs) {
  const fs::path task = open("wall_align.yaml");
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "0.08 m/s", 6), "`0.08 m/s`: a velocity"));
  EXPECT_TRUE(
      contains(editor_.at("textDocument/hover", task, "5 mm/s", 3), "`5 mm/s` = 0.005 m/s: a velocity"));
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "rz: free", 1), "`free`: no statement"));
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "push:", 1), "how hard to press"));
}

TEST_F(Features, HoverTellsWhatAFunctionMeasures) {
  const fs::path task = open("wall_align.yaml");
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "moved(base)", 2),
                       "`moved(..)`: of the origin's path since the task was entered"));
}

TEST_F(Features, HoverCallsNoWordOfAConditionAName) {
  const fs::path task = open("wall_align.yaml");
  EXPECT_FALSE(contains(editor_.at("textDocument/hover", task, "and moved", 1), "group"));
  const json elapsed = editor_.at("textDocument/hover", task, "elapsed", 2);
  EXPECT_TRUE(contains(elapsed, "time since the task was entered")) << elapsed;
  EXPECT_FALSE(contains(elapsed, "group")) << elapsed;
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "contact.x.position", 2), "group `contact`"));
  const fs::path scenario = open("scenarios/wall_align.yaml");
  EXPECT_FALSE(contains(editor_.at("textDocument/hover", scenario, "truth.", 2), "group `truth`"));
}

TEST_F(Features, HoverRoundsAsAPersonReads) {
  const fs::path task = open("wall_align.yaml");
  // pi / 360
  EXPECT_TRUE(
      contains(editor_.at("textDocument/hover", task, "0.5 deg/s", 2), "`0.5 deg/s` = 0.00872665 rad/s:"));
}

TEST_F(Features, HoverTellsARowOfANormOnceAndWhatIsUnknown) {
  const fs::path task = open("docking.yaml");
  const json norm = editor_.at("textDocument/hover", task, "plane: {acceleration", 2);
  const std::string words = "bounds the acceleration from above";
  const std::string told = norm["contents"]["value"];
  EXPECT_EQ(told.find(words), told.rfind(words)) << told;
  // The partner, whose pose is a signal: the scene has measured none yet.
  EXPECT_TRUE(contains(editor_.at("textDocument/hover", task, "x:  {position: 0 m", 1),
                       "not known at the start: `partner`"));
}

TEST_F(Features, AnUnknownNameInACallHasAnEdit) {
  const fs::path task = open("wall_align.yaml");
  const std::string text = replaced(slurp(task), "moved(base)", "moved( bse )");
  editor_.change(task, text);
  const std::size_t at = text.find("bse");
  const json place = Editor::position(text, at);
  const json actions =
      editor_.ask("textDocument/codeAction", {{"textDocument", {{"uri", uri_of(task)}}},
                                              {"range", {{"start", place}, {"end", place}}},
                                              {"context", {{"diagnostics", json::array()}}}});
  ASSERT_EQ(actions.size(), 1U) << actions.dump(1);
  const std::string fixed = Editor::edited(text, actions[0]["edit"]["changes"][uri_of(task)]);
  EXPECT_EQ(fixed, replaced(text, "bse", "base"));
}

/// No function is near: each one that may stand there is offered, and none is preferred.
TEST_F(Features, AnUnknownFunctionHasAChoiceOfEdits) {
  const fs::path task = open("wall_align.yaml");
  const std::string text = replaced(slurp(task), "moved(base)", "zzzz(base)");
  editor_.change(task, text);
  const json place = Editor::position(text, text.find("zzzz"));
  const json actions = editor_.fixes(task, {{"start", place}, {"end", place}});
  std::set<std::string> fixed;
  for (const json& action : actions) {
    EXPECT_FALSE(action["isPreferred"]);
    fixed.insert(Editor::edited(text, action["edit"]["changes"][uri_of(task)]));
  }
  EXPECT_TRUE(fixed.contains(replaced(text, "zzzz", "moved"))) << actions.dump(1);
  EXPECT_FALSE(fixed.contains(replaced(text, "zzzz", "valid"))) << "it takes a signal, and `base` is none";
}

/// A file that comes, changes its kind or goes is known at once.
TEST_F(Features, CompletionOfFilesFollowsTheFolder) {
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

TEST_F(Features, ACompletionIsNoMistake) {
  // Each proposal for a `goto` leaves the file without an error, but for `back`.
  const fs::path task = open("hospital.yaml");
  for (const std::string& name : proposed(task, "goto: pause}", "goto: ")) {
    editor_.change(task, replaced(slurp(task), "goto: pause}", "goto: " + name + "}"));
    const std::vector<std::string> codes = editor_.codes(task, 1);
    for (const std::string& code : codes) EXPECT_EQ(code, "E508") << name;  // `back` in an exit of `always`
  }
}

TEST_F(Features, DefinitionLeadsToTheNameAndToTheFile) {
  const fs::path task = open("hospital.yaml");
  const auto line_of = [&](const std::string& words) {
    return Editor::position(editor_.text(task), editor_.text(task).find(words))["line"];
  };
  EXPECT_EQ(editor_.at("textDocument/definition", task, "goto: pause", 7)["range"]["start"]["line"],
            line_of("  pause:"));
  EXPECT_EQ(editor_.at("textDocument/definition", task, "go.x.position", 1)["range"]["start"]["line"],
            line_of("        go:"));
  EXPECT_EQ(editor_.at("textDocument/definition", task, "$pace", 2)["range"]["start"]["line"],
            line_of("args:"));
  EXPECT_EQ(editor_.at("textDocument/definition", task, "robots/mecanum", 2)["uri"],
            uri_of(task.parent_path() / "robots/mecanum_base.yaml"));
  const fs::path scenario = open("scenarios/hospital.yaml");
  EXPECT_EQ(editor_.at("textDocument/definition", scenario, "../hospital", 2)["uri"], uri_of(task));
}

TEST_F(Features, ARenameGoesOverTaskSceneAndScenario) {
  const fs::path task = open("hospital.yaml");
  const json edit = rename(task, "  loaded:", 3, "has_load");
  ASSERT_TRUE(edit.contains("changes")) << edit.dump(1);
  EXPECT_TRUE(edit["changes"].contains(uri_of(task)));
  EXPECT_TRUE(edit["changes"].contains(uri_of(task.parent_path() / "scenes/corridor.yaml")));
  const auto messages = [&](const fs::path& path) {
    Editor fresh;
    fresh.open(path, slurp(path));
    return fresh.codes(path);
  };
  const auto before = messages(task);
  apply(edit);
  EXPECT_EQ(messages(task), before);
  EXPECT_EQ(slurp(task).find("loaded:"), slurp(task).find("unloaded:"));  // none is left
}

TEST_F(Features, ARenameThereAndBackIsNoChange) {
  const fs::path task = open("wall_align.yaml");
  const std::string good = slurp(task);
  for (const auto& [words, into] :
       std::vector<std::pair<std::string, std::size_t>>{{"$push", 1}, {"start: ", 7}}) {
    const json there = rename(task, words, into, "another");
    ASSERT_TRUE(there.contains("changes")) << there.dump(1);
    std::map<std::string, std::string> old;
    for (const auto& [uri, edits] : there["changes"].items()) old[uri] = slurp(*path_of(uri));
    apply(there);
    editor_.open(task, slurp(task));
    const std::string name = good.substr(good.find(words) + into);
    const json back = rename(task, words.front() == '$' ? "$another" : words, into,
                             name.substr(0, name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_")));
    ASSERT_TRUE(back.contains("changes")) << back.dump(1);
    apply(back);
    for (const auto& [uri, text] : old) EXPECT_EQ(slurp(*path_of(uri)), text);
    editor_.open(task, slurp(task));
  }
}

TEST_F(Features, ARenameGoesOverStudies) {
  const fs::path task = open("wall_align.yaml");
  const json edit = rename(task, "$push", 1, "shove");
  ASSERT_TRUE(edit.contains("changes")) << edit.dump(1);
  EXPECT_TRUE(edit["changes"].contains(uri_of(task.parent_path() / "studies/wall_align.yaml")));
}

TEST_F(Features, ARenameThatWouldHarmIsRefused) {
  const fs::path task = open("hospital.yaml");
  for (const char* name : {"", "1st", "a b", "a.b", "back", "load"}) {
    const json refused = rename(task, "  pause:", 3, name);
    EXPECT_EQ(refused.value("code", 0), -32803) << name << refused.dump(1);
  }
  EXPECT_EQ(rename(task, "speed:", 1, "soft").value("code", 0), -32803);
  // Nobody's name: the link of a URDF.
  EXPECT_EQ(rename(task, "move: base_link", 8, "another").value("code", 0), -32803);
}

TEST_F(Features, SymbolsAreTheNamesOfTheFile) {
  const fs::path task = open("hospital.yaml");
  std::set<std::string> names;
  for (const json& symbol :
       editor_.ask("textDocument/documentSymbol", {{"textDocument", {{"uri", uri_of(task)}}}}))
    names.insert(symbol["name"]);
  for (const char* name :
       {"speed", "loaded", "ward", "corridor", "drive_to", "pace", "pause", "go", "boundary"})
    EXPECT_TRUE(names.contains(name)) << name;
}

}  // namespace
}  // namespace zwang::lsp
