#include "firmware/wire/n2k/signals.hpp"

#include "firmware/core/math.hpp"

namespace earshot::n2k {

namespace {

using enum Signal::Sign;

constexpr double kTwoPi = 6.283185307179586;
constexpr double kPi = 3.141592653589793;

// Bare arrays: of a std::array whose type is deduced, GCC 12 makes a variable that could be written.
// Layouts, scales and ranges. Source: canboat docs/canboat.json 8.0.0-beta3 (Apache-2.0), after NMEA 2000.
// Oracle: Signals tests on frames recorded from real buses (tests/reference/n2k).

// Columns: name, first bit, bits, sign, scale, offset, unit, lowest, highest.
constexpr Signal kHeading[]{
    Signal{"SID", 0, 8, kUnsigned, 1.0, 0.0, "", 0, 252},
    Signal{"Heading", 8, 16, kUnsigned, 1e-4, 0.0, "rad", 0, kTwoPi},
    Signal{"Deviation", 24, 16, kSigned, 1e-4, 0.0, "rad", -kPi, kPi},
    Signal{"Variation", 40, 16, kSigned, 1e-4, 0.0, "rad", -kPi, kPi},
    Signal{"Reference", 56, 2, kUnsigned, 1.0, 0.0, "", 0, 2},
};

constexpr Signal kPosition[]{
    Signal{"Latitude", 0, 32, kSigned, 1e-7, 0.0, "deg", -90, 90},
    Signal{"Longitude", 32, 32, kSigned, 1e-7, 0.0, "deg", -180, 180},
};

constexpr Signal kSpeed[]{
    Signal{"SID", 0, 8, kUnsigned, 1.0, 0.0, "", 0, 252},
    Signal{"SpeedWaterReferenced", 8, 16, kUnsigned, 0.01, 0.0, "m/s", 0, 655.32},
    Signal{"SpeedGroundReferenced", 24, 16, kUnsigned, 0.01, 0.0, "m/s", 0, 655.32},
    Signal{"SpeedWaterReferencedType", 40, 8, kUnsigned, 1.0, 0.0, "", 0, 252},
    Signal{"SpeedDirection", 48, 4, kUnsigned, 1.0, 0.0, "", 0, 13},
};

constexpr Signal kPressure[]{
    Signal{"SID", 0, 8, kUnsigned, 1.0, 0.0, "", 0, 252},
    Signal{"Instance", 8, 8, kUnsigned, 1.0, 0.0, "", 0, 252},
    Signal{"Source", 16, 8, kUnsigned, 1.0, 0.0, "", 0, 252},
    Signal{"Pressure", 24, 32, kSigned, 0.1, 0.0, "Pa", -214'748'364.7, 214'748'364.4},
};

constexpr Signal kHeadingControl[]{
    Signal{"RudderLimitExceeded", 0, 2, kUnsigned, 1.0, 0.0, "", 0, 2},
    Signal{"OffHeadingLimitExceeded", 2, 2, kUnsigned, 1.0, 0.0, "", 0, 2},
    Signal{"OffTrackLimitExceeded", 4, 2, kUnsigned, 1.0, 0.0, "", 0, 2},
    Signal{"Override", 6, 2, kUnsigned, 1.0, 0.0, "", 0, 2},
    Signal{"SteeringMode", 8, 3, kUnsigned, 1.0, 0.0, "", 0, 6},
    Signal{"TurnMode", 11, 3, kUnsigned, 1.0, 0.0, "", 0, 6},
    Signal{"HeadingReference", 14, 2, kUnsigned, 1.0, 0.0, "", 0, 2},
    Signal{"CommandedRudderDirection", 21, 3, kUnsigned, 1.0, 0.0, "", 0, 6},
    Signal{"CommandedRudderAngle", 24, 16, kSigned, 1e-4, 0.0, "rad", -kPi, kPi},
    Signal{"HeadingToSteer", 40, 16, kUnsigned, 1e-4, 0.0, "rad", 0, kTwoPi},
    Signal{"Track", 56, 16, kUnsigned, 1e-4, 0.0, "rad", 0, kTwoPi},
    Signal{"RudderLimit", 72, 16, kUnsigned, 1e-4, 0.0, "rad", 0, kTwoPi},
    Signal{"OffHeadingLimit", 88, 16, kUnsigned, 1e-4, 0.0, "rad", 0, kTwoPi},
    Signal{"RadiusOfTurnOrder", 104, 16, kSigned, 1.0, 0.0, "m", -32767, 32764},
    Signal{"RateOfTurnOrder", 120, 16, kSigned, 3.125e-5, 0.0, "rad/s", -1.02396875, 1.023875},
    Signal{"OffTrackLimit", 136, 16, kSigned, 1.0, 0.0, "m", -32767, 32764},
    Signal{"VesselHeading", 152, 16, kUnsigned, 1e-4, 0.0, "rad", 0, kTwoPi},
};

// Ours. A proprietary group begins with the maker's code; 2044, the highest that the field can hold, is assigned to nobody known to canboat
// and must become the vehicle maker's own before it sails with strangers' devices.
constexpr Signal kSpeedDepth[]{
    Signal{"ManufacturerCode", 0, 11, kUnsigned, 1.0, 0.0, "", 0, 2044},
    Signal{"IndustryGroup", 13, 3, kUnsigned, 1.0, 0.0, "", 0, 6},
    Signal{"CommandedSpeed", 16, 16, kUnsigned, 0.01, 0.0, "m/s", 0, 655.32},
    Signal{"CommandedDepth", 32, 32, kUnsigned, 0.01, 0.0, "m", 0, 12'000},
};

constexpr Message message_of(std::string_view name, std::uint32_t pgn, std::uint8_t priority, std::uint8_t size, Direction direction,
                             Duration period, std::span<const Signal> signals) {
  return {name, pgn, priority, size, direction, period, Duration{10 * period.us}, signals};
}

// Periods: once a second, the pace of navigation and set-points in a mission, where the standard's own default is shorter.
constexpr Message kMessages[]{
    message_of("VesselHeading", kHeadingPgn, 2, 8, Direction::kToRuntime, Duration::seconds(1), kHeading),
    message_of("PositionRapidUpdate", kPositionPgn, 2, 8, Direction::kToRuntime, Duration::seconds(1), kPosition),
    message_of("Speed", kSpeedPgn, 2, 8, Direction::kToRuntime, Duration::seconds(1), kSpeed),
    message_of("ActualPressure", kPressurePgn, 5, 8, Direction::kToRuntime, Duration::seconds(1), kPressure),
    message_of("HeadingTrackControl", kHeadingControlPgn, 2, 21, Direction::kFromRuntime, Duration::seconds(1), kHeadingControl),
    message_of("EarshotSpeedDepth", kSpeedDepthPgn, 3, 8, Direction::kFromRuntime, Duration::seconds(1), kSpeedDepth),
};

static_assert(
    [] {
      for (const Message& message : kMessages) {
        if (message.size > kMaxMessageSize) return false;
        for (const Signal& signal : message.signals) {
          if (signal.bit_count < 1 || signal.bit_count > 32 || signal.first_bit + signal.bit_count > 8 * message.size) return false;
        }
      }
      return true;
    }(),
    "every signal lies in its message, and every message in kMaxMessageSize");

std::uint32_t read_bits(std::span<const std::uint8_t> bytes, const Signal& signal) {
  std::uint32_t raw = 0;
  for (unsigned i = 0; i < signal.bit_count; ++i) {
    const unsigned bit = signal.first_bit + i;
    raw |= ((unsigned{bytes[bit / 8]} >> (bit % 8)) & 1U) << i;
  }
  return raw;
}

void write_bits(std::span<std::uint8_t> bytes, const Signal& signal, std::uint32_t raw) {
  for (unsigned i = 0; i < signal.bit_count; ++i) {
    const unsigned bit = signal.first_bit + i;
    const unsigned mask = 1U << (bit % 8);
    const unsigned cleared = bytes[bit / 8] & ~mask;
    bytes[bit / 8] = static_cast<std::uint8_t>(((raw >> i) & 1U) != 0 ? cleared | mask : cleared);
  }
}

bool fits(const Signal& signal, std::size_t size) {
  return std::size_t{signal.first_bit} + signal.bit_count <= 8 * size;
}

}  // namespace

std::span<const Message> messages() {
  return kMessages;
}

const Message* find_message(std::uint32_t pgn) {
  for (const Message& message : kMessages) {
    if (message.pgn == pgn) return &message;
  }
  return nullptr;
}

const Signal* find_signal(const Message& message, std::string_view name) {
  for (const Signal& signal : message.signals) {
    if (signal.name == name) return &signal;
  }
  return nullptr;
}

std::int64_t not_available(const Signal& signal) {
  const unsigned magnitude_bits = signal.sign == kSigned ? signal.bit_count - 1U : signal.bit_count;
  return (std::int64_t{1} << magnitude_bits) - 1;
}

std::int64_t special_values(const Signal& signal) {
  if (signal.bit_count >= 8) return 3;
  return signal.bit_count >= 4 ? 2 : 1;
}

Result<double> decode(const Signal& signal, std::span<const std::uint8_t> bytes) {
  if (!fits(signal, bytes.size())) return Status::kMalformed;
  const std::uint32_t bits = read_bits(bytes, signal);
  std::int64_t raw = bits;
  if (signal.sign == kSigned && ((bits >> (signal.bit_count - 1U)) & 1U) != 0) raw -= std::int64_t{1} << signal.bit_count;
  const std::int64_t top = not_available(signal);
  if (raw == top) return Status::kNotReady;
  if (raw > top - special_values(signal)) return Status::kOutOfRange;
  const double value = static_cast<double>(raw) * signal.scale + signal.offset;
  // Half a step of room: the highest angle on the bus, 62832 * 1e-4 rad, is a hair over 2 pi.
  if (!(value >= signal.lowest - 0.5 * signal.scale && value <= signal.highest + 0.5 * signal.scale)) return Status::kOutOfRange;
  return value;
}

Status encode(const Signal& signal, double value, std::span<std::uint8_t> bytes) {
  if (!fits(signal, bytes.size())) return Status::kFull;
  if (!(value >= signal.lowest && value <= signal.highest)) return Status::kOutOfRange;
  const double scaled = (value - signal.offset) / signal.scale;
  const auto raw = static_cast<std::int64_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
  if (raw > not_available(signal) - special_values(signal)) return Status::kOutOfRange;
  write_bits(bytes, signal, static_cast<std::uint32_t>(raw));
  return Status::kOk;
}

std::array<std::uint8_t, kMaxMessageSize> blank(const Message& message) {
  std::array<std::uint8_t, kMaxMessageSize> bytes{};
  bytes.fill(0xFF);
  for (const Signal& signal : message.signals) write_bits(bytes, signal, static_cast<std::uint32_t>(not_available(signal)));
  return bytes;
}

}  // namespace earshot::n2k
