#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "hil/nodes/device.hpp"

namespace earshot::hil {

/// What becomes of frames on a bad bus.
enum class FrameFault : std::uint8_t {
  kLoss,          ///< a frame never arrives
  kDelay,         ///< arrives `seconds` later, behind what was said meanwhile
  kJitter,        ///< arrives up to `seconds` later, so that frames overtake each other
  kDuplication,   ///< arrives twice
  kCorruption,    ///< one bit of its data is another, as no CAN controller would let pass
  kNotAvailable,  ///< all its data say "not available" (ones)
  kTruncation,    ///< has only the first half of its data
  kWrongLength,   ///< a fast packet's first frame says another length
  kReplay,        ///< arrives once more `seconds` later, word for word: a log that somebody plays back
  kReordering,    ///< of what is said in one turn, those that it hits change places (LCM only)
  kDateError,     ///< is dated `seconds` ahead (LCM only: no frame bears a date)
};

/// Which frames it hits.
struct AfflictedFrames {
  std::optional<std::uint8_t> source;  ///< address of the device that sends them; nothing: of all
  std::optional<std::uint32_t> pgn;
  double share = 1.0;  ///< of these, drawn one by one
};

/// One fault of the bus, as long as it lasts.
struct Affliction {
  FrameFault fault = FrameFault::kLoss;
  AfflictedFrames frames;
  Duration seconds;  ///< of kDelay, kJitter and kReplay
};

/// A bus on which frames are lost, late, double or spoilt. It has no bus itself: frames and time go in, what arrives comes out. The same
/// seed gives the same faults.
class BadBus {
 public:
  explicit BadBus(std::uint64_t seed) : random_(seed) {}

  /// @param frames  said now, in their order   @param now  never goes back
  /// @return what arrives now, in this order: first what was said before
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
    int times = 1;
    Duration late;
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
