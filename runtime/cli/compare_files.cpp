#include "compare_files.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>

namespace zwang::cli {

namespace {

using lang::Source;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Finds the lines between the common beginning and the common end of two files.
void find_difference(const std::string& first, const std::string& second, FilePair& pair) {
  const std::vector<std::string> a = lines_of(first), b = lines_of(second);
  const std::size_t shorter = std::min(a.size(), b.size());
  std::size_t ahead = 0, behind = 0;
  while (ahead < shorter && a[ahead] == b[ahead]) ++ahead;
  while (behind < shorter - ahead && a[a.size() - 1 - behind] == b[b.size() - 1 - behind]) ++behind;
  pair.line = static_cast<int>(ahead) + 1;
  const auto between = [&](const std::vector<std::string>& lines) {
    return std::vector(lines.begin() + static_cast<std::ptrdiff_t>(ahead),
                       lines.end() - static_cast<std::ptrdiff_t>(behind));
  };
  pair.first_lines = between(a);
  pair.second_lines = between(b);
}

FilePair pair_of(const Source* first, const Source* second) {
  FilePair pair;
  if (first != nullptr) pair.first = first->path;
  if (second != nullptr) pair.second = second->path;
  if (first == nullptr || second == nullptr) return pair;
  pair.is_same = first->text == second->text;
  if (!pair.is_same) find_difference(first->text, second->text, pair);
  return pair;
}

std::string name_of(const Source& source) {
  return std::filesystem::path(source.path).filename().string();
}

}  // namespace

std::vector<FilePair> pairs_of(const std::vector<Source>& first, const std::vector<Source>& second) {
  std::vector<const Source*> counterparts(first.size(), nullptr);
  std::vector<bool> is_taken(second.size(), false);
  const auto match = [&](const std::function<bool(std::size_t, std::size_t)>& belong) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t j = 0; j < second.size() && counterparts[i] == nullptr; ++j) {
        if (is_taken[j] || !belong(i, j)) continue;
        counterparts[i] = &second[j];
        is_taken[j] = true;
      }
    }
  };
  match([&](std::size_t i, std::size_t j) { return first[i].path == second[j].path; });
  match([&](std::size_t i, std::size_t j) { return name_of(first[i]) == name_of(second[j]); });
  match([](std::size_t i, std::size_t j) { return i == 0 && j == 0; });
  std::vector<FilePair> pairs;
  for (std::size_t i = 0; i < first.size(); ++i) pairs.push_back(pair_of(&first[i], counterparts[i]));
  for (std::size_t j = 0; j < second.size(); ++j) {
    if (!is_taken[j]) pairs.push_back(pair_of(nullptr, &second[j]));
  }
  return pairs;
}

}  // namespace zwang::cli
