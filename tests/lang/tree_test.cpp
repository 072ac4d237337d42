#include <gtest/gtest.h>

#include "support.hpp"
#include "tree/read.hpp"

namespace zwang::lang {
namespace {

using test::count;

struct Reading {
  Diagnostics diagnostics;
  std::optional<Document> document;
};

Reading read_text(const std::string& text) {
  Reading reading;
  const int source = reading.diagnostics.add_source({"t.yaml", text});
  reading.document = read(source, reading.diagnostics);
  return reading;
}

/// The stretch of the text that a span covers, by its own arithmetic.
std::string covered(const std::string& text, const Span& span) {
  std::string result;
  Position at{1, 1};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool continues = (static_cast<unsigned char>(text[i]) & 0xC0u) == 0x80u;
    if (continues) {
      if (!result.empty()) result += text[i];
      continue;
    }
    const auto before = [](const Position& a, const Position& b) {
      return a.line < b.line || (a.line == b.line && a.column < b.column);
    };
    if (!before(at, span.begin) && before(at, span.end)) result += text[i];
    if (text[i] == '\n') {
      at = {at.line + 1, 1};
    } else {
      ++at.column;
    }
  }
  return result;
}

const Node& value_of(const Document& document, const std::string& key) {
  return document.root.find(key)->value;
}

TEST(Read, spans_cover_exactly_what_was_written) {
  const std::string text =
      "plain: 0.08 m/s   # comment\n"
      "double: \"a \\\"b\\\" c\"\n"
      "single: 'it''s'\n"
      "flow: [1 m, {a: 2 N}]\n"
      "folded: one and\n"
      "    two\n"
      "after: x\n";
  const Reading r = read_text(text);
  ASSERT_TRUE(r.document) << test::rendered(r.diagnostics);
  EXPECT_EQ(covered(text, value_of(*r.document, "plain").span), "0.08 m/s");
  EXPECT_EQ(covered(text, value_of(*r.document, "double").span), "\"a \\\"b\\\" c\"");
  EXPECT_EQ(covered(text, value_of(*r.document, "single").span), "'it''s'");
  EXPECT_EQ(covered(text, value_of(*r.document, "flow").span), "[1 m, {a: 2 N}]");
  EXPECT_EQ(covered(text, value_of(*r.document, "flow").items[1].span), "{a: 2 N}");
  EXPECT_EQ(value_of(*r.document, "folded").text, "one and two");
  EXPECT_EQ(covered(text, value_of(*r.document, "folded").span), "one and\n    two");
  EXPECT_EQ(covered(text, r.document->root.find("after")->key.span), "after");
}

TEST(Read, columns_count_code_points) {
  const std::string text =
      "gr\xC3\xB6\xC3\x9F"
      "e: 2 m\n";
  const Reading r = read_text(text);
  ASSERT_TRUE(r.document);
  const Node& value = r.document->root.entries[0].value;
  EXPECT_EQ(value.span.begin.column, 8);
  EXPECT_EQ(value.span.end.column, 11);
}

TEST(Read, letters_of_a_folded_text_keep_their_places) {
  const std::string text = "when: a < 1 m\n  and b > 2 s\n";
  const Reading r = read_text(text);
  ASSERT_TRUE(r.document);
  const Node& value = r.document->root.entries[0].value;
  ASSERT_EQ(value.text, "a < 1 m and b > 2 s");
  const std::vector<Position> positions = positions_of(value, text);
  const Position b = positions[value.text.find('b')];
  EXPECT_EQ(b.line, 2);
  EXPECT_EQ(b.column, 7);
}

TEST(Read, collects_comments_outside_quotes) {
  const Reading r = read_text("a: 'no # comment' # zwang: allow W501 reason\nb: x#y\n");
  ASSERT_TRUE(r.document);
  ASSERT_EQ(r.document->comments.size(), 1u);
  EXPECT_EQ(r.document->comments[0].text, "# zwang: allow W501 reason");
  EXPECT_EQ(r.document->comments[0].span.begin.column, 19);
}

struct Refusal {
  const char* name;
  std::string text;
  const char* code;
  int line;
  int column;
};

class ReadRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(ReadRefuses, with_code_and_place) {
  const Reading r = read_text(GetParam().text);
  ASSERT_EQ(r.diagnostics.all().size(), 1u) << test::rendered(r.diagnostics);
  const Diagnostic& d = r.diagnostics.all()[0];
  EXPECT_EQ(d.code, GetParam().code);
  EXPECT_EQ(d.span.begin.line, GetParam().line) << test::rendered(r.diagnostics);
  EXPECT_EQ(d.span.begin.column, GetParam().column) << test::rendered(r.diagnostics);
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Texts, ReadRefuses,
    testing::Values(Refusal{"empty", "", "E100", 1, 1}, Refusal{"comment_only", "# nothing\n", "E100", 1, 1},
                    Refusal{"comma", ",", "E100", 1, 1}, Refusal{"tab", "a: 1\n\tb: 2\n", "E100", 2, 1},
                    Refusal{"duplicate", "a: 1\nb: 2\na: 3\n", "E102", 3, 1},
                    Refusal{"duplicate_in_flow", "m: {y: 1, y: 2}\n", "E102", 1, 11},
                    Refusal{"anchor", "a: &x 1\n", "E106", 1, 4}, Refusal{"alias", "a: *x\n", "E106", 1, 4},
                    Refusal{"tag", "a: !!int 1\n", "E106", 1, 4},
                    Refusal{"bare_tag", "a: ! b\n", "E106", 1, 4},
                    Refusal{"tag_of_a_key", "a: 1\n! b: 2\n", "E106", 2, 1},
                    Refusal{"merge", "<<: {a: 1}\n", "E106", 1, 1},
                    Refusal{"complex_key", "? [a, b]\n: c\n", "E106", 1, 3},
                    Refusal{"second_document", "a: 1\n---\nb: 2\n", "E100", 2, 1},
                    Refusal{"block_scalar", "a: |\n  text\n", "E100", 1, 4},
                    Refusal{"open_quote", "a: \"text\n  more\"\n", "E100", 1, 4},
                    Refusal{"open_behind_a_doubled_quote", "a: '''\nb: 1\n", "E100", 1, 4},
                    Refusal{"not_utf8", "a: \xFF\n", "E100", 1, 4},
                    Refusal{"overlong", "a: \xC0\xAF\n", "E100", 1, 4},
                    Refusal{"surrogate", "a: \xED\xA0\x80\n", "E100", 1, 4},
                    Refusal{"nul", std::string("a: 1\0\n", 6), "E100", 1, 5},
                    Refusal{"escape", "a: \x1b[31mred\n", "E100", 1, 4},
                    Refusal{"bidi", "a: \xE2\x80\xAEgoto\n", "E100", 1, 4},
                    Refusal{"lone_return", "a: 1\rb: 2\n", "E100", 1, 5},
                    Refusal{"unclosed_brace", "a: {b: 1\nc: 2\n", "E100", 2, 2},
                    Refusal{"stray_brace", "a: b}\nc: }\n", "E100", 2, 4},
                    Refusal{"long_line", "a: " + std::string(4094, 'x') + "\n", "E111", 1, 1},
                    Refusal{"long_key", std::string(129, 'k') + ": 1\n", "E114", 1, 1},
                    Refusal{"deep", repeated("[", 33) + repeated("]", 33), "E112", 1, 33},
                    Refusal{"many", "[" + repeated("1,\n ", 20000) + "1]\n", "E113", 20000, 2}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

TEST(Read, accepts_texts_at_their_limits) {
  EXPECT_TRUE(read_text("a: " + std::string(4093, 'x') + "\n").document);
  EXPECT_TRUE(read_text(std::string(128, 'k') + ": 1\n").document);
  EXPECT_TRUE(read_text(repeated("[", 32) + repeated("]", 32)).document);
  EXPECT_TRUE(read_text("[" + repeated("1,\n ", 19998) + "1]\n").document);
  EXPECT_TRUE(read_text("a: don't\r\nb: it's 'fine'\r\n").document);
}

TEST(Read, a_scalar_of_many_lines_has_a_limit_too) {
  const std::string line = "  " + std::string(1022, 'x') + "\n";
  const Reading fits = read_text("a:\n" + repeated(line, 4));
  EXPECT_TRUE(fits.document) << test::rendered(fits.diagnostics);
  EXPECT_EQ(count(read_text("a:\n" + repeated(line, 5)).diagnostics, "E115"), 1);
}

TEST(Read, a_text_with_blank_lines_ends_where_it_ends) {
  Diagnostics diagnostics;
  const int source = diagnostics.add_source({"t.yaml", "a: one\n\n\n\n  two\nb: 1\n"});
  const std::optional<Document> document = read(source, diagnostics);
  ASSERT_TRUE(document) << test::rendered(diagnostics);
  const Span& span = document->root.entries[0].value.span;
  EXPECT_EQ(document->root.entries[0].value.text, "one\n\n\ntwo");
  EXPECT_EQ(span.end.line, 5);
  EXPECT_EQ(span.end.column, 6);
}

}  // namespace
}  // namespace zwang::lang
