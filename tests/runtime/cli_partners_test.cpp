// A run with a second robot in its scene, from the command line.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read;
using test::Result;

constexpr const char* stand_for = R"(zwang: 1
robot: robots/mecanum_base.yaml
start: stand
tasks:
  stand:
    constraints: {still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
)";

class Partners : public test::Program {
 protected:
  Partners() {
    fs::copy(fs::path(ZWANG_SOURCE_DIR) / "specs/robots", folder_ / "robots", fs::copy_options::recursive);
    write("task.yaml", std::string(stand_for) + "    timeout: {after: 1 s, goto: done}\n");
    write("other.yaml", std::string(stand_for) + "    timeout: {after: 9 s, goto: done}\n");
    write("scene.yaml", "zwang_scene: 1\nrobots: {other: {task: other.yaml, at: [3 m, 0 m]}}\n");
  }
};

TEST_F(Partners, EachLeavesALogThatReplays) {
  const Result r = zwang({"run", "task.yaml", "--scene", "scene.yaml", "--log", "log", "--format", "json"});
  ASSERT_EQ(r.code, 0) << r.out << r.err;
  const json report = json::parse(r.out);
  EXPECT_EQ(report["outcome"], "done");
  EXPECT_EQ(report["robots"]["other"]["outcome"], "unfinished") << "the first robot's end is the run's";
  for (const char* log : {"log/log.mcap", "log/log-other.mcap"}) {
    const Result again = zwang({"replay", log, "--format", "json"});
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    const json replayed = json::parse(again.out);
    EXPECT_GE(replayed["records"], 1000);
    EXPECT_EQ(replayed["equal"], replayed["records"]) << log;
  }
}

TEST_F(Partners, ATaskFileWithAMistakeIsToldByItsOwnPlace) {
  write("other.yaml", std::string(stand_for) + "    timeout: {after: 9 kg, goto: done}\n");
  const Result r = zwang({"run", "task.yaml", "--scene", "scene.yaml", "--log", "log"});
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("other.yaml:7:"), std::string::npos) << r.err;
  EXPECT_FALSE(fs::exists(folder_ / "log")) << "nothing ran";
}

}  // namespace
}  // namespace zwang
