#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/random.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/vehicle_status.hpp"

// All that the recorded mission takes in. It is made of whole numbers, and a double or a float is one of them times a power of two: no
// machine can round it differently.
namespace earshot::bits {

inline constexpr std::int32_t kSeconds = 480;         ///< that the mission is given
inline constexpr std::int32_t kSampleRate_hz = 1000;  ///< of its one hydrophone
inline constexpr double kPlaceUnit_m = 0x1p-10;
inline constexpr double kAngleUnit_rad = 0x1p-20;

/// From this second on the vehicle heads for a place: what a decision of the flight that was recorded came to.
struct Corner {
  std::int32_t second;
  std::int32_t north;  ///< in kPlaceUnit_m, as `east`
  std::int32_t east;
  std::int32_t heading;  ///< in kAngleUnit_rad, as `bearing`
  std::int32_t bearing;  ///< of the source
};

struct Place {
  std::int64_t north = 0;  ///< in kPlaceUnit_m
  std::int64_t east = 0;
};

inline constexpr Place kStart{4'000 * 1024, 1'200 * 1024};
inline constexpr Place kSource{1'700 * 1024, 4'900 * 1024};
inline constexpr std::int64_t kSpeed = 10 * 1024;  ///< of the vehicle, in kPlaceUnit_m a second

/// Where the vehicle is: at its start, and from the first corner on always straight ahead.
class Vehicle {
 public:
  /// Turns to `corner`, from where it is.
  void head_for(const Corner& corner);
  /// A second passes.
  void move();

  [[nodiscard]] const Place& place() const { return place_; }
  [[nodiscard]] messages::Navigation navigation(std::int32_t second) const;
  [[nodiscard]] messages::VehicleStatus status(std::int32_t second) const;
  [[nodiscard]] messages::BearingMeasurement bearing(std::int32_t second) const;

 private:
  Place place_ = kStart;
  Place from_ = kStart;
  Corner corner_{};
  std::int64_t length_ = 0;  ///< from there to the corner
  std::int64_t travelled_ = 0;
};

/// A whale's pulse of 20 Hz every fifteen seconds, fainter by 1 dB every 118 m and by a chance of its own, in the noise of the sea.
class Sea {
 public:
  using Samples = std::array<float, kSampleRate_hz>;

  /// What the hydrophone takes in the second that ends with `second`.
  void hear(std::int32_t second, const Place& vehicle, Samples& samples);

 private:
  Pcg32 random_{560};
  std::int64_t sample_ = 0;
};

/// What an operator says in a second, if anything.
[[nodiscard]] std::optional<messages::OperatorCommand> order_of(std::int32_t second);

/// Of the block that ends with it: a piece of it is missing, another gain.
[[nodiscard]] bool is_lost(std::int32_t second);
[[nodiscard]] Decibels gain_of(std::int32_t second);

/// The largest whole number whose square is no larger.
[[nodiscard]] std::int64_t whole_root(std::int64_t square);

}  // namespace earshot::bits
