#include "policy/training/progress.hpp"

#include <unistd.h>

#include <cstdio>

#include "firmware/host/text/numbers.hpp"

namespace earshot::training {

using namespace std::chrono_literals;

TrainingProgress::TrainingProgress(std::size_t trainings, Voice voice)
    : begun_(trainings), now_(trainings), is_shown_(voice == Voice::kSpeaks && isatty(STDERR_FILENO) != 0) {}

void TrainingProgress::begin(std::size_t training, const At& at) {
  const std::scoped_lock guard(lock_);
  begun_[training] = now_[training] = at;
}

void TrainingProgress::update(std::size_t training, const At& at) {
  const std::scoped_lock guard(lock_);
  now_[training] = at;
  if (Clock::now() - shown_ > 200ms) show();
}

void TrainingProgress::finish() {
  const std::scoped_lock guard(lock_);
  show();
  if (is_shown_) std::fputc('\n', stderr);
}

std::string TrainingProgress::line() {
  const std::scoped_lock guard(lock_);
  return text();
}

double TrainingProgress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void TrainingProgress::show() {
  shown_ = Clock::now();
  if (!is_shown_) return;
  std::fprintf(stderr, "\r%s   ", text().c_str());
  std::fflush(stderr);
}

std::string TrainingProgress::text() const {
  At all;
  double begun = 0.0;
  std::uint64_t taken = 0;
  std::vector<LearningCurve::Recent> recent;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const auto share = 1.0 / static_cast<double>(now_.size());
    all.fraction += share * now_[i].fraction;
    begun += share * begun_[i].fraction;
    all.steps += now_[i].steps;
    all.episodes += now_[i].episodes;
    taken += now_[i].steps - begun_[i].steps;
    recent.push_back(now_[i].recent);
  }
  const double left = all.fraction > begun ? seconds() * (1.0 - all.fraction) / (all.fraction - begun) : 0.0;
  return host::formatted("%3.0f %%  %llu episodes  %llu steps  %.0f steps/s  last 50: %s  %.0f s left", 100.0 * all.fraction,
                         static_cast<unsigned long long>(all.episodes), static_cast<unsigned long long>(all.steps),
                         static_cast<double>(taken) / seconds(), to_string(LearningCurve::recent_of_all(recent)).c_str(), left);
}

}  // namespace earshot::training
