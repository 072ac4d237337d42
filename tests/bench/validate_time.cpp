// How long `zwang validate` takes as a whole process, beside one that links the same libraries and reads the
// same files with them: task, robot and scene with yaml-cpp, the robot's description with urdfdom. Both take
// turns in one run, and of each the fastest counts: what else the machine does only adds. The bounds are 1.6
// for a task file of some 60 lines and 10 for one of 256 KiB. Instructions, by callgrind, stand beside, and
// tell how the work grows with the number of tasks.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "count_instructions.hpp"

namespace {

namespace fs = std::filesystem;

/// [s] of a process from its start to its end; it must succeed.
double time_of(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    std::fprintf(stderr, "%s failed\n", words[0].c_str());
    std::exit(2);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// `files`: the task file first, then those that it names.
bool compare(const std::string& what, const std::vector<fs::path>& files, int turns, double bound) {
  std::vector<std::string> reader{ZWANG_READ_YAML};
  std::string command;
  for (const fs::path& file : files) reader.push_back(file.string());
  for (const std::string& word : reader) command += "'" + word + "' ";
  const std::vector<std::string> validator{ZWANG_PROGRAM, "validate", files.front().string()};
  double validate = 1e9, read = 1e9;
  for (int i = 0; i < turns; ++i) {
    read = std::min(read, time_of(reader));
    validate = std::min(validate, time_of(validator));
  }
  const bool is_good = validate <= bound * read;
  std::printf("%-22s validate %7.2f ms, the libraries alone %7.2f ms, ratio %5.2f of %g%s", what.c_str(),
              1e3 * validate, 1e3 * read, validate / read, bound, is_good ? ", pass" : ", MISSED");
  const auto ours =
      zwang::bench::count_instructions("'" ZWANG_PROGRAM "' validate '" + validator.back() + "'");
  const auto theirs = zwang::bench::count_instructions(command);
  if (ours && theirs) std::printf("; %.1f M and %.1f M instructions", 1e-6 * *ours, 1e-6 * *theirs);
  std::printf("\n");
  return is_good;
}

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The task file with `count` more tasks like its own, one after the other.
std::string with_more_tasks(const std::string& head, int count) {
  std::string text = head;
  for (int i = 0; i < count; ++i) {
    const std::string next = i + 1 == count ? "done" : "more" + std::to_string(i + 1);
    text += "  more" + std::to_string(i) +
            ":\n    constraints:\n      go: {move: base_link, in: base_link, x: {velocity: 0.1 m/s, "
            "acceleration: +-0.3 "
            "m/s^2}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}\n    exits:\n      - {when: "
            "abs(go.x.velocity) < 5 mm/s "
            "and moved(base_link) > 2 cm, for: 0.2 s, goto: failed}\n    timeout: {after: 20 s, goto: " +
            next + "}\n";
  }
  return text;
}

/// As many tasks as 256 KiB and 20 000 nodes hold, and comments up to the size.
std::string large(const std::string& head) {
  std::string text = with_more_tasks(head, 240);
  constexpr std::size_t size = 256 * 1024;
  while (text.size() + 200 < size) text += "# " + std::string(97, '-') + "\n";
  return text;
}

/// Instructions over tasks, from 100 to 250, on a double logarithmic scale. True without valgrind, too.
bool grows_evenly(const std::string& head, const fs::path& folder) {
  constexpr double few = 100.0, many = 250.0, most = 1.05;
  std::optional<double> counts[2];
  for (int i = 0; i < 2; ++i) {
    const fs::path file = folder / "tasks.yaml";
    std::ofstream(file) << with_more_tasks(head, static_cast<int>(i == 0 ? few : many) - 2);
    counts[i] = zwang::bench::count_instructions("'" ZWANG_PROGRAM "' validate '" + file.string() + "'");
    if (!counts[i]) return true;
  }
  const double exponent = std::log(*counts[1] / *counts[0]) / std::log(many / few);
  std::printf("%g tasks %.0f M instructions, %g tasks %.0f M: exponent %.2f of %g%s\n", few,
              1e-6 * *counts[0], many, 1e-6 * *counts[1], exponent, most,
              exponent <= most ? ", pass" : ", MISSED");
  return exponent <= most;
}

}  // namespace

int main() {
  const fs::path specs = fs::path(ZWANG_SOURCE_DIR) / "specs";
  const fs::path folder = fs::temp_directory_path() / ("zwang_validate_time_" + std::to_string(getpid()));
  fs::create_directories(folder);
  fs::copy(specs, folder, fs::copy_options::recursive);
  // The second task of the file leads on to those that are added.
  std::string head = slurp(specs / "wall_align.yaml");
  const std::string last = "{when: elapsed > 2 s, goto: done}";
  head.replace(head.find(last), last.size(), "{when: elapsed > 2 s, goto: more0}");
  std::ofstream(folder / "large.yaml") << large(head);
  const fs::path robots = folder / "robots", scenes = folder / "scenes";
  const fs::path robot = robots / "mecanum_base.yaml", description = robots / "mecanum_base.urdf";
  const bool is_small_good =
      compare("70 lines", {folder / "obstacle.yaml", robot, scenes / "obstacle.yaml", description}, 60, 1.6);
  const bool is_large_good = compare(
      "256 KiB, 242 tasks", {folder / "large.yaml", robot, scenes / "wall.yaml", description}, 20, 10.0);
  const bool is_growth_good = grows_evenly(head, folder);
  fs::remove_all(folder);
  return is_small_good && is_large_good && is_growth_good ? 0 : 1;
}
