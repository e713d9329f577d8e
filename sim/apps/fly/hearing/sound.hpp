#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "sim/apps/fly/hearing/hearing_record.hpp"
#include "sim/hydrophone/calls.hpp"
#include "sim/hydrophone/hydrophone.hpp"
#include "sim/hydrophone/hydrophone_bus.hpp"
#include "sim/search/scenario/surroundings.hpp"

namespace earshot::fly {

/// What the vehicle of a flight hears, and how it listens.
struct SoundSetup {
  detector::SoundSettings listening;   ///< the mission's
  hydrophone::Calls calls;             ///< of every source
  std::vector<Decibels> noise_levels;  ///< N of each ocean that the flight may be in
  search::SoundConditions conditions;
  hydrophone::HydrophoneBus& bus;
  std::uint64_t seed = 1;
};

/// The calls of a flight's sources: recorded ones where `recording` names a file, else a song where the conditions have a pattern and a
/// tone where they have none. Throws as hydrophone::load_calls does.
[[nodiscard]] hydrophone::Calls calls_of(const std::filesystem::path& recording, const search::Conditions& conditions, Hertz frequency,
                                         const detector::SoundSettings& listening);

/// The sound of a flight: samples at the vehicle, put on the hydrophone's bus. What the vehicle's detector makes of it is known here, too:
/// the same detector hears the same blocks beside it, and the same sound gives the same bits.
class Sound {
 public:
  /// A block lasts as long as a tick. @param setup  must outlive it
  Sound(const SoundSetup& setup, const search::Surroundings& surroundings, Duration tick);

  /// A tick: the sound since the last one, which begins with the first.
  /// @param arrivals, modelled  of the sources now; speed  of the vehicle through the water
  /// Throws std::runtime_error when the bus cannot carry it.
  void pass(Time now, const search::Arrivals& arrivals, const policy::Reception& modelled, MetersPerSecond speed);
  /// How the vehicle says that it moves, as its detector is told at the end of a turn.
  void note_motion(MetersPerSecond speed) { sound_detector_->note_motion(speed, 0.0); }

  /// The measurements that came of the last tick.
  [[nodiscard]] std::span<const messages::SnrMeasurement> measurements() const { return measurements_; }
  [[nodiscard]] bool has_heard() const { return record_.measurements() > 0; }
  /// So long a detector that hears at all has given a measurement.
  [[nodiscard]] Duration patience() const { return setup_.listening.floor_window + Duration::seconds(60); }
  [[nodiscard]] const char* in_the_way() const { return detector::to_string(hearing_); }
  [[nodiscard]] std::uint64_t blocks() const { return setup_.bus.blocks(); }
  [[nodiscard]] std::uint64_t lost_blocks() const { return lost_blocks_; }
  [[nodiscard]] const HearingRecord& record() const { return record_; }

 private:
  void hear(const policy::Reception& modelled);

  const SoundSetup& setup_;
  Decibels noise_level_;
  hydrophone::Hydrophone hydrophone_;
  std::unique_ptr<detector::SoundDetector> sound_detector_;
  HearingRecord record_;
  std::vector<messages::SnrMeasurement> measurements_;
  detector::Hearing hearing_ = detector::Hearing::kFillingUp;  ///< of the last estimate
  std::uint64_t lost_blocks_ = 0;
  bool has_begun_ = false;
};

}  // namespace earshot::fly
