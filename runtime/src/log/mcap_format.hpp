/// The records of MCAP version 0 (https://mcap.dev/spec), as far as a log of ours has them. A record is an
/// opcode (1 byte), the length of its content (8 bytes) and the content. All numbers are little-endian. A
/// string or a map has its length in bytes (4) before it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace zwang::runtime::mcap {

inline constexpr std::string_view magic("\x89MCAP0\r\n", 8);

enum Opcode : unsigned char {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::size_t record_head = 9;  // opcode and length
/// Of the records, and of their schema. Other channels are for other programs.
inline constexpr std::uint16_t records_channel = 1;

// Metadata of ours: the facts; those that only the end of a run knows; and where the last records were
// dropped, the sequence number behind them.
inline constexpr const char* facts_name = "zwang";
inline constexpr const char* conclusion_name = "zwang.conclusion";
inline constexpr const char* end_name = "zwang.end";
inline constexpr const char* end_sequence = "sequence";

/// The content of a record, put together.
class Content {
 public:
  Content& u16(std::uint16_t value) { return number(value, 2); }
  Content& u32(std::uint32_t value) { return number(value, 4); }
  Content& u64(std::uint64_t value) { return number(value, 8); }
  Content& text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size()));
    return raw(value);
  }
  Content& raw(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  Content& number(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_ += static_cast<char>((value >> (8 * i)) & 0xFF);
    return *this;
  }
  std::string bytes_;
};

inline std::string record(Opcode opcode, std::string_view content) {
  Content whole;
  whole.raw(std::string(1, static_cast<char>(opcode))).u64(content.size()).raw(content);
  return whole.bytes();
}

/// Takes the content of a record apart; past its end everything is zero or empty and `good` is false.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  unsigned char opcode() { return static_cast<unsigned char>(number(1)); }
  std::string_view text() { return raw(u32()); }
  std::string_view raw(std::uint64_t size) {
    if (size > rest_.size()) {
      good_ = false;
      rest_ = {};
      return {};
    }
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
    rest_.remove_prefix(static_cast<std::size_t>(size));
    return taken;
  }
  std::string_view rest() const { return rest_; }
  bool good() const { return good_; }

 private:
  std::uint64_t number(std::size_t size) {
    const std::string_view taken = raw(size);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      value |= std::uint64_t{static_cast<unsigned char>(taken[i])} << (8 * i);
    }
    return value;
  }
  std::string_view rest_;
  bool good_ = true;
};

}  // namespace zwang::runtime::mcap
