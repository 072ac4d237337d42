// Validating anything ends within 2 s of processor time and 256 MB, and leaves no file behind.
#include <sys/resource.h>
#include <sys/wait.h>

#include <functional>
#include <set>

#include "../many_axes.hpp"
#include "../times_count.hpp"
#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;

const fs::path specs = fs::path(ZWANG_SOURCE_DIR) / "specs";

constexpr std::size_t most_bytes = 256 * 1024;

std::string number(int i) {
  return std::to_string(i);
}

std::string repeated(int count, const std::function<std::string(int)>& piece) {
  std::string text;
  for (int i = 0; i < count; ++i) text += piece(i);
  return text;
}

const std::string head = "zwang: 1\nrobot: robots/mecanum_arm_base.yaml\nstart: t0\n";
const std::string end = "    timeout: {after: 9 s, goto: failed}\n";

/// As many groups as may stand in a task, each in axes of its own, in as many tasks as fit.
std::string axes_everywhere() {
  std::string text = head + "frames:\n" + repeated(400, [](int i) {
                       return "  f" + number(i) + ": {parent: base_link, at: [" + number(i) +
                              " mm, 0 m], yaw: " + number(i) + " deg}\n";
                     });
  text += "tasks:\n";
  for (int t = 0; text.size() + 4000 < most_bytes && t < 100; ++t) {
    text += "  t" + number(t) + ":\n    constraints:\n" +
            repeated(32,
                     [&](int g) {
                       const std::string frame = "f" + number((t * 32 + g) % 400);
                       return "      g" + number(g) + ": {move: " + frame + ", in: " + frame +
                              ", x: {force: 3 N, acceleration: +-1 m/s^2}, level: 3}\n";
                     }) +
            "    timeout: {after: 9 s, goto: " + (t == 0 ? "t1" : "failed") + "}\n";
  }
  return text;
}

/// A distance is looked at in many directions, on an arm in many configurations.
std::string distances() {
  return head + "frames:\n" +
         repeated(300,
                  [](int i) {
                    return "  f" + number(i) + ": {parent: base_link, at: [" + number(i) + " mm, 0.1 m]}\n";
                  }) +
         "features:\n" +
         repeated(300,
                  [](int i) { return "  d" + number(i) + ": {distance: [f" + number(i) + ", world]}\n"; }) +
         "tasks:\n" + repeated(10, [](int t) {
           return "  t" + number(t) + ":\n    constraints:\n" +
                  repeated(30,
                           [&](int g) {
                             return "      g" + number(g) + ": {feature: d" + number(t * 30 + g) +
                                    ", force: -3 N, acceleration: +-1 m/s^2, level: " + number(1 + g % 9) +
                                    "}\n";
                           }) +
                  end;
         });
}

/// A polygon of thousands of corners: whether its edges cross is asked of all pairs.
std::string corners() {
  std::string text = head + "regions:\n  hall:\n    polygon:\n";
  for (int i = 0; i < 2400; ++i) text += "      - [" + number(i) + " m, " + number((i % 2) * 5000) + " mm]\n";
  text += "      - [9 m, 9 km]\n";
  return text + "tasks:\n  t0:\n    constraints: {stay: {move: footprint, inside: hall}}\n" + end;
}

/// Conditions as long as a value may be, and as deep as they may be.
std::string conditions() {
  std::string deep = std::string(31, '(') + "elapsed" + std::string(31, ')') + " > 1 s";
  while (deep.size() + 60 < 4000) deep += " or elapsed * 2 - 1 s > 2 s and not elapsed < 1 s";
  std::string text = head + "tasks:\n  t0:\n    exits:\n";
  while (text.size() + 4200 < most_bytes) text += "      - {goto: done, when: " + deep + "}\n";
  return text + end;
}

/// Names that are nearly those of hundreds of others: the nearest is looked for each time.
std::string misspelt_names() {
  std::string text = head + "params:\n" +
                     repeated(1500, [](int i) { return "  a_rather_long_name_" + number(i) + ": 1 m/s\n"; }) +
                     "tasks:\n";
  for (int t = 0; text.size() + 400 < most_bytes && t < 250; ++t) {
    text += "  t" + number(t) + ":\n    constraints:\n" +
            repeated(3,
                     [&](int g) {
                       return "      g" + number(g) +
                              ": {move: base_link, in: base_link, x: {velocity: $a_rather_long_nmae_" +
                              number(g + t) + "}}\n";
                     }) +
            end;
  }
  return text;
}

std::string brackets() {
  return head + "about: " + repeated(600, [](int) { return std::string("[[[[[[[[[[]]]]]]]]]], "); }) + "\n";
}

