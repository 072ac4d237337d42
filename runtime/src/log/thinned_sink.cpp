#include <cmath>
#include <vector>

#include "log/pace.hpp"
#include "zwang/runtime/log_parts.hpp"

namespace zwang::runtime {

namespace {

class ThinnedSink : public LogSink {
 public:
  ThinnedSink(std::unique_ptr<LogSink> sink, double rate) : sink_(std::move(sink)), pace_(1.0 / rate) {}

  std::string open(const std::vector<Column>& columns) override {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].name == "task") task_ = i;
      if (columns[i].name == "event") event_ = i;
    }
    return sink_->open(columns);
  }

  std::string write(std::span<const double> values) override {
    const bool is_due = pace_.is_due(values.front());
    const bool is_another = is_another_task(values);
    if (is_due || is_another || has_event(values)) {
      last_.clear();
      return sink_->write(values);
    }
    last_.assign(values.begin(), values.end());
    return "";
  }

  std::string skip(std::uint64_t records) override { return sink_->skip(records); }
  std::string conclude(const std::map<std::string, std::string>& facts) override {
    const std::string error = write_last();
    return error.empty() ? sink_->conclude(facts) : error;
  }
  std::string flush() override { return sink_->flush(); }
  std::string close() override {
    const std::string error = write_last(), closing = sink_->close();
    return error.empty() ? closing : error;
  }
  std::uint64_t size() const override { return sink_->size(); }

 private:
  bool has_event(std::span<const double> values) const {
    return event_ < values.size() && !std::isnan(values[event_]);
  }
  bool is_another_task(std::span<const double> values) {
    if (task_ >= values.size() || values[task_] == active_) return false;
    active_ = values[task_];
    return true;
  }
  std::string write_last() {
    const std::string error = last_.empty() ? "" : sink_->write(last_);
    last_.clear();
    return error;
  }

  std::unique_ptr<LogSink> sink_;
  Pace pace_;
  std::size_t task_ = ~std::size_t{0}, event_ = ~std::size_t{0};  ///< columns
  double active_ = -1.0;
  std::vector<double> last_;  ///< that was not handed on
};

}  // namespace

std::unique_ptr<LogSink> thinned_sink(std::unique_ptr<LogSink> sink, double rate) {
  return std::make_unique<ThinnedSink>(std::move(sink), rate);
}

}  // namespace zwang::runtime
