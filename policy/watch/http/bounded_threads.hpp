#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace earshot::watch {

/// Threads that each do one piece of work at a time; so many at most, which begin when they are first needed. Work waits for none: where
/// all are busy it is refused.
/// Oracle: BoundedThreads.*
class BoundedThreads {
 public:
  explicit BoundedThreads(std::size_t most) : most_(most) {}
  ~BoundedThreads() { finish(); }
  BoundedThreads(const BoundedThreads&) = delete;
  BoundedThreads& operator=(const BoundedThreads&) = delete;

  /// @return false: all are busy, and the work is not done
  [[nodiscard]] bool begin(std::function<void()> work);
  /// Waits for what was begun; nothing is begun any more.
  void finish();

 private:
  void run();

  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable has_work_;
  std::deque<std::function<void()>> waiting_;
  std::size_t unfinished_ = 0;  ///< pieces of work, those that wait for their thread among them
  bool is_over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace earshot::watch
