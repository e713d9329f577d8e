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
/// the last frame again, as CAN does when the very last bit of one is disturbed. So does a first frame behind more than two others, which
/// is no swap any more: the one before was lost. Oracle: FastPackets tests on frames that canboat recombines
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
    std::size_t size = 0;    ///< bytes, says the first frame
    std::uint32_t held = 0;  ///< bit n: frame n is there
    std::array<n2k::Frame, kMostFrames> frames{};
    n2k::Frame last{};  ///< that came, of this message or of the one before
    std::optional<Time> began{};
    std::optional<Time> fed{};
    std::uint64_t turn = 0;  ///< at which it was fed last
  };
  [[nodiscard]] const Begun* find(const n2k::Identifier& identifier, std::uint8_t sequence) const;
  [[nodiscard]] Begun& begun_of(const n2k::Identifier& identifier, std::uint8_t sequence);
  /// Gives up what of an older message is in the way of a frame.
  void make_way(Begun& begun, unsigned number, const n2k::Frame& frame, std::optional<Time> now);
  [[nodiscard]] std::optional<Whole> finish(Begun& begun);
  void give_up(Begun& begun);

  std::vector<Begun> begun_;
  std::uint64_t turn_ = 0;
  std::uint64_t given_up_ = 0;
};

}  // namespace earshot::hil
