// Records in blocks: whatever the numbers are, the same bits come back; whatever the bytes are, nothing
// breaks.
#include "log/block_code.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace zwang::runtime {
namespace {

using Rows = std::vector<std::vector<double>>;

std::string packed_rows(const Rows& rows) {
  BlockWriter writer(rows.front().size());
  for (const std::vector<double>& row : rows) writer.add(row.data());
  return writer.take();
}

bool come_back(const Rows& rows, const std::string& block) {
  std::vector<double> found;
  const std::size_t columns = rows.front().size();
  if (!read_block(block, columns, found) || found.size() != rows.size() * columns) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::memcmp(&found[i * columns], rows[i].data(), columns * sizeof(double)) != 0) return false;
  }
  return true;
}

/// One of the ways in which columns go.
double value_at(unsigned kind, int row, std::mt19937_64& random) {
  switch (kind % 8) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return 0.25;
    case 2:
      return 1e9 + row * 1e-3;
    case 3:
      return std::sin(0.05 * row - 1.0);
    case 4:
      return std::bit_cast<double>(random());
    case 5:
      return row % 2 == 0 ? 0.0 : -0.0;
    case 6:
      return row < 7 ? std::numeric_limits<double>::quiet_NaN() : 0.5 * row;
    default:
      return row == 11 ? std::numeric_limits<double>::infinity() : 3.0;
  }
}

Rows drawn_rows(std::mt19937_64& random) {
  Rows rows(1 + random() % 100, std::vector<double>(1 + random() % 20));
  for (std::size_t c = 0; c < rows.front().size(); ++c) {
    const auto kind = static_cast<unsigned>(random());
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r][c] = value_at(kind, static_cast<int>(r), random);
    // Some columns are copies of others.
    if (c > 0 && random() % 4 == 0) {
      for (std::vector<double>& row : rows) row[c] = row[0];
    }
  }
  return rows;
}

TEST(BlockCode, BringsEveryBitBack) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    const Rows rows = drawn_rows(random);
    EXPECT_TRUE(come_back(rows, packed_rows(rows))) << round;
  }
}

TEST(BlockCode, AWriterIsUsedAgain) {
  std::mt19937_64 random(2);
  BlockWriter writer(1);
  for (int round = 0; round < 20; ++round) {
    Rows rows(1 + random() % 60, std::vector<double>(1));
    for (std::vector<double>& row : rows) {
      row[0] = value_at(static_cast<unsigned>(round), static_cast<int>(&row - rows.data()), random);
      writer.add(row.data());
    }
    EXPECT_EQ(writer.records(), rows.size());
    EXPECT_TRUE(come_back(rows, writer.take())) << round;
    EXPECT_EQ(writer.records(), 0u);
  }
}

/// The sizes that the format says. In [1, 2) a number and its bits go up together, evenly.
TEST(BlockCode, TakesTheBytesThatTheFormatSays) {
  constexpr std::size_t head = 4 + 4, number = 8;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Rows blank(50, {nan}), constant(50, {1.5}), even, noise, copies;
  std::mt19937_64 random(3);
  for (int i = 0; i < 50; ++i) {
    even.push_back({1.0 + std::ldexp(i, -10)});
    noise.push_back({std::bit_cast<double>((random() >> 12U) | std::bit_cast<std::uint64_t>(1.0))});
    copies.push_back({noise.back()[0], noise.back()[0]});
  }
  EXPECT_EQ(packed_rows(blank).size(), head + 1);
  EXPECT_EQ(packed_rows(constant).size(), head + 1 + number);
  EXPECT_EQ(packed_rows(even).size(), head + 1 + 2 * number) << "second differences are zero";
  EXPECT_EQ(packed_rows(noise).size(), head + 1 + number + 49 * 7) << "52 random bits and a sign";
  EXPECT_EQ(packed_rows(copies).size(), packed_rows(noise).size() + 1 + 2);
}

TEST(BlockCode, RefusesWhatIsNoBlock) {
  std::mt19937_64 random(4);
  std::vector<double> found;
  for (int round = 0; round < 20; ++round) {
    const Rows rows = drawn_rows(random);
    const std::size_t columns = rows.front().size();
    const std::string block = packed_rows(rows);
    for (std::size_t size = 0; size < block.size(); size += 1 + size / 16)
      EXPECT_FALSE(read_block(std::string_view(block).substr(0, size), columns, found)) << size;
    EXPECT_FALSE(read_block(block, columns + 1, found));
    EXPECT_FALSE(read_block(block + "x", columns, found));
  }
  EXPECT_FALSE(read_block("", 0, found));
  EXPECT_FALSE(read_block(std::string("\xFF\xFF\xFF\xFF\1\0\0\0\0", 9), 1, found)) << "32 GB of blanks";
}

TEST(BlockCode, BytesOfAnyKindBreakNothing) {
  std::mt19937_64 random(5);
  std::vector<double> found;
  for (int round = 0; round < 2000; ++round) {
    const Rows rows = drawn_rows(random);
    std::string block = packed_rows(rows);
    for (int change = 0; change < 3; ++change) block[random() % block.size()] = static_cast<char>(random());
    if (read_block(block, rows.front().size(), found)) {
      EXPECT_EQ(found.size() % rows.front().size(), 0u);
    }
  }
}

}  // namespace
}  // namespace zwang::runtime
