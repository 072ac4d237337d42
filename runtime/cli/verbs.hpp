/// What the program can do, one function and one file a verb. Each returns the exit code.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace zwang::cli {

enum ExitCode {
  exit_good = 0,
  exit_bad = 1,         ///< what was checked is bad, or the task did not reach `done`
  exit_impossible = 2,  ///< the question could not be answered
};

enum class Format { human, json };

struct ValidateArguments {
  std::vector<std::string> files;
  Format format = Format::human;
};
int validate(const ValidateArguments& arguments);

struct RunArguments {
  std::string file;
  std::optional<std::string> robot, scene, log;
  std::map<std::string, std::string> parameters;
  std::uint64_t seed = 0;
  bool quiet = false;
  Format format = Format::human;
  std::optional<double> start_yaw;                ///< [rad]
  std::optional<std::array<double, 2>> start_at;  ///< [m]
};
int run(const RunArguments& arguments);

struct InfoArguments {
  std::string file;
  Format format = Format::human;
};
int info(const InfoArguments& arguments);

}  // namespace zwang::cli
