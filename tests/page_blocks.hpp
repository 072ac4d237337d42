/// The fenced blocks of a Markdown page: what a test runs of it.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace zwang::test {

struct PageBlock {
  std::string kind;  ///< behind the opening fence: "yaml", "yaml task", "text zwang validate FILE", ""
  std::string text;
  int line = 0;  ///< of the opening fence
};

inline std::vector<PageBlock> page_blocks(const std::filesystem::path& path) {
  std::ifstream page(path);
  std::vector<PageBlock> blocks;
  bool is_inside = false;
  int number = 0;
  for (std::string line; std::getline(page, line);) {
    ++number;
    if (line.starts_with("```")) {
      is_inside = !is_inside;
      if (is_inside) blocks.push_back({line.substr(3), "", number});
    } else if (is_inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

}  // namespace zwang::test
