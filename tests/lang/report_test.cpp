// Diagnostics in the forms that other programs read: one line each, JSON for editors, SARIF for code
// scanning.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

using nlohmann::json;

Diagnostics said_about_file(const std::string& name) {
  std::filesystem::current_path(test::source_dir);
  Diagnostics diagnostics;
  load("tests/conformance/" + name, {}, diagnostics);
  return diagnostics;
}

Diagnostics with_note() {
  Diagnostics diagnostics;
  Diagnostic note;
  note.code = "N603";
  note.severity = Severity::note;
  note.message = "a note";
  diagnostics.add(note);
  return diagnostics;
}

TEST(ShortReport, has_one_line_for_each) {
  std::ostringstream out;
  render_short(said_about_file("E101_misspelt_quantity.yaml"), out);
  EXPECT_EQ(out.str(),
            "tests/conformance/E101_misspelt_quantity.yaml:10:13: error E101: unknown key `velcity` in axis "
            "`contact.x`\n");
}

TEST(Reports, show_notes_when_asked) {
  std::ostringstream without, with;
  render_short(with_note(), without);
  render_short(with_note(), with, {.notes = true});
  EXPECT_EQ(without.str(), "");
  EXPECT_EQ(with.str(), "note N603: a note\n");
  EXPECT_EQ(json::parse(render_json(with_note())).size(), 0u);
  EXPECT_EQ(json::parse(render_json(with_note(), {.notes = true})).size(), 1u);
}

/// The text of a file after the edits of one diagnostic, done as an editor does. The last edit is done first,
/// so that the places of the others stay.
std::string edited(std::string text, const json& diagnostic) {
  const json& edits = diagnostic["edits"];
  for (std::size_t i = edits.size(); i > 0; --i) {
    const json& edit = edits[i - 1];
    const auto offset = [&](const json& position) {
      std::size_t at = 0;
      for (int line = 1; line < position["line"].get<int>(); ++line) at = text.find('\n', at) + 1;
      return at + position["column"].get<std::size_t>() - 1;
    };
    const std::size_t begin = offset(edit["range"]["start"]);
    text.replace(begin, offset(edit["range"]["end"]) - begin, edit["text"].get<std::string>());
  }
  return text;
}

TEST(JsonReport, has_edits_that_mend_the_file) {
  int tried = 0;
  for (const char* name : {"E101_misspelt_quantity", "E201_no_unit", "E201_units_of_a_group",
                           "E203_newton_metre", "E105_symbols"}) {
    const std::string file = std::string(name) + ".yaml";
    const json all = json::parse(render_json(said_about_file(file)));
    ASSERT_EQ(all.size(), 1u) << name;
    ASSERT_FALSE(all[0]["edits"].empty()) << name;
    const test::Folder folder;
    const auto conformance = test::source_dir / "tests/conformance";
    folder.write("robots/mini.yaml", test::slurp(conformance / "robots/mini.yaml"));
    folder.write("robots/mini.urdf", test::slurp(conformance / "robots/mini.urdf"));
    Diagnostics after;
    EXPECT_TRUE(load(folder.write("task.yaml", edited(test::slurp(conformance / file), all[0])), {}, after))
        << name << "\n"
        << test::rendered(after);
    ++tried;
  }
  EXPECT_EQ(tried, 5);
}

TEST(SarifReport, names_rule_place_and_fix) {
  const Diagnostics diagnostics = said_about_file("E101_misspelt_quantity.yaml");
  const json log = json::parse(render_sarif({&diagnostics}, "1.2.3"));
  EXPECT_EQ(log["version"], "2.1.0");
  const json& run = log["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["version"], "1.2.3");
  EXPECT_EQ(run["tool"]["driver"]["rules"][0]["id"], "E101");
  const json& result = run["results"][0];
  EXPECT_EQ(result["ruleId"], "E101");
  EXPECT_EQ(result["level"], "error");
  const json& place = result["locations"][0]["physicalLocation"];
  EXPECT_EQ(place["artifactLocation"]["uri"], "tests/conformance/E101_misspelt_quantity.yaml");
  EXPECT_EQ(place["region"],
            (json{{"startLine", 10}, {"startColumn", 13}, {"endLine", 10}, {"endColumn", 20}}));
  EXPECT_EQ(result["fixes"][0]["artifactChanges"][0]["replacements"][0]["insertedContent"]["text"],
            "velocity");
}

TEST(SarifReport, has_one_fix_for_all_units_of_a_mapping) {
  const Diagnostics diagnostics = said_about_file("E201_units_of_a_group.yaml");
  const json log = json::parse(render_sarif({&diagnostics}, "1.2.3"));
  std::vector<std::string> written;
  for (const json& replacement :
       log["runs"][0]["results"][0]["fixes"][0]["artifactChanges"][0]["replacements"])
    written.push_back(replacement["insertedContent"]["text"]);
  EXPECT_EQ(written, (std::vector<std::string>{"-0.1 m/s", "0.2 m/s", "+-1 m/s^2", "0 rad/s"}));
}

TEST(SarifReport, keeps_what_was_silenced_and_why) {
  const Diagnostics diagnostics = said_about_file("ok_allowed.yaml");
  EXPECT_TRUE(diagnostics.all().empty());
  const json log = json::parse(render_sarif({&diagnostics}, "1"));
  const json& result = log["runs"][0]["results"][0];
  EXPECT_EQ(result["ruleId"], "W503");
  EXPECT_EQ(result["suppressions"][0]["kind"], "inSource");
  EXPECT_EQ(result["suppressions"][0]["justification"], "the operator ends it");
}

TEST(SarifReport, escapes_paths) {
  Diagnostics diagnostics;
  Diagnostic error;
  error.code = "E100";
  error.message = "x";
  error.span = {diagnostics.add_source({"/tmp/a b%\xC3\xA4.yaml", "x"}), {1, 1}, {1, 2}};
  diagnostics.add(error);
  const json log = json::parse(render_sarif({&diagnostics}, "1"));
  EXPECT_EQ(log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "file:///tmp/a%20b%25%C3%A4.yaml");
}

}  // namespace
}  // namespace zwang::lang
