#include "robot/text_edits.hpp"

#include <algorithm>
#include <numeric>

namespace zwang::lang {

std::size_t TextEdits::add(std::size_t offset, std::size_t length, std::string text) {
  edits_.push_back({offset, length, std::move(text)});
  return edits_.size() - 1;
}

std::string TextEdits::applied_to(const std::string& text) {
  std::vector<std::size_t> order(edits_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return edits_[a].offset < edits_[b].offset; });
  lines_.assign(edits_.size(), 1);
  std::string result;
  std::size_t at = 0;
  for (const std::size_t i : order) {
    const Edit& edit = edits_[i];
    result += text.substr(at, edit.offset - at);
    // A new line begins behind the newline that the edit may open with.
    const std::size_t first = edit.text.find_first_not_of('\n');
    const std::string before = result + edit.text.substr(0, first == std::string::npos ? 0 : first);
    lines_[i] = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    result += edit.text;
    at = edit.offset + edit.length;
  }
  return result + text.substr(at);
}

}  // namespace zwang::lang
