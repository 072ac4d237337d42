// What the fuzzer starts from and what it once found, given to the same targets: a find stays mended.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "targets.hpp"

namespace zwang::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path corpus = fs::path(ZWANG_SOURCE_DIR) / "tests/fuzz/corpus";

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class Replay : public testing::TestWithParam<Target> {};

TEST_P(Replay, every_input_of_the_corpus) {
  int count = 0;
  for (const auto& file : fs::directory_iterator(corpus / GetParam().name)) {
    SCOPED_TRACE(file.path().string());
    GetParam().run(slurp(file.path()));
    ++count;
  }
  EXPECT_GE(count, 5);
}

/// Every cut of a good file: what a half-written one looks like.
TEST_P(Replay, every_beginning_of_the_longest_seed) {
  std::string longest;
  for (const auto& file : fs::directory_iterator(corpus / GetParam().name)) {
    const bool is_seed = file.path().filename().string().starts_with("seed_");
    if (is_seed && fs::file_size(file.path()) > longest.size()) longest = slurp(file.path());
  }
  ASSERT_GT(longest.size(), 20u);
  const std::size_t step = std::max<std::size_t>(1, longest.size() / 300);
  for (std::size_t size = 0; size <= longest.size(); size += step) GetParam().run(longest.substr(0, size));
}

INSTANTIATE_TEST_SUITE_P(Of, Replay, testing::ValuesIn(targets()),
                         [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace zwang::fuzz
