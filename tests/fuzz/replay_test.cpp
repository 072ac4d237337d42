// The fuzzer's seeds and its former finds, given to the same targets: a fixed find stays fixed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "targets.hpp"

namespace zwang::fuzz {

void PrintTo(const Target& target, std::ostream* out) {
  *out << target.name;
}

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

/// One change that a hand or a broken disk makes: a byte, a cut, a line twice, a piece of another file.
std::string mutated(std::string text, const std::string& other, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::size_t at = below(text.size());
  const std::size_t length = below(std::min<std::size_t>(text.size() - at, 40) + 1);
  static const std::string letters = "{}[],:-#'\"$&*!|>%@` \n\tx1.\xC3\x80";
  switch (random() % 5) {
    case 0:
      if (!text.empty()) text[at] = letters[below(letters.size())];
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, text.substr(at, length));
      break;
    case 3:
      text.insert(at, other.substr(below(other.size()), 1 + below(40)));
      break;
    default:
      text.insert(at, 1, static_cast<char>(random() % 256));
  }
  return text;
}

/// A fuzzer that knows nothing, but runs everywhere: the seed is fixed, ZWANG_MUTATIONS asks for more.
TEST_P(Replay, seeded_changes_of_every_seed) {
  std::vector<std::string> seeds;
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(corpus / GetParam().name)) files.push_back(file.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) seeds.push_back(slurp(file));
  const char* more = std::getenv("ZWANG_MUTATIONS");
  const int count = more != nullptr ? std::atoi(more) : 300;
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) {
    std::string text = seeds[random() % seeds.size()];
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes) {
      text = mutated(std::move(text), seeds[random() % seeds.size()], random);
    }
    // Left behind when the target aborts.
    if (more != nullptr) std::ofstream("last_mutation", std::ios::binary) << text;
    GetParam().run(text);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Replay, testing::ValuesIn(targets()),
                         [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace zwang::fuzz
