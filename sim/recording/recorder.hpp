#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "sim/recording/sound_file.hpp"
#include "sim/recording/sound_texts.hpp"

namespace earshot::recording {

/// What a recorder wrote of itself into a file, beside it, or into its name.
struct RecorderNotes {
  std::string recorder;                    ///< "icListen", "AudioMoth", "SoundTrap"; empty: not known
  std::optional<Time> start;               ///< UTC of the first sample
  std::string start_from;                  ///< "its comment", "5100.200912231533.log.xml", "its name, taken as UTC"
  std::optional<Decibels> sensitivity;     ///< of the hydrophone, dB re 1 V/uPa
  std::optional<double> full_scale_volts;  ///< at the ADC's input, of a sample of 1.0
  std::string gain;                        ///< in the recorder's own words: no calibration by itself
};

/// Where a SoundTrap's log of a recording stands, whether there is one or not.
[[nodiscard]] std::filesystem::path log_beside(const std::filesystem::path& recording);

/// Reads what the common recorders write. What is not as they write it is taken for nothing, never for a wrong number.
///
/// - icListen (Ocean Sonics): INFO chunk; ICMT "3.000000 V pk, -177 dBV re 1uPa, ..., 8388608 = Max Count, ...", ICRD the start in UTC.
///   Source: a recording that MHKiT-Python ships (examples/data/acoustics/RBW_6661_20240601_053114.wav, read by mhkit/acoustics/io.py,
///   its texts printed in mhkit/tests/acoustics/test_io.py); the maker's guide was not at hand.
/// - AudioMoth (Open Acoustic Devices): ICMT "Recorded at 19:17:30 24/09/2019 (UTC+2) by AudioMoth 24F3... at gain setting 2 ...", with
///   "during deployment 01234..." in place of the device where one is set, and milliseconds in some.
///   Source: AudioMoth-Firmware-Basic, and metamoth's documentation of the comment of each version.
/// - SoundTrap (Ocean Instruments): SERIAL.yymmddHHMMSS.wav, and beside it SERIAL.yymmddHHMMSS.log.xml with SamplingStartTimeUTC,
///   SamplingStartTimeSubS and the gain. Its calibration stands in neither.
///   Source: SoundTrap User Guide; PAMGuard's offloader, which writes that file.
/// - Any other: what states its zone first, of GUANO's Timestamp, ICRD and the name (20210205T035946+1000); else the first of GUANO, ICRD,
///   name and bext, taken as UTC.
///   Source: as in sound_texts.hpp.
/// Oracle: RecorderNotes.*
[[nodiscard]] RecorderNotes notes_of(const std::filesystem::path& path, const SoundTexts& texts, const SoundFormat& format);

}  // namespace earshot::recording
