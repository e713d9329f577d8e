#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/bits/digest.hpp"
#include "tests/bits/inputs.hpp"

namespace earshot::bits {

/// What there is to say of a decision, or of the end.
struct Line {
  std::int32_t second = 0;
  std::uint32_t step = 0;
  bool is_end = false;
  std::uint64_t snr_bits = 0;      ///< of the decision: its double
  std::uint32_t measurements = 0;  ///< SNRs heard so far
  std::uint32_t setpoints = 0;     ///< given so far
  unsigned action = 0;
  Corner corner{};           ///< where the decision leads to
  std::uint32_t digest = 0;  ///< CRC-32 of every bit of what the core has said so far
};

/// Where the corners come from at which the vehicle turns.
enum class Track : std::uint8_t {
  kRecorded,  ///< kTrack: nothing that the core says changes what it is given
  kFlown,     ///< its own decisions
};

/// Is shown what goes into the core and what comes out of it.
class Witness {
 public:
  virtual void see(const messages::Input& input) = 0;
  virtual void see(Time turn, const runtime::Outputs& outputs) = 0;

 protected:
  ~Witness() = default;
};

/// The vehicle's whole core, from the samples of a hydrophone to the set-point, given a mission that was recorded. No heap, no file, no
/// clock; some hundreds of kilobytes, so that it belongs where static variables lie.
class Mission {
 public:
  /// From the beginning. Anything but kOk: the core refuses the mission, which it must not.
  [[nodiscard]] Status begin(Track track);
  /// Flies to the next decision, or to the end.
  [[nodiscard]] Line fly();
  /// From now on. @param witness  must outlive it
  void show(Witness& witness) { witness_ = &witness; }

 private:
  void make_policy();
  void add_small_numbers();
  void listen(std::int32_t second);
  void take(const detector::Estimate& estimate, std::int32_t second);
  template <class Value>
  void give(std::int32_t second, const Value& value);
  [[nodiscard]] Line line(const messages::Decision& decision) const;

  Track track_ = Track::kRecorded;
  Vehicle vehicle_;
  Sea sea_;
  Sea::Samples samples_{};
  detector::SoundDetector detector_;
  policy::FrozenPolicy policy_;
  policy::OceanTables tables_;
  policy::SearchMemory memory_;
  runtime::Runtime runtime_;
  std::int32_t second_ = 0;
  std::size_t next_corner_ = 0;
  std::uint64_t inputs_ = 0;
  Digest digest_;
  MetersPerSecond speed_;
  Line now_;
  Witness* witness_ = nullptr;
};

/// @param number  of the line, from 0: the first that fly() gave after begin()
[[nodiscard]] bool is_as_recorded(std::size_t number, const Line& line);

}  // namespace earshot::bits
