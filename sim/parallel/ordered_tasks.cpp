#include "sim/parallel/ordered_tasks.hpp"

#include <sched.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace earshot::parallel {
namespace {

/// Shared by the threads, all under one lock: tasks take milliseconds.
class Ledger {
 public:
  explicit Ledger(const TaskGroups& groups) : groups_(groups), left_(groups.groups, groups.tasks_per_group) {}

  /// The next task, or `kNone` when there is none or one has failed.
  std::size_t take() {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return stopped_ || next_ == total() || next_ / groups_.tasks_per_group < handed_over_ + groups_.window; });
    return stopped_ || next_ == total() ? kNone : next_++;
  }

  void done(std::size_t task) {
    const std::scoped_lock lock(mutex_);
    if (--left_[task / groups_.tasks_per_group] == 0) ready_.notify_one();
  }

  void failed(std::size_t task, std::exception_ptr error) {
    const std::scoped_lock lock(mutex_);
    if (task < failed_task_) failed_task_ = task, error_ = std::move(error);
    stop_locked();
  }

  /// False when it will never be ready because a task failed.
  bool wait_for(std::size_t group) {
    std::unique_lock lock(mutex_);
    ready_.wait(lock, [&] { return stopped_ || left_[group] == 0; });
    return left_[group] == 0;
  }

  void handed_over(std::size_t group) {
    const std::scoped_lock lock(mutex_);
    handed_over_ = group + 1;
    room_.notify_all();
  }

  void stop() {
    const std::scoped_lock lock(mutex_);
    stop_locked();
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

 private:
  [[nodiscard]] std::size_t total() const { return groups_.groups * groups_.tasks_per_group; }
  void stop_locked() {
    stopped_ = true;
    room_.notify_all();
    ready_.notify_all();
  }

  TaskGroups groups_;
  std::mutex mutex_;
  std::condition_variable room_;   // a task may be taken
  std::condition_variable ready_;  // a group is done
  std::vector<std::size_t> left_;  // tasks of each group
  std::size_t next_ = 0;
  std::size_t handed_over_ = 0;
  bool stopped_ = false;
  std::size_t failed_task_ = kNone;
  std::exception_ptr error_;
};

void work_until_none_is_left(Ledger& ledger, const std::function<void(std::size_t)>& work) {
  for (std::size_t task = ledger.take(); task != Ledger::kNone; task = ledger.take()) {
    try {
      work(task);
      ledger.done(task);
    } catch (...) {
      ledger.failed(task, std::current_exception());
    }
  }
}

/// Stops the others and waits for them, also when the calling thread leaves by an exception.
class Workers {
 public:
  Workers(Ledger& ledger, std::size_t threads, const std::function<void(std::size_t)>& work) : ledger_(ledger) {
    try {
      for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([&ledger, &work] { work_until_none_is_left(ledger, work); });
    } catch (...) {  // no more threads to be had: no destructor runs, and those that were started wait for tasks
      ledger.stop();
      throw;
    }
  }
  ~Workers() { ledger_.stop(); }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

 private:
  Ledger& ledger_;
  std::vector<std::jthread> threads_;
};

}  // namespace

std::size_t available_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return std::max(1U, std::thread::hardware_concurrency());
  return static_cast<std::size_t>(std::max(1, CPU_COUNT(&set)));
}

void run_in_order(const TaskGroups& groups, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t)>& finished) {
  Ledger ledger(groups);
  {
    const Workers workers(ledger, std::min(groups.threads, std::max<std::size_t>(1, groups.groups * groups.tasks_per_group)), work);
    for (std::size_t group = 0; group < groups.groups && ledger.wait_for(group); ++group) {
      finished(group);
      ledger.handed_over(group);
    }
  }
  ledger.rethrow();
}

}  // namespace earshot::parallel
