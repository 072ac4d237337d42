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

bool is_input(const std::string& name) {
  return name.starts_with("sensed.") || name.starts_with("params.");
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
  std::string_view record() const { return records_.json(); }
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
    columns_ = logged_columns(first_.contents().schema);
    const std::vector<LoggedColumn> others = logged_columns(second_.contents().schema);
    pair_up(others);
    RecordParts first(columns_), second(others);
    const double shorter =
        std::min(period_of(first_.contents().context), period_of(second_.contents().context));
    tolerance_ = share_of_a_period * shorter;
    while (first_.is_open() && second_.is_open()) {
      const double ahead = first_.time() - second_.time();
      if (std::abs(ahead) <= tolerance_) compare(first, second);
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
  void pair_up(const std::vector<LoggedColumn>& others) {
    std::map<std::string_view, std::size_t> places;
    for (std::size_t i = 0; i < others.size(); ++i) places[others[i].name] = i;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const auto other = places.find(columns_[i].name);
      if (other == places.end()) {
        found_.only_first.push_back(columns_[i].name);
        continue;
      }
      if (columns_[i].name != "time") pairs_.push_back({i, other->second, is_clock(columns_[i].name)});
      places.erase(other);
    }
    for (const LoggedColumn& other : others) {
      if (places.contains(other.name)) found_.only_second.push_back(other.name);
    }
  }

  void compare(RecordParts& first, RecordParts& second) {
    ++found_.compared;
    found_.until = first_.time();
    // Runs are alike most of the time, and their texts then are, too.
    if (first_.record() == second_.record()) return;
    first.split(first_.record());
    second.split(second_.record());
    for (Pair& pair : pairs_) {
      const std::string_view a = first[pair.first], b = second[pair.second];
      if (a == b || (is_zero(pair, a) && is_zero(pair, b))) continue;
      if (!pair.is_clock || !are_one_instant(a, b)) note(pair, a, b);
    }
  }

  /// Zeros of either sign are alike. An input that is left out is 0.
  bool is_zero(const Pair& pair, std::string_view text) const {
    return text == "0" || text == "-0.0" || (text.empty() && is_input(columns_[pair.first].name));
  }

  /// A blank clock is one at 0.
  bool are_one_instant(std::string_view a, std::string_view b) const {
    const double first = a.empty() ? 0.0 : number_of(a), second = b.empty() ? 0.0 : number_of(b);
    return std::abs((first - first_.begin()) - (second - second_.begin())) <= tolerance_;
  }

  void note(Pair& pair, std::string_view a, std::string_view b) {
    if (pair.difference < 0) {
      pair.difference = static_cast<int>(found_.columns.size());
      ColumnDifference& one = found_.columns.emplace_back();
      one.name = columns_[pair.first].name;
      one.unit = columns_[pair.first].unit;
      one.is_input = is_input(one.name);
      one.time = first_.time();
      // An input that is left out is 0.
      const bool is_zero_blank = one.is_input && !columns_[pair.first].has_words;
      one.first = a.empty() && is_zero_blank ? "0" : a;
      one.second = b.empty() && is_zero_blank ? "0" : b;
    }
    ColumnDifference& one = found_.columns[static_cast<std::size_t>(pair.difference)];
    ++one.records;
    // NaN of a word, and of a blank: neither is larger than anything.
    const double size = columns_[pair.first].has_words ? std::nan("") : std::abs(number_of(a) - number_of(b));
    if (!(size > one.largest.value_or(-1.0))) return;
    one.largest = size;
    one.largest_time = first_.time();
  }

  Side first_, second_;
  double tolerance_ = 0.0;             // [s]
  std::vector<LoggedColumn> columns_;  // of the first log
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
