#include "log/block_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "log/mcap_format.hpp"

namespace zwang::runtime {

namespace {

// The first byte of a column.
constexpr std::uint8_t blank = 0;     // no number in any record
constexpr std::uint8_t constant = 1;  // the 8 bytes of all records
constexpr std::uint8_t copy = 2;      // the number (2 bytes) of an earlier column that is the same
// Beyond: 16 times how often differences are taken, and the bytes that one of them needs.
constexpr unsigned order_step = 16;
constexpr std::size_t most_orders = 3;  // a fourth saves 6 % of the hospital's bytes

constexpr std::uint64_t blank_bits = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::quiet_NaN());
constexpr std::size_t most_numbers = std::size_t{1} << 23;  // of a block that is read; ours have 100 records
constexpr unsigned byte_bits = 8;

std::uint64_t bits_of(double number) {
  return std::bit_cast<std::uint64_t>(number);
}

/// Small numbers of either sign become small ones without a sign.
std::uint64_t folded(std::uint64_t difference) {
  return (difference << 1U) ^ (0 - (difference >> 63U));
}
std::uint64_t unfolded(std::uint64_t number) {
  return (number >> 1U) ^ (0 - (number & 1U));
}

std::size_t bytes_for(std::uint64_t number) {
  return (static_cast<std::size_t>(std::bit_width(number)) + byte_bits - 1) / byte_bits;
}

void append_number(std::string& bytes, std::uint64_t number, std::size_t size) {
  char all[sizeof number];
  for (std::size_t i = 0; i < sizeof number; ++i) all[i] = static_cast<char>(number >> (byte_bits * i));
  bytes.append(all, size);
}

/// From the entry `order` on each minus the one before it. Returns the bits that they have, folded, together.
std::uint64_t take_differences(const std::vector<std::uint64_t>& numbers, std::size_t order,
                               std::vector<std::uint64_t>& differences) {
  differences.resize(numbers.size());
  std::copy_n(numbers.begin(), order, differences.begin());
  std::uint64_t bits = 0;
  for (std::size_t i = order; i < numbers.size(); ++i) {
    differences[i] = numbers[i] - numbers[i - 1];
    bits |= folded(differences[i]);
  }
  return bits;
}

void add_up(std::vector<std::uint64_t>& numbers, std::size_t order) {
  for (std::size_t i = order; i < numbers.size(); ++i) numbers[i] += numbers[i - 1];
}

}  // namespace

BlockWriter::BlockWriter(std::size_t columns) : columns_(columns), changed_(columns) {}

void BlockWriter::add(const double* record) {
  const std::size_t begin = records_ * columns_;
  if (rows_.size() < begin + columns_) rows_.resize(begin + columns_);
  // One pass: a record comes from memory that no cache holds.
  const double* const first = rows_.data();
  double* const row = rows_.data() + begin;
  std::uint64_t* const changed = changed_.data();
  for (std::size_t i = 0; i < columns_; ++i) {
    row[i] = record[i];
    changed[i] |= bits_of(first[i]) ^ bits_of(record[i]);
  }
  ++records_;
}

const std::string& BlockWriter::take() {
  bytes_.clear();
  append_number(bytes_, records_, sizeof(std::uint32_t));
  append_number(bytes_, columns_, sizeof(std::uint32_t));
  packed_.clear();
  for (std::size_t i = 0; i < columns_; ++i) append_column(i);
  std::ranges::fill(changed_, 0);
  records_ = 0;
  return bytes_;
}

void BlockWriter::append_column(std::size_t column) {
  if (changed_[column] == 0) {
    const std::uint64_t bits = bits_of(rows_[column]);
    const bool is_blank = bits == blank_bits;
    bytes_ += static_cast<char>(is_blank ? blank : constant);
    if (!is_blank) append_number(bytes_, bits, sizeof(double));
    return;
  }
  column_.resize(records_);
  for (std::size_t i = 0; i < records_; ++i) column_[i] = bits_of(rows_[i * columns_ + column]);
  if (append_copy(column)) return;
  packed_.push_back(column);
  append_differences();
}

