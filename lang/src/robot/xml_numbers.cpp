#include "robot/xml_numbers.hpp"

#include <charconv>
#include <cmath>

namespace zwang::lang {

std::optional<std::vector<double>> read_numbers(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r')) ++at;
    if (at == end) break;
    if (*at == '+') ++at;
    double number = 0.0;
    const auto [next, error] = std::from_chars(at, end, number);
    const bool is_separated = next == end || *next == ' ' || *next == '\t' || *next == '\n' || *next == '\r';
    if (error != std::errc{} || !std::isfinite(number) || !is_separated) return std::nullopt;
    numbers.push_back(number);
    at = next;
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

}  // namespace zwang::lang
