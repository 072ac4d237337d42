/// XCDR1, the encoding of ROS 2 messages: written little endian, read in either order, never beyond the end.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace zwang::connect {

using Bytes = std::vector<std::uint8_t>;

/// A number of CDR: as wide as it is aligned.
template <typename T>
concept CdrNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Alignment counts from behind the four bytes of the encapsulation header.
inline constexpr std::size_t cdr_header = 4;

class CdrWriter {
 public:
  /// Writes into `bytes`, whose memory is used again.
  explicit CdrWriter(Bytes& bytes) : bytes_(bytes) { bytes_.assign({0, 1, 0, 0}); }

  template <CdrNumber T>
  void operator()(const T& value) {
    while ((bytes_.size() - cdr_header) % sizeof(T) != 0) bytes_.push_back(0);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof(T));
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
  }
  void operator()(const bool& value) { bytes_.push_back(value ? 1 : 0); }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }
  template <typename T>
  void operator()(const std::vector<T>& list) {
    (*this)(static_cast<std::uint32_t>(list.size()));
    for (const T& item : list) (*this)(item);
  }
  template <typename T, std::size_t n>
  void operator()(const std::array<T, n>& items) {
    for (const T& item : items) (*this)(item);
  }

 private:
  static_assert(std::endian::native == std::endian::little, "the header says little endian");
  Bytes& bytes_;
};

/// After the first value that is not there everything reads as 0, and `is_good` stays false.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    is_good_ = bytes.size() >= cdr_header && bytes[0] == 0 && bytes[1] <= 1;
    is_swapped_ = is_good_ && bytes[1] == 0;
  }

  bool is_good() const { return is_good_; }
  /// Whether nothing is left but the padding of a payload to four bytes.
  bool is_at_end() const { return is_good_ && bytes_.size() - at_ < 4; }

  template <CdrNumber T>
  void operator()(T& value) {
    value = T{};
    const std::size_t padding = (sizeof(T) - (at_ - cdr_header) % sizeof(T)) % sizeof(T);
    if (!has(padding + sizeof(T))) return;
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_ + padding, sizeof(T));
    if (is_swapped_) std::reverse(raw.begin(), raw.end());
    std::memcpy(&value, raw.data(), sizeof(T));
    at_ += padding + sizeof(T);
  }
  void operator()(bool& value) {
    std::uint8_t byte = 0;
    (*this)(byte);
    value = byte != 0;
    if (byte > 1) is_good_ = false;
  }
  void operator()(std::string& text) {
    text.clear();
    std::uint32_t length = 0;
    (*this)(length);
    // The terminating zero counts; some write an empty text without it.
    if (!has(length) || length == 0) return;
    if (bytes_[at_ + length - 1] != 0) is_good_ = false;
    text.assign(bytes_.begin() + static_cast<std::ptrdiff_t>(at_),
                bytes_.begin() + static_cast<std::ptrdiff_t>(at_ + length - 1));
    at_ += length;
  }
  template <typename T>
  void operator()(std::vector<T>& list) {
    list.clear();
    std::uint32_t count = 0;
    (*this)(count);
    // No item is smaller than a byte: a count that lies cannot ask for more memory than came.
    if (!has(count)) return;
    for (std::uint32_t i = 0; i < count && is_good_; ++i) {
      list.emplace_back();
      (*this)(list.back());
    }
  }
  template <typename T, std::size_t n>
  void operator()(std::array<T, n>& items) {
    for (T& item : items) (*this)(item);
  }

 private:
  bool has(std::size_t count) {
    is_good_ = is_good_ && count <= bytes_.size() - at_;
    return is_good_;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = cdr_header;
  bool is_good_ = false;
  bool is_swapped_ = false;
};

}  // namespace zwang::connect
