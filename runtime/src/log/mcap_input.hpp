/// An MCAP file that is read from its begin, record by record, whole or damaged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace zwang::runtime::mcap {

inline constexpr std::uint64_t largest_record = std::uint64_t{64} << 20;  // [bytes]; ours have 1 MiB at most

class Input {
 public:
  /// Throws std::runtime_error when the file cannot be opened or does not begin as MCAP does.
  explicit Input(const std::filesystem::path& path);

  std::uint64_t at() const { return at_; }      ///< [bytes] where the next record begins
  std::uint64_t size() const { return size_; }  ///< [bytes]
  bool is_at_end() const { return at_ >= size_; }
  bool is_closed() const { return is_closed_; }         ///< ends as a file does that was ended properly
  std::uint32_t data_crc() const { return data_crc_; }  ///< of all records so far but the end of the data

  /// The opcode of the record that begins here, and its content; nothing when it cannot be one.
  std::optional<unsigned char> next_record(std::string& content);
  /// Whatever was damaged, chunks behind it can be found by how they begin. False: there is none.
  bool go_to_next_chunk(std::uint64_t from);
  /// The text of the first schema, which stands in the summary, too. Empty where it cannot be read. Reading
  /// goes on where it was.
  std::string schema_of_summary();

 private:
  bool take(std::string& bytes);
  void go_to(std::uint64_t place);
  bool ends_with_magic();
  std::string content_of(unsigned char opcode);

  std::ifstream file_;
  std::uint64_t at_ = 0, size_ = 0;
  std::uint32_t data_crc_ = 0;
  bool is_closed_ = false;
};

}  // namespace zwang::runtime::mcap
