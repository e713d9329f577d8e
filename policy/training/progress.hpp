#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "policy/training/learning_curve.hpp"

namespace earshot::training {

/// A line on standard error: how far one training or several have come, at what rate, how well, and how long it will take. It is renewed
/// on a terminal; elsewhere nothing is printed.
class TrainingProgress {
 public:
  enum class Voice : std::uint8_t { kSpeaks, kSilent };
  TrainingProgress(std::size_t trainings, Voice voice);

  struct At {
    double fraction = 0.0;  ///< of the training that is done, 0 to 1
    std::uint64_t steps = 0;
    std::uint64_t episodes = 0;
    LearningCurve::Recent recent;
  };
  /// Sets the point where a training begins. May be called from any thread, as update() may.
  void begin(std::size_t training, const At& at);
  void update(std::size_t training, const At& at);
  /// Shows the last line for good.
  void finish();
  /// What the line says by now.
  [[nodiscard]] std::string line();
  [[nodiscard]] double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  void show();
  [[nodiscard]] std::string text() const;

  std::mutex lock_;
  std::vector<At> begun_;
  std::vector<At> now_;
  bool is_shown_;  ///< there is a terminal, and it may speak
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
};

}  // namespace earshot::training
