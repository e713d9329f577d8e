#pragma once

#include <cstdint>

#include "firmware/core/units.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::board {

/// What a bus wants of everybody on it, between turns, too.
class BusMember {
 public:
  /// Called at least ten times a second of the host's time.
  virtual void serve() = 0;
  /// Called before the first turn until it says that the port could send. What arrives meanwhile is no input.
  [[nodiscard]] virtual bool settle() = 0;

 protected:
  ~BusMember() = default;
};

/// Listens to sound beside the loop.
class SoundListener {
 public:
  /// How fast the vehicle moves through the water, once a turn, before Port::publish(): a hydrophone may then hear nothing but the vehicle.
  /// Always finite: where the last fix does not say, it is the speed of the last set-point, and zero before there was one. A vehicle does
  /// about what it is told; were the speed that nobody knows too fast, a vehicle without a log would never hear, and if it were never too
  /// fast, it would take its own noise for the sea's.
  virtual void note_speed(MetersPerSecond speed) = 0;
  /// Blocks of sound that it has listened to so far, and whose SNR, if they gave any, Port::collect() has or can give.
  [[nodiscard]] virtual std::uint64_t blocks_heard() const = 0;

 protected:
  ~SoundListener() = default;
};

/// Sends the sounds that any hydrophone of the vehicle heard.
class DetectionSender {
 public:
  /// Sends it if the port's roles ask for that.
  virtual void publish_detection(const messages::SoundDetection& detection) = 0;

 protected:
  ~DetectionSender() = default;
};

/// What a port has to do besides what every port does; null: not that.
struct FurtherDuties {
  BusMember* bus_member = nullptr;
  SoundListener* sound_listener = nullptr;
  DetectionSender* detection_sender = nullptr;
};

}  // namespace earshot::board
