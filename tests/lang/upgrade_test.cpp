// `zwang fmt --upgrade`: the newest version's words, comments and all, and the same program.
#include "zwang/lang/upgrade.hpp"

#include <gtest/gtest.h>

#include "program_text.hpp"
#include "support.hpp"

namespace zwang::lang {
namespace {

namespace fs = std::filesystem;

std::string upgraded(const std::string& text) {
  const test::Folder folder;
  Diagnostics diagnostics;
  return upgrade_task(folder.write("file.yaml", text), diagnostics).value_or("refused");
}

TEST(Upgrade, WritesVersionAndPlaneAndNothingElse) {
  const std::string before =
      "zwang: 1  # of old\n"
      "params: {speed: {value: 0.4 m/s, range: [0.1 m/s, 1 m/s]}}\n"
      "always:\n"
      "  constraints:\n"
      "    manners2: {move: base, in: base, speed: {velocity: [0 m/s, $speed]}}  # no faster\n"
      "tasks:\n"
      "  speed:\n"
      "    exits:\n"
      "      - when: speed(base) < 1 cm/s and manners2.speed.velocity < 1 cm/s and\n"
      "          other.speed.velocity < 1 cm/s or manners2.speed.force > 2 N\n"
      "        goto: done\n";
  std::string after = before;
  for (const auto& [from, to] : {std::pair{"zwang: 1", "zwang: 2"},
                                 {"base, speed:", "base, plane:"},
                                 {"manners2.speed.velocity", "manners2.plane.velocity"},
                                 {"manners2.speed.force", "manners2.plane.force"}})
    after = test::replaced(after, from, to);
  EXPECT_EQ(upgraded(before), after);
  EXPECT_EQ(upgraded(after), after) << "not stable";
}

TEST(Upgrade, RefusesWhatItCannotRead) {
  EXPECT_EQ(upgraded("zwang: 1\na: [\n"), "refused");
  EXPECT_EQ(upgraded("zwang: 1\nzwang: 1\n"), "refused");
}

/// All text behind `from`, wherever it stands.
std::string with_each(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TEST(Upgrade, EveryTaskThatShipsIsTheSameProgramInBothVersions) {
  const test::Folder folder;
  fs::copy(test::source_dir / "specs", folder.path(), fs::copy_options::recursive);
  int with_speed = 0;
  std::vector<fs::directory_entry> files;
  for (const char* place : {".", "laws", "partners"}) {
    for (const auto& file : fs::directory_iterator(folder.path() / place)) {
      if (file.path().extension() == ".yaml") files.push_back(file);
    }
  }
  // One program is one run: what it says of its verdict need not be asked again.
  for (const auto& file : files) {
    SCOPED_TRACE(file.path().filename());
    const std::string name = file.path().lexically_relative(folder.path()).string();
    const auto program_of = [&](const std::string& text) {
      Diagnostics diagnostics;
      const auto program = load(folder.write(name, text), {}, diagnostics);
      EXPECT_TRUE(program && !diagnostics.has_errors()) << test::rendered(diagnostics);
      return program ? test::ProgramText(*program).text() : std::string();
    };
    std::string old_text = with_each(test::slurp(file.path()), "zwang: 2", "zwang: 1");
    old_text =
        with_each(old_text, "plane: {velocity: [0 m/s, 0.5 m/s]}", "speed: {velocity: [0 m/s, 0.5 m/s]}");
    const std::string before = program_of(old_text);
    Diagnostics diagnostics;
    const std::string new_text = upgrade_task(file.path(), diagnostics).value_or("refused");
    EXPECT_NE(new_text.find("zwang: 2\n"), std::string::npos);
    EXPECT_EQ(with_each(before, ".speed -1 ", ".plane -1 "), program_of(new_text));
    with_speed += before.find(".speed -1 ") != std::string::npos;
  }
  EXPECT_GE(with_speed, 1);
}

}  // namespace
}  // namespace zwang::lang
