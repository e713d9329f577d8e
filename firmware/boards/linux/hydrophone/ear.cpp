#include "firmware/boards/linux/hydrophone/ear.hpp"

namespace earshot::board {

void Ear::hear(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  meter_.hear(block, samples);
  blocks_heard_.store(blocks_heard_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  if (wakes_ == WakesFor::kBlocks) bell_.ring();
}

}  // namespace earshot::board
