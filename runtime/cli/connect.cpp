#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "argument_text.hpp"
#include "output.hpp"
#include "shipped.hpp"
#include "verbs.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;

fs::path program_for(const std::string& name) {
  if (const auto path = optional_part(name)) return *path;
  throw Impossible(
      "this zwang was built without ROS 2 topics: there is no " + name +
      "\nInstall Fast DDS (apt install libfastrtps-dev), and build again with -DZWANG_CONNECT=ON.");
}

std::vector<std::string> words_of(const ConnectArguments& a) {
  std::vector<std::string> words{file_or_shipped(a.file), "--over",
                                 file_or_shipped(a.connection, "connections")};
  const auto add = [&words](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  if (a.overrides.robot) add("--robot", *a.overrides.robot);
  if (a.overrides.scene) add("--scene", *a.overrides.scene);
  for (const auto& [name, value] : a.overrides.parameters) add("-p", name + "=" + value);
  if (a.log) add("--log", *a.log);
  if (a.log_rate) add("--log-rate", std::to_string(*a.log_rate));
  rotation(a.rotation);  // what is none is told here
  for (const std::string& limit : a.rotation) add("--log-rotate", limit);
  if (a.observe) add("--observe", std::to_string(*a.observe));
  if (a.wait) add("--wait", std::to_string(*a.wait));
  if (a.seed) add("--seed", std::to_string(*a.seed));
  return words;
}

}  // namespace

int connect(const std::string& verb, const ConnectArguments& arguments) {
  require_file(file_or_shipped(arguments.connection, "connections"));
  const std::string program = program_for("zwang-" + verb).string();
  std::vector<std::string> words = words_of(arguments);
  words.insert(words.begin(), program);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // In the place of this process: signals reach what drives the robot without a way round.
  execv(program.c_str(), argv.data());
  throw Impossible(program + ": " + std::strerror(errno));
}

}  // namespace zwang::cli
