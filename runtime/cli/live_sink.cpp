#include "live_sink.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "json_parts.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr auto most_wait = std::chrono::milliseconds(50);

class LiveSink : public runtime::LogSink {
 public:
  LiveSink(double bucket, std::function<void(std::string)> send) : bucket_(bucket), send_(std::move(send)) {}

  std::string open(const std::vector<runtime::Column>& columns) override {
    columns_ = columns;
    extremes_.resize(columns.size());
    task_ = place_of("task");
    event_ = place_of("event");
    signal_ = place_of("event.signal");
    value_ = place_of("event.value");
    return {};
  }

  std::string write(std::span<const double> values) override {
    const double time = values[0];
    if (records_ == 0) begin_ = time;
    ++records_;
    for (std::size_t i = 0; i < values.size(); ++i) extremes_[i].take(values[i], records_);
    note_task(values, time);
    note_event(values, time);
    last_.assign(values.begin(), values.end());
    if (time - begin_ >= bucket_) send_bucket();
    return {};
  }

  /// A run that is slow is seen tick by tick. If no record came since the last look, the run stands: what is
  /// held back goes at once.
  std::string flush() override {
    if (records_ == looked_at_ || Clock::now() - sent_ > most_wait) send_bucket();
    looked_at_ = records_;
    return {};
  }

  std::string close() override {
    send_bucket();
    return {};
  }

 private:
  /// Of the bucket; a blank changes nothing.
  struct Extremes {
    void take(double value, std::uint64_t record) {
      if (std::isnan(value)) return;
      if (!(least <= value)) {
        least = value;
        least_at = record;
      }
      if (!(largest >= value)) {
        largest = value;
        largest_at = record;
      }
    }
    double least = std::numeric_limits<double>::quiet_NaN(), largest = least;
    std::uint64_t least_at = 0, largest_at = 0;
  };

  std::size_t place_of(const std::string& name) const {
    std::size_t place = 0;
    while (place < columns_.size() && columns_[place].name != name) ++place;
    return place;
  }

  ordered_json word(std::span<const double> values, std::size_t place) const {
    if (place >= values.size() || std::isnan(values[place])) return nullptr;
    const auto index = static_cast<std::size_t>(values[place]);
    const std::vector<std::string>& words = columns_[place].words;
    return index < words.size() ? ordered_json(words[index]) : ordered_json(nullptr);
  }

  void note_task(std::span<const double> values, double time) {
    const ordered_json now = word(values, task_);
    if (now.is_null() || now == active_) return;
    active_ = now;
    tasks_.push_back({time, now});
  }

  void note_event(std::span<const double> values, double time) {
    const ordered_json code = word(values, event_);
    if (code.is_null() || code == "none") return;
    const ordered_json signal = word(values, signal_);
    events_.push_back({{"time", time},
                       {"code", code},
                       {"signal", signal.is_null() ? ordered_json("") : signal},
                       {"value", value_ < values.size() ? ordered_json(values[value_]) : ordered_json()}});
  }

  void send_bucket() {
    if (records_ == 0) return;
    std::vector<float> numbers(3 * columns_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Extremes& e = extremes_[i];
      const bool rises = e.least_at <= e.largest_at;
      numbers[i] = static_cast<float>(rises ? e.least : e.largest);
      numbers[columns_.size() + i] = static_cast<float>(rises ? e.largest : e.least);
      numbers[2 * columns_.size() + i] = static_cast<float>(last_[i]);
    }
    const ordered_json head = {{"kind", "bucket"},    {"begin", begin_}, {"end", last_[0]},
                               {"records", records_}, {"task", active_}, {"tasks", tasks_},
                               {"events", events_}};
    send_(live_message(text_of(head), numbers));
    sent_ = Clock::now();
    records_ = 0;
    extremes_.assign(columns_.size(), {});
    tasks_ = ordered_json::array();
    events_ = ordered_json::array();
  }

  double bucket_;
  std::function<void(std::string)> send_;
  std::vector<runtime::Column> columns_;
  std::size_t task_ = 0, event_ = 0, signal_ = 0, value_ = 0;
  std::vector<Extremes> extremes_;
  std::vector<double> last_;
  double begin_ = 0.0;
  Clock::time_point sent_;
  std::uint64_t records_ = 0, looked_at_ = 0;
  ordered_json active_, tasks_ = ordered_json::array(), events_ = ordered_json::array();
};

}  // namespace

std::string live_message(std::string text, const std::vector<float>& numbers) {
  static_assert(std::numeric_limits<float>::is_iec559 && sizeof(float) == 4);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = static_cast<std::uint32_t>(text.size());
  std::string message(reinterpret_cast<const char*>(&size), sizeof size);
  message += text;
  message.append(reinterpret_cast<const char*>(numbers.data()), 4 * numbers.size());
  return message;
}

std::unique_ptr<runtime::LogSink> live_sink(double bucket, std::function<void(std::string)> send) {
  return std::make_unique<LiveSink>(bucket, std::move(send));
}

}  // namespace zwang::cli
