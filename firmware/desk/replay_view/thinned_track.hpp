#pragma once

#include <cstddef>
#include <vector>

#include "firmware/core/geometry.hpp"

namespace earshot::replay_view {

/// Every n-th place of a track and the newest, n so large that there are no more than a picture has points across.
class ThinnedTrack {
 public:
  static constexpr std::size_t kMost = 4096;

  void add(NorthEast place) {
    newest_ = place;
    if (count_++ % stride_ != 0) return;
    kept_.push_back(place);
    if (kept_.size() < kMost) return;
    for (std::size_t i = 1; i < kMost / 2; ++i) kept_[i] = kept_[2 * i];
    kept_.resize(kMost / 2);
    stride_ *= 2;
  }

  [[nodiscard]] std::vector<NorthEast> places() const {
    std::vector<NorthEast> all = kept_;
    if (!all.empty()) all.push_back(newest_);
    return all;
  }

 private:
  std::vector<NorthEast> kept_;
  NorthEast newest_;
  std::size_t count_ = 0;
  std::size_t stride_ = 1;
};

}  // namespace earshot::replay_view
