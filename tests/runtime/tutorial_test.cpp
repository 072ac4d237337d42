// The blocks of README.md and of the tutorial's three parts are true. Each task is good and runs; each
// mistake is refused in the words of the page.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "../page_blocks.hpp"
#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;

using test::PageBlock;

std::vector<PageBlock> blocks(const char* page = "docs/tutorial.md") {
  return test::page_blocks(fs::path(ZWANG_SOURCE_DIR) / page);
}

class Tutorial : public test::Program {
 protected:
  void SetUp() override {
    fs::copy(fs::path(ZWANG_SOURCE_DIR) / "specs", folder_, fs::copy_options::recursive);
  }
  void write(const PageBlock& block) { Program::write("mine.yaml", block.text); }
};

TEST_F(Tutorial, each_block_is_good) {
  int tried = 0;
  for (const PageBlock& block : blocks()) {
    if (block.kind != "yaml") continue;
    write(block);
    const test::Result result = zwang({"validate", "--deny", "warnings", "mine.yaml"});
    EXPECT_EQ(result.code, 0) << "docs/tutorial.md:" << block.line << "\n" << result.out << result.err;
    ++tried;
  }
  EXPECT_EQ(tried, 5);
}

TEST_F(Tutorial, each_block_runs) {
  for (const PageBlock& block : blocks()) {
    if (block.kind != "yaml") continue;
    write(block);
    const test::Result result =
        zwang({"run", "mine.yaml", "--scene", "scenes/wall.yaml", "--quiet", "--format", "json"});
    ASSERT_EQ(result.code, 0) << "docs/tutorial.md:" << block.line << "\n" << result.out << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out).at("outcome"), "done") << "docs/tutorial.md:" << block.line;
  }
}

TEST_F(Tutorial, the_first_block_has_eight_lines) {
  for (const PageBlock& block : blocks()) {
    if (block.kind != "yaml") continue;
    EXPECT_EQ(std::count(block.text.begin(), block.text.end(), '\n'), 8);
    return;
  }
}

TEST_F(Tutorial, the_mistake_is_refused_in_these_words) {
  const std::vector<PageBlock> all = blocks();
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i].kind != "yaml mistake") continue;
    write(all[i]);
    const test::Result result = zwang({"validate", "mine.yaml"});
    EXPECT_EQ(result.code, 1);
    EXPECT_EQ(result.out.substr(0, all[i + 1].text.size()), all[i + 1].text);
    return;
  }
  FAIL() << "no mistake in the tutorial";
}

TEST_F(Tutorial, the_last_block_squares_the_base_up) {
  std::optional<PageBlock> last;
  for (const PageBlock& block : blocks()) {
    if (block.kind == "yaml") last = block;
  }
  ASSERT_TRUE(last);
  write(*last);
  const test::Result result = zwang({"run", "mine.yaml", "--quiet", "--format", "json"});
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  const auto report = nlohmann::json::parse(result.out);
  EXPECT_EQ(report.at("outcome"), "done");
  EXPECT_NEAR(report.at("truth").at("base").at("yaw").get<double>(), 0.0, 0.1 * 0.0174532925199433);
  EXPECT_NEAR(report.at("truth").at("wall").at("steady_force").get<double>(), 20.0, 0.2);
}

