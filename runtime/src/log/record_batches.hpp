/// Hands records from the thread that reads a log to one that takes them apart: either is half of the work.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace zwang::runtime {

class RecordBatches {
 public:
  using Take = std::function<void(double time, std::string_view record)>;

  /// `take` is called on a thread of its own, record by record in their order. It must not throw.
  explicit RecordBatches(Take take);
  /// Waits as `finish` does.
  ~RecordBatches();
  RecordBatches(const RecordBatches&) = delete;
  RecordBatches& operator=(const RecordBatches&) = delete;

  void add(double time, std::string_view record);
  /// Until all records were taken. None may be added afterwards.
  void finish();

 private:
  struct Batch {
    std::string bytes;
    std::vector<double> times;      ///< [s]
    std::vector<std::size_t> ends;  ///< of the records in `bytes`
  };
  void hand_over();
  void work();
  void take_all(const Batch& batch) const;

  Take take_;
  Batch open_;
  std::deque<Batch> waiting_;
  std::vector<Batch> spare_;  ///< their memory is used again
  bool is_over_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace zwang::runtime
