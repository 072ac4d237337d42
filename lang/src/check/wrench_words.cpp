#include "check/wrench_words.hpp"

#include <algorithm>
#include <array>

namespace zwang::lang {

namespace {

// In the order of WrenchPart.
constexpr std::array<std::string_view, 7> words{"x", "y", "z", "rx", "ry", "rz", "plane"};

}  // namespace

std::optional<WrenchPart> wrench_part_named(std::string_view word) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<WrenchPart>(found - words.begin());
}

std::vector<std::string> wrench_part_names() {
  return {words.begin(), words.end()};
}

Dimension dimension_of(WrenchPart part) {
  const bool turns = part == WrenchPart::rx || part == WrenchPart::ry || part == WrenchPart::rz;
  return turns ? dimension::torque : dimension::force;
}

}  // namespace zwang::lang
