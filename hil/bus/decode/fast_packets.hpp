#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::hil {

/// Puts the fast packets of one device together, also those that gateways write: frames swapped, and the last one without its padding.
/// (A vehicle takes neither: on a CAN bus frames keep their order and have 8 bytes.)
///
/// Frames of one destination, group and sequence are held by their number. A number that is held already begins a new message, unless it is
/// the last frame again, as CAN does when the very last bit of one is disturbed; where it came ahead of the first frame, those that did are
/// of the message before, and the first one is the new one's. A first frame behind more than two others begins a new message, too, unless
/// it is known to have come right behind them and they are no message's end, in order up to its last: the first of that was lost. Oracle:
/// FastPackets tests on frames that canboat recombines
class FastPackets {
 public:
  static constexpr std::size_t kMostBegun = 32;  ///< messages at once; full: the one fed longest ago is given up

  struct Whole {
    std::vector<std::uint8_t> bytes;
    std::optional<Time> began;  ///< arrival of the first of its frames
  };
  /// @param now  arrival of the frame, if it is known: frames more than n2k::kFastPacketTimeout apart belong to two messages
  [[nodiscard]] std::optional<Whole> accept(const n2k::Identifier& identifier, const n2k::Frame& frame, std::optional<Time> now);

  /// Whether this frame would go on with a message whose first frame is there.
  [[nodiscard]] bool expects(const n2k::Identifier& identifier, const n2k::Frame& frame) const;

  /// Messages and single frames that were given up, and those that are not whole yet.
  [[nodiscard]] std::uint64_t incomplete() const;

 private:
  static constexpr std::size_t kMostFrames = 32;
  struct Begun {
    std::uint32_t pgn = 0;
    std::uint8_t destination = 0;
    std::uint8_t sequence = 0;
    std::size_t size = 0;      ///< bytes, says the first frame
    std::uint32_t held = 0;    ///< bit n: frame n is there
    std::uint32_t ahead = 0;   ///< of these, those that came before the first one
    unsigned last_number = 0;  ///< of the frame that came last
    bool is_in_order = false;  ///< each has a higher number than the one that came before it
    std::array<n2k::Frame, kMostFrames> frames{};
    n2k::Frame last{};  ///< that came, of this message or of the one before
    std::optional<Time> began{};
    std::optional<Time> first_came{};  ///< arrival of frame 0
    std::optional<Time> fed{};
    std::uint64_t turn = 0;  ///< at which it was fed last
  };
  [[nodiscard]] const Begun* find(const n2k::Identifier& identifier, std::uint8_t sequence) const;
  [[nodiscard]] Begun& begun_of(const n2k::Identifier& identifier, std::uint8_t sequence);
  /// Gives up what of an older message is in the way of a frame.
  void make_way(Begun& begun, unsigned number, const n2k::Frame& frame, std::optional<Time> now);
  /// Whether what is held begins no message that the first frame, which comes now, is of.
  [[nodiscard]] static bool is_of_the_one_before(const Begun& begun, std::optional<Time> now);
  [[nodiscard]] std::optional<Whole> finish(Begun& begun);
  void give_up(Begun& begun);
  /// What came before the first frame, which is of a newer message.
  void give_up_ahead(Begun& begun);

  std::vector<Begun> begun_;
  std::uint64_t turn_ = 0;
  std::uint64_t given_up_ = 0;
};

}  // namespace earshot::hil