/// Each block names its file: "yaml specs/mine.yaml". A task runs as soon as its scene stands beside it.
TEST_F(Tutorial, part_2_grows_file_by_file_and_each_task_is_done) {
#ifdef ZWANG_SANITIZED
  GTEST_SKIP() << "long simulations, of which a sanitizer learns nothing new";
#endif
  const std::vector<PageBlock> all = blocks("docs/tutorial_2.md");
  int runs = 0, tests = 0;
  for (const PageBlock& block : all) {
    constexpr std::string_view yaml = "yaml specs/";
    if (!block.kind.starts_with(yaml)) continue;
    const std::string file = block.kind.substr(yaml.size());
    Program::write(file, block.text);
    const std::string where = "docs/tutorial_2.md:" + std::to_string(block.line) + "\n";
    const bool needs_its_scene = file == "mine.yaml" && block.text.find("$target") == std::string::npos;
    if (needs_its_scene) continue;
    const bool is_scenario = file.starts_with("scenarios/");
    const test::Result result = is_scenario ? zwang({"test", file}) : zwang({"run", "mine.yaml", "--quiet"});
    EXPECT_EQ(result.code, 0) << where << result.out << result.err;
    const test::Result good = zwang({"validate", "--deny", "warnings", file, "mine.yaml"});
    EXPECT_EQ(good.code, 0) << where << good.out << good.err;
    ++(is_scenario ? tests : runs);
  }
  EXPECT_EQ(runs, 3);
  EXPECT_EQ(tests, 1);
}

/// The commands of part 3 run where a reader runs them: beside the folder `specs`.
class OwnRobot : public test::Program {
 protected:
  void SetUp() override {
    fs::copy(fs::path(ZWANG_SOURCE_DIR) / "specs", folder_ / "specs", fs::copy_options::recursive);
  }
  /// Of `text zwang robot inspect FILE`: what that command prints.
  std::string said_by(const std::string& command) {
    std::istringstream words(command);
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    arguments.erase(arguments.begin(), arguments.begin() + 2);
    const test::Result result = zwang(arguments);
    return result.out + result.err;
  }
};

/// Each block names its file, or the command whose words it holds.
TEST_F(OwnRobot, part_3_comes_from_a_urdf_to_a_task_that_is_done) {
  const std::vector<PageBlock> all = blocks("docs/tutorial_3.md");
  int files = 0, commands = 0;
  for (const PageBlock& block : all) {
    const std::string where = "docs/tutorial_3.md:" + std::to_string(block.line) + "\n";
    const std::string& kind = block.kind;
    if (kind.starts_with("text zwang ")) {
      const std::string said = said_by(kind);
      EXPECT_NE(said.find(block.text.substr(0, block.text.size() - 1)), std::string::npos) << where << said;
      ++commands;
    }
    if (!kind.starts_with("xml ") && !kind.starts_with("yaml ")) continue;
    const std::string file = kind.substr(kind.rfind(' ') + 1);
    Program::write(file, block.text);
    if (kind.starts_with("xml ") || kind.starts_with("yaml mistake ")) continue;
    const test::Result good = zwang({"validate", "--deny", "warnings", file});
    EXPECT_EQ(good.code, 0) << where << good.out << good.err;
    if (file == "specs/mine.yaml") {
      EXPECT_EQ(zwang({"run", file, "--quiet"}).code, 0) << where;
    }
    ++files;
  }
  EXPECT_EQ(files, 4);
  EXPECT_EQ(commands, 5);
}

using Readme = Tutorial;

TEST_F(Readme, its_task_is_good_and_squares_the_base_up) {
  const std::vector<PageBlock> all = blocks("README.md");
  ASSERT_EQ(all.at(0).kind, "yaml");
  write(all[0]);
  const test::Result good = zwang({"validate", "--deny", "warnings", "mine.yaml"});
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  const test::Result result = zwang({"run", "mine.yaml", "--quiet", "--format", "json"});
  ASSERT_EQ(result.code, 0) << result.out << result.err;
  const auto report = nlohmann::json::parse(result.out);
  EXPECT_NEAR(report.at("truth").at("base").at("yaw").get<double>(), 0.0, 0.1 * 0.0174532925199433);
}

TEST_F(Readme, its_diagnostic_is_the_programs) {
  const std::vector<PageBlock> all = blocks("README.md");
  ASSERT_EQ(all.at(1).kind, "text");
  std::string mistake = all[0].text;
  mistake.replace(mistake.find("20 N, velocity"), 4, "900 N");
  Program::write("press.yaml", mistake);
  const test::Result result = zwang({"validate", "press.yaml"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.out.substr(0, all[1].text.size()), all[1].text);
}

}  // namespace
}  // namespace zwang
