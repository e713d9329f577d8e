#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace earshot::wire {

// Consistent Overhead Byte Stuffing: bytes without a zero among them, so that a zero ends a frame, and who lost his place on a serial line
// finds it again at the next one.
// Source: Cheshire and Baker, "Consistent Overhead Byte Stuffing", IEEE/ACM Transactions on Networking 7(2), 1999.
// Oracle: Cobs.* (the examples of that paper and of its articles)

/// Room that `size` bytes take at most, with the zero that ends them.
[[nodiscard]] constexpr std::size_t cobs_room(std::size_t size) {
  return size + size / 254 + 2;
}

/// @param to  of cobs_room(from.size()) bytes or more. `from` may be the last bytes of so many, and is written over: what is stuffed never
/// comes as far as what is still to be read. Otherwise they must not overlap.
/// @return how many bytes of `to` were written, the ending zero among them
[[nodiscard]] std::size_t stuff(std::span<const std::uint8_t> from, std::span<std::uint8_t> to);

/// Takes bytes off a line one by one and puts frames together again.
class CobsReader {
 public:
  enum class Outcome : std::uint8_t {
    kNothing,  ///< yet
    kFrame,    ///< the frame is whole: frame() holds it until the next take()
    kBroken,   ///< what came before this zero was none: too long, or torn
  };

  /// @param room  where frames are put together; what is longer is broken
  explicit CobsReader(std::span<std::uint8_t> room) : room_(room) {}

  [[nodiscard]] Outcome take(std::uint8_t byte);
  [[nodiscard]] std::span<const std::uint8_t> frame() const { return room_.first(whole_); }

 private:
  void put(std::uint8_t byte);

  std::span<std::uint8_t> room_;
  std::size_t size_ = 0;
  std::size_t whole_ = 0;
  std::uint8_t left_ = 0;     ///< bytes until the next code
  bool is_zero_due_ = false;  ///< before the next byte, for the code before it was shorter than the longest
  bool is_too_long_ = false;
};

}  // namespace earshot::wire
