/// zstd and CRC-32. The only file of the room that knows these libraries is compression.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace zwang::runtime {

/// Keeps its memory from call to call.
class Compressor {
 public:
  Compressor();
  ~Compressor();
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
  /// Valid until the next call; nothing when the library refuses.
  std::optional<std::string_view> compress(std::string_view bytes);

 private:
  struct State;
  std::unique_ptr<State> state_;
};
/// False unless `bytes` are a whole frame of exactly `size` bytes. `whole` keeps its memory from call to
/// call.
bool decompress(std::string_view bytes, std::size_t size, std::string& whole);
/// In the zlib format (RFC 1950), which browsers read; nullopt where memory ends.
std::optional<std::string> deflate(std::string_view bytes);
/// CRC-32 as in zlib; `crc` is that of the bytes before.
std::uint32_t crc32(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace zwang::runtime
