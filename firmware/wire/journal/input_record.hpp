#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::wire {

// How an input stands in a journal: on its kind's LCM channel with the port that brought it behind a dot, as in "EARSHOT_NAV_STATE.1",
// dated with its arrival. No runtime listens to such a channel: a journal that is played back to a bus commands nobody.

/// One input as a record. Holds it itself: nothing is allocated.
class InputRecord {
 public:
  explicit InputRecord(const messages::Input& input);
  [[nodiscard]] std::string_view channel() const { return {channel_.data(), channel_size_}; }
  [[nodiscard]] std::span<const std::uint8_t> data() const { return encoded_.bytes(); }

 private:
  Encoded encoded_;
  std::array<char, 40> channel_{};
  std::size_t channel_size_ = 0;
};

/// An input out of its record. kUnsupported: the channel is no input's. kMalformed: the bytes are not of the channel's type.
/// @param sequence  how many inputs stand before it in the journal
[[nodiscard]] Status read_input(std::string_view channel, Time time, std::span<const std::uint8_t> data, std::uint64_t sequence,
                                messages::Input& input);

}  // namespace earshot::wire
