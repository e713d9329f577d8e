#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"

namespace earshot::config {

/// How a decision sums up the SNR measurements in its window.
enum class Listening : std::uint8_t {
  kNewest,   ///< the measurement that ends the leg, as in the paper
  kLoudest,  ///< the loudest of those that were measured; of many measurements that fluctuate it is louder than the sound is
  kMean,     ///< the mean, in dB, of those that were measured: a call among silence counts whole, and fluctuation averages out; the newest
             ///< measurement where the floor may have cut off the lower part of them
};

/// The words for these in files and on command lines, in the same order.
inline constexpr std::array<std::string_view, 3> kListeningWords{"newest", "loudest", "mean"};

/// The window over which an observation listens, and how it sums up the measurements in it. The vehicle in flight and the search that its
/// policy was trained in have the same. The window ends with the leg and never reaches back beyond the leg's beginning.
struct ListeningWindow {
  Listening listening = Listening::kNewest;
  Duration length;  ///< whole seconds, 1 to kMaxListeningSeconds; of kNewest none
  friend constexpr bool operator==(ListeningWindow, ListeningWindow) = default;
};

/// Whether the window's length fits its kind of listening.
[[nodiscard]] constexpr bool is_valid(ListeningWindow window) {
  if (window.listening == Listening::kNewest) return window.length == Duration{};
  const bool is_known = window.listening == Listening::kLoudest || window.listening == Listening::kMean;
  const bool is_whole = window.length.us % Duration::seconds(1).us == 0;
  return is_known && is_whole && window.length >= Duration::seconds(1) &&
         window.length <= Duration::seconds(static_cast<std::int64_t>(kMaxListeningSeconds));
}

}  // namespace earshot::config
