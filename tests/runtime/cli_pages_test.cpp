// The data of the pages that compare two runs, and that show a whole matrix. tests/web has them in a browser.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read;
using test::Result;

constexpr const char* mark = "zwang-data-goes-here";

/// A program whose page has no parts but its data.
class Pages : public test::Program {
 protected:
  Pages() {
    fs::create_directories(folder_ / "installed/bin");
    fs::create_directories(folder_ / "installed/share/zwang/web");
    fs::copy_file(ZWANG_PROGRAM, folder_ / "installed/bin/zwang");
    write("installed/share/zwang/web/report.html", std::string("<") + mark + ">");
    fs::copy(fs::path(ZWANG_SOURCE_DIR) / "specs/robots", folder_ / "robots", fs::copy_options::recursive);
    write("scene.yaml",
          "zwang_scene: 1\nobjects: {crate: {box: [1 m, 1 m, 1 m], at: [3 m, 0 m], mass: 20 kg}}\n");
    write("go.yaml", task("0.3 m/s"));
  }
  static std::string task(const std::string& speed) {
    return R"(zwang: 1
robot: robots/mecanum_base.yaml
scene: scene.yaml
start: go
params: {speed: )" +
           speed + R"(, after: {value: 0.2 s, range: [0.1 s, 1 s]}}
tasks:
  go:
    constraints: {move: {move: base_link, in: base_link, x: {velocity: $speed}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    timeout: {after: $after, goto: done}
)";
  }
  Result run(const std::vector<std::string>& arguments) {
    std::string line = "exec installed/bin/zwang";
    for (const std::string& one : arguments) line += " '" + one + "'";
    return finish(start_shell(line));
  }
  pid_t start_shell(const std::string& line) {
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(folder_.c_str()) != 0) _exit(99);
    const std::string whole = line + " >out 2>err";
    execl("/bin/sh", "sh", "-c", whole.c_str(), nullptr);
    _exit(98);
  }
  json data_of(const std::string& page) {
    const std::string text = read(folder_ / page);
    if (text.size() < 2) return nullptr;
    return json::parse(text.substr(1, text.size() - 2), nullptr, false);
  }
};

TEST_F(Pages, CompareSaysWhatDiffersBeforeTheStartAndThen) {
  ASSERT_EQ(run({"run", "go.yaml", "--log", "a", "--quiet"}).code, 0) << read(folder_ / "err");
  write("go.yaml", task("0.25 m/s"));
  ASSERT_EQ(run({"run", "go.yaml", "--log", "b", "--quiet", "--seed", "7", "-p", "after=0.3 s"}).code, 0);
  const Result r = run({"report", "a", "--compare", "b"});
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out, "a/compare.html\n");
  const json page = data_of("a/compare.html");
  ASSERT_TRUE(page.is_object());
  ASSERT_EQ(page["runs"].size(), 2u);
  const json& comparison = page["comparison"];
  std::map<std::string, std::pair<std::string, std::string>> facts;
  for (const json& fact : comparison["facts"])
    facts[fact["name"]] = {fact["first"].is_null() ? "" : fact["first"],
                           fact["second"].is_null() ? "" : fact["second"]};
  EXPECT_EQ(facts["seed"], (std::pair<std::string, std::string>("0", "7"))) << comparison["facts"];
  EXPECT_TRUE(facts.contains("params.speed") && facts.contains("params.after"));
  EXPECT_FALSE(facts.contains("zwang")) << "the version is the same";
  // The file of the task, from the line on that is another one.
  ASSERT_EQ(comparison["files"].size(), 1u) << comparison["files"];
  const json& file = comparison["files"][0];
  EXPECT_EQ(file["line"], 5);
  EXPECT_NE(file["first_lines"][0].get<std::string>().find("0.3 m/s"), std::string::npos);
  EXPECT_NE(file["second_lines"][0].get<std::string>().find("0.25 m/s"), std::string::npos);
  // The parameter is an input of the first record: what is computed from it stands behind.
  EXPECT_EQ(comparison["columns"][0]["input"], true) << comparison["columns"][0];
  EXPECT_EQ(comparison["columns"][0]["time"], 0.0);
  EXPECT_EQ(comparison["columns"][0]["first"], "0.3");
  EXPECT_EQ(comparison["columns"][0]["second"], "0.25");
  EXPECT_EQ(comparison["transitions"]["differs"], 1) << comparison["transitions"];
  EXPECT_TRUE(comparison["events"]["differs"].is_null());
}

TEST_F(Pages, CompareOfARunWithItselfFindsNothing) {
  ASSERT_EQ(run({"run", "go.yaml", "--log", "a", "--quiet"}).code, 0);
  ASSERT_EQ(run({"run", "go.yaml", "--log", "b", "--quiet"}).code, 0);
  ASSERT_EQ(run({"report", "a", "--compare", "b", "-o", "both.html"}).code, 0);
  const json comparison = data_of("both.html")["comparison"];
  for (const char* list : {"facts", "files", "columns", "only_first", "only_second"})
    EXPECT_TRUE(comparison[list].empty()) << list << comparison[list];
  EXPECT_TRUE(comparison["transitions"]["differs"].is_null());
  EXPECT_GT(comparison["compared"].get<int>(), 200);
}

