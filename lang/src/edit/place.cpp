#include <algorithm>

#include "edit/name_walk.hpp"
#include "zwang/lang/completion.hpp"

namespace zwang::lang {

namespace {

std::string trimmed_key(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\"'");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\"'") - begin + 1));
}

/// A level of the structure that is open.
struct Level {
  int indent = -1;         ///< of a block's key or dash; -1: within brackets
  char bracket = '\0';     ///< `{` or `[`
  std::string key;         ///< that was read last in it; `-` of a list
  bool has_value = false;  ///< the key's colon was read
};

/// Reads up to the place, a character at a time. Never looks ahead, so that what follows cannot mislead it.
class PlaceFinder {
 public:
  explicit PlaceFinder(std::string_view text) : text_(text) {}

  TextPlace find() {
    while (at_ < text_.size()) step();
    TextPlace place;
    for (const Level& level : levels_) {
      const bool is_open = level.bracket == '[' || level.has_value;
      if (is_open) place.keys.push_back(level.bracket == '[' ? "-" : level.key);
    }
    place.is_key = is_at_key() || is_behind_dash_;
    if (place.is_key && !is_in_brackets() && !is_behind_dash_) drop_deeper(place);
    const std::size_t begin = text_.find_first_not_of(" \t", value_begin_);
    place.value = begin == std::string_view::npos ? "" : std::string(text_.substr(begin));
    const bool is_quoted = place.value.starts_with('"') || place.value.starts_with('\'');
    place.value_begin = text_.size() - place.value.size() + (is_quoted ? 1 : 0);
    // Between brackets a line may end, with a comment, before the value begins.
    const std::size_t line = text_.find_first_not_of(" \t", line_begin_);
    place.value_begin = std::max(place.value_begin, std::min(line, text_.size()));
    place.word_begin = text_.size();
    while (place.word_begin > value_begin_ && is_word_part(text_[place.word_begin - 1])) --place.word_begin;
    return place;
  }

 private:
  bool is_in_brackets() const { return !levels_.empty() && levels_.back().bracket != '\0'; }

  bool is_at_key() const {
    if (is_in_brackets()) return levels_.back().bracket == '{' && !levels_.back().has_value;
    return !is_behind_colon_;
  }

  /// A key that begins at this indent belongs to the last level that is less deep.
  void drop_deeper(TextPlace& place) const {
    place.keys.clear();
    for (const Level& level : levels_) {
      if (level.bracket == '\0' && level.indent < column_of_line_) place.keys.push_back(level.key);
    }
  }

  void step() {
    const char c = text_[at_];
    if (c == '\n') return end_line();
    if (c == '#' && (at_ == 0 || text_[at_ - 1] == ' ' || text_[at_ - 1] == '\n')) return skip_comment();
    if (c == '"' || c == '\'') return skip_quoted(c);
    if (is_in_brackets() || (is_behind_colon_ && is_first_of_value())) {
      if (step_in_brackets(c)) return;
    }
    if (!is_in_brackets()) step_in_block(c);
    ++at_;
  }

  bool is_first_of_value() const {
    return text_.substr(value_begin_, at_ - value_begin_).find_first_not_of(" \t") == std::string_view::npos;
  }

  bool step_in_brackets(char c) {
    if (c == '{' || c == '[') {
      levels_.push_back({-1, c, "", false});
      is_behind_dash_ = false;
    } else if ((c == '}' || c == ']') && is_in_brackets()) {
      levels_.pop_back();
    } else if (c == ',' && is_in_brackets()) {
      levels_.back().key.clear();
      levels_.back().has_value = false;
    } else if (c == ':' && is_in_brackets() && levels_.back().bracket == '{' && !levels_.back().has_value) {
      levels_.back().key = trimmed_key(text_.substr(value_begin_, at_ - value_begin_));
      levels_.back().has_value = true;
    } else {
      return false;
    }
    value_begin_ = ++at_;
    return true;
  }

  void step_in_block(char c) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\r';
    if (!has_content_ && !is_blank) {
      column_of_line_ = static_cast<int>(at_ - line_begin_);
      const bool is_dash =
          c == '-' && (at_ + 1 == text_.size() || text_[at_ + 1] == ' ' || text_[at_ + 1] == '\n');
      close_deeper(is_dash ? column_of_line_ + 1 : column_of_line_);
      if (is_dash) {
        // The list's key may have the same indent; the item before has.
        if (!levels_.empty() && levels_.back().key == "-" && levels_.back().indent == column_of_line_)
          levels_.pop_back();
        levels_.push_back({column_of_line_, '\0', "-", true});
        value_begin_ = at_ + 1;
        is_behind_colon_ = true;
        is_behind_dash_ = true;
        return;
      }
      has_content_ = true;
      is_behind_dash_ = false;
      key_begin_ = value_begin_ = at_;
      is_behind_colon_ = false;
    }
    const bool is_colon = c == ':' && !is_behind_colon_ &&
                          (at_ + 1 == text_.size() || text_[at_ + 1] == ' ' || text_[at_ + 1] == '\n' ||
                           text_[at_ + 1] == '\r');
    if (!is_colon) return;
    levels_.push_back({column_of_line_, '\0', trimmed_key(text_.substr(key_begin_, at_ - key_begin_)), true});
    value_begin_ = at_ + 1;
    is_behind_colon_ = true;
  }

  void close_deeper(int column) {
    while (!levels_.empty() && levels_.back().bracket == '\0' && levels_.back().indent >= column)
      levels_.pop_back();
  }

  void end_line() {
    ++at_;
    line_begin_ = at_;
    if (is_in_brackets()) return;
    value_begin_ = at_;
    has_content_ = is_behind_colon_ = is_behind_dash_ = false;
    // Blanks alone: the place itself says how deep a key would stand.
    std::size_t end = at_;
    while (end < text_.size() && text_[end] == ' ') ++end;
    column_of_line_ = static_cast<int>(end - at_);
  }

  void skip_comment() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  void skip_quoted(char quote) {
    if (!is_in_brackets() && !has_content_) step_in_block(quote);
    const std::size_t end = text_.find(quote, at_ + 1);
    const std::size_t line = text_.find('\n', at_);
    at_ = std::min({end == std::string_view::npos ? text_.size() : end + 1, line, text_.size()});
  }

  std::string_view text_;
  std::vector<Level> levels_;
  std::size_t at_ = 0, line_begin_ = 0, key_begin_ = 0, value_begin_ = 0;
  int column_of_line_ = 0;
  bool has_content_ = false, is_behind_colon_ = false, is_behind_dash_ = false;
};

}  // namespace

TextPlace place_at(std::string_view text, std::size_t offset) {
  return PlaceFinder(text.substr(0, std::min(offset, text.size()))).find();
}

}  // namespace zwang::lang
