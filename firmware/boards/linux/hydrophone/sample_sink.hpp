#pragma once

#include <span>

#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::board {

/// Who listens to the hydrophone: called for block after block in the order of their arrival, in a thread of the receiver's.
class SampleSink {
 public:
  SampleSink() = default;
  virtual ~SampleSink() = default;
  SampleSink(const SampleSink&) = delete;
  SampleSink& operator=(const SampleSink&) = delete;

  /// May take its time: what comes meanwhile waits in the ring. Must not allocate.
  /// @param samples  block.samples_per_channel times block.channels, interleaved; valid until it returns
  virtual void hear(const messages::HydrophoneBlock& block, std::span<const float> samples) = 0;
};

}  // namespace earshot::board
