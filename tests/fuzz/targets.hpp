/// The fuzzer's targets. Each target takes any bytes and gives them to one reader. A broken property aborts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace zwang::fuzz {

void task(std::string_view bytes);       ///< a task file, with a fixed robot; and its layout
void condition(std::string_view bytes);  ///< a condition of a fixed task file
/// A robot file, a line `=== URDF`, and the URDF; without the line a URDF alone.
void robot(std::string_view bytes);
void scene(std::string_view bytes);  ///< a scene file
/// A scenario file beside those of tests/conformance: its matrix multiplied out, and its expectations of a
/// fixed task.
void scenario(std::string_view bytes);
void study(std::string_view bytes);  ///< a study file, by itself

struct Target {
  std::string name;
  void (*run)(std::string_view);
};
const std::vector<Target>& targets();

}  // namespace zwang::fuzz
