#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace earshot::link {

enum class Delivery : std::uint8_t {
  kArrived,  ///< the value is new
  kNothing,  ///< nothing came in time
  kLost,     ///< the other side is gone and everything it sent has been taken
};

/// Hands one value at a time from one thread to another; a value not yet taken is replaced (in lock-step there is never a second one).
///
/// The taker sleeps at once. Looking out for the next value in a loop that yields the processor looks cheaper, and gives each turn away to
/// whoever else is busy (`sil.busy.times_real_time` in tests/bench).
template <class T>
class Mailbox {
 public:
  void put(const T& value) {
    {
      const std::scoped_lock lock(mutex_);
      value_ = value;
      is_new_ = true;
    }
    changed_.notify_one();
  }

  /// No more values will come.
  void close() {
    {
      const std::scoped_lock lock(mutex_);
      is_closed_ = true;
    }
    changed_.notify_all();
  }

  [[nodiscard]] Delivery take(T& value, std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, timeout, [this] { return is_new_ || is_closed_; })) return Delivery::kNothing;
    if (!is_new_) return Delivery::kLost;
    is_new_ = false;
    value = value_;
    return Delivery::kArrived;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_new_ = false;
  bool is_closed_ = false;
  T value_{};
};

}  // namespace earshot::link
