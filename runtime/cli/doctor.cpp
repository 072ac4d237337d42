// The verb `doctor` prints the means of this machine, and the way to each that is missing.
#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "output.hpp"
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

Finding graph_drawer() {
  const char* path = std::getenv("PATH");
  std::string rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string folder = rest.substr(0, colon);
    if (!folder.empty() && access((folder + "/dot").c_str(), X_OK) == 0)
      return {"Graphviz", folder + "/dot", ""};
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return {"Graphviz", "none", "`apt install graphviz` draws what `zwang graph` prints"};
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
      graph_drawer(),
  };
  std::string text;
  for (const Finding& finding : findings) {
    text += padded(finding.subject, 22) + finding.found + "\n";
    if (!finding.way_out.empty()) text += padded("", 22) + "-> " + finding.way_out + "\n";
  }
  print(text);
  return exit_good;
}

}  // namespace zwang::cli
