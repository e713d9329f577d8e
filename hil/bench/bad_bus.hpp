#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "hil/bench/fault.hpp"
#include "hil/nodes/device.hpp"

namespace earshot::hil {

/// Which frames it hits.
struct AfflictedFrames {
  std::optional<std::uint8_t> source;  ///< address of the device that sends them; nothing: of all
  std::optional<std::uint32_t> pgn;
  double share = 1.0;  ///< of these, drawn one by one
};

/// One fault of the bus, as long as it lasts.
struct Affliction {
  Fault fault = Fault::kLoss;  ///< that hits frames (FaultTarget::kFrames)
  AfflictedFrames frames;
  Duration seconds;  ///< of kDelay, kJitter and kReplay
};

/// How often what was said arrives, and how much later.
struct Passage {
  int times = 1;
  Duration late = {};

  /// @param seconds  of a delay, or the most of a jitter
  /// @return false: the fault neither loses nor delays
  bool lose_or_delay(Fault fault, Duration seconds, Pcg32& random);
};

/// A bus on which frames are lost, late, double or spoilt. It has no bus itself: frames and time go in, what arrives comes out. The same
/// seed gives the same faults.
class BadBus {
 public:
  explicit BadBus(std::uint64_t seed) : random_(seed) {}

  /// @param frames  said now, in their order   @param now  never goes back
  /// @return what arrives now, in this order: first what was said before
  /// @throws NoMaker of a fault that frames on a CAN bus cannot have
  [[nodiscard]] Frames pass(const Frames& frames, const std::vector<Affliction>& afflictions, Time now);
  /// How often a fault did something to a frame, so far.
  [[nodiscard]] std::uint64_t afflicted() const { return afflicted_; }

 private:
  struct Late {
    Time due;
    n2k::Frame frame;
  };
  /// What becomes of one.
  struct Fate {
    n2k::Frame frame;
    Passage passage;
  };
  void pass(const n2k::Frame& frame, const std::vector<Affliction>& afflictions, Time now, Frames& arriving);
  /// @return whether it did anything to the frame
  [[nodiscard]] bool inject(const Affliction& affliction, Time now, Fate& fate);
  [[nodiscard]] bool hits(const AfflictedFrames& which, const n2k::Frame& frame);

  Pcg32 random_;
  std::vector<Late> late_;  ///< in the order in which they were said
  std::uint64_t afflicted_ = 0;
};

}  // namespace earshot::hil
