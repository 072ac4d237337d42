#include "words/units.hpp"
#include "zwang/lang/quantity.hpp"

namespace zwang::lang {

namespace {

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::optional<double> read(std::string_view text, const Dimension& dimension) {
  const QuantityResult result = parse_quantity(without_blanks(text));
  if (result.error != QuantityError::none || !result.quantity.has_unit) return std::nullopt;
  if (result.quantity.dimension != dimension) return std::nullopt;
  return result.quantity.value;
}

}  // namespace

std::optional<double> read_length(std::string_view text) {
  return read(text, dimension::length);
}

std::optional<double> read_angle(std::string_view text) {
  return read(text, dimension::angle);
}

std::optional<double> read_mass(std::string_view text) {
  return read(text, dimension::mass);
}

}  // namespace zwang::lang
