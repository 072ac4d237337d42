#include "zwang/runtime/series.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "log/compression.hpp"
#include "log/extremes.hpp"

namespace zwang::runtime {

namespace {

// Beyond these a curve has no more to show, or too little.
constexpr std::size_t most_buckets = 4096;
constexpr std::size_t fewest_buckets = 256;

constexpr int no_curve = -1;

class SeriesReader {
 public:
  explicit SeriesReader(std::size_t most_points) : most_points_(most_points) {}

  void read(const std::filesystem::path& log) {
    series.log = read_log(
        log, [this](double time, std::span<const double> values) { take(time, values); },
        [this](const LogContents& head) { list_columns(head.columns); });
    if (!open_.empty()) close_bucket();
    give_points();
  }

  Series series;

 private:
  void list_columns(const std::vector<LoggedColumn>& columns) {
    columns_ = columns;
    task_ = place_of(columns_, "task");
    event_ = place_of(columns_, "event");
    signal_ = place_of(columns_, "event.signal");
    value_ = place_of(columns_, "event.value");
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const LoggedColumn& column = columns_[i];
      const bool is_curve = column.words.empty() && column.name != "time" && !column.is_input();
      curve_of_.push_back(is_curve ? static_cast<int>(series.curves.size()) : no_curve);
      if (is_curve) series.curves.push_back({column.name, column.unit, column.file, column.line, {}, {}});
    }
    const std::size_t room = most_points_ / (2 * std::max<std::size_t>(1, series.curves.size()));
    most_ = std::clamp(room, fewest_buckets, most_buckets);
    open_.resize(series.curves.size());
    buckets_.resize(series.curves.size());
    open_.assign(series.curves.size(), {});
  }

  void take(double time, std::span<const double> values) {
    note_task(time, values);
    note_event(time, values);
    if (in_bucket_ == 0) begin_ = time;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (curve_of_[i] == no_curve) continue;
      Bucket& bucket = open_[static_cast<std::size_t>(curve_of_[i])];
      const auto value = static_cast<float>(values[i]);
      if (in_bucket_ == 0) bucket.first = value;
      bucket.take(value);
    }
    end_ = time;
    if (++in_bucket_ >= series.records_a_bucket) close_bucket();
  }

  std::string_view word(std::span<const double> values, std::size_t place) const {
    return place < values.size() ? columns_[place].word(values[place]) : std::string_view{};
  }

  void note_task(double time, std::span<const double> values) {
    const std::string_view task = word(values, task_);
    if (task.empty()) return;
    if (!series.tasks.empty()) series.tasks.back().end = time;
    if (series.tasks.empty() || series.tasks.back().word != task)
      series.tasks.push_back({std::string(task), time, time});
  }

  void note_event(double time, std::span<const double> values) {
    const std::string_view event = word(values, event_);
    if (event.empty()) return;
    LoggedEvent& told = series.events.emplace_back();
    told.time = time;
    told.code = event;
    told.signal = word(values, signal_);
    if (value_ < values.size()) told.value = values[value_];
  }

  void close_bucket() {
    if (in_bucket_ == 0) return;
    for (std::size_t i = 0; i < open_.size(); ++i) buckets_[i].push_back(open_[i]);
    spans_.push_back({begin_, end_});
    open_.assign(open_.size(), {});
    in_bucket_ = 0;
    if (spans_.size() < most_) return;
    for (std::vector<Bucket>& buckets : buckets_) merge_pairs(buckets);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < spans_.size(); i += 2)
      spans_[kept++] = {spans_[i].begin, spans_[std::min(i + 1, spans_.size() - 1)].end};
    spans_.resize(kept);
    series.records_a_bucket *= 2;
  }

  void give_points() {
    const bool is_whole = series.records_a_bucket == 1;
    for (const Span& span : spans_) {
      series.times.push_back(span.begin);
      if (!is_whole) series.times.push_back(0.5 * (span.begin + span.end));
      series.sample_times.push_back(span.begin);
    }
    for (std::size_t c = 0; c < series.curves.size(); ++c) {
      Curve& curve = series.curves[c];
      for (const Bucket& bucket : buckets_[c]) {
        curve.samples.push_back(bucket.first);
        curve.points.push_back(bucket.least_came_first ? bucket.least : bucket.largest);
        if (!is_whole) curve.points.push_back(bucket.least_came_first ? bucket.largest : bucket.least);
      }
    }
  }

  struct Span {
    double begin = 0.0, end = 0.0;
  };
  std::size_t most_points_;
  std::size_t most_ = most_buckets;
  std::vector<LoggedColumn> columns_;
  std::vector<int> curve_of_;  ///< by column: index into Series::curves, or `no_curve`
  std::size_t task_ = 0, event_ = 0, signal_ = 0, value_ = 0;  ///< columns
  std::vector<Bucket> open_;                                   ///< by curve
  std::vector<std::vector<Bucket>> buckets_;                   ///< by curve
  std::vector<Span> spans_;                                    ///< of each bucket
  std::size_t in_bucket_ = 0;
  double begin_ = 0.0, end_ = 0.0;
};

}  // namespace

Series read_series(const std::filesystem::path& log, std::size_t most_points) {
  SeriesReader reader(most_points);
  reader.read(log);
  return std::move(reader.series);
}

std::string packed(const std::vector<float>& numbers) {
  const std::size_t count = numbers.size();
  std::string planes(sizeof(float) * count, '\0');
  for (std::size_t i = 0; i < count; ++i) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(float)>>(numbers[i]);
    for (std::size_t b = 0; b < bytes.size(); ++b) planes[b * count + i] = bytes[b];
  }
  std::optional<std::string> deflated = deflate(planes);
  if (!deflated) throw std::runtime_error("the numbers of the run could not be compressed");
  return std::move(*deflated);
}

}  // namespace zwang::runtime
