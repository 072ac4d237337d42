/// Records as bytes: a block of them column by column, without the loss of a bit. docs/logs.md has the
/// format, for other programs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace zwang::runtime {

/// The name of the encoding, as a channel of such messages has it.
inline constexpr const char* block_encoding = "zwang.block";

/// Takes records one by one and packs them together. Keeps its memory from block to block.
class BlockWriter {
 public:
  explicit BlockWriter(std::size_t columns);

  void add(const double* record);  ///< one number a column
  std::size_t records() const { return records_; }
  /// The block of all records since the last call. Valid until the next one.
  const std::string& take();

 private:
  void append_column(std::size_t column);
  bool append_copy(std::size_t column);
  void append_differences();

  std::size_t columns_, records_ = 0;
  std::vector<double> rows_;            ///< the records, one behind the other; those of before behind them
  std::vector<std::uint64_t> changed_;  ///< by column: bits that are unlike those of the first record
  std::vector<std::uint64_t> column_;   ///< the one that is packed now
  std::vector<std::uint64_t> differences_, best_;
  std::vector<std::size_t> packed_;  ///< columns of this block that stand in full
  std::string bytes_;
};

/// The records of a block, one behind the other. False where it is none of so many columns.
bool read_block(std::string_view block, std::size_t columns, std::vector<double>& records);

}  // namespace zwang::runtime
