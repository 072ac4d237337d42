#include "spec/expression.hpp"

#include <algorithm>
#include <array>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/value.hpp"
#include "tree/read.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"
#include "zwang/lang/condition_function.hpp"
#include "zwang/lang/printable.hpp"

namespace zwang::lang {

namespace {

constexpr int deepest_expression = 32;

/// Thrown when the condition cannot be read on; its diagnostic is already written.
struct Unreadable {};

bool is_word_part(char c) {
  return is_word_start(c) || (c >= '0' && c <= '9');
}

class ConditionParser {
 public:
  ConditionParser(const Node& node, Diagnostics& diagnostics)
      : text_(node.text), node_span_(node.span), diagnostics_(diagnostics) {
    // A text that a template's argument was put into has no letter-by-letter place.
    if (!node.is_replaced) positions_ = positions_of(node, diagnostics.source(node.span.source).text);
  }

  std::vector<ExpressionText> parse() {
    parse_or(0);
    skip_spaces();
    if (at_ < text_.size()) stop_at_leftover();
    return std::move(nodes_);
  }

 private:
  Span span(std::size_t begin, std::size_t end) const {
    if (positions_.empty()) return node_span_;
    return {node_span_.source, positions_[std::min(begin, text_.size())],
            positions_[std::min(end, text_.size())]};
  }

  [[noreturn]] void stop(Diagnostic diagnostic) {
    diagnostics_.add(std::move(diagnostic));
    throw Unreadable{};
  }

  [[noreturn]] void stop_at_leftover() {
    const std::string_view rest = std::string_view(text_).substr(at_);
    if (rest[0] == ')') stop(wording::unopened_parenthesis(span(at_, at_ + 1)));
    if (rest.starts_with("&&") || rest.starts_with("||") || rest.starts_with("&") || rest.starts_with("|")) {
      const bool is_and = rest[0] == '&';
      const std::size_t length = rest.size() > 1 && rest[1] == rest[0] ? 2 : 1;
      stop(wording::symbol_for_word(span(at_, at_ + length), std::string(rest.substr(0, length)),
                                    is_and ? "and" : "or"));
    }
    if (rest[0] == '=' || rest.starts_with("!=")) {
      const std::size_t length = rest.size() > 1 && rest[1] == '=' ? 2 : 1;
      const bool is_swapped = rest.starts_with("=<") || rest.starts_with("=>");
      if (is_swapped)
        stop(wording::symbol_for_word(span(at_, at_ + 2), std::string(rest.substr(0, 2)),
                                      rest[1] == '<' ? "<=" : ">="));
      const std::string other = trimmed(rest.substr(length));
      stop(other.starts_with("true") || other.starts_with("false")
               ? wording::equality_of_truth(span(at_, at_ + length))
               : wording::equality(span(at_, at_ + length)));
    }
    if (std::string_view("<>").find(rest[0]) != std::string_view::npos) {
      stop(wording::chained_comparison(span(at_, at_ + 1)));
    }
    stop_at_capitals();
    stop_at_decimal_comma();
    std::size_t end = at_ + 1;
    while (end < text_.size() && (is_continuation_byte(text_[end]) || is_word_part(text_[end]))) ++end;
    stop(wording::unexpected_in_condition(span(at_, end), text_.substr(at_, end - at_)));
  }

  /// `0,5 m`, which has been read as far as `0`.
  void stop_at_decimal_comma() {
    const auto is_digit = [this](std::size_t at) { return text_[at] >= '0' && text_[at] <= '9'; };
    if (text_[at_] != ',') return;
    std::size_t begin = at_;
    while (begin > 0 && is_digit(begin - 1)) --begin;
    std::size_t end = std::min(text_.find_first_not_of(' ', at_ + 1), text_.size());
    while (end < text_.size() && is_digit(end)) ++end;
    const std::string written = text_.substr(begin, end - begin);
    const std::string plain = wording::plainly_written(written);
    if (plain != written) stop(wording::odd_letters(span(begin, end), written, plain));
  }

  void stop_at_capitals() {
    const std::string word(peek_word());
    const std::string meant = lower_case(word);
    if (meant != word && (meant == "and" || meant == "or" || meant == "not"))
      stop(wording::word_in_capitals(span(at_, at_ + word.size()), word, meant));
  }

  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }

  /// The word at the cursor, not consumed.
  std::string_view peek_word() {
    skip_spaces();
    if (at_ >= text_.size() || !is_word_start(text_[at_])) return {};
    std::size_t end = at_;
    while (end < text_.size() && is_word_part(text_[end])) ++end;
    return std::string_view(text_).substr(at_, end - at_);
  }

  bool accept_word(std::string_view word) {
    if (peek_word() != word) return false;
    at_ += word.size();
    return true;
  }

