#include <charconv>
#include <cmath>

#include "log/log_file.hpp"
#include "log/longest_number.hpp"
#include "zwang/runtime/log_csv.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

namespace {

constexpr int significant_digits = 9;
constexpr int digits_of_a_date = 15;   // a clock that counts from 1970 has 10 before its point
constexpr double earliest_date = 1e5;  // [s] below it nine digits are 0.1 ms

void append_number(std::string& line, double value, int precision) {
  char digits[longest_number];
  // Negative zero would make two equal states differ in the log.
  const auto end = std::to_chars(digits, digits + longest_number, value == 0.0 ? 0.0 : value,
                                 std::chars_format::general, precision);
  line.append(digits, end.ptr);
}

void append_value(std::string& line, const Column& column, double value) {
  if (std::isnan(value)) return;
  if (column.words.empty()) {
    const bool is_date = column.unit == "s" && std::abs(value) >= earliest_date;
    append_number(line, value, is_date ? digits_of_a_date : significant_digits);
    return;
  }
  const auto index = static_cast<std::size_t>(value);
  if (value >= 0.0 && index < column.words.size()) line += column.words[index];
}

std::string header(const std::vector<Column>& columns) {
  std::string line;
  for (const Column& column : columns) {
    if (column.is_input) continue;
    if (!line.empty()) line += ',';
    line += column.name;
    if (!column.unit.empty()) line += " [" + column.unit + "]";
  }
  return line + "\n";
}

void append_line(std::string& text, const std::vector<Column>& columns, std::span<const double> values) {
  bool is_first = true;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].is_input) continue;
    if (!is_first) text += ',';
    is_first = false;
    append_value(text, columns[i], values[i]);
  }
  text += '\n';
}

std::vector<Column> columns_of_log(const LogContents& log) {
  std::vector<Column> columns;
  for (const LoggedColumn& logged : log.columns)
    columns.push_back({logged.name, logged.unit, logged.words, {}, logged.is_input()});
  return columns;
}

class CsvSink : public LogSink {
 public:
  explicit CsvSink(const std::filesystem::path& path) : file_(path) {}

  std::string open(const std::vector<Column>& columns) override {
    columns_ = columns;
    const std::string error = file_.open();
    return error.empty() ? file_.append(header(columns_)) : error;
  }

  std::string write(std::span<const double> values) override {
    line_.clear();
    append_line(line_, columns_, values);
    return file_.append(line_);
  }

  std::string flush() override { return file_.flush(); }
  std::string close() override { return file_.close(); }
  std::uint64_t size() const override { return file_.size(); }

 private:
  LogFile file_;
  std::vector<Column> columns_;
  std::string line_;
};

}  // namespace

std::unique_ptr<LogSink> csv_sink(const std::filesystem::path& path) {
  return std::make_unique<CsvSink>(path);
}

LogContents log_as_csv(const std::filesystem::path& log, const std::function<void(std::string_view)>& put) {
  constexpr std::size_t piece = std::size_t{1} << 16;  // [bytes]
  std::vector<Column> columns;
  std::string text;
  LogContents contents = read_log(
      log,
      [&](double, std::span<const double> values) {
        append_line(text, columns, values);
        if (text.size() < piece) return;
        put(text);
        text.clear();
      },
      [&](const LogContents& head) {
        columns = columns_of_log(head);
        text = header(columns);
      });
  put(text);
  return contents;
}

}  // namespace zwang::runtime
