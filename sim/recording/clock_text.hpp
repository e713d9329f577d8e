#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "firmware/core/time.hpp"
#include "sim/recording/text_scanner.hpp"

namespace earshot::recording {

/// A date and time of day as a text states it.
struct ClockTime {
  Time utc;               ///< without a zone: as if the clock showed UTC
  bool has_zone = false;  ///< the text says how far the clock was from UTC
};

/// "Z", "UTC", "UTC-4", "+1000", "+5:30", "-03:30", "+10": how far a clock is ahead of UTC. Nothing where no zone between -14 and +14 hours
/// stands.
[[nodiscard]] std::optional<Duration> read_zone(TextScanner& text);

/// "2021-02-05T03:59:46.250+10:00": a blank in place of the T, / in place of -, fraction, seconds and zone may lack; the basic format
/// "20210205T035946Z" likewise. Nothing where anything else stands behind: a zone that is not understood must not become UTC.
[[nodiscard]] std::optional<ClockTime> read_iso(std::string_view text);

/// What is wrong with a text that read_iso() does not read; empty: nothing.
[[nodiscard]] std::string fault_of_iso(std::string_view text);

/// The first date in a file's name: "20210205_035946", "20210205T035946+1000", "20210205035946Z", "2021-02-05T03-59-46.250Z" and the like.
[[nodiscard]] std::optional<ClockTime> time_in_name(std::string_view name);

/// The time of a name by a pattern of %Y %y %m %d %j %H %M %S %f (fraction of a second) %z and letters that stand for themselves, anywhere
/// in the name. Nothing where it does not occur.
/// @param format  fault_of_format() has none
[[nodiscard]] std::optional<ClockTime> time_by_format(std::string_view format, std::string_view name);

/// What is wrong with such a pattern; empty: nothing.
[[nodiscard]] std::string fault_of_format(std::string_view format);

}  // namespace earshot::recording
