#pragma once

#include <sched.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace earshot::bench {

/// Confines this process and those it will start to two processors.
inline void use_two_processors() {
  cpu_set_t two{};
  CPU_SET(0, &two);
  CPU_SET(1, &two);
  if (sched_setaffinity(0, sizeof(two), &two) != 0) throw std::runtime_error("processors 0 and 1 cannot be had");
}

/// Eight loops that do nothing, for as long as this lives.
class BusyLoops {
 public:
  BusyLoops() {
    constexpr int kLoops = 8;
    for (int i = 0; i < kLoops; ++i) loops_.emplace_back([this] { loop(); });
  }
  ~BusyLoops() {
    ending_ = true;
    for (std::thread& loop : loops_) loop.join();
  }
  BusyLoops(const BusyLoops&) = delete;
  BusyLoops& operator=(const BusyLoops&) = delete;

 private:
  void loop() const {
    while (!ending_.load(std::memory_order_relaxed)) {
    }
  }

  std::atomic<bool> ending_{false};
  std::vector<std::thread> loops_;
};

}  // namespace earshot::bench
