#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace earshot::board {

/// Values on their way from one thread to another, in fixed memory: one thread puts, one takes, neither ever waits, nothing is locked.
template <class Value, std::size_t kSize>
class SpscQueue {
 public:
  /// @return false when there is no room: the value is not put
  [[nodiscard]] bool put(const Value& value) {
    const std::uint64_t number = put_.load(std::memory_order_relaxed);
    if (number - taken_.load(std::memory_order_acquire) >= kSize) return false;
    values_[number % kSize] = value;
    put_.store(number + 1, std::memory_order_release);
    return true;
  }

  /// @return false when there is none
  [[nodiscard]] bool take(Value& oldest) {
    const std::uint64_t number = taken_.load(std::memory_order_relaxed);
    if (put_.load(std::memory_order_acquire) == number) return false;
    oldest = values_[number % kSize];
    taken_.store(number + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<Value, kSize> values_{};
  // Each written by one thread, read by the other.
  std::atomic<std::uint64_t> put_{0};
  std::atomic<std::uint64_t> taken_{0};
};

}  // namespace earshot::board