// The records of a run whose samples stay away repeat the time of the last one. The report has the true
// times.
TEST_F(Pages, TellEventsAtTheTimesOfTheReport) {
  write("scene.yaml", "zwang_scene: 1\nfaults: [{at: 0.1 s, samples: lost}]\n");
  EXPECT_EQ(run({"run", "go.yaml", "--log", "a", "--quiet"}).code, 1);
  EXPECT_EQ(run({"run", "go.yaml", "--log", "b", "--quiet"}).code, 1);
  ASSERT_EQ(run({"report", "a", "-o", "a.html"}).code, 0);
  ASSERT_EQ(run({"report", "a", "--compare", "b", "-o", "both.html"}).code, 0);
  const json page = data_of("a.html"), compared = data_of("both.html")["comparison"]["events"]["first"];
  const json& told = page["report"]["events"];
  ASSERT_GT(told.size(), 1u);
  ASSERT_EQ(page["events"].size(), told.size());
  ASSERT_EQ(compared.size(), told.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(page["events"][i]["time"], told[i]["time"]);
    EXPECT_EQ(compared[i]["time"], told[i]["time"].get<double>() - page["begin"].get<double>());
  }
  EXPECT_GT(told.back()["time"], page["end"]) << "no record has this time";
}

/// Two cells that hold, and one whose motor is lost: it is missed, and comes first.
class MatrixPages : public Pages {
 protected:
  MatrixPages() {
    write("many.yaml", R"(zwang_scenario: 1
task: go.yaml
faults: {lost: [{at: 0 s, wheel: front_left_wheel, torque: lost}]}
matrix:
  params.speed: [0.1 m/s, 0.3 m/s]
  faults: [none, lost]
expect:
  - outcome: done
  - {at: end, that: abs(truth.base.yaw) < 0.5 deg}
)");
  }
};

TEST_F(MatrixPages, HaveTheWorstRunFirstAndTheCommandThatRepeatsIt) {
  const Result r = run({"test", "many.yaml", "--report"});
  EXPECT_EQ(r.code, 1) << r.out << r.err;
  EXPECT_NE(r.out.find("page   test-report.html\n"), std::string::npos) << r.out;
  const json page = data_of("test-report.html");
  ASSERT_EQ(page["cells"].size(), 4u) << r.out;
  const json &worst = page["cells"][0], &best = page["cells"][3];
  EXPECT_EQ(worst["passed"], false);
  EXPECT_EQ(best["passed"], true);
  double last = -1e300;
  for (const json& cell : page["cells"]) {
    if (cell["passed"] != worst["passed"]) break;
    EXPECT_GE(cell["worst"].is_null() ? last : cell["worst"].get<double>(), last);
    last = cell["worst"].is_null() ? last : cell["worst"].get<double>();
  }
  EXPECT_EQ(worst["expectations"][0]["held"], false) << "what was missed comes first";
  EXPECT_FALSE(worst["story"]["transitions"].empty());
  EXPECT_FALSE(worst["story"]["limits"].empty());
  EXPECT_GT(worst["story"]["path"].size(), 30u);
  // The command, as a shell takes it, repeats the run to the last tick.
  std::string command = worst["command"];
  ASSERT_TRUE(command.starts_with("zwang run many.yaml --cell '")) << command;
  command = "exec installed/bin/" + command + " --format json --log again";
  const Result again = finish(start_shell(command));
  const json report = json::parse(again.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << command << again.out << again.err;
  EXPECT_EQ(report["outcome"], worst["outcome"]);
  EXPECT_NEAR(report["elapsed"].get<double>(), worst["simulated"].get<double>(), 1.5e-3);
  const json& path = worst["story"]["path"];
  EXPECT_NEAR(report["truth"]["base"]["x"].get<double>(), path[path.size() - 3].get<double>(), 1e-3);
  EXPECT_NEAR(report["truth"]["base"]["yaw"].get<double>(), path[path.size() - 1].get<double>(), 1e-3);
  EXPECT_TRUE(fs::exists(folder_ / "again/report.html"));
}

TEST_F(MatrixPages, NeedsACellThatIsThere) {
  const Result none = run({"run", "many.yaml"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("a scenario of 4 runs; choose one:"), std::string::npos) << none.err;
  const Result misspelt = run({"run", "many.yaml", "--cell", "speed 0.1 m/s, faults nne"});
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_NE(misspelt.err.find("did you mean `"), std::string::npos) << misspelt.err;
  EXPECT_EQ(run({"run", "go.yaml", "--cell", "x"}).code, 2);
  EXPECT_EQ(run({"run", "many.yaml", "--cell", "x", "--seed", "3"}).code, 2);
  EXPECT_EQ(run({"test", "many.yaml", "-o", "page.html"}).code, 2) << "a page that nobody asked for";
}

}  // namespace
}  // namespace zwang
