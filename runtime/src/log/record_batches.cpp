#include "log/record_batches.hpp"

#include <utility>

namespace zwang::runtime {

namespace {

constexpr std::size_t batch_size = std::size_t{1} << 18;  // [bytes]; stays in the cache of a core
constexpr std::size_t most_waiting = 8;                   // batches: the reader waits for the other thread

}  // namespace

RecordBatches::RecordBatches(Take take) : take_(std::move(take)), thread_([this] { work(); }) {}

RecordBatches::~RecordBatches() {
  finish();
}

void RecordBatches::add(double time, std::string_view record) {
  open_.bytes.append(record);
  open_.times.push_back(time);
  open_.ends.push_back(open_.bytes.size());
  if (open_.bytes.size() >= batch_size) hand_over();
}

void RecordBatches::hand_over() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < most_waiting; });
  waiting_.push_back(std::move(open_));
  open_ = {};
  if (!spare_.empty()) {
    open_ = std::move(spare_.back());
    spare_.pop_back();
  }
  changed_.notify_all();
}

void RecordBatches::finish() {
  if (!thread_.joinable()) return;
  hand_over();
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RecordBatches::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !waiting_.empty() || is_over_; });
    if (waiting_.empty()) return;
    Batch batch = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
    take_all(batch);
    batch.bytes.clear();
    batch.times.clear();
    batch.ends.clear();
    lock.lock();
    spare_.push_back(std::move(batch));
  }
}

void RecordBatches::take_all(const Batch& batch) const {
  const std::string_view bytes = batch.bytes;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < batch.times.size(); ++i) {
    take_(batch.times[i], bytes.substr(begin, batch.ends[i] - begin));
    begin = batch.ends[i];
  }
}

}  // namespace zwang::runtime
