#include "framing.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace zwang::lsp {

namespace {

constexpr std::string_view length_key = "content-length:";
/// A length beyond this is no length: what follows it is searched for the next header.
constexpr std::size_t longest_skip = std::size_t{1} << 30;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

std::optional<std::string> FrameDecoder::take() {
  for (;;) {
    if (!skip()) return std::nullopt;
    if (!length_) {
      if (!read_header_line()) return std::nullopt;
      continue;
    }
    if (buffer_.size() < *length_) return std::nullopt;
    std::string content = buffer_.substr(0, *length_);
    buffer_.erase(0, *length_);
    length_.reset();
    return content;
  }
}

/// False while the content that is passed over goes on.
bool FrameDecoder::skip() {
  const std::size_t count = std::min(to_skip_, buffer_.size());
  buffer_.erase(0, count);
  to_skip_ -= count;
  return to_skip_ == 0;
}

/// False until a whole line has come.
bool FrameDecoder::read_header_line() {
  const std::size_t end = buffer_.find('\n');
  if (end == std::string::npos) {
    // The end of a line of rubbish may be the beginning of a header.
    if (buffer_.size() > longest_header) buffer_.erase(0, buffer_.size() - length_key.size());
    return false;
  }
  std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end + 1);
  if (line.ends_with('\r')) line.pop_back();
  if (!line.empty()) {
    announce(line);
    return true;
  }
  if (!announced_) return true;
  const std::size_t length = *std::exchange(announced_, std::nullopt);
  if (length <= most_content) {
    length_ = length;
  } else {
    to_skip_ = length;
    ++dropped_;
  }
  return true;
}

/// A content that was shorter than its length said ends in front of the next header, on the same line.
void FrameDecoder::announce(std::string_view line) {
  const std::size_t key = lower_case(line).rfind(length_key);
  if (key == std::string::npos) return;
  std::string_view digits = line.substr(key + length_key.size());
  digits.remove_prefix(std::min(digits.find_first_not_of(" \t"), digits.size()));
  while (!digits.empty() && (digits.back() == ' ' || digits.back() == '\t')) digits.remove_suffix(1);
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), length);
  const bool is_length =
      error == std::errc() && end == digits.data() + digits.size() && length <= longest_skip;
  announced_ = is_length ? std::optional(length) : std::nullopt;
}

std::string framed(std::string_view content) {
  return "Content-Length: " + std::to_string(content.size()) + "\r\n\r\n" + std::string(content);
}

}  // namespace zwang::lsp
