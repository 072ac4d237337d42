/// Columns of text for the terminal.
#pragma once

#include <string>
#include <vector>

namespace zwang::cli {

/// Columns as wide as their widest cell; those of numbers stand to the right.
class Table {
 public:
  explicit Table(std::vector<bool> to_right);
  void add(std::vector<std::string> row);
  std::string text() const;

 private:
  std::vector<bool> to_right_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace zwang::cli
