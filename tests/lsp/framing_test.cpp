// Bytes and places at the edge to the editor.
#include "lsp/framing.hpp"

#include <gtest/gtest.h>

#include <random>

#include "lsp/lines.hpp"
#include "lsp/uri.hpp"

namespace zwang::lsp {
namespace {

std::vector<std::string> taken(FrameDecoder& decoder) {
  std::vector<std::string> all;
  while (auto content = decoder.take()) all.push_back(*content);
  return all;
}

std::vector<std::string> decoded(std::string_view stream) {
  FrameDecoder decoder;
  decoder.feed(stream);
  return taken(decoder);
}

TEST(Framing, HoweverAStreamIsCutItsMessagesAreTheSame) {
  const std::string stream =
      framed("{}") + "content-length:3\r\nContent-Type: x\r\n\r\nabc" + framed("") + framed("\n\r\n");
  const std::vector<std::string> whole = decoded(stream);
  EXPECT_EQ(whole, (std::vector<std::string>{"{}", "abc", "", "\n\r\n"}));
  for (std::size_t step = 1; step < stream.size(); ++step) {
    FrameDecoder decoder;
    std::vector<std::string> pieces;
    for (std::size_t at = 0; at < stream.size(); at += step) {
      decoder.feed(std::string_view(stream).substr(at, step));
      for (std::string& content : taken(decoder)) pieces.push_back(std::move(content));
    }
    EXPECT_EQ(pieces, whole) << step;
  }
}

TEST(Framing, BehindALengthThatLiesTheNextHeaderIsFound) {
  // Shorter than it says: it swallows what follows. Longer: its rest stands in front of the next header.
  EXPECT_EQ(decoded("Content-Length: 1\r\n\r\n{}" + framed("next")).back(), "next");
  for (const char* wrong : {"-1", "1e3", "99999999999999999999999", "", "12x", "0x10", "2147483648"}) {
    const std::string stream = std::string("Content-Length: ") + wrong + "\r\n\r\nrubbish" + framed("next");
    EXPECT_EQ(decoded(stream), std::vector<std::string>{"next"}) << wrong;
  }
  EXPECT_EQ(decoded("\r\n\r\n\n\n:\n" + framed("next")), std::vector<std::string>{"next"});
}

TEST(Framing, AMessageThatIsTooLongIsPassedOver) {
  const std::size_t size = FrameDecoder::most_content + 1;
  FrameDecoder decoder;
  decoder.feed("Content-Length: " + std::to_string(size) + "\r\n\r\n");
  const std::string part(std::size_t{1} << 20, 'x');
  for (std::size_t fed = 0; fed < size; fed += part.size()) {
    decoder.feed(std::string_view(part).substr(0, std::min(part.size(), size - fed)));
    EXPECT_FALSE(decoder.take());
  }
  decoder.feed(framed("next"));
  EXPECT_EQ(decoder.take(), "next");
  EXPECT_EQ(decoder.dropped(), 1);
}

TEST(Framing, BytesOfAnyKindEndWithoutAMessageThatNobodySent) {
  std::mt19937 random(24);
  for (int i = 0; i < 200; ++i) {
    std::string bytes(1000, '\0');
    for (char& c : bytes) c = static_cast<char>(random() & 0x7Fu);
    FrameDecoder decoder;
    decoder.feed(bytes);
    EXPECT_TRUE(taken(decoder).empty());
    decoder.feed("\n" + framed("next"));
    EXPECT_EQ(decoder.take(), "next");
  }
}

TEST(Lines, APlaceGoesToTheEditorAndBack) {
  // One, two, three and four bytes a character; the last is two units of UTF-16.
  const std::string text = "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\xA4\x96z\r\n\nend";
  const Lines lines(text);
  const std::vector<int> units{0, 1, 2, 3, 5, 6};  // in front of each character of the first line
  const std::vector<std::size_t> bytes{0, 1, 3, 6, 10, 11};
  for (std::size_t i = 0; i < units.size(); ++i) {
    const lang::Position place{1, static_cast<int>(i) + 1};
    EXPECT_EQ(lines.to_editor(place), (EditorPosition{0, units[i]}));
    EXPECT_EQ(lines.from_editor({0, units[i]}).column, place.column);
    EXPECT_EQ(lines.offset({0, units[i]}), bytes[i]);
  }
  EXPECT_EQ(lines.from_editor({0, 4}).column, 4);  // inside of the pair
  EXPECT_EQ(lines.offset({0, 99}), 11U);
  EXPECT_EQ(lines.offset({99, 0}), text.size());
  EXPECT_EQ(lines.end(), (EditorPosition{2, 3}));
}

TEST(Uri, APathGoesThereAndBack) {
  for (const char* path : {"/a/b.yaml", "/with space/%41.yaml", "/\xC3\xA4#?.yaml", "/"})
    EXPECT_EQ(path_of(uri_of(path)), path);
  EXPECT_EQ(path_of("file://localhost/a"), "/a");
  for (const char* none :
       {"untitled:1", "http://a/b", "file://host/a", "file:///%", "file:///%zz", "file:///a%00b", ""})
    EXPECT_FALSE(path_of(none)) << none;
}

}  // namespace
}  // namespace zwang::lsp
