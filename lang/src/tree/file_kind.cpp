#include "zwang/lang/file_kind.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>

#include "zwang/lang/open_texts.hpp"

namespace zwang::lang {

const char* word_of(FileKind kind) {
  switch (kind) {
    case FileKind::task:
      return "task";
    case FileKind::robot:
      return "robot";
    case FileKind::scene:
      return "scene";
    case FileKind::scenario:
      return "scenario";
    case FileKind::connection:
      return "connection";
    case FileKind::study:
      break;
  }
  return "study";
}

namespace {

struct FirstKey {
  std::string_view key;
  FileKind kind;
};
constexpr FirstKey first_keys[] = {{"zwang", FileKind::task},
                                   {"zwang_robot", FileKind::robot},
                                   {"zwang_scene", FileKind::scene},
                                   {"zwang_scenario", FileKind::scenario},
                                   {"zwang_connection", FileKind::connection},
                                   {"zwang_study", FileKind::study}};
constexpr std::size_t is_another_word = 3;

/// How many letters have to be written again for one word to become the other, if they stand together.
std::size_t letters_between(std::string_view a, std::string_view b) {
  const std::size_t longest = std::max(a.size(), b.size()), shortest = std::min(a.size(), b.size());
  std::size_t before = 0, behind = 0;
  while (before < shortest && a[before] == b[before]) ++before;
  while (before + behind < shortest && a[a.size() - 1 - behind] == b[b.size() - 1 - behind]) ++behind;
  return longest - before - behind;
}

/// A key with a letter too many, too few, wrong or swapped is the one that it is nearest to.
std::optional<FileKind> kind_of_key(std::string_view key) {
  std::size_t least = is_another_word;
  std::optional<FileKind> kind;
  for (const FirstKey& first : first_keys) {
    const std::size_t letters = letters_between(key, first.key);
    // Of a short word more would be left than is told by it.
    if (letters >= least || (first.kind == FileKind::task && letters > 1)) continue;
    least = letters;
    kind = first.kind;
  }
  return kind;
}

/// The key that a line begins with, whatever stands around it; empty for a comment and the like.
std::string_view key_of(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t\r{\"'");
  if (begin == std::string_view::npos || line[begin] == '#' || line.substr(begin, 3) == "---") return {};
  line.remove_prefix(begin);
  return line.substr(0, line.find_first_of(" \t\r:\"'"));
}

}  // namespace

std::optional<FileKind> kind_of_text(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (const std::string_view key = key_of(text.substr(0, end)); !key.empty()) return kind_of_key(key);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return std::nullopt;
}

std::optional<FileKind> kind_of_file(const std::filesystem::path& path) {
  if (const std::string* open = open_text_of(path)) return kind_of_text(*open);
  std::string start(16 * 1024, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return kind_of_text(start);
}

}  // namespace zwang::lang