  bool accept(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  int add(ExpressionText node, std::size_t begin) { return add(std::move(node), begin, begin); }

  /// `text_begin`: the same, with the parentheses around the first operand.
  int add(ExpressionText node, std::size_t begin, std::size_t text_begin) {
    node.span = span(begin, at_);
    node.text = in_one_line(std::string_view(text_).substr(text_begin, at_ - text_begin));
    nodes_.push_back(std::move(node));
    begins_.push_back(begin);
    text_begins_.push_back(text_begin);
    return static_cast<int>(nodes_.size()) - 1;
  }

  int add_binary(std::string op, int left, int right) {
    ExpressionText node;
    node.kind = ExpressionKind::binary;
    node.word = std::move(op);
    node.left = left;
    node.right = right;
    return add(std::move(node), begins_[static_cast<std::size_t>(left)],
               text_begins_[static_cast<std::size_t>(left)]);
  }

  int add_unary(ExpressionKind kind, int operand, std::size_t begin) {
    ExpressionText node;
    node.kind = kind;
    node.left = operand;
    return add(std::move(node), begin);
  }

  void check_depth(int depth) {
    if (depth > deepest_expression) stop(wording::condition_too_deep(span(at_, at_ + 1), deepest_expression));
  }

  int parse_or(int depth) {
    int left = parse_and(depth);
    while (accept_word("or")) left = add_binary("or", left, parse_and(depth));
    return left;
  }

  int parse_and(int depth) {
    int left = parse_not(depth);
    while (accept_word("and")) left = add_binary("and", left, parse_not(depth));
    return left;
  }

  int parse_not(int depth) {
    check_depth(depth);
    skip_spaces();
    const std::size_t begin = at_;
    if (accept_word("not")) return add_unary(ExpressionKind::logical_not, parse_not(depth + 1), begin);
    return parse_comparison(depth);
  }

  int parse_comparison(int depth) {
    const int left = parse_sum(depth);
    skip_spaces();
    if (at_ >= text_.size() || (text_[at_] != '<' && text_[at_] != '>')) return left;
    std::string op(1, text_[at_++]);
    if (at_ < text_.size() && text_[at_] == '=') op += text_[at_++];
    return add_binary(op, left, parse_sum(depth));
  }

  int parse_sum(int depth) {
    int left = parse_product(depth);
    while (true) {
      if (accept('+')) {
        left = add_binary("+", left, parse_product(depth));
      } else if (accept('-')) {
        left = add_binary("-", left, parse_product(depth));
      } else {
        return left;
      }
    }
  }

  int parse_product(int depth) {
    int left = parse_factor(depth);
    while (true) {
      if (accept('*')) {
        left = add_binary("*", left, parse_factor(depth));
      } else if (accept('/')) {
        left = add_binary("/", left, parse_factor(depth));
      } else {
        return left;
      }
    }
  }

  int parse_factor(int depth) {
    check_depth(depth);
    skip_spaces();
    const std::size_t begin = at_;
    if (at_ >= text_.size()) stop(wording::condition_ends(span(at_, at_)));
    if (accept('-')) return add_unary(ExpressionKind::negate, parse_factor(depth + 1), begin);
    if (accept('(')) {
      const int inner = parse_or(depth + 1);
      if (!accept(')')) stop_at_missing_parenthesis(begin);
      text_begins_[static_cast<std::size_t>(inner)] = begin;
      return inner;
    }
    if (accept('$')) return parse_parameter(begin);
    if (number_length(std::string_view(text_).substr(at_)) > 0) return parse_number();
    if (text_[at_] == '!') stop(wording::symbol_for_word(span(at_, at_ + 1), "!", "not"));
    stop_at_capitals();
    const std::string_view word = peek_word();
    if (word.empty() || word == "and" || word == "or" || word == "not") {
      const std::size_t length = std::max<std::size_t>(word.size(), 1);
      stop(wording::unexpected_in_condition(span(at_, at_ + length), text_.substr(at_, length)));
    }
    return parse_name(depth);
  }

  [[noreturn]] void stop_at_missing_parenthesis(std::size_t opened) {
    skip_spaces();
    if (at_ < text_.size()) stop_at_leftover();
    stop(wording::missing_parenthesis(span(opened, opened + 1)));
  }

  int parse_parameter(std::size_t begin) {
    ExpressionText node;
    node.kind = ExpressionKind::parameter;
    node.word = std::string(peek_word());
    const std::size_t close = text_.find('}', at_);
    if (text_.substr(at_).starts_with('{') && close != std::string::npos)
      stop(wording::parameter_in_braces(span(begin, close + 1),
                                        std::string(text_.substr(begin, close + 1 - begin))));
    if (node.word.empty()) stop(wording::unexpected_in_condition(span(begin, at_), "$"));
    at_ += node.word.size();
    return add(std::move(node), begin);
  }

  /// The end of the unit behind a number: words joined by spaces, `*`, `/` for as long as they are units.
  /// A first word that is neither a unit nor a word of the grammar is a misspelt unit.
  std::size_t end_of_unit(std::size_t begin) const {
    std::size_t end = begin;
    std::size_t at = begin;
    bool is_first = true;
    while (true) {
      while (at < text_.size() && text_[at] == ' ') ++at;
      const bool is_joined = at < text_.size() && (text_[at] == '/' || text_[at] == '*');
      if (is_joined && is_first) return end;
      if (is_joined) ++at;
      while (at < text_.size() && text_[at] == ' ') ++at;
      const std::size_t start = at;
      while (at < text_.size() && (is_word_part(text_[at]) || text_[at] == '%')) ++at;
      const std::string_view word = std::string_view(text_).substr(start, at - start);
      if (word.empty() || word == "and" || word == "or" || word == "not") return end;
      if (!is_unit_name(word) && !is_first) return end;
      if (at < text_.size() && text_[at] == '^') {
        ++at;
        if (at < text_.size() && text_[at] == '-') ++at;
        while (at < text_.size() && text_[at] >= '0' && text_[at] <= '9') ++at;
      }
      end = at;
      is_first = false;
    }
  }

  int parse_number() {
    const std::size_t begin = at_;
    const std::size_t unit = at_ + number_length(std::string_view(text_).substr(at_));
    at_ = end_of_unit(unit);
    const std::string written = text_.substr(begin, at_ - begin);
    QuantityResult result = parse_quantity(written);
    if (result.error == QuantityError::unknown_unit) {
      stop(wording::unknown_unit(span(begin, at_), written, result.unknown, nearest_unit(result.unknown)));
    }
    if (result.error != QuantityError::none) stop(wording::number_out_of_range(span(begin, at_), written));
    ExpressionText node;
    node.kind = ExpressionKind::quantity;
    node.quantity = std::move(result.quantity);
    return add(std::move(node), begin);
  }

  int parse_name(int depth) {
    const std::size_t begin = at_;
    std::string path(peek_word());
    at_ += path.size();
    if (at_ < text_.size() && text_[at_] == '(') return parse_call(path, begin, depth);
    while (at_ + 1 < text_.size() && text_[at_] == '.' && is_word_start(text_[at_ + 1])) {
      ++at_;
      const std::string_view part = peek_word();
      path += "." + std::string(part);
      at_ += part.size();
    }
    ExpressionText node;
    node.kind = ExpressionKind::name;
    node.word = std::move(path);
    return add(std::move(node), begin);
  }

  int parse_call(const std::string& function, std::size_t begin, int depth) {
    const ConditionFunction* known = find_function(function);
    if (known == nullptr) {
      const std::vector<std::string> names = function_names();
      stop(wording::unknown_function(span(begin, at_), function, nearest(function, names), names));
    }
    const std::size_t opened = at_++;
    ExpressionText node;
    node.kind = ExpressionKind::call;
    node.word = function;
    if (known->argument != FunctionArgument::number) {
      const std::size_t close = text_.find(')', at_);
      if (close == std::string::npos) stop(wording::missing_parenthesis(span(opened, opened + 1)));
      node.argument = trimmed(std::string_view(text_).substr(at_, close - at_));
      const std::size_t written = text_.find(node.argument, at_);
      node.argument_span = span(written, written + node.argument.size());
      at_ = close + 1;
      if (node.argument.empty()) stop(wording::missing_argument(span(begin, at_), function));
    } else {
      node.left = parse_or(depth + 1);
      if (!accept(')')) stop_at_missing_parenthesis(opened);
    }
    return add(std::move(node), begin);
  }

  std::string text_;
  Span node_span_;
  Diagnostics& diagnostics_;
  std::vector<Position> positions_;
  std::vector<ExpressionText> nodes_;
  std::vector<std::size_t> begins_;       ///< offset of each node's first letter
  std::vector<std::size_t> text_begins_;  ///< the same, with the parentheses around it
  std::size_t at_ = 0;
};

}  // namespace

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const ConditionFunction& function : condition_functions()) names.emplace_back(function.name);
  return names;
}

namespace {

ConditionText parse_text(const Node& node, Diagnostics& diagnostics) {
  ConditionText condition;
  condition.span = node.span;
  condition.text = node.text;
  try {
    condition.nodes = ConditionParser(node, diagnostics).parse();
    condition.is_bad = condition.nodes.empty();
  } catch (const Unreadable&) {
  }
  return condition;
}

}  // namespace

ConditionText parse_condition(const Node& node, Diagnostics& diagnostics) {
  if (node.is_scalar() && !node.is_bad) return parse_text(node, diagnostics);
  if (!node.is_bad) diagnostics.add(wording::expected_condition(node.span));
  ConditionText bad;
  bad.span = node.span;
  return bad;
}

ConditionText parse_expression(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  if (node.is_scalar() && !node.is_bad) return parse_text(node, diagnostics);
  if (!node.is_bad) diagnostics.add(wording::expected_value(node.span, what, node.kind == NodeKind::null));
  ConditionText bad;
  bad.span = node.span;
  return bad;
}

}  // namespace zwang::lang
