// The questions of editors about a text: the keys around a place, its names, and completion.
#include <gtest/gtest.h>

#include <algorithm>

#include "support.hpp"
#include "tree/read.hpp"
#include "words/text.hpp"
#include "zwang/lang/completion.hpp"
#include "zwang/lang/names.hpp"
#include "zwang/lang/open_texts.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;
using test::slurp;
using test::source_dir;

std::vector<fs::path> shipped_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source_dir / "specs")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

class PlacesOf {
 public:
  explicit PlacesOf(const fs::path& path) : path_(path), text_(slurp(path)), index_(text_) {}

  void check() {
    Diagnostics diagnostics;
    const auto document = read(diagnostics.add_source({path_.string(), text_}), diagnostics);
    ASSERT_TRUE(document) << path_;
    walk(document->root, {});
  }

 private:
  std::string where(const Position& position) const {
    return path_.string() + ":" + std::to_string(position.line) + ":" + std::to_string(position.column);
  }

  void walk(const Node& node, const std::vector<std::string>& keys) {
    for (const Entry& entry : node.entries) {
      const TextPlace at_key = place_at(text_, index_.offset(entry.key.span.begin));
      EXPECT_TRUE(at_key.is_key) << where(entry.key.span.begin);
      EXPECT_EQ(at_key.keys, keys) << where(entry.key.span.begin);
      std::vector<std::string> below = keys;
      below.push_back(entry.key.text);
      walk(entry.value, below);
    }
    for (const Node& item : node.items) {
      std::vector<std::string> below = keys;
      below.push_back("-");
      walk(item, below);
    }
    const bool is_one_line = node.span.begin.line == node.span.end.line;
    if (!node.is_scalar() || node.is_quoted || !is_one_line ||
        (!keys.empty() && keys.back() == "-" && !node.is_flow))
      return;
    const TextPlace behind = place_at(text_, index_.offset(node.span.end));
    EXPECT_FALSE(behind.is_key) << where(node.span.end);
    EXPECT_EQ(behind.keys, keys) << where(node.span.end);
    EXPECT_EQ(behind.value, node.text) << where(node.span.end);
  }

  fs::path path_;
  std::string text_;
  TextIndex index_;
};

TEST(Editing, APlaceHasTheKeysThatTheReaderFindsAroundIt) {
  for (const fs::path& path : shipped_files()) PlacesOf(path).check();
}

TEST(Editing, APlaceIsFoundInTextThatNoReaderTakes) {
  const std::string text =
      "tasks:\n  press:\n    constraints:\n      contact: {move: base_link, x: {force: 20 ";
  const TextPlace place = place_at(text, text.size());
  EXPECT_EQ(place.keys, (std::vector<std::string>{"tasks", "press", "constraints", "contact", "x", "force"}));
  EXPECT_FALSE(place.is_key);
  EXPECT_EQ(place.value, "20 ");
  const std::string deeper = "tasks:\n  press:\n    exits:\n      - when: a\n        ";
  EXPECT_EQ(place_at(deeper, deeper.size()).keys, (std::vector<std::string>{"tasks", "press", "exits", "-"}));
  const std::string back = "tasks:\n  press:\n    timeout: {}\n  ";
  EXPECT_EQ(place_at(back, back.size()).keys, std::vector<std::string>{"tasks"});
  EXPECT_TRUE(place_at(back, back.size()).is_key);
  EXPECT_TRUE(place_at("", 0).is_key);
}

/// A name is given once, and what means it is written as it.
TEST(Editing, EveryNameThatIsMeantStandsInTheText) {
  for (const fs::path& path : shipped_files()) {
    const std::string text = slurp(path);
    const TextIndex index(text);
    const auto kind = kind_of_text(text);
    if (!kind) continue;
    Diagnostics diagnostics;
    for (const NamePlace& name : names_of(*kind, path, diagnostics)) {
      const std::size_t begin = index.offset(name.span.begin);
      EXPECT_EQ(text.substr(begin, index.offset(name.span.end) - begin), name.name) << path;
      EXPECT_TRUE(is_name(name.name)) << name.name;
    }
  }
}

