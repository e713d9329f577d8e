#include "firmware/boards/linux/hydrophone/block_ring.hpp"

namespace earshot::board {

std::span<float> BlockRing::room_for(std::size_t count) {
  const std::size_t at = place(written_);
  const std::size_t passed_over = samples_->size() - at < count ? samples_->size() - at : 0;  // a block lies in one piece
  const std::uint64_t begin = written_ + passed_over;
  const std::uint64_t end = begin + count;
  const bool has_entry = put_.load(std::memory_order_relaxed) - taken_.load(std::memory_order_acquire) < entries_->size();
  const bool has_samples = end - freed_.load(std::memory_order_acquire) <= samples_->size();
  if (!has_entry || !has_samples) return {};
  room_begin_ = begin;
  room_end_ = end;
  return std::span(*samples_).subspan(place(begin), count);
}

void BlockRing::put(const messages::HydrophoneBlock& block) {
  const std::uint64_t number = put_.load(std::memory_order_relaxed);
  entry(number) = {.block = block, .begin = room_begin_, .end = room_end_};
  written_ = room_end_;
  put_.store(number + 1, std::memory_order_release);
}

bool BlockRing::take(SampledBlock& oldest) const {
  const std::uint64_t number = taken_.load(std::memory_order_relaxed);
  if (put_.load(std::memory_order_acquire) == number) return false;
  const Entry& next = entry(number);
  oldest = {.block = next.block,
            .samples = std::span(*samples_).subspan(place(next.begin), static_cast<std::size_t>(next.end - next.begin))};
  return true;
}

void BlockRing::release() {
  const std::uint64_t number = taken_.load(std::memory_order_relaxed);
  freed_.store(entry(number).end, std::memory_order_release);
  taken_.store(number + 1, std::memory_order_release);
}

}  // namespace earshot::board
