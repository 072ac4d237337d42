/// The latest value from one thread to another, without a lock and without waiting.
#pragma once

#include <array>
#include <atomic>

namespace zwang::connect {

/// Three copies: one is written, one is read, the third waits between them. One thread puts, one takes.
template <typename Value>
class Mailbox {
 public:
  /// All copies are as `first`: a put and a take need no memory where its assignment needs none.
  explicit Mailbox(const Value& first = {}) : copies_{first, first, first} {}

  /// The value that the next `put` will hand over; it may hold any older value.
  Value& draft() noexcept { return copies_[writing_]; }
  void put() noexcept { writing_ = middle_.exchange(writing_ | is_new, std::memory_order_acq_rel) & index; }

  /// Whether a value has come since the last call; `value` is then that one.
  bool take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & is_new) == 0) return false;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & index;
    return true;
  }
  const Value& value() const noexcept { return copies_[reading_]; }

 private:
  static constexpr unsigned is_new = 4, index = 3;
  std::array<Value, 3> copies_;
  unsigned writing_ = 0;  ///< the putting thread's
  std::atomic<unsigned> middle_{1};
  unsigned reading_ = 2;  ///< the taking thread's
};

}  // namespace zwang::connect
