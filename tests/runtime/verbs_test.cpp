// The verbs that do not run anything, as their users meet them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read;
using test::Result;

const fs::path source = ZWANG_SOURCE_DIR;
const fs::path specs_folder = source / "specs";
const fs::path conformance = source / "tests/conformance";

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

class Verbs : public test::Program {
 protected:
  /// A task beside the small robot of the golden suite.
  std::string task(const std::string& name, const std::string& text) {
    fs::create_directories(folder_ / "robots");
    for (const char* file : {"robots/mini.yaml", "robots/mini.urdf"}) {
      fs::copy_file(conformance / file, folder_ / file, fs::copy_options::overwrite_existing);
    }
    return write(name, text).string();
  }
  std::string endless() { return task("endless.yaml", read(conformance / "W503_endless.yaml")); }
};

TEST_F(Verbs, AMistypedVerbIsAnsweredWithTheOneThatWasMeant) {
  const Result r = zwang({"runn", "wall_align.yaml"});
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(contains(r.err, "did you mean `zwang run`?")) << r.err;
  EXPECT_TRUE(contains(zwang({"xyzzy"}).err, "no verb `xyzzy`\n"));
  const Result of_robot = zwang({"robot", "inpsect", "x"});
  EXPECT_EQ(of_robot.code, 2);
  EXPECT_TRUE(contains(of_robot.err,
                       "no verb `inpsect` of `zwang robot`; did you mean `zwang robot inspect`?\n"
                       "Try `zwang robot --help`."))
      << of_robot.err;
}

TEST_F(Verbs, AUrdfIsNoTaskFile) {
  const std::string urdf = (specs_folder / "robots/diff_base.urdf").string();
  for (const char* verb : {"run", "plan", "graph", "validate"}) {
    const Result r = zwang({verb, urdf});
    EXPECT_EQ(r.code, 2) << verb;
    EXPECT_TRUE(contains(r.err, "is a URDF")) << r.err;
    EXPECT_TRUE(contains(r.err, "`zwang robot init " + urdf + " -o diff_base.yaml`")) << r.err;
  }
}

TEST_F(Verbs, AShippedScenarioIsFoundByItsName) {
  const Result mistyped = zwang({"test", "pushde"});
  EXPECT_EQ(mistyped.code, 2);
  EXPECT_TRUE(contains(mistyped.err, "did you mean `pushed`")) << mistyped.err;
  const Result r = zwang({"test", "docking_already", "--format", "json"});
  EXPECT_EQ(json::parse(r.out)["scenarios"][0]["file"],
            (specs_folder / "scenarios/docking_already.yaml").string());
}

TEST_F(Verbs, AShippedTaskIsFoundByItsName) {
  const Result r = zwang({"plan", "wall_align", "--format", "json"});
  EXPECT_EQ(r.code, 0) << r.err;
  const Result mistyped = zwang({"plan", "wall_alihn"});
  EXPECT_EQ(mistyped.code, 2);
  EXPECT_TRUE(contains(mistyped.err, "did you mean `wall_align`")) << mistyped.err;
  // A file of the user's is the user's.
  write("wall_align", "zwang: 1\n");
  EXPECT_EQ(zwang({"plan", "wall_align"}).code, 1);
}

