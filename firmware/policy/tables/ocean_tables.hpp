#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/envelope/provenance.hpp"

namespace earshot::policy {

/// Of an SNR in a table. Rounded to half a decibel it is off by a quarter at most, a sixteenth of the spread that the belief allows an
/// ocean it knows (4 dB), and a byte holds it: 96 tables of 512 ranges are 48 KiB, a fifth of what the belief has; of floats they would be
/// 192.
inline constexpr float kHalfDecibel = 0.5F;
/// The ends of what a byte holds. Above stands only what is heard within some 150 m of a loud source, where the search has ended; below,
/// nothing that any hydrophone measures.
inline constexpr float kLeastTableSnr_db = -64.0F;
inline constexpr float kMostTableSnr_db = 63.5F;

/// An SNR as a table holds it: the nearest half decibel, the louder of two as near; beyond the ends as at the end, and a NaN as at the
/// fainter one.
/// Oracle: HalfDecibels.*
[[nodiscard]] std::int8_t to_half_db(double snr_db);

// What the numbers of tables may be.
inline constexpr double kLeastFrequency_hz = 1.0;
inline constexpr double kMostFrequency_hz = 1e4;
/// Of the deepest trench 11 km.
inline constexpr double kMostDepth_m = 12e3;
inline constexpr double kMostRangeStep_m = 1e4;
inline constexpr double kLeastPrior = double{1e-6F};
inline constexpr double kMostPrior = 1e6;

/// One ocean that is believed possible, or several that are much alike: what would be heard in it.
struct OceanTable {
  FixedVector<char, config::kMaxTableName> name;  ///< UTF-8, for people
  float prior = 1.0F;                             ///< > 0; priors need not add up to one
  float sea_depth_m = 0.0F;                       ///< of the sea floor at the source, for people
  /// SL - TL - N at the receiver's depth, in half decibels, at range i * range_step, of which there are OceanTables::range_count; beyond
  /// their end as at their end.
  std::array<std::int8_t, config::kMaxTableRanges> snr_half_db{};

  [[nodiscard]] float snr_db(std::size_t range) const { return kHalfDecibel * static_cast<float>(snr_half_db[range]); }
};

/// From the least to the most of several.
struct DepthRange {
  Meters least;
  Meters most;
  friend constexpr bool operator==(const DepthRange&, const DepthRange&) = default;
};

/// All that is believed possible of the ocean at a mission's place, for one depth of the vehicle and one frequency of the source; all that
/// a `.tables` file holds but its checksum and signature.
struct OceanTables {
  Hertz frequency;          ///< of the source
  Meters receiver_depth;    ///< of the vehicle
  DepthRange source_depth;  ///< of the sources in these oceans
  DepthRange sea_depth;     ///< of all oceans that went into the tables
  Meters range_step{100.0};
  std::uint16_t range_count = 0;  ///< of every table; the first stands at range 0
  FixedVector<OceanTable, config::kMaxOceanTables> tables;
  Provenance provenance;
};

/// Whether every size fits its capacity and is not zero, and every ocean has a name.
[[nodiscard]] bool has_valid_shape(const OceanTables& tables);
/// Whether what all tables have in common is in its range: frequency 1 Hz to 10 kHz; depths above 0 up to 12 km, the least of a range not
/// more than its most; range step 1 m to 10 km.
[[nodiscard]] bool has_valid_grid(const OceanTables& tables);
/// Whether the numbers of each table are besides: priors 1e-6 to 1e6, sea floors within `sea_depth`.
[[nodiscard]] bool has_valid_numbers(const OceanTables& tables);

/// How far the last range of the tables lies.
[[nodiscard]] inline Meters reach(const OceanTables& tables) {
  return static_cast<double>(tables.range_count - 1) * tables.range_step;
}

/// What a mission listens for, and how far.
struct SearchedSound {
  Meters vehicle_depth;
  Hertz frequency;
  Meters furthest;  ///< that a source may be from the vehicle: the diagonal of the area
};

/// Share of the tables' depth and frequency by which a mission's may differ.
///
/// Near the surface a source and its image make a dipole (Lloyd's mirror), and so do a receiver and its own: on paths that meet the surface
/// at both ends, by way of the sea floor, the pressure goes as
///
///   |p| ~ sin(k z_s sin a) sin(k z_r sin a),    k = 2 pi f / c; z_s, z_r: depths of source and receiver; a: angle of the path
///
/// where the sines are small the level goes as 20 log10 (z_r f^2). A tenth of the depth is 0.8 dB, a twentieth of the frequency, which
/// stands there twice, 0.8 dB: less than the 1 dB that the narrowest hypothesis of the belief allows. Further in the interference moves
/// with the phases, out or in by the same tenth or twentieth: at 10 km by a step of the search, or half a one. Of a vehicle at 300 m that
/// is 4.4 dB rms, and it finds the source nevertheless: policy/tables/README.md.
/// Source: Jensen et al., Computational Ocean Acoustics, 2nd ed., section 1.4 (Lloyd mirror).
inline constexpr double kDepthTolerance = 0.1;
inline constexpr double kFrequencyTolerance = 0.05;

/// Whether tables are of what a mission listens for.
enum class Coverage : std::uint8_t {
  kCovered,
  kAnotherDepth,      ///< the vehicle's depth differs by more than kDepthTolerance of the tables'
  kAnotherFrequency,  ///< the source's frequency differs by more than kFrequencyTolerance of the tables'
  kOutOfReach,        ///< the tables end before the furthest place of a source
};

/// The first of these that fails. @param tables  of a valid shape
/// Oracle: Coverage.*
[[nodiscard]] Coverage coverage(const OceanTables& tables, const SearchedSound& sound);

/// Whether a vehicle may search by them: of a valid shape and grid, with valid numbers, and they cover the sound.
[[nodiscard]] bool are_usable(const OceanTables& tables, const SearchedSound& sound);

}  // namespace earshot::policy
