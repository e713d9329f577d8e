#include "policy/watch/http/browser.hpp"

#include <utility>

namespace earshot::watch {

std::uint64_t Browser::push(Frame frame) {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kLost) return 1;
  if (state_ == State::kAsks) return 0;
  const bool is_full = frames_.size() >= kMostFrames || (!frames_.empty() && bytes_ + frame->size() > kMostBytes);
  if (is_full) {
    const std::uint64_t dropped = frames_.size() + 1;
    frames_.clear();
    bytes_ = 0;
    state_ = State::kLost;
    wake_.signal();
    return dropped;
  }
  bytes_ += frame->size();
  frames_.push_back(std::move(frame));
  wake_.signal();
  return 0;
}

bool Browser::asks() const {
  const std::lock_guard lock(mutex_);
  return state_ == State::kAsks;
}

void Browser::give(Frame whole) {
  const std::lock_guard lock(mutex_);
  state_ = State::kFollows;
  bytes_ += whole->size();
  frames_.push_back(std::move(whole));
  wake_.signal();
}

void Browser::restart() {
  const std::lock_guard lock(mutex_);
  state_ = State::kAsks;
  frames_.clear();
  bytes_ = 0;
}

Frame Browser::next() {
  const std::lock_guard lock(mutex_);
  if (state_ == State::kLost) state_ = State::kAsks;
  if (frames_.empty()) {
    wake_.clear();
    return nullptr;
  }
  Frame frame = std::move(frames_.front());
  frames_.pop_front();
  bytes_ -= frame->size();
  return frame;
}

}  // namespace earshot::watch