/// Each parameter, signal, region and task of a program is given once in its text.
TEST(Editing, TheNamesOfAProgramAreGivenInItsText) {
  for (const char* name : {"hospital", "docking", "wall_align", "obstacle"}) {
    const fs::path path = source_dir / "specs" / (std::string(name) + ".yaml");
    Diagnostics diagnostics;
    const auto program = load(path, {}, diagnostics);
    ASSERT_TRUE(program);
    const std::vector<NamePlace> names = names_of(FileKind::task, path, diagnostics);
    const auto given = [&](NameKind kind, const std::string& one) {
      return std::count_if(names.begin(), names.end(), [&](const NamePlace& place) {
        return place.is_given && place.kinds.front() == kind && place.name == one;
      });
    };
    for (const Parameter& p : program->parameters) EXPECT_EQ(given(NameKind::parameter, p.name), 1) << p.name;
    for (const Signal& s : program->signals) EXPECT_EQ(given(NameKind::signal, s.name), 1) << s.name;
    for (const Region& r : program->regions) EXPECT_EQ(given(NameKind::region, r.name), 1) << r.name;
    for (const Task& t : program->tasks) EXPECT_EQ(given(NameKind::task, t.name), 1) << t.name;
  }
}

/// The completions at a place of the text, with the names that the text itself gives.
std::vector<std::string> completed(const std::string& text, const std::string& before) {
  test::Folder folder;
  Diagnostics diagnostics;
  KnownNames known;
  known.given = names_of(FileKind::task, folder.write("task.yaml", text), diagnostics);
  std::vector<std::string> words;
  for (const Proposal& proposal : proposals(FileKind::task, text, text.find(before) + before.size(), known))
    words.push_back(proposal.text);
  return words;
}

TEST(Editing, AFunctionIsOfferedWhatItTakes) {
  const std::string text =
      "signals: {latch: {type: bool, stale_after: 1 s}}\noutputs: {lamp: {type: bool, stop: keep}}\n"
      "frames: {goal: {parent: world}}\nstart: a\n"
      "tasks:\n  a:\n    exits: [{when: since(b) > 1 s and speed(goal) > 1 m/s and valid(latch), goto: b}]\n"
      "  b: {enter: {set: {outputs.lamp: true}}}\n";
  const auto has = [](const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const auto tasks = completed(text, "since("), frames = completed(text, "speed("),
             signals = completed(text, "valid("), any = completed(text, "when: ");
  EXPECT_EQ(tasks, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(has(frames, "goal") && !has(frames, "a") && !has(frames, "latch"));
  EXPECT_EQ(signals, (std::vector<std::string>{"latch"}));
  for (const char* word : {"latch", "lamp", "since", "turned", "entries"})
    EXPECT_TRUE(has(any, word)) << word;
}

// A task is renamed where conditions ask for it, an output where it is set.
TEST(Editing, TasksOfConditionsAndOutputsAreNames) {
  const std::string text =
      "outputs: {lamp: {type: bool, stop: keep}}\nstart: a\n"
      "tasks:\n  a:\n    enter: {set: {outputs.lamp: true}}\n"
      "    exits: [{when: entries(a) > 1 and lamp, goto: done}]\n";
  test::Folder folder;
  Diagnostics diagnostics;
  int tasks = 0, outputs = 0;
  for (const NamePlace& place : names_of(FileKind::task, folder.write("task.yaml", text), diagnostics)) {
    tasks += place.name == "a" && place.kinds.front() == NameKind::task ? 1 : 0;
    outputs += place.name == "lamp" && place.kinds.front() == NameKind::output ? 1 : 0;
  }
  EXPECT_EQ(tasks, 3) << "given, `start`, `entries`";
  EXPECT_EQ(outputs, 3) << "given, set, asked for";
}

TEST(Editing, AnOpenTextIsReadInThePlaceOfTheFile) {
  const test::Folder folder;
  const fs::path path = folder.write("a.yaml", "on the disk");
  const fs::path link = folder.path() / "link.yaml";
  fs::create_symlink(path, link);
  OpenTexts outer, inner;
  outer.put(path, "outer");
  inner.put(link, "inner");
  EXPECT_EQ(open_text_of(path), nullptr);
  {
    const ReadsOpenTexts reading(outer);
    EXPECT_EQ(*open_text_of(link), "outer");
    {
      const ReadsOpenTexts nested(inner);
      EXPECT_EQ(*open_text_of(path), "inner");
    }
    EXPECT_EQ(*open_text_of(path), "outer");
    EXPECT_EQ(open_text_of(folder.path() / "b.yaml"), nullptr);
  }
  EXPECT_EQ(open_text_of(path), nullptr);
}

TEST(Editing, QuantitiesInSi) {
  EXPECT_EQ(in_si("10 cm"), "0.1 m");
  EXPECT_EQ(in_si("250 ms"), "0.25 s");
  EXPECT_EQ(in_si("1 m"), "");
  EXPECT_EQ(in_si("5"), "");
  EXPECT_EQ(in_si("x"), "");
}

}  // namespace
}  // namespace zwang::lang