std::string chained_urdf() {
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"r\"><link name=\"base_link\"/>";
  const std::string body =
      "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" "
      "iyz=\"0\"/></inertial>";
  for (int i = 1; i < 256; ++i) {
    text += "<link name=\"l" + number(i) + "\">" + body + "</link><joint name=\"j" + number(i) +
            "\" type=\"continuous\"><axis xyz=\"0 1 0\"/><parent link=\"" +
            (i == 1 ? std::string("base_link") : "l" + number(i - 1)) + "\"/><child link=\"l" + number(i) +
            "\"/></joint>\n";
  }
  return text + std::string(4 * 1024 * 1024 - text.size() - 9, ' ') + "</robot>\n";
}

struct Load {
  std::string name;
  std::function<std::string()> make;
};

void PrintTo(const Load& load, std::ostream* out) {
  *out << load.name;
}

class Means : public test::Program {
 protected:
  struct Spent {
    int code = -1;
    double seconds = 0.0;    ///< of processor time
    double megabytes = 0.0;  ///< at most, at any time
  };
  Spent spent_on(const std::vector<std::string>& arguments) {
    const pid_t child = start(arguments);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
            seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024.0};
  }
  std::set<fs::path> files() const {
    std::set<fs::path> all;
    for (const auto& file : fs::recursive_directory_iterator(folder_)) all.insert(file.path());
    return all;
  }
  void expect_modest(const std::vector<std::string>& arguments) {
    std::set<fs::path> before = files();
    const Spent spent = spent_on(arguments);
    EXPECT_TRUE(spent.code == 0 || spent.code == 1) << spent.code;
    if (test::times_count) {
      EXPECT_LT(spent.seconds, 2.0);
      EXPECT_LT(spent.megabytes, 256.0);
    }
    before.insert({folder_ / "out", folder_ / "err"});
    EXPECT_EQ(files(), before);
  }
};

class MeansFor : public Means, public testing::WithParamInterface<Load> {
 protected:
  MeansFor() = default;
};

TEST_P(MeansFor, ValidatingIsModest) {
  fs::copy(specs / "robots", folder_ / "robots");
  const std::string text = GetParam().make();
  ASSERT_LE(text.size(), most_bytes);
  expect_modest({"validate", write("task.yaml", text).string(), "--notes"});
}

INSTANTIATE_TEST_SUITE_P(Of, MeansFor,
                         testing::Values(Load{"Axes", axes_everywhere}, Load{"Distances", distances},
                                         Load{"Corners", corners}, Load{"Conditions", conditions},
                                         Load{"Names", misspelt_names}, Load{"Brackets", brackets}),
                         [](const auto& test_case) { return test_case.param.name; });

TEST_F(Means, ForALongChainOfLinks) {
  write("r.urdf", chained_urdf());
  const std::string stop = "stop: {deceleration: 1 m/s^2, force: 50 N}\n";
  const fs::path robot = write(
      "r.yaml", "zwang_robot: 1\nurdf: r.urdf\nbase: base_link\nwheels: [{joint: j1, radius: 0.1 m}]\n" +
                    stop + "footprint: {polygon: [[0.3 m, 0.2 m], [-0.3 m, 0 m], [0.3 m, -0.2 m]]}\n");
  expect_modest({"validate", robot.string()});
  expect_modest({"robot", "inspect", (folder_ / "r.urdf").string()});
}

TEST_F(Means, ForAnArmOfHundredsOfJoints) {
  fs::copy(specs / "robots", folder_ / "robots");
  std::string urdf = test::read(specs / "robots/mecanum_base.urdf");
  urdf.insert(urdf.rfind("</robot>"), test::long_arm(200));
  write("robots/mecanum_base.urdf", urdf);
  const std::string task = test::tasks_along_axes("robots/mecanum_base.yaml", 250);
  expect_modest({"validate", write("task.yaml", task).string(), "--notes"});
}

TEST_F(Means, ForAScenarioOfManyCells) {
  fs::copy(specs / "robots", folder_ / "robots");
  const auto of_each = [](const std::string& before, const std::string& behind) {
    return repeated(9, [&](int i) { return before + number(i) + behind; });
  };
  write("task.yaml",
        test::tasks_along_axes("robots/mecanum_base.yaml", 1, "params:\n" + of_each("  p", ": 1 m\n")));
  const std::string matrix = "matrix:\n" + of_each("  params.p", ": [1 m, 2 m]\n");
  expect_modest({"validate", write("scenario.yaml",
                                   "zwang_scenario: 1\ntask: task.yaml\nexpect: [{outcome: done}]\n" + matrix)
                                 .string()});
}

}  // namespace
}  // namespace zwang