TEST_F(Verbs, InitMakesAFolderThatRuns) {
  Result r = zwang({"init", "mine"});
  ASSERT_EQ(r.code, 0) << r.err;
  r = zwang({"validate", "mine", "--deny", "warnings"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  r = zwang({"test", "mine/scenarios"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  for (const char* kind : {"task", "robot", "scene", "scenario"})
    EXPECT_EQ(read(folder_ / "mine/schemas" / (std::string(kind) + ".json")), zwang({"schema", kind}).out);
  EXPECT_TRUE(json::accept(read(folder_ / "mine/.vscode/settings.json")));
  r = zwang({"init", "mine"});
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(contains(r.err, "is there already")) << r.err;
}

TEST_F(Verbs, OnAFullDiskInitLeavesNoHalfFolder) {
  fs::create_directory(folder_ / "empty");
  for (const char* folder : {"new", "empty"}) {
    const test::FullDisk full(4096);
    const Result refused = zwang({"init", folder});
    EXPECT_EQ(refused.code, 2) << refused.out;
  }
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  EXPECT_TRUE(fs::is_empty(folder_ / "empty"));
  EXPECT_EQ(zwang({"init", "new"}).code, 0);
}

TEST_F(Verbs, DoctorSaysWhatIsThere) {
  const Result r = zwang({"doctor"});
  EXPECT_EQ(r.code, 0) << r.err;
  for (const char* subject : {"zwang ", "MuJoCo ", "real-time priority", "locked memory", "shipped files",
                              "page of a run", "Python module", "ROS 2 topics (DDS)", "node", "Chromium"})
    EXPECT_TRUE(contains(r.out, subject)) << r.out;
  EXPECT_TRUE(contains(r.out, specs_folder.string())) << r.out;
  // The line after a missing program has the command that installs it.
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  const Result poor = zwang({"doctor"});
  setenv("PATH", path.c_str(), 1);
  for (const char* package : {"nodejs", "chromium", "graphviz"})
    EXPECT_TRUE(contains(poor.out, std::string("-> `apt install ") + package)) << poor.out;
}

TEST_F(Verbs, ValidateReadsFolders) {
  Result r = zwang({"validate", specs_folder.string(), "--format", "json"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  const json files = json::parse(r.out)["files"];
  std::size_t shipped = 0;
  for (const auto& file : fs::recursive_directory_iterator(specs_folder)) {
    shipped += file.path().extension() == ".yaml" ? 1u : 0u;
  }
  EXPECT_EQ(files.size(), shipped);
  for (const json& file : files) EXPECT_EQ(file["ok"], true) << file;
}

TEST_F(Verbs, ValidatePassesOverWhatIsNotOursInAFolder) {
  endless();
  write("compose.yaml", "services: {}\n");
  const Result r = zwang({"validate", ".", "--format", "json"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  EXPECT_EQ(json::parse(r.out)["files"].size(), 2u) << r.out;  // the task and its robot
}

/// A folder of links, as a build system or a package manager leaves it. A loop of them ends.
TEST_F(Verbs, ValidateFollowsLinksInAFolder) {
  endless();
  fs::create_directories(folder_ / "linked");
  fs::create_directory_symlink(folder_ / "robots", folder_ / "linked/robots");
  fs::create_symlink(folder_ / "endless.yaml", folder_ / "linked/task.yaml");
  fs::create_directory_symlink(folder_ / "linked", folder_ / "linked/loop");
  fs::create_symlink("nowhere", folder_ / "linked/broken.yaml");
  Result r = zwang({"validate", "linked", "--format", "json"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  json files = json::parse(r.out)["files"];
  ASSERT_EQ(files.size(), 2u) << r.out;
  EXPECT_EQ(files[0]["file"], "linked/robots/mini.yaml");
  EXPECT_EQ(files[1]["file"], "linked/task.yaml");
  r = zwang({"validate", ".", "--format", "json"});
  files = json::parse(r.out)["files"];
  ASSERT_EQ(files.size(), 2u) << "each file once: " << r.out;
  EXPECT_EQ(files[0]["file"], "./endless.yaml") << "by its own name";
}

TEST_F(Verbs, DeniedWarningsRefuseTheFile) {
  const std::string file = endless();
  Result r = zwang({"validate", file});
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(contains(r.out, "warning W503")) << r.out;
  EXPECT_TRUE(contains(r.out, "endless.yaml: good")) << r.out;
  r = zwang({"validate", file, "--deny", "warnings"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.out, "endless.yaml: 0 errors, 1 warning")) << r.out;
  EXPECT_EQ(zwang({"validate", file, "--deny", "everything"}).code, 2);
}

TEST_F(Verbs, ValidateTakesWhatRunAndPlanTake) {
  const std::string file = (specs_folder / "wall_align.yaml").string();
  EXPECT_EQ(zwang({"validate", file, "-p", "push=30 N"}).code, 0);
  Result r = zwang({"validate", file, "-p", "push=200 N"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.out, "error E204: ")) << r.out;
  // The same words, in the same place.
  const Result of_plan = zwang({"plan", file, "-p", "push=200 N"});
  EXPECT_EQ(of_plan.code, 1);
  EXPECT_EQ(r.out, of_plan.out + file + ": 1 error\n");
  r = zwang({"validate", file, "-p", "psuh=30 N"});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.out, "did you mean `push`?")) << r.out;

  const std::string skid = (specs_folder / "robots/skid_base.yaml").string();
  r = zwang({"validate", file, "--robot", (specs_folder / "robots/omni_base.yaml").string()});
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(contains(r.out, "omni")) << r.out;
  EXPECT_EQ(zwang({"graph", file, "--robot", skid, "-p", "push=200 N"}).code, 1);
  EXPECT_EQ(zwang({"validate", file, "--robot", "no_such.yaml"}).code, 2);
  EXPECT_EQ(zwang({"plan", file, "--robot", "no_such.yaml"}).code, 2);
  r = zwang({"validate", skid, "-p", "push=30 N"});
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(contains(r.err, "for task files")) << r.err;
}

TEST_F(Verbs, ValidateKnowsARobotForAScene) {
  const std::string scene = (specs_folder / "scenes/dock.yaml").string();
  EXPECT_EQ(zwang({"validate", scene, "--robot", (specs_folder / "robots/mecanum_base.yaml").string()}).code,
            0);
  const std::string mini = (fs::path(ZWANG_SOURCE_DIR) / "tests/conformance/robots/mini.yaml").string();
  const Result r = zwang({"validate", scene, "--robot", mini});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.out, "error E301: no frame of the robot named `hook`")) << r.out;
  EXPECT_EQ(zwang({"validate", scene, "-p", "push=30 N"}).code, 2);
}

TEST_F(Verbs, AnAllowedWarningIsNotDenied) {
  const std::string file = task("allowed.yaml", read(conformance / "ok_allowed.yaml"));
  const Result r = zwang({"validate", file, "--deny", "warnings"});
  EXPECT_EQ(r.code, 0) << r.out;
}

TEST_F(Verbs, ValidateSpeaksShortAndSarif) {
  const std::string file = endless();
  Result r = zwang({"validate", file, "--format", "short"});
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(contains(r.out, "endless.yaml:5:3: warning W503: ")) << r.out;
  EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 1) << r.out;
  r = zwang({"validate", file, (specs_folder / "robots").string(), "--format", "sarif"});
  EXPECT_EQ(r.code, 0);
  const json log = json::parse(r.out);
  EXPECT_EQ(log["version"], "2.1.0");
  ASSERT_EQ(log["runs"].size(), 1u);
  EXPECT_EQ(log["runs"][0]["results"][0]["ruleId"], "W503");
}

TEST_F(Verbs, ExplainSaysWhatACodeMeans) {
  Result r = zwang({"explain", "E201"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out.find("error E201: a number without a unit\n"), 0u) << r.out;
  r = zwang({"explain", "w503", "E405", "--markdown"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out, read(source / "docs/errors/W503.md") + "\n" + read(source / "docs/errors/E405.md"));
  r = zwang({"explain", "--all"});
  EXPECT_EQ(r.code, 0);
  std::size_t pages = 0;
  for (const auto& page : fs::directory_iterator(source / "docs/errors")) {
    const std::string code = page.path().stem().string();
    if (code == "README") continue;
    EXPECT_TRUE(contains("\n" + r.out, "\n" + code + "  ")) << code;
    ++pages;
  }
  EXPECT_EQ(static_cast<std::size_t>(std::count(r.out.begin(), r.out.end(), '\n')), pages);
  r = zwang({"explain", "E000"});
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(contains(r.err, "no code `E000`")) << r.err;
  EXPECT_EQ(zwang({"explain"}).code, 2);
}

const char* const untidy =
    "zwang: 1\nrobot:   robots/mini.yaml\nstart: go\ntasks:\n    go:   # drive\n      constraints:\n"
    "         drive: {move: base_link,in: base_link, x: {velocity: 0.1 m/s}}\n      timeout: {after: 3 s, "
    "goto: done}\n";
const char* const tidy =
    "zwang: 1\nrobot: robots/mini.yaml\nstart: go\ntasks:\n  go:  # drive\n    constraints:\n"
    "      drive: {move: base_link, in: base_link, x: {velocity: 0.1 m/s}}\n    timeout: {after: 3 s, goto: "
    "done}\n";

TEST_F(Verbs, FmtWritesTheLayoutInOneStep) {
  const fs::path file = task("task.yaml", untidy);
  fs::permissions(file, fs::perms::owner_all | fs::perms::group_read);
  fs::create_symlink("task.yaml", folder_ / "link.yaml");
  Result r = zwang({"fmt", "--check", file.string()});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.out, "task.yaml: would be laid out anew")) << r.out;
  EXPECT_EQ(read(file), untidy);
  r = zwang({"fmt", (folder_ / "link.yaml").string()});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(read(file), tidy);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.yaml"));
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_all | fs::perms::group_read);
  r = zwang({"fmt", "--check", file.string()});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out, "");
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) files += entry.is_directory() ? 0u : 1u;
  EXPECT_EQ(files, 4u) << "task, link, out, err";
}

TEST_F(Verbs, FmtLeavesFilesWithErrorsAlone) {
  const std::string bad = std::string(untidy) + "strat: go\n";
  const std::string file = task("task.yaml", bad);
  const Result r = zwang({"fmt", file});
  EXPECT_EQ(r.code, 1);
  EXPECT_TRUE(contains(r.out, "error E101")) << r.out;
  EXPECT_TRUE(contains(r.out, "task.yaml: left as it is")) << r.out;
  EXPECT_EQ(read(file), bad);
}

TEST_F(Verbs, SchemaPrintsEveryKind) {
  for (const char* kind : {"task", "robot", "scene", "scenario", "connection", "study"}) {
    const Result r = zwang({"schema", kind});
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(r.out, read(specs_folder / "schemas" / (std::string(kind) + ".json"))) << kind;
    EXPECT_EQ(json::parse(r.out)["$schema"], "http://json-schema.org/draft-07/schema#");
  }
  EXPECT_EQ(zwang({"schema"}).out, read(specs_folder / "schemas/task.json"));
  EXPECT_EQ(zwang({"schema", "robots"}).code, 2);
  // The words that may stand there, and where to read about this verb.
  EXPECT_EQ(zwang({"schema", "robots"}).err,
            "zwang: kind: robots not in {connection,robot,scenario,scene,study,task}\nTry `zwang schema "
            "--help`.\n");
  EXPECT_EQ(zwang({"robot", "inspect"}).err, "zwang: file is required\nTry `zwang robot inspect --help`.\n");
}

TEST_F(Verbs, GraphDrawsEveryWay) {
  const fs::path graphs = source / "tests/runtime/graphs";
  const std::string file = task("ways.yaml", read(graphs / "ways.yaml"));
  for (const auto& [format, ending] : {std::pair{"dot", ".dot"}, {"mermaid", ".mmd"}}) {
    const Result r = zwang({"graph", file, "--format", format});
    EXPECT_EQ(r.code, 0) << r.err;
    const fs::path expected = graphs / (std::string("ways") + ending);
    if (std::getenv("ZWANG_WRITE_EXPECTED") != nullptr) std::ofstream(expected) << r.out;
    EXPECT_EQ(r.out, read(expected));
  }
  const Result r = zwang({"graph", task("bad.yaml", "zwang: 1\n")});
  EXPECT_EQ(r.code, 1);
  EXPECT_EQ(r.out, "");
  EXPECT_TRUE(contains(r.err, "error E103")) << r.err;
}

}  // namespace
}  // namespace zwang
