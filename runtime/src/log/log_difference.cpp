#include "zwang/runtime/log_difference.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "log/logged_columns.hpp"

namespace zwang::runtime {

namespace {

constexpr double usual_period = 1e-3;       // [s]
constexpr double share_of_a_period = 0.25;  // two neighbours are never both a pair with one record

bool is_clock(const std::string& name) {
  return name == "sensed.time" || name.ends_with(".stamp");
}

/// A log that is read record by record.
class Side {
 public:
  explicit Side(const std::filesystem::path& path) : records_(path) { is_open_ = records_.next(); }

  bool is_open() const { return is_open_; }
  void go_on() { is_open_ = records_.next(); }
  /// [s] since the run began
  double time() const { return records_.time() - begin(); }
  double begin() const { return records_.contents().begin; }
  std::span<const double> values() const { return records_.values(); }
  const std::vector<LoggedColumn>& columns() const { return contents().columns; }
  const LogContents& contents() const { return records_.contents(); }

 private:
  LogRecords records_;
  bool is_open_ = false;
};

/// A column of the first log and its namesake in the second.
struct Pair {
  std::size_t first = 0, second = 0;
  bool is_clock = false;
  int difference = -1;  ///< index into the differences; -1: none so far
};

class Comparison {
 public:
  Comparison(const std::filesystem::path& first, const std::filesystem::path& second)
      : first_(first), second_(second) {}

  LogDifference of_all() {
    columns_ = first_.contents().columns;
    others_ = second_.contents().columns;
    pair_up();
    const double shorter =
        std::min(period_of(first_.contents().context), period_of(second_.contents().context));
    tolerance_ = share_of_a_period * shorter;
    while (first_.is_open() && second_.is_open()) {
      const double ahead = first_.time() - second_.time();
      if (std::abs(ahead) <= tolerance_) compare(first_.values(), second_.values());
      if (ahead <= tolerance_) first_.go_on();
      if (ahead >= -tolerance_) second_.go_on();
    }
    while (first_.is_open()) first_.go_on();
    while (second_.is_open()) second_.go_on();
    found_.first = first_.contents();
    found_.second = second_.contents();
    std::ranges::stable_sort(found_.columns, [](const ColumnDifference& a, const ColumnDifference& b) {
      return a.time != b.time ? a.time < b.time : a.is_input && !b.is_input;
    });
    return std::move(found_);
  }

 private:
  void pair_up() {
    std::map<std::string_view, std::size_t> places;
    for (std::size_t i = 0; i < others_.size(); ++i) places[others_[i].name] = i;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto other = places.find(columns_[i].name);
      if (other == places.end()) {
        found_.only_first.push_back(columns_[i].name);
        continue;
      }
      if (columns_[i].name != "time") pairs_.push_back({i, other->second, is_clock(columns_[i].name)});
      places.erase(other);
    }
    for (const LoggedColumn& other : others_) {
      if (places.contains(other.name)) found_.only_second.push_back(other.name);
    }
  }

  void compare(std::span<const double> first, std::span<const double> second) {
    ++found_.compared;
    found_.until = first_.time();
    for (Pair& pair : pairs_) {
      const double a = first[pair.first], b = second[pair.second];
      if (are_alike(pair, a, b)) continue;
      if (!pair.is_clock || !are_one_instant(a, b)) note(pair, a, b);
    }
  }

  bool has_words(const Pair& pair) const { return !columns_[pair.first].words.empty(); }

  /// Zeros of either sign are alike. An input that is left out is 0.
  double number(const Pair& pair, double value) const {
    return std::isnan(value) && !has_words(pair) && columns_[pair.first].is_input() ? 0.0 : value;
  }

  bool are_alike(const Pair& pair, double a, double b) const {
    if (has_words(pair)) return columns_[pair.first].word(a) == others_[pair.second].word(b);
    const double first = number(pair, a), second = number(pair, b);
    return first == second || (std::isnan(first) && std::isnan(second));
  }

  /// A blank clock is one at 0.
  bool are_one_instant(double a, double b) const {
    const double first = std::isnan(a) ? 0.0 : a, second = std::isnan(b) ? 0.0 : b;
    return std::abs((first - first_.begin()) - (second - second_.begin())) <= tolerance_;
  }

  void note(Pair& pair, double a, double b) {
    const LoggedColumn& column = columns_[pair.first];
    if (pair.difference < 0) {
      pair.difference = static_cast<int>(found_.columns.size());
      ColumnDifference& one = found_.columns.emplace_back();
      one.name = column.name;
      one.unit = column.unit;
      one.is_input = column.is_input();
      one.time = first_.time();
      one.first = column.text(number(pair, a));
      one.second = others_[pair.second].text(number(pair, b));
    }
    ColumnDifference& one = found_.columns[static_cast<std::size_t>(pair.difference)];
    ++one.records;
    // NaN of a word, and of a blank: neither is larger than anything.
    const double size = has_words(pair) ? std::nan("") : std::abs(a - b);
    if (!(size > one.largest.value_or(-1.0))) return;
    one.largest = size;
    one.largest_time = first_.time();
  }

  Side first_, second_;
  double tolerance_ = 0.0;                      // [s]
  std::vector<LoggedColumn> columns_, others_;  // of the first log, and of the second one
  std::vector<Pair> pairs_;
  LogDifference found_;
};

}  // namespace

LogDifference difference(const std::filesystem::path& first, const std::filesystem::path& second) {
  return Comparison(first, second).of_all();
}

std::optional<std::size_t> first_difference(const std::vector<Happening>& first,
                                            const std::vector<Happening>& second, double tolerance) {
  const std::size_t both = std::min(first.size(), second.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (first[i].what != second[i].what || std::abs(first[i].time - second[i].time) > tolerance) return i;
  }
  if (first.size() == second.size()) return std::nullopt;
  return both;
}

double period_of(const LogContext& context) {
  const auto period = context.facts.find("period [s]");
  const double value = period == context.facts.end() ? usual_period : number_of(period->second);
  return value > 0.0 ? value : usual_period;
}

}  // namespace zwang::runtime
