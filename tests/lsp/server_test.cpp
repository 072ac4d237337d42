// The diagnostics of files that an editor has not saved.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>

#include "../is_long.hpp"
#include "editor.hpp"

namespace zwang::lsp {
namespace {

namespace fs = std::filesystem;
using test::Editor;
using test::json;
using test::replaced;
using test::slurp;
using Codes = std::vector<std::string>;

const fs::path source = ZWANG_SOURCE_DIR;
const fs::path specs_folder = source / "specs";
const fs::path conformance = source / "tests/conformance";

TEST(LanguageServer, TellsOfTextThatIsNotSaved) {
  Editor editor;
  const fs::path task = specs_folder / "wall_align.yaml";
  const std::string good = slurp(task);
  editor.open(task, good);
  EXPECT_EQ(editor.codes(task), Codes{});
  editor.change(task, replaced(good, "20 N,", "20 Nm,"));
  EXPECT_EQ(editor.codes(task), Codes{"E203"});
  const json d = editor.diagnostics(task)[0];
  EXPECT_EQ(d["range"]["start"], Editor::position(editor.text(task), editor.text(task).find("20 Nm")));
  EXPECT_EQ(d["codeDescription"]["href"], uri_of(source / "docs/errors/E203.md"));
  editor.change(task, good);
  EXPECT_EQ(editor.codes(task), Codes{});
}

TEST(LanguageServer, RobotSceneAndUrdfActBeforeTheyAreSaved) {
  Editor editor;
  const fs::path task = specs_folder / "wall_align.yaml";
  editor.open(task, slurp(task));
  // Of each file that the task leads to: a text, and what is wrong with it. Told at that file's own address.
  const fs::path robot = specs_folder / "robots/mecanum_base.yaml", scene = specs_folder / "scenes/wall.yaml";
  for (const fs::path& file : {robot, scene}) {
    editor.open(file, slurp(file) + "colour: red\n");
    EXPECT_EQ(editor.codes(file), Codes{"E101"}) << file;
    editor.close(file);
    EXPECT_EQ(editor.codes(file), Codes{}) << file;
  }
  const fs::path urdf = specs_folder / "robots/mecanum_base.urdf";
  editor.open(urdf, replaced(slurp(urdf), "</robot>", ""));
  EXPECT_EQ(editor.codes(urdf), Codes{"E854"});
  editor.change(urdf, slurp(urdf));
  EXPECT_EQ(editor.codes(urdf), Codes{});
}

TEST(LanguageServer, PlacesAreThoseOfUtf16) {
  Editor editor;
  const fs::path task = specs_folder / "wall_align.yaml";
  editor.open(task, replaced(slurp(task), "help: how", "help: \xF0\x9F\xA4\x96 how"));
  EXPECT_EQ(editor.codes(task), Codes{});
  const std::string text = replaced(slurp(task), "range: [5 N, 40 N], help: how hard",
                                    "help: \xF0\x9F\xA4\x96 how hard, range: [5 N, 40 Nx], about: hard");
  editor.change(task, text);
  const std::size_t at = text.find("40 Nx");
  bool is_found = false;
  for (const json& d : editor.diagnostics(task))
    is_found = is_found || d["range"]["start"] == Editor::position(text, at);
  EXPECT_TRUE(is_found) << editor.diagnostics(task).dump(1);
}

TEST(LanguageServer, FormatsAsFmtDoes) {
  Editor editor;
  const fs::path task = specs_folder / "wall_align.yaml";
  const std::string good = slurp(task);
  editor.open(task, replaced(good, "tasks:", "tasks:   # all"));
  const json edits = editor.ask("textDocument/formatting", {{"textDocument", {{"uri", uri_of(task)}}}});
  ASSERT_EQ(edits.size(), 1U);
  const std::string laid_out = Editor::edited(editor.text(task), edits);
  EXPECT_EQ(laid_out, replaced(good, "tasks:", "tasks:  # all"));
  editor.change(task, laid_out);
  EXPECT_EQ(editor.ask("textDocument/formatting", {{"textDocument", {{"uri", uri_of(task)}}}}),
            json::array());
}

/// The files of the golden suite with a fix. Each fix is done alone. Then its diagnostic is gone, and there
/// is no error more than before.
TEST(LanguageServer, EveryQuickFixLeadsToABetterFile) {
  int fixed = 0;
  for (const auto& entry : fs::directory_iterator(conformance)) {
    const fs::path& path = entry.path();
    if (path.extension() != ".yaml") continue;
    Editor editor;
    const std::string text = slurp(path);
    editor.open(path, text);
    const json before = editor.diagnostics(path);
    for (const json& d : before) {
      json fixes = editor.fixes(path, d["range"]);
      fixes.erase(std::remove_if(fixes.begin(), fixes.end(),
                                 [&](const json& fix) { return fix["diagnostics"][0]["code"] != d["code"]; }),
                  fixes.end());
      for (const json& fix : fixes) {
        const json& changes = fix["edit"]["changes"];
        if (!changes.contains(uri_of(path))) continue;
        const int errors = editor.errors(path);
        editor.change(path, Editor::edited(text, changes[uri_of(path)]));
        ++fixed;
        EXPECT_LE(editor.errors(path), errors) << path << "\n" << fix.dump(1) << editor.text(path);
        for (const json& after : editor.diagnostics(path)) {
          EXPECT_FALSE(after["code"] == d["code"] && after["message"] == d["message"] &&
                       after["range"]["start"] == d["range"]["start"])
              << path << "\n"
              << after.dump(1);
        }
        editor.change(path, text);
      }
    }
  }
  EXPECT_GT(fixed, 90);
}

TEST(LanguageServer, AnyContentIsAnsweredAndTheNextOneIsServed) {
  Editor editor;
  const fs::path task = specs_folder / "wall_align.yaml";
  editor.open(task, slurp(task));
  for (const std::string& content :
       {std::string("rubbish"), std::string("\xFF\xFE"), std::string(100000, '['), std::string("[]"),
        std::string("null"), std::string("{}"), std::string(R"({"id":{},"method":"shutdown"})"),
        std::string(R"({"id":null,"method":1})")}) {
    const std::size_t before = editor.refusals().size();
    editor.server().receive(content);
    EXPECT_EQ(editor.refusals().size(), before + 1) << content.substr(0, 40);
  }
  const json uri = uri_of(task);
  const std::vector<json> odd = {
      nullptr,
      1,
      "x",
      json::array(),
      json::object(),
      {{"textDocument", 1}},
      {{"textDocument", {{"uri", 1}}}},
      {{"textDocument", {{"uri", "untitled:1"}}}},
      {{"textDocument", {{"uri", "file:///nowhere.yaml"}}}},
      {{"textDocument", {{"uri", uri}}}, {"position", {{"line", -1}, {"character", 1e300}}}},
      {{"textDocument", {{"uri", uri}}},
       {"position", {{"line", 1000000}, {"character", 1000000}}},
       {"newName", 1}},
      {{"textDocument", {{"uri", uri}, {"version", "x"}}}, {"contentChanges", {1}}},
      {{"textDocument", {{"uri", uri}, {"version", 1e300}}}, {"contentChanges", json::array()}}};
  for (const char* method :
       {"textDocument/codeAction", "textDocument/formatting", "textDocument/hover", "textDocument/completion",
        "textDocument/definition", "textDocument/references", "textDocument/documentSymbol",
        "textDocument/prepareRename", "textDocument/rename", "nonsense"}) {
    for (const json& parameters : odd) editor.ask(method, parameters);
  }
  for (const char* method : {"textDocument/didOpen", "textDocument/didChange", "textDocument/didClose",
                             "textDocument/didSave", "$/cancelRequest", "nonsense"}) {
    for (const json& parameters : odd) editor.tell(method, parameters);
  }
  editor.open(task, replaced(slurp(task), "20 N,", "20 Nm,"));
  EXPECT_EQ(editor.codes(task), Codes{"E203"});
}

TEST(LanguageServer, EndsAsTheProtocolSays) {
  Editor editor;
  EXPECT_EQ(editor.server().exit_code(), 1);
  EXPECT_EQ(editor.ask("shutdown", nullptr), nullptr);
  EXPECT_EQ(editor.ask("textDocument/hover", json::object())["code"], -32600);
  EXPECT_FALSE(editor.server().is_over());
  editor.tell("exit", nullptr);
  EXPECT_TRUE(editor.server().is_over());
  EXPECT_EQ(editor.server().exit_code(), 0);
}

/// A text after one more random edit: a stretch taken out, doubled, or letters put in.
std::string edited_at_random(std::string text, std::mt19937& random) {
  static const std::vector<std::string> pieces = {
      "{",    "}",  "[",  "]", ":",     "\n", "  ", "- ",
      "$",    "'",  "\"", "#", "20 N",  "x",  "\t", "\xF0\x9F\xA4\x96",
      "\r\n", "&a", "*a", "<", "goto: "};
  const std::size_t at = random() % (text.size() + 1);
  const std::size_t length = std::min<std::size_t>(random() % 40, text.size() - at);
  switch (random() % 3) {
    case 0:
      return text.erase(at, length);
    case 1:
      return text.insert(random() % (text.size() + 1), text.substr(at, length));
    default:
      return text.insert(at, pieces[random() % pieces.size()]);
  }
}

/// An edit may cut a character into pieces; an editor's text has none.
std::string in_utf8(const std::string& text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

TEST(LanguageServer, AfterAnyEditsItSaysWhatItWouldSayOfTheTextAlone) {
  const int edits = zwang::test::is_long() ? 10000 : 200;
  const fs::path task = specs_folder / "hospital.yaml";
  const std::string good = slurp(task);
  std::mt19937 random(2411);
  Editor editor;
  editor.open(task, good);
  std::string text = good;
  for (int i = 0; i < edits; ++i) {
    text = i % 25 == 24 ? good : in_utf8(edited_at_random(text, random));
    editor.change(task, text);
    const std::size_t at = random() % (text.size() + 1);
    json parameters = {{"textDocument", {{"uri", uri_of(task)}}}, {"position", Editor::position(text, at)}};
    parameters["range"] = {{"start", parameters["position"]}, {"end", parameters["position"]}};
    for (const char* method :
         {"textDocument/hover", "textDocument/completion", "textDocument/definition",
          "textDocument/codeAction", "textDocument/documentSymbol", "textDocument/formatting"})
      editor.ask(method, parameters);
    if (i % 20 != 0) continue;
    Editor fresh;
    fresh.open(task, text);
    EXPECT_EQ(editor.diagnostics(task), fresh.diagnostics(task)) << text;
  }
}

}  // namespace
}  // namespace zwang::lsp
