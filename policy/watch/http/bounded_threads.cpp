#include "policy/watch/http/bounded_threads.hpp"

#include <utility>

namespace earshot::watch {

bool BoundedThreads::begin(std::function<void()> work) {
  const std::lock_guard lock(mutex_);
  if (is_over_ || unfinished_ >= most_) return false;
  if (++unfinished_ > threads_.size()) threads_.emplace_back([this] { run(); });
  waiting_.push_back(std::move(work));
  has_work_.notify_one();
  return true;
}

void BoundedThreads::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  has_work_.notify_all();
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
}

void BoundedThreads::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    has_work_.wait(lock, [&] { return is_over_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::function<void()> work = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    work();
    lock.lock();
    --unfinished_;
  }
}

}  // namespace earshot::watch
