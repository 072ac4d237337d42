/// Task files of a mecanum base, drawn with one fault or without.
#pragma once

#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace zwang::lang::silence {

/// The same on every machine: the standard fixes the generator, not its distributions.
class Dice {
 public:
  explicit Dice(unsigned seed) : generator_(seed) {}
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  int whole(int low, int high) {
    return low + static_cast<int>(generator_() % static_cast<unsigned>(high - low + 1));
  }
  template <typename T>
  const T& of(const std::vector<T>& all) {
    return all[generator_() % all.size()];
  }

 private:
  std::mt19937 generator_;
};

inline std::string q(double value, const char* unit) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g %s", value, unit);
  return text;
}

inline std::string range(double low, double high, const char* unit) {
  return "[" + q(low, unit) + ", " + q(high, unit) + "]";
}

/// A task file of `tasks`, each `name: body`.
inline std::string file(const std::string& tasks, const std::string& head = "",
                        const std::string& robot = "mecanum_base") {
  return "zwang: 1\nrobot: robots/" + robot + ".yaml\nscene: scenes/open.yaml\n" + head +
         "start: a\ntasks:\n" + tasks;
}

inline std::string drive(const std::string& x) {
  return "constraints: {go: {move: base_link, in: base_link, x: {" + x +
         "}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}";
}

inline std::string task(const std::string& name, const std::string& body, const std::string& exits,
                        const std::string& timeout) {
  return "  " + name + ":\n    " + body + "\n" + (exits.empty() ? "" : "    exits: [" + exits + "]\n") +
         "    timeout: " + timeout + "\n";
}

inline std::string exit_when(const std::string& when, const std::string& to, double dwell = 0.1) {
  return "{when: \"" + when + "\", for: " + q(dwell, "s") + ", goto: " + to + "}";
}

inline const std::string fails = "{after: 20 s, goto: failed}";

/// A kind of fault: `fault` says whether the file that it draws has it.
struct Kind {
  const char* name;
  std::vector<const char*> codes;
  std::function<std::string(Dice&, bool)> draw;
};

/// The kinds of faults that concern regions, places, times and people.
std::vector<Kind> kinds_of_places();
/// Those of drivers that something else in the file holds back.
std::vector<Kind> kinds_of_drivers();
/// Those of ways that end before the exit.
std::vector<Kind> kinds_of_ways();

}  // namespace zwang::lang::silence
