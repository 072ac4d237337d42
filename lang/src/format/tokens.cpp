#include "format/tokens.hpp"

#include <algorithm>

#include "words/text.hpp"

namespace zwang::lang {

namespace {

/// A scalar's place in the text.
struct Stretch {
  std::size_t begin = 0, end = 0;
};

class Tokenizer {
 public:
  Tokenizer(const Document& document, std::string_view text)
      : document_(document),
        text_(text),
        index_(text),
        lines_(static_cast<std::size_t>(index_.line_count())) {}

  std::vector<LineTokens> take() {
    walk_block(document_.root, 0);
    std::sort(scalars_.begin(), scalars_.end(),
              [](const Stretch& a, const Stretch& b) { return a.begin < b.begin; });
    mark_comments();
    std::size_t at = 0;
    for (const Stretch& scalar : scalars_) {
      add_punctuation(at, scalar.begin);
      add_scalar(scalar);
      at = scalar.end;
    }
    add_punctuation(at, text_.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) finish_line(i);
    return std::move(lines_);
  }

 private:
  std::size_t line_of(std::size_t offset) const {
    return static_cast<std::size_t>(index_.position(offset).line) - 1;
  }

  int column_of(std::size_t offset) const { return index_.position(offset).column - 1; }

  void collect(const Node& node) {
    const bool is_written = node.is_scalar() || node.kind == NodeKind::null;
    const Stretch stretch{index_.offset(node.span.begin), index_.offset(node.span.end)};
    if (is_written && stretch.begin < stretch.end) scalars_.push_back(stretch);
  }

  void walk_flow(const Node& node) {
    collect(node);
    for (const Node& item : node.items) walk_flow(item);
    for (const Entry& entry : node.entries) {
      collect(entry.key);
      walk_flow(entry.value);
    }
  }

  /// `depth` is the indentation that the node's entries or items get.
  void walk_block(const Node& node, int depth) {
    if (node.is_flow || (!node.is_mapping() && !node.is_sequence())) return walk_flow(node);
    for (const Entry& entry : node.entries) {
      start_line(entry.key.span.begin, depth);
      collect(entry.key);
      walk_block(entry.value, depth + 1);
    }
    for (const Node& item : node.items) {
      const std::size_t dash = dash_before(index_.offset(item.span.begin));
      start_line(index_.position(dash), depth);
      walk_block(item, depth + 1);
    }
  }

  /// The `-` that opens the item at the offset: only spaces, comments and line ends lie between.
  std::size_t dash_before(std::size_t offset) const {
    std::size_t line = line_of(offset);
    std::string_view before = index_.line(static_cast<int>(line) + 1);
    const std::size_t start = index_.offset({static_cast<int>(line) + 1, 1});
    const std::size_t dash = before.substr(0, offset - start).rfind('-');
    if (dash != std::string_view::npos) return start + dash;
    while (line > 0) {
      --line;
      before = index_.line(static_cast<int>(line) + 1);
      const std::size_t first = before.find_first_not_of(' ');
      if (first == std::string_view::npos || before[first] == '#') continue;
      return index_.offset({static_cast<int>(line) + 1, 1}) + first;
    }
    return offset;
  }

  /// The first entry or item that starts on a line gives the line its depth.
  void start_line(const Position& position, int depth) {
    const auto line = static_cast<std::size_t>(position.line) - 1;
    const std::string_view text = index_.line(position.line);
    const std::size_t column = index_.offset(position) - index_.offset({position.line, 1});
    if (text.find_first_not_of(' ') != column) return;
    lines_[line].depth = depth;
    starts_.push_back(line);
  }

  void mark_comments() {
    for (const Comment& comment : document_.comments) {
      const auto line = static_cast<std::size_t>(comment.span.begin.line) - 1;
      lines_[line].comment = comment.text;
      const std::size_t end = lines_[line].comment.find_last_not_of(" \t\r");
      lines_[line].comment.resize(end + 1);
    }
  }

  /// Adds the characters between scalars: brackets, commas, colons, dashes; never a quote or a letter.
  void add_punctuation(std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at) {
      const char c = text_[at];
      if (c == '#') at = std::min(text_.find('\n', at), end);
      if (at >= end || c == ' ' || c == '\n' || c == '\r' || c == '#') continue;
      std::size_t length = 1;
      while (c == '-' && at + length < end && text_[at + length] == '-') ++length;  // `---`
      lines_[line_of(at)].tokens.push_back(
          {TokenKind::punctuation, std::string(text_.substr(at, length)), column_of(at)});
      at += length - 1;
    }
  }

  /// A text that goes on over several lines is a token of each of them.
  void add_scalar(const Stretch& scalar) {
    std::size_t begin = scalar.begin;
    while (begin < scalar.end) {
      std::size_t end = std::min(text_.find('\n', begin), scalar.end);
      const std::string piece = trimmed(text_.substr(begin, end - begin));
      if (!piece.empty()) {
        lines_[line_of(begin)].tokens.push_back({TokenKind::scalar, piece, column_of(begin)});
      }
      begin = end + 1;
    }
  }

  void finish_line(std::size_t i) {
    const std::string_view text = index_.line(static_cast<int>(i) + 1);
    const std::size_t first = text.find_first_not_of(' ');
    lines_[i].indent = first == std::string_view::npos ? 0 : static_cast<int>(first);
    const bool starts = std::find(starts_.begin(), starts_.end(), i) != starts_.end();
    const bool is_mark = lines_[i].tokens.size() == 1 && lines_[i].tokens[0].text == "---";
    lines_[i].continues = !lines_[i].tokens.empty() && !starts && !is_mark;
  }

  const Document& document_;
  std::string_view text_;
  TextIndex index_;
  std::vector<LineTokens> lines_;
  std::vector<Stretch> scalars_;
  std::vector<std::size_t> starts_;
};

}  // namespace

std::vector<LineTokens> tokens_of(const Document& document, std::string_view text) {
  return Tokenizer(document, text).take();
}

}  // namespace zwang::lang
