#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"
#include "firmware/wire/n2k/sensors/readings.hpp"
#include "firmware/wire/n2k/sensors/source_gate.hpp"

namespace earshot::n2k {

/// What is taken from one device at a time.
enum class Measured : std::uint8_t {
  kPosition,
  kHeading,
  kVariation,
  kRateOfTurn,
  kAttitude,
  kSpeed,
  kOverGround,
  kPressure,
  kAltitude,
  kTemperature,
  kBattery,
  kCharge,
  kRudder,
};
inline constexpr std::size_t kMeasured = 13;

/// What a pressure sensor counts from.
enum class PressureKind : std::uint8_t {
  kGauge,     ///< the air's pressure at the surface
  kAbsolute,  ///< nothing: the air's pressure must be known (surface_pa, or zero_at_surface) before there is a depth
};

struct SensorSettings {
  std::array<SourceChoice, kMeasured> sources{};  ///< by Measured
  PressureKind pressure_kind = PressureKind::kGauge;
  std::optional<double> surface_pa;  ///< what the sensor says at the surface; a gauge's: zero unless told otherwise
};

struct SensorCounters {
  std::uint64_t taken = 0;                            ///< messages that gave a reading
  std::uint64_t refused = 0;                          ///< malformed, out of range, or of a reference that is not taken
  std::uint64_t unavailable = 0;                      ///< the device says that it has no value
  std::uint64_t other_device = 0;                     ///< of a device that this quantity is not taken from
  std::array<std::uint64_t, kMeasured> not_chosen{};  ///< of those, of a device that the mission does not name, by Measured
  std::uint64_t no_variation = 0;                     ///< of those refused: magnetic headings without a variation
  std::uint64_t no_surface = 0;                       ///< of those refused: absolute pressures before the surface's is known
  std::uint64_t of_no_interest = 0;                   ///< frames of other groups, and what is measured in air
};

/// Reads the vehicle's sensors off the bus. Every quantity has its own device, its own reading and its own age: one that is missing is
/// missing alone.
class Sensors {
 public:
  Sensors() = default;
  explicit Sensors(const SensorSettings& settings);

  /// @param now  arrival of the frame
  /// @return kOk: `measured` has a new reading. kNotReady: nothing came of it (another group or device, half a message, no value).
  /// Otherwise refused and counted: kOutOfRange and kMalformed as decode(), kUnsupported for what has a meaning that is not taken.
  [[nodiscard]] Status accept(const HeardFrame& heard, Time now, Measured& measured);

  /// Takes the newest pressure for that at the surface. kNotReady: there is none. kOutOfRange: nobody is at the surface with it (a gauge
  /// over 20 kPa from zero, an absolute pressure outside 80 to 110 kPa), and nothing is changed.
  [[nodiscard]] Status zero_at_surface();

  [[nodiscard]] const Readings& readings() const { return readings_; }
  /// When the device that this is taken from spoke last, with a value or saying that it has none. While it is taken from nobody, whoever
  /// says that he has none counts.
  [[nodiscard]] std::optional<Time> heard(Measured measured) const { return heard_[static_cast<std::size_t>(measured)]; }
  [[nodiscard]] const Directory& directory() const { return directory_; }
  [[nodiscard]] const SensorCounters& counters() const { return counters_; }
  [[nodiscard]] const FastPacketCounters& fast_packet_counters() const { return assembly_.counters(); }

 private:
  using Bytes = std::span<const std::uint8_t>;
  struct Arrival {
    Identifier identifier;
    Bytes bytes;
    Time time;
  };
  [[nodiscard]] Status take(const Arrival& arrival, Measured& measured);
  [[nodiscard]] Status take_packet(const Identifier& identifier, const Frame& frame, Time now, Measured& measured);
  template <class T>
  [[nodiscard]] Status keep(std::optional<Reading<T>>& reading, Result<T> value, Time time);
  /// What `read` makes of a message, if it is of the device that this is taken from. Only a value makes it that device: one that has none
  /// is in nobody's way.
  /// @param handover  of the message: the silence after which another device takes the place
  template <class T, class Read>
  [[nodiscard]] Status keep_admitted(Measured measured, const Arrival& arrival, Duration handover, std::optional<Reading<T>>& reading,
                                     const Read& read, std::optional<std::uint8_t> instance = {});
  [[nodiscard]] Result<Radians> true_heading(Bytes bytes, Time now);
  [[nodiscard]] Status take_pressure(const Arrival& arrival);
  [[nodiscard]] Status take_temperature(const Arrival& arrival);
  [[nodiscard]] Status take_charge(const Arrival& arrival);

  PressureKind pressure_kind_ = PressureKind::kGauge;
  std::optional<double> surface_pa_;
  std::array<SourceGate, kMeasured> gates_{};
  std::array<std::optional<Time>, kMeasured> heard_{};
  Directory directory_;
  FastPacketAssembly assembly_;
  Readings readings_;
  SensorCounters counters_;
};

}  // namespace earshot::n2k
