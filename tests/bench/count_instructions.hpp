/// Callgrind's instruction count of a call of a program of ours. nullopt: valgrind is not installed. Counts
/// do not depend on the machine's load.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

namespace zwang::bench {

/// Inside functions that match `inside` ("" for the whole process), with those that they call.
inline std::optional<double> count_instructions(const std::string& command, const std::string& inside = "") {
  const std::string toggle = inside.empty() ? "" : " '--toggle-collect=" + inside + "'";
  const std::string line_of_shell =
      "valgrind --tool=callgrind --callgrind-out-file=/dev/null" + toggle + " " + command + " 2>&1";
  FILE* const pipe = popen(line_of_shell.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  double total = 0.0;
  char line[4096];
  while (std::fgets(line, sizeof(line), pipe) != nullptr) {
    if (const char* const found = std::strstr(line, "Collected :")) total = std::strtod(found + 11, nullptr);
  }
  if (pclose(pipe) != 0 || total == 0.0) return std::nullopt;
  return total;
}

}  // namespace zwang::bench
