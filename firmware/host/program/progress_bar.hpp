#pragma once

#include <chrono>
#include <string>

namespace earshot::program {

/// A bar with the time left on standard error, when that is a terminal and the work takes longer than a second; else silence.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// @param fraction  of the work that is done, 0 to 1
  void update(double fraction);

 private:
  std::string label_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_drawn_ = start_;
  bool terminal_;
  bool drawn_ = false;
};

}  // namespace earshot::program
