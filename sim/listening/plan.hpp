#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/toml/range.hpp"
#include "sim/listening/chain.hpp"
#include "sim/recording/sequence.hpp"

namespace earshot::listening {

// What may be asked for, on a command line and elsewhere.
inline constexpr host::Range kBandEdges_hz{1.0, 1000.0};
inline constexpr host::Range kThresholds_db{-10.0, 60.0};
inline constexpr host::Range kFullScaleLevels_db{-100.0, 400.0};
inline constexpr host::Range kLevelsIntervals_s{1.0, 86'400.0};
inline constexpr host::Range kTolerances_s{0.0, 3600.0};
inline constexpr std::size_t kMostChannels = 1024;

/// "fin", "blue", "antarctic", "tone"
[[nodiscard]] std::vector<std::string> preset_names();

/// What somebody asks of a recording, whichever it is.
struct Request {
  std::string preset = "fin";          ///< one of preset_names()
  std::optional<detector::Band> band;  ///< in place of the preset's
  std::optional<Decibels> threshold;   ///< SNR of a detection, in place of the preset's
  std::size_t channel = 1;             ///< from 1
  std::optional<Chain> chain;          ///< nothing: what the recorders say
};

/// What is to be listened to, and how: all that can be judged before the work.
struct Plan {
  recording::Sequence sequence;
  std::size_t channel = 0;  ///< from 0
  Chain chain;
  detector::SoundSettings settings;
  detector::Band asked;              ///< of which settings.band is the part that the recording holds
  std::vector<std::string> remarks;  ///< for who asked
};

/// Reads no sample: the divisor of the chain stays 1. Throws host::BadInput for what cannot be listened to.
[[nodiscard]] Plan plan_for(recording::Sequence sequence, const Request& request);

/// What the detector takes for full scale; only differences of level count in it.
inline constexpr Decibels kNominalFullScale{180.0};

/// What is added to the detector's levels for levels as they are told.
[[nodiscard]] Decibels correction_of(const Plan& plan);

/// The recording's own sample rate, or what it is decimated to.
[[nodiscard]] Hertz listening_rate(const recording::Sequence& sequence);

/// A refusal of the recording, by its name.
[[nodiscard]] host::BadInput unheard(const recording::Sequence& sequence, const std::string& why);

}  // namespace earshot::listening
