#include "zwang/runtime/series.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "log/compression.hpp"
#include "log/extremes.hpp"

namespace zwang::runtime {

namespace {

using nlohmann::ordered_json;

// Beyond these a curve has no more to show, or too little.
constexpr std::size_t most_buckets = 4096;
constexpr std::size_t fewest_buckets = 256;

constexpr double blank = std::numeric_limits<double>::quiet_NaN();

struct LoggedColumn {
  std::string key;          ///< as a record writes it: `"base.x":`
  int curve = -1;           ///< index into Series::curves; -1: none
  double value = blank;     ///< of the present record
  std::string_view word{};  ///< the same of a column of words
};

/// `[m/s] wall_align.yaml:22`, either part alone, or none.
void read_description(const std::string& text, Curve& curve) {
  std::string_view rest = text;
  if (rest.starts_with('[')) {
    const std::size_t close = rest.find(']');
    curve.unit = rest.substr(1, close - 1);
    rest.remove_prefix(std::min(rest.size(), close == std::string_view::npos ? rest.size() : close + 2));
  }
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos) return;
  curve.file = rest.substr(0, colon);
  std::from_chars(rest.data() + colon + 1, rest.data() + rest.size(), curve.line);
}

class SeriesReader {
 public:
  explicit SeriesReader(std::size_t most_points) : most_points_(most_points) {}

  void read(const std::filesystem::path& log) {
    series.log = read_log(
        log, [this](double time, std::string_view record) { take(time, record); },
        [this](const LogContents& head) { list_columns(head.schema); });
    if (!open_.empty()) close_bucket();
    give_points();
  }

  Series series;

 private:
  void list_columns(const std::string& schema) {
    const ordered_json whole = ordered_json::parse(schema, nullptr, false);
    const auto properties = whole.is_object() ? whole.find("properties") : whole.end();
    if (properties == whole.end() || !properties->is_object()) return;
    for (const auto& [name, property] : properties->items()) {
      LoggedColumn& column = columns_.emplace_back();
      column.key = ordered_json(name).dump() + ":";
      if (name == "task") task_ = columns_.size() - 1;
      if (name == "event") event_ = columns_.size() - 1;
      const bool is_curve = !property.contains("enum") && name != "time" && !name.starts_with("sensed.") &&
                            !name.starts_with("params.");
      if (!is_curve) continue;
      column.curve = static_cast<int>(series.curves.size());
      Curve& curve = series.curves.emplace_back();
      curve.name = name;
      if (property.contains("description"))
        read_description(property["description"].get<std::string>(), curve);
    }
    const std::size_t room = most_points_ / (2 * std::max<std::size_t>(1, series.curves.size()));
    most_ = std::clamp(room, fewest_buckets, most_buckets);
    open_.resize(series.curves.size());
    buckets_.resize(series.curves.size());
    open_.assign(series.curves.size(), {});
  }

  /// Keys stand in the order of the columns; those of blanks are left out.
  void parse(std::string_view record) {
    for (LoggedColumn& column : columns_) {
      column.value = blank;
      column.word = {};
    }
    std::size_t at = 1;
    for (LoggedColumn& column : columns_) {
      if (at >= record.size()) return;
      if (record.compare(at, column.key.size(), column.key) != 0) continue;
      at += column.key.size();
      if (record[at] == '"') {
        const std::size_t close = record.find('"', at + 1);
        column.word = record.substr(at + 1, close - at - 1);
        at = close + 2;
      } else {
        const char* const end = record.data() + record.size();
        const auto [behind, error] = std::from_chars(record.data() + at, end, column.value);
        if (error != std::errc()) column.value = blank;
        at = std::min(record.find_first_of(",}", static_cast<std::size_t>(behind - record.data())),
                      record.size()) +
             1;
      }
    }
  }

  void take(double time, std::string_view record) {
    parse(record);
    note_task(time);
    note_event(time);
    if (in_bucket_ == 0) begin_ = time;
    for (const LoggedColumn& column : columns_) {
      if (column.curve < 0) continue;
      Bucket& bucket = open_[static_cast<std::size_t>(column.curve)];
      const auto value = static_cast<float>(column.value);
      if (in_bucket_ == 0) bucket.first = value;
      bucket.take(value);
    }
    end_ = time;
    if (++in_bucket_ >= series.records_a_bucket) close_bucket();
  }

  void note_task(double time) {
    if (!task_ || columns_[*task_].word.empty()) return;
    const std::string_view word = columns_[*task_].word;
    if (!series.tasks.empty()) series.tasks.back().end = time;
    if (series.tasks.empty() || series.tasks.back().word != word)
      series.tasks.push_back({std::string(word), time, time});
  }

  void note_event(double time) {
    if (!event_ || columns_[*event_].word.empty()) return;
    LoggedEvent& told = series.events.emplace_back();
    told.time = time;
    told.code = columns_[*event_].word;
    for (std::size_t i = *event_ + 1; i < columns_.size() && i < *event_ + 3; ++i) {
      if (columns_[i].key == R"("event.signal":)") told.signal = columns_[i].word;
      if (columns_[i].key == R"("event.value":)") told.value = columns_[i].value;
    }
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
  std::optional<std::size_t> task_, event_;
  std::vector<Bucket> open_;                  ///< by curve
  std::vector<std::vector<Bucket>> buckets_;  ///< by curve
  std::vector<Span> spans_;                   ///< of each bucket
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
