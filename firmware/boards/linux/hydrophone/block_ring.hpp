#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::board {

/// Hydrophone blocks on their way from the thread that receives them to the one that listens. One thread puts, one takes; neither ever
/// waits for the other, nothing is locked. The samples of a block lie in one piece. All memory is touched at construction.
class BlockRing {
 public:
  /// Bytes of samples and entries.
  [[nodiscard]] static constexpr std::size_t memory() { return sizeof(Samples) + sizeof(Entries); }

  /// Room for the samples of the next block, which put() hands over; empty when the ring is full.
  /// @param count  at least 1
  [[nodiscard]] std::span<float> room_for(std::size_t count);
  /// The block whose samples were written into the room given last.
  void put(const messages::HydrophoneBlock& block);

  struct SampledBlock {
    messages::HydrophoneBlock block;
    std::span<const float> samples;
  };
  /// The oldest block; false if there is none. Its samples stay until release().
  [[nodiscard]] bool take(SampledBlock& oldest) const;
  /// Gives back the room of the block taken.
  void release();

 private:
  struct Entry {
    messages::HydrophoneBlock block;
    std::uint64_t begin = 0;  ///< of its samples, counted since the beginning
    std::uint64_t end = 0;
  };
  using Samples = std::array<float, config::kHydrophoneRingSamples>;
  using Entries = std::array<Entry, config::kHydrophoneRingBlocks>;

  /// Where the sample of this number, counted since the beginning, lies in the ring; and the block.
  [[nodiscard]] std::size_t place(std::uint64_t sample) const { return static_cast<std::size_t>(sample % samples_->size()); }
  [[nodiscard]] Entry& entry(std::uint64_t block) const { return (*entries_)[static_cast<std::size_t>(block % entries_->size())]; }

  std::unique_ptr<Samples> samples_ = std::make_unique<Samples>();
  std::unique_ptr<Entries> entries_ = std::make_unique<Entries>();
  // The putter's.
  std::uint64_t room_begin_ = 0;
  std::uint64_t room_end_ = 0;
  std::uint64_t written_ = 0;  ///< samples, those passed over at the ring's end too
  // Each written by one thread, read by the other.
  std::atomic<std::uint64_t> put_{0};    ///< blocks
  std::atomic<std::uint64_t> taken_{0};  ///< blocks
  std::atomic<std::uint64_t> freed_{0};  ///< samples, before taken_
};

}  // namespace earshot::board
