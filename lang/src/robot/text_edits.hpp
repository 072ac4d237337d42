/// Insertions and replacements in a text, and the lines where they end up.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace zwang::lang {

class TextEdits {
 public:
  /// `text` in the place of the `length` bytes from `offset`. Returns the edit's number.
  std::size_t add(std::size_t offset, std::size_t length, std::string text);
  /// A place whose line is asked for.
  std::size_t mark(std::size_t offset) { return add(offset, 0, ""); }

  /// Edits at one place in the order in which they were added; they do not overlap.
  std::string applied_to(const std::string& text);
  /// From 1, in the text that `applied_to` returned: of the first letter of an edit.
  int line(std::size_t edit) const { return lines_.at(edit); }

 private:
  struct Edit {
    std::size_t offset, length;
    std::string text;
  };
  std::vector<Edit> edits_;
  std::vector<int> lines_;
};

}  // namespace zwang::lang