bool BlockWriter::append_copy(std::size_t column) {
  const auto is_same = [&](std::size_t other) {
    // Unlike columns part soon, and most of them where they change first and last.
    if (changed_[other] != changed_[column]) return false;
    for (std::size_t i = records_; i-- > 0;) {
      if (bits_of(rows_[i * columns_ + other]) != column_[i]) return false;
    }
    return true;
  };
  const auto same = std::ranges::find_if(packed_, is_same);
  if (same == packed_.end() || *same > std::numeric_limits<std::uint16_t>::max()) return false;
  bytes_ += static_cast<char>(copy);
  append_number(bytes_, *same, sizeof(std::uint16_t));
  return true;
}

/// A smooth curve has small second and third differences; noise has not, and ends the search.
void BlockWriter::append_differences() {
  std::size_t order = 0, width = sizeof(double) + 1;
  for (std::size_t tried = 1; tried <= most_orders && tried < records_; ++tried) {
    const std::vector<std::uint64_t>& before = tried == 1 ? column_ : best_;
    const std::size_t needed = bytes_for(take_differences(before, tried, differences_));
    if (needed >= width) break;
    width = needed;
    order = tried;
    std::swap(best_, differences_);
  }
  bytes_ += static_cast<char>(order_step * order + width);
  for (std::size_t i = 0; i < order; ++i) append_number(bytes_, best_[i], sizeof(double));
  for (std::size_t i = order; i < records_; ++i) best_[i] = folded(best_[i]);
  const std::size_t count = records_ - order;
  std::size_t begin = bytes_.size();
  bytes_.resize(begin + width * count);
  for (std::size_t plane = width; plane-- > 0; begin += count) {
    for (std::size_t i = 0; i < count; ++i)
      bytes_[begin + i] = static_cast<char>(best_[order + i] >> (byte_bits * plane));
  }
}

namespace {

/// Puts one column after another into records that are given.
class BlockReader {
 public:
  BlockReader(std::string_view bytes, std::size_t columns, std::size_t records, std::vector<double>& rows)
      : bytes_(bytes), columns_(columns), records_(records), rows_(rows) {}

  bool read_all() {
    for (column_ = 0; column_ < columns_; ++column_) {
      if (!read_column() || !bytes_.good()) return false;
    }
    return bytes_.rest().empty();
  }

 private:
  double& at(std::size_t record, std::size_t column) { return rows_[record * columns_ + column]; }

  bool read_column() {
    const unsigned kind = bytes_.opcode();
    if (kind == blank || kind == constant) {
      const auto value = std::bit_cast<double>(kind == blank ? blank_bits : bytes_.u64());
      for (std::size_t i = 0; i < records_; ++i) at(i, column_) = value;
      return true;
    }
    if (kind == copy) {
      const std::size_t other = bytes_.u16();
      if (other >= column_) return false;
      for (std::size_t i = 0; i < records_; ++i) at(i, column_) = at(i, other);
      return true;
    }
    return read_differences(kind / order_step, kind % order_step);
  }

  bool read_differences(std::size_t order, std::size_t width) {
    if (order == 0 || order > most_orders || order >= records_ || width > sizeof(double)) return false;
    numbers_.assign(records_, 0);
    for (std::size_t i = 0; i < order; ++i) numbers_[i] = bytes_.u64();
    for (std::size_t plane = width; plane-- > 0;) {
      const std::string_view one = bytes_.raw(records_ - order);
      if (!bytes_.good()) return false;
      for (std::size_t i = 0; i < one.size(); ++i)
        numbers_[order + i] |= std::uint64_t{static_cast<unsigned char>(one[i])} << (byte_bits * plane);
    }
    for (std::size_t i = order; i < records_; ++i) numbers_[i] = unfolded(numbers_[i]);
    for (std::size_t i = order; i > 0; --i) add_up(numbers_, i);
    for (std::size_t i = 0; i < records_; ++i) at(i, column_) = std::bit_cast<double>(numbers_[i]);
    return true;
  }

  mcap::Reader bytes_;
  std::size_t columns_, records_, column_ = 0;
  std::vector<double>& rows_;
  std::vector<std::uint64_t> numbers_;
};

}  // namespace

bool read_block(std::string_view block, std::size_t columns, std::vector<double>& records) {
  mcap::Reader head(block);
  const std::size_t count = head.u32();
  if (head.u32() != columns || !head.good() || count == 0 || columns == 0) return false;
  if (count > most_numbers / columns) return false;
  records.resize(count * columns);
  return BlockReader(head.rest(), columns, count, records).read_all();
}

}  // namespace zwang::runtime
