// The verb `doctor` prints the means of this machine, and the way to each that is missing.
#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "colour.hpp"
#include "output.hpp"
#include "report_page.hpp"
#include "shipped.hpp"
#include "verbs.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/version.hpp"

namespace zwang::cli {

namespace fs = std::filesystem;

namespace {

struct Finding {
  std::string subject;
  std::string found;
  std::string way_out;  ///< empty: nothing is missing
};

Finding shipped_files() {
  const auto folder = shipped_folder();
  if (folder) return {"shipped files", folder->string(), ""};
  return {"shipped files", "none", "install zwang with its share/zwang, or run it from its checkout"};
}

Finding log_folder() {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (!error && access(here.c_str(), W_OK) == 0) return {"runs/ of this folder", "can be written", ""};
  return {"runs/ of this folder", "cannot be written", "go to a folder of your own, or name one by --log"};
}

/// Of a loop at 1 kHz beside others: SCHED_FIFO, and no page of it swapped out.
Finding real_time_priority() {
  rlimit limit{};
  const bool is_root = geteuid() == 0;
  getrlimit(RLIMIT_RTPRIO, &limit);
  if (is_root || limit.rlim_cur > 0)
    return {"real-time priority", is_root ? "any, as root" : "up to " + std::to_string(limit.rlim_cur), ""};
  return {
      "real-time priority", "not allowed",
      "add `YOU - rtprio 80` to /etc/security/limits.d/zwang.conf and log in anew; simulations do without"};
}

Finding locked_memory() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY) return {"locked memory", "all of it", ""};
  return {"locked memory", std::to_string(limit.rlim_cur / 1024) + " KiB",
          "add `YOU - memlock unlimited` to /etc/security/limits.d/zwang.conf and log in anew; simulations "
          "do without"};
}

Finding kernel() {
  utsname name{};
  uname(&name);
  std::ifstream real_time("/sys/kernel/realtime");
  const bool is_real_time =
      std::string(name.version).find("PREEMPT_RT") != std::string::npos || real_time.good();
  return {"kernel", std::string(name.release) + (is_real_time ? ", PREEMPT_RT" : ", not PREEMPT_RT"),
          is_real_time ? "" : "for a robot's loop install linux-image-rt-amd64; simulations do without"};
}

/// A program in a folder of PATH; empty: none has it.
std::string on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string folder = rest.substr(0, colon);
    if (!folder.empty() && access((folder + "/" + program).c_str(), X_OK) == 0) return folder + "/" + program;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return "";
}

Finding of_program(const std::string& subject, const std::string& program, const std::string& way_out) {
  const std::string path = on_path(program);
  return path.empty() ? Finding{subject, "none", way_out} : Finding{subject, path, ""};
}

Finding of_part(const std::string& subject, const std::optional<fs::path>& path, const std::string& way_out) {
  return path ? Finding{subject, path->string(), ""} : Finding{subject, "none", way_out};
}

Finding page() {
  const auto file = page_parts_file();
  if (file) return {"page of a run", file->string(), ""};
  return {"page of a run", "its parts are missing",
          "`./dev web` in a checkout builds them, with node and npm; `report` and `--live` need them"};
}

Finding python_module() {
  return of_part(
      "Python module",
      beside_program({"../lib/python3/dist-packages/zwang/__init__.py", "python/zwang/__init__.py"}),
      "install python3-zwang, or `./dev python` in a checkout; docs/python.md has the rest");
}

Finding robot_program() {
  return of_part("ROS 2 topics (DDS)", optional_part("zwang-drive"),
                 "install zwang-ros2; in a checkout `apt install libfastrtps-dev` and build with "
                 "-DZWANG_CONNECT=ON");
}

Finding node() {
  return of_program("node", "node", "`apt install nodejs npm`: `./dev web` builds the page with them");
}

Finding browser() {
  return of_program(
      "Chromium", "chromium",
      "`apt install chromium`: pictures and the tests of the page need it; pages open in any browser");
}

Finding graph_drawer() {
  return of_program("Graphviz", "dot", "`apt install graphviz` draws what `zwang graph` prints");
}

}  // namespace

int doctor() {
  const Finding findings[] = {
      {"zwang", ZWANG_VERSION, ""},
      {"simulator", std::string("MuJoCo ") + runtime::mujoco_version(), ""},
      {"processors", std::to_string(std::thread::hardware_concurrency()), ""},
      kernel(),
      real_time_priority(),
      locked_memory(),
      shipped_files(),
      log_folder(),
      page(),
      python_module(),
      robot_program(),
      graph_drawer(),
      node(),
      browser(),
  };
  std::string text;
  for (const Finding& finding : findings) {
    text += padded(finding.subject, 22) + finding.found + "\n";
    if (!finding.way_out.empty())
      text += padded("", 22) + marked(Hue::warning, "->") + " " + finding.way_out + "\n";
  }
  print(text);
  return exit_good;
}

}  // namespace zwang::cli
