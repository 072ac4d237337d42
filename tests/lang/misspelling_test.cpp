// Every word of a shipped file misspelt, every number without its unit, one at a time: whatever is said of it
// is said once.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "../is_long.hpp"
#include "support.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/schema.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

/// A file of specs/.
class Misspelling : public testing::TestWithParam<const char*> {
 protected:
  Misspelling() {
    fs::copy(test::source_dir / "specs", folder_.path(), fs::copy_options::recursive);
    folder_.write(".zwang-root", "");
  }

  Diagnostics said_about(const std::string& text) {
    const std::string file = GetParam();
    const fs::path path = folder_.write(file, text);
    Diagnostics diagnostics;
    if (file.starts_with("robots/")) {
      load_robot(path, diagnostics);
    } else if (file.starts_with("scenes/")) {
      load_scene(path, diagnostics);
    } else if (file.starts_with("scenarios/")) {
      check_scenario(path, diagnostics);
    } else {
      load(path, {}, diagnostics);
    }
    return diagnostics;
  }

  /// Tries the text with each `step`th find of `what`, outside of comments, written as `spoil` says. The
  /// share of which something is said.
  template <typename Spoil>
  double try_each(const std::regex& what, const Spoil& spoil, int step = 1) {
    const std::string text = test::slurp(test::source_dir / "specs" / GetParam());
    int told = 0, tried = 0, found = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), what), end; at != end; ++at) {
      const auto begin = static_cast<std::size_t>(at->position());
      const std::size_t line = text.rfind('\n', begin) + 1;
      if (text.substr(line, begin - line).find('#') != std::string::npos) continue;
      if (found++ % step != 0) continue;
      std::string bad = text;
      bad.replace(begin, at->str().size(), spoil(at->str()));
      const Diagnostics diagnostics = said_about(bad);
      EXPECT_LE(diagnostics.all().size(), 1u) << bad.substr(line, bad.find('\n', line) - line) << "\n"
                                              << test::rendered(diagnostics);
      ++tried;
      told += diagnostics.all().empty() ? 0 : 1;
    }
    return tried == 0 ? 0.0 : static_cast<double>(told) / tried;
  }

  test::Folder folder_;
};

TEST_P(Misspelling, of_any_word_is_told_once) {
  const auto swapped = [](std::string word) {
    if (word[1] == word[2]) return word.substr(0, word.size() - 1);
    std::swap(word[1], word[2]);
    return word;
  };
  // The others are names that nobody refers to, and words for people.
  const int step = zwang::test::is_long() ? 1 : 3;
  EXPECT_GT(try_each(std::regex("[A-Za-z_][A-Za-z_0-9]{2,}"), swapped, step), 0.5);
}

TEST_P(Misspelling, of_any_number_is_told_once) {
  const auto broken = [](const std::string& number) { return number + "x"; };
  EXPECT_GT(try_each(std::regex("[0-9]+ "), broken), 0.9);
}

TEST_P(Misspelling, without_a_unit_is_told_once) {
  const std::regex unit(
      "[0-9] (m/s\\^2|rad/s\\^2|m/s|rad/s|N m|kN/m|mm|cm|deg|kg|Hz|ms|m|N|s|%)(?=[,\\]}\n])");
  EXPECT_EQ(try_each(unit, [](const std::string& number) { return number.substr(0, 1); }), 1.0);
}

void gather_properties_of(const nlohmann::json& schema, std::set<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties")) {
    for (const auto& [key, value] : schema["properties"].items()) keys.insert(key);
  }
  for (const auto& part : schema) {
    if (part.is_structured()) gather_properties_of(part, keys);
  }
}

/// An unknown key is answered with those that the reader looks for. Completion knows them by the schema.
TEST_P(Misspelling, of_a_key_names_only_keys_of_the_schema) {
  const std::string file = GetParam();
  const FileKind kind = file.starts_with("robots/")      ? FileKind::robot
                        : file.starts_with("scenes/")    ? FileKind::scene
                        : file.starts_with("scenarios/") ? FileKind::scenario
                                                         : FileKind::task;
  std::set<std::string> in_schema;
  gather_properties_of(nlohmann::json::parse(json_schema(kind)), in_schema);
  const std::string text = test::slurp(test::source_dir / "specs" / file);
  const std::string begin = "known here: ";
  std::set<std::string> named;
  const auto gather_named = [&](std::size_t at, const std::string& odd) {
    const Diagnostics diagnostics = said_about(text.substr(0, at) + odd + text.substr(at));
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      if (!diagnostic.message.starts_with("unknown key") || !diagnostic.help.starts_with(begin)) continue;
      std::istringstream keys(diagnostic.help.substr(begin.size(), diagnostic.help.find(';') - begin.size()));
      for (std::string key; std::getline(keys >> std::ws, key, ',');) named.insert(key);
    }
  };
  // A mapping has several lines, and most mappings of a file are alike.
  const int step = zwang::test::is_long() ? 1 : 3;
  int found = 0;
  for (std::size_t at = text.find('{'); at != text.npos; at = text.find('{', at + 1)) {
    if (found++ % step == 0) gather_named(at + 1, "no_such_key: 1, ");
  }
  const std::regex line("\n( *)[a-z_]+:");
  for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at) {
    if (found++ % step == 0)
      gather_named(static_cast<std::size_t>(at->position()), "\n" + at->str(1) + "no_such_key: 1");
  }
  EXPECT_FALSE(named.empty());
  for (const std::string& key : named) EXPECT_TRUE(in_schema.contains(key)) << key;
}

INSTANTIATE_TEST_SUITE_P(In, Misspelling,
                         testing::Values("wall_align.yaml", "obstacle.yaml", "docking.yaml", "hospital.yaml",
                                         "scenes/dock_live_meets.yaml", "scenes/corridor.yaml",
                                         "robots/mecanum_base.yaml", "scenarios/faults_of_motors.yaml"),
                         [](const auto& shipped) {
                           std::string name = shipped.param;
                           for (char& c : name) c = c == '/' || c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace zwang::lang
