#include "table.hpp"

#include <algorithm>
#include <utility>

#include "colour.hpp"
#include "output.hpp"

namespace zwang::cli {

Table::Table(std::vector<bool> to_right) : to_right_(std::move(to_right)), widths_(to_right_.size(), 0) {}

void Table::add(std::vector<std::string> row) {
  for (std::size_t i = 0; i < row.size(); ++i) widths_[i] = std::max(widths_[i], columns_of(row[i]));
  rows_.push_back(std::move(row));
}

std::string Table::text() const {
  std::string out;
  for (const auto& row : rows_) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += ' ';
      line += to_right_[i] ? padded_left(row[i], widths_[i]) : padded(row[i], widths_[i]);
      line += ' ';
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

}  // namespace zwang::cli
