#pragma once

#include <chrono>
#include <string>

#include "firmware/host/program/live_line.hpp"

namespace earshot::program {

/// A bar with the time left, as a live line.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);

  /// @param fraction  of the work that is done, 0 to 1
  void update(double fraction);

 private:
  std::string label_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  LiveLine line_;
};

}  // namespace earshot::program
