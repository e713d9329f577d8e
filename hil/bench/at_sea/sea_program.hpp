#pragma once

#include <chrono>
#include <csignal>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/host/program/child_process.hpp"

namespace earshot::hil {

/// One of the two programs of a flight at sea, which a case may kill, halt, and have started again.
class SeaProgram {
 public:
  using Start = std::function<std::unique_ptr<program::ChildProcess>()>;
  SeaProgram(std::string name, Start start) : name_(std::move(name)), start_(std::move(start)) {}

  /// Waits for the one before it, if that has been killed.
  void start() {
    while (runs()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    child_ = start_();
    is_wanted_ = true;
  }
  void kill() { end_with(SIGKILL); }
  void halt() { signal(SIGSTOP); }
  void go_on() { signal(SIGCONT); }
  /// Asks it to end, whatever it is doing.
  void stop() {
    go_on();
    end_with(SIGTERM);
  }

  /// Whether it has ended, and nobody had told it to.
  [[nodiscard]] bool is_lost() { return is_wanted_ && !runs(); }
  [[nodiscard]] bool runs() {
    if (!child_) return false;
    child_->poll();
    if (child_->running()) return true;
    exit_statuses_.push_back(child_->status());
    child_.reset();
    return false;
  }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Of every process that it was, in order; 128 and a signal's number.
  [[nodiscard]] const std::vector<int>& exit_statuses() const { return exit_statuses_; }

 private:
  void end_with(int number) {
    is_wanted_ = false;
    signal(number);
  }
  void signal(int number) {
    if (child_) child_->signal(number);
  }

  std::string name_;
  Start start_;
  std::unique_ptr<program::ChildProcess> child_;
  bool is_wanted_ = false;
  std::vector<int> exit_statuses_;
};

}  // namespace earshot::hil
