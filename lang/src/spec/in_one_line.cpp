#include "spec/in_one_line.hpp"

#include "diagnostic/wordings_slips.hpp"
#include "words/text.hpp"
#include "words/units.hpp"

namespace zwang::lang {

namespace {

bool is_bare(const Node& node) {
  if (node.is_bad || !node.is_scalar()) return false;
  const QuantityResult result = parse_quantity(trimmed(node.text));
  return result.error == QuantityError::none && !result.quantity.has_unit;
}

/// Whether one of the bare numbers would be in degrees. An author who writes one angle in degrees writes all
/// so.
bool has_degrees(const Node& node, const Dimension& expected) {
  if (node.is_scalar()) return is_bare(node) && wording::with_unit(node.text, expected).ends_with("deg");
  for (const Node& item : node.items) {
    if (has_degrees(item, expected)) return true;
  }
  return false;
}

std::string written(const Node& node, const Dimension& expected, bool is_in_degrees) {
  const auto join = [](std::string& line, const std::string& part) {
    line += (line.empty() ? "" : ", ") + part;
  };
  std::string line;
  if (node.is_sequence()) {
    for (const Node& item : node.items) join(line, written(item, expected, is_in_degrees));
    return "[" + line + "]";
  }
  if (node.is_mapping()) {
    for (const Entry& entry : node.entries)
      join(line, entry.key.text + ": " + written(entry.value, expected, is_in_degrees));
    return "{" + line + "}";
  }
  const std::string text = trimmed(node.text);
  if (expected == dimension::none || !is_bare(node)) return text;
  return is_in_degrees ? text + " deg" : wording::with_unit(text, expected);
}

}  // namespace

int count_bare_numbers(const Node& node) {
  int count = is_bare(node) ? 1 : 0;
  for (const Node& item : node.items) count += count_bare_numbers(item);
  for (const Entry& entry : node.entries) count += count_bare_numbers(entry.value);
  return count;
}

std::string in_one_line(const Node& node, const Dimension& expected) {
  return written(node, expected, expected == dimension::angle && has_degrees(node, expected));
}

}  // namespace zwang::lang
