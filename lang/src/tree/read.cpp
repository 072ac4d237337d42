#include "tree/read.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <istream>
#include <streambuf>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "tree/allowances.hpp"
#include "tree/scalar_span.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

/// yaml-cpp counts lines and columns in bytes of its own stream; `pos` is the offset that they come from.
Position position_of(const YAML::Mark& mark, const TextIndex& index) {
  return index.position(mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos));
}

/// Thrown through yaml-cpp when the text cannot be read on; its diagnostic is already written.
struct Abandoned {};

/// Collects yaml-cpp's events into a tree.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(int source, std::string_view text, Diagnostics& diagnostics)
      : source_(source), text_(text), index_(text), diagnostics_(diagnostics) {}

  Node take() { return std::move(root_); }
  bool has_document() const { return has_document_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (has_document_) {
      diagnostics_.add(wording::second_document(point(mark)));
      throw Abandoned{};
    }
    has_document_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node node = start(NodeKind::null, mark);
    if (is_null_written_at(mark)) node.span = word_at(mark);
    refuse_anchor(node, anchor, mark);
    place(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    Node node = start(NodeKind::null, mark);
    diagnostics_.add(wording::alias(word_at(mark)));
    node.is_bad = true;
    place(std::move(node));
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node node = start(NodeKind::scalar, mark);
    node.text = value;
    const std::size_t offset = index_.offset(node.span.begin);
    const ScalarText found = find_scalar(text_, offset, value);
    node.is_quoted = found.style == ScalarStyle::quoted;
    node.span.end = index_.position(found.end);
    if (found.style == ScalarStyle::block) {
      diagnostics_.add(wording::block_scalar(node.span));
      node.is_bad = true;
    }
    refuse_tag(node, tag, mark);
    refuse_anchor(node, anchor, mark);
    if (value.size() > longest_scalar) {
      diagnostics_.add(wording::scalar_too_long(point(mark), longest_scalar));
      throw Abandoned{};
    }
    place(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    open(NodeKind::sequence, mark, tag, anchor, style);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    open(NodeKind::mapping, mark, tag, anchor, style);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    Node node;
    std::optional<Node> key;  ///< of a mapping, waiting for its value
  };

  Position position(const YAML::Mark& mark) const { return position_of(mark, index_); }

  Span point(const YAML::Mark& mark) const {
    return {source_, position(mark), index_.position(index_.offset(position(mark)) + 1)};
  }

  /// From the mark to the next space or bracket.
  Span word_at(const YAML::Mark& mark) const {
    const std::size_t begin = index_.offset(position(mark));
    std::size_t end = begin;
    while (end < text_.size() && std::string_view(" \n\r,]}").find(text_[end]) == std::string_view::npos) {
      ++end;
    }
    return {source_, position(mark), index_.position(end)};
  }

  /// Whether YAML's word for nothing stands at the mark, and nothing behind it: else it begins the next key.
  bool is_null_written_at(const YAML::Mark& mark) const {
    const Span span = word_at(mark);
    const std::size_t begin = index_.offset(span.begin), end = index_.offset(span.end);
    const std::string_view word = text_.substr(begin, end - begin);
    if (word != "~" && word != "null" && word != "Null" && word != "NULL") return false;
    const std::size_t next = text_.find_first_not_of(' ', end);
    if (next == std::string_view::npos) return true;
    const bool is_in_flow = !levels_.empty() && levels_.back().node.is_flow;
    return std::string_view(is_in_flow ? "\r\n#,]}" : "\r\n#").find(text_[next]) != std::string_view::npos;
  }

  Node start(NodeKind kind, const YAML::Mark& mark) {
    if (++nodes_ > most_nodes) {
      diagnostics_.add(wording::too_many_nodes(point(mark), most_nodes));
      throw Abandoned{};
    }
    Node node;
    node.kind = kind;
    node.span = {source_, position(mark), position(mark)};
    return node;
  }

  void refuse_tag(Node& node, const std::string& tag, const YAML::Mark& mark) {
    const bool is_written = !tag.empty() && text_[index_.offset(position(mark))] == '!';  // else: of quotes
    if (!is_written && (tag.empty() || tag == "?" || tag == "!")) return;
    diagnostics_.add(is_condition_next() ? wording::exclamation_for_not(word_at(mark))
                                         : wording::tag(word_at(mark)));
    node.is_bad = true;
  }

  /// Whether the value that begins now is a condition: in other languages `!` negates it.
  bool is_condition_next() const {
    if (levels_.empty() || !levels_.back().key) return false;
    const std::string& key = levels_.back().key->text;
    return key == "when" || key == "require" || key == "that";
  }

  void refuse_anchor(Node& node, YAML::anchor_t anchor, const YAML::Mark& mark) {
    if (anchor == YAML::NullAnchor) return;
    diagnostics_.add(wording::anchor(word_at(mark)));
    node.is_bad = true;
  }

  void open(NodeKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            YAML::EmitterStyle::value style) {
    Node node = start(kind, mark);
    node.is_flow = style == YAML::EmitterStyle::Flow;
    refuse_tag(node, tag, mark);
    refuse_anchor(node, anchor, mark);
    if (static_cast<int>(levels_.size()) >= deepest_nesting) {
      diagnostics_.add(wording::too_deep(point(mark), deepest_nesting));
      throw Abandoned{};
    }
    levels_.push_back({std::move(node), std::nullopt});
  }

  void close() {
    Node node = std::move(levels_.back().node);
    levels_.pop_back();
    Position end = node.span.begin;
    if (!node.items.empty()) end = node.items.back().span.end;
    if (!node.entries.empty()) end = node.entries.back().value.span.end;
    node.span.end = end;
    // A pair alone in a list, `[v: 1 m/s]`, is a mapping without braces.
    const std::size_t begin = index_.offset(node.span.begin);
    const bool has_brackets = begin < text_.size() && (text_[begin] == '{' || text_[begin] == '[');
    if (node.is_flow && has_brackets) {
      const bool is_empty = node.items.empty() && node.entries.empty();
      const std::size_t from = index_.offset(end) + (is_empty ? 1 : 0);
      node.span.end = index_.position(end_of_flow(text_, from, node.is_mapping() ? '}' : ']'));
    }
    // One in brackets belongs to the lines around it, but to those of the whole file.
    const std::size_t depth = levels_.size();
    if (depth == 1 || (depth > 1 && !node.is_flow)) diagnostics_.add_collection(node.span);
    place(std::move(node));
  }

  /// Puts a finished node where it belongs: key or value of a mapping, item of a list, or the root.
  void place(Node node) {
    if (levels_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& level = levels_.back();
    if (level.node.is_sequence()) {
      level.node.items.push_back(std::move(node));
    } else if (!level.key) {
      check_key(node, level.node);
      level.key = std::move(node);
    } else {
      // `key:` with nothing behind it: yaml-cpp marks the next token; the place is the key's end.
      const bool is_nothing =
          node.kind == NodeKind::null && index_.offset(node.span.begin) == index_.offset(node.span.end);
      if (is_nothing) node.span = {source_, level.key->span.end, level.key->span.end};
      if (is_nothing && refuse_decimal_comma(level)) return;
      level.node.entries.push_back({std::move(*level.key), std::move(node)});
      level.key.reset();
    }
  }

  /// `{velocity: 0,2 m/s}` comes as `velocity: 0` and a key `2 m/s` without a value: one mistake, told at the
  /// number. The key that is none is dropped.
  bool refuse_decimal_comma(Level& level) {
    if (!level.node.is_flow || level.node.entries.empty()) return false;
    Node& number = level.node.entries.back().value;
    if (number.is_bad || number.is_quoted || level.key->is_bad || level.key->is_quoted) return false;
    const std::string meant = joined_at_decimal_comma(number.text, level.key->text);
    if (meant.empty()) return false;
    number.span.end = level.key->span.end;
    diagnostics_.add(wording::decimal_comma(number.span, meant));
    number.is_bad = true;
    level.key.reset();
    return true;
  }

  /// The last line of a block may lack its colon: yaml-cpp makes a key without a value of it.
  void require_colon(const Node& key) {
    const std::size_t next = text_.find_first_not_of(' ', index_.offset(key.span.end));
    if (next != std::string_view::npos && text_[next] == ':') return;
    diagnostics_.add(wording::unreadable_yaml(key.span, "no colon behind a key"));
    throw Abandoned{};
  }

  void check_key(Node& key, const Node& mapping) {
    if (key.is_bad) return;
    if (key.is_scalar() && !mapping.is_flow) require_colon(key);
    if (!key.is_scalar()) {
      key.is_bad = true;
      diagnostics_.add(wording::complex_key(key.span));
    } else if (key.text == "<<") {
      key.is_bad = true;
      diagnostics_.add(wording::merge_key(key.span));
    } else if (key.text.size() > longest_key) {
      diagnostics_.add(wording::key_too_long(key.span, longest_key));
      throw Abandoned{};
    } else if (const Entry* first = mapping.find(key.text); first != nullptr && !first->key.is_bad) {
      key.is_bad = true;
      diagnostics_.add(wording::duplicate_key(key.span, key.text, first->key.span));
    }
  }

  int source_;
  std::string_view text_;
  TextIndex index_;
  Diagnostics& diagnostics_;
  std::vector<Level> levels_;
  Node root_;
  int nodes_ = 0;
  bool has_document_ = false;
};

/// Lets a stream read a string_view without a copy.
class ViewBuffer final : public std::streambuf {
 public:
  explicit ViewBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());  // NOLINT: streambuf's get area is char*, never written
    setg(begin, begin, begin + text.size());
  }
};

}  // namespace

