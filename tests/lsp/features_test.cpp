// The answers to an editor about a place in a text.
#include "features.hpp"

#include <sstream>

namespace zwang::lsp {
namespace {

namespace fs = std::filesystem;
using test::Editor;
using test::Features;
using test::json;
using test::labels;
using test::replaced;
using test::slurp;

bool contains(const json& answer, const std::string& words) {
  return answer.dump().find(words) != std::string::npos;
}

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

// By the rows and the conditions that use the parameter, not by the unit that it has.
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
