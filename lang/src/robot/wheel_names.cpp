// A name is read in words, which `_`, digits, capitals and the like part: `Rad2Joint` is rad and joint. A
// word of German is often the end of a longer one (Antriebsrad), and `rad` the beginning of a radar.
#include "robot/wheel_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

namespace zwang::lang {

namespace {

constexpr std::array<std::string_view, 6> wheels{"wheel", "whl", "roue", "rueda", "ruota", "reifen"};
constexpr std::array<std::string_view, 12> casters{"caster",    "castor",   "lenkrolle",  "laufrolle",
                                                   "stuetzrad", "stützrad", "roulette",   "folle",
                                                   "loca",      "rotella",  "pivottante", "piroettante"};
constexpr std::array<std::string_view, 4> sensors{"lidar", "laser", "velodyne", "scanner"};
constexpr std::array<std::string_view, 3> steerings{"steer", "lenkung", "sterz"};
constexpr std::array<std::string_view, 3> hinges{"hinge", "knuckle", "kingpin"};
constexpr std::array<std::string_view, 5> balls{"ball", "kugel", "bille", "bola", "sfera"};

std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words;
  bool is_inside = false, was_capital = false;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_letter = std::isalpha(byte) != 0 || byte >= 0x80U;  // of a letter beyond ASCII
    const bool is_capital = std::isupper(byte) != 0;
    if (is_letter && (!is_inside || (is_capital && !was_capital))) words.emplace_back();
    if (is_letter) words.back() += static_cast<char>(byte < 0x80U ? std::tolower(byte) : c);
    is_inside = is_letter;
    was_capital = is_capital;
  }
  return words;
}

template <std::size_t count>
bool has_word(const std::string& name, const std::array<std::string_view, count>& known) {
  const std::vector<std::string> words = words_of(name);
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::any_of(known.begin(), known.end(),
                       [&](std::string_view part) { return word.find(part) != std::string::npos; });
  });
}

}  // namespace

bool is_called_wheel(const std::string& name) {
  const std::vector<std::string> words = words_of(name);
  const bool is_german = std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word.ends_with("rad") || word.ends_with("raeder") || word.ends_with("räder");
  });
  return is_german || has_word(name, wheels);
}

bool is_called_caster(const std::string& name) {
  return has_word(name, casters);
}

bool is_called_steering(const std::string& name) {
  return has_word(name, steerings);
}

bool is_called_hinge(const std::string& name) {
  return has_word(name, hinges);
}

bool is_called_sensor(const std::string& name) {
  return has_word(name, sensors);
}

bool is_called_ball(const std::string& name) {
  return has_word(name, balls);
}

}  // namespace zwang::lang