namespace {

/// `${push}` in brackets: YAML takes its brace for one of its own, and stumbles behind it. Whether that is
/// why it did, on this line.
bool report_braces(int source, const std::string& text, std::size_t stumbled, const TextIndex& index,
                   Diagnostics& diagnostics) {
  const std::size_t end_of_last_line = text.rfind('\n', stumbled == 0 ? 0 : stumbled - 1);
  const std::size_t begin_of_line = end_of_last_line == std::string::npos ? 0 : end_of_last_line + 1;
  const std::size_t begin = text.find("${", begin_of_line);
  const std::size_t end = text.find_first_of("}\n", begin);
  if (begin == std::string::npos || begin > stumbled || end == std::string::npos || text[end] != '}')
    return false;
  diagnostics.add(wording::parameter_in_braces({source, index.position(begin), index.position(end + 1)},
                                               text.substr(begin, end + 1 - begin)));
  return true;
}

}  // namespace

std::optional<Document> read(int source, Diagnostics& diagnostics) {
  // A copy: adding sources while this one is read would move the text.
  const std::string text = diagnostics.source(source).text;
  Document document{source, {}, {}};
  if (!prescan_yaml(source, text, diagnostics, document.comments)) return std::nullopt;
  read_allowances(document.comments, text, diagnostics);
  TreeBuilder builder(source, text, diagnostics);
  try {
    ViewBuffer buffer(text);
    std::istream stream(&buffer);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    // One byte `,` makes HandleNextDocument succeed for ever: it is asked once more, and never a third time.
    if (builder.has_document()) parser.HandleNextDocument(builder);
  } catch (const Abandoned&) {
    return std::nullopt;
  } catch (const YAML::Exception& error) {
    const TextIndex index(text);
    const Position at = position_of(error.mark, index);
    if (error.msg.starts_with("the referenced anchor")) {
      diagnostics.add(wording::alias({source, at, index.position(index.offset(at) + 1)}));
      return std::nullopt;
    }
    if (!report_braces(source, text, index.offset(at), index, diagnostics))
      diagnostics.add(
          wording::unreadable_yaml({source, at, index.position(index.offset(at) + 1)}, error.msg));
    return std::nullopt;
  }
  if (!builder.has_document()) {
    diagnostics.add(wording::empty_file({source, {1, 1}, {1, 1}}));
    return std::nullopt;
  }
  document.root = builder.take();
  return document;
}

std::vector<Position> positions_of(const Node& scalar, std::string_view text) {
  const TextIndex index(text);
  std::vector<Position> result;
  for (const std::size_t offset :
       offsets_of_scalar(text, index.offset(scalar.span.begin), scalar.text, scalar.is_quoted)) {
    result.push_back(index.position(offset));
  }
  return result;
}

bool is_yaml(const std::string& text) {
  Diagnostics diagnostics;
  return read(diagnostics.add_source({"", text}), diagnostics).has_value() && !diagnostics.has_errors();
}

}  // namespace zwang::lang
