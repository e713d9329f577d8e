#pragma once

#include <cstdint>

#include "firmware/boards/linux/port/bus_trouble.hpp"
#include "firmware/boards/linux/port/heard_chain.hpp"
#include "firmware/boards/linux/port/order_trouble.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::board {

/// Takes what the ports bring, one by one in the order in which it came.
class InputSink {
 public:
  using Value = decltype(messages::Input::value);

  InputSink() = default;
  virtual ~InputSink() = default;
  InputSink(const InputSink&) = delete;
  InputSink& operator=(const InputSink&) = delete;

  /// @param value  its date on the mission clock
  virtual void take(std::uint8_t port, const Value& value) = 0;
  /// A sound heard from its beginning to its end. It is told, and steers nothing.
  virtual void report_detection(std::uint8_t /*port*/, const messages::SoundDetection& /*detection*/) {}
  /// With what chain sound is heard from now on, or why it is not.
  virtual void report_chain(std::uint8_t /*port*/, const HeardChain& /*chain*/) {}
  /// Something is wrong with a port from now on, or no longer.
  virtual void report_trouble(std::uint8_t /*port*/, BusTrouble /*trouble*/, bool /*is_there*/) {}
  /// Something was wrong with an order that a port brought.
  virtual void report_order_trouble(std::uint8_t /*port*/, OrderTrouble /*trouble*/) {}
};

}  // namespace earshot::board
