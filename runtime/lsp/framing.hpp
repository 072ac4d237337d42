/// The base protocol of language servers: messages with a `Content-Length` in front of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace zwang::lsp {

/// Cuts a stream of bytes into messages. Bytes that belong to no message are passed over: after a header or a
/// length that is wrong, the next `Content-Length` is the next message.
class FrameDecoder {
 public:
  static constexpr std::size_t most_content = std::size_t{16} << 20;  ///< [bytes] of a message that is taken
  static constexpr std::size_t longest_header = 8192;                 ///< [bytes] of a header's line

  void feed(std::string_view bytes) { buffer_.append(bytes); }
  /// The content of the next message; nullopt until all of it has come.
  std::optional<std::string> take();
  /// Messages that were longer than `most_content`, since the last call.
  int dropped() { return std::exchange(dropped_, 0); }

 private:
  bool skip();
  bool read_header_line();
  void announce(std::string_view line);

  std::string buffer_;
  std::optional<std::size_t> announced_;  ///< by the header that is being read
  std::optional<std::size_t> length_;     ///< of the content that comes next
  std::size_t to_skip_ = 0;               ///< [bytes] of a content that is too long
  int dropped_ = 0;
};

/// A message as it goes over the wire.
std::string framed(std::string_view content);

}  // namespace zwang::lsp
