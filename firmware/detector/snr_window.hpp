#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/config/listening_window.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/snr_measurement.hpp"

namespace earshot::detector {

/// What was received over a window of measurements.
struct WindowReception {
  Decibels snr;                    ///< as the window's Listening has it; where none could be measured, the highest of the floors
  bool too_faint = false;          ///< no measurement could be measured: the signal lay below `snr` in all of them
  std::uint32_t measurements = 0;  ///< that counted
  std::uint32_t measured = 0;      ///< of them
  friend constexpr bool operator==(const WindowReception&, const WindowReception&) = default;
};

/// Remembers the measurements of one leg and says what was received over a window of them. One object for flight (firmware/runtime) and
/// training (sim/search), in fixed memory: the measurements of one second of the clock are summed up as they come, however many there are,
/// so a window is so many whole seconds, the last of them the one that has begun.
///
///   newest   the last measurement, whatever the window
///   loudest  the greatest measured SNR; measurements that were too faint to measure say no more than that they were fainter than their
///   floor mean     sum of the measured SNRs in dB / their number, added up second by second, the oldest first; the newest measurement
///   alone where some
///            were too faint and the mean lies less than 10 dB above the highest of their floors
///
/// Of what fluctuates about the floor only the upper part is measured: its mean stays above the floor however faint the sound gets. The
/// newest measurement says what it is. Pulses well above the floor, with silence between, count whole.
/// When no measurement of the window was measured, all that is known of the loudest, and of the mean, is that it lay below the highest
/// floor. Measurements may come from several senders, in any order within the window: dates decide. Gaps are seconds without measurements.
/// Oracle: SnrWindow.*
class SnrWindow {
 public:
  /// Measurements dated before `now` count no more, whenever they arrive, but for the newest as long as no other follows.
  void begin_leg(Time now);

  /// Takes a measurement. @param measurement  its snr is finite. One dated kMaxListeningSeconds or more before the latest is too old to
  /// count.
  void take(const messages::SnrMeasurement& measurement);

  /// What was heard over a window that ends `now`. A measurement dated after `now` moves the window's end to its own second. The newest
  /// measurement always counts, however old: how old it may be is the caller's business. @param window  is_valid(); a measurement was taken
  /// before
  [[nodiscard]] WindowReception reception(config::ListeningWindow window, Time now) const;

  /// The measurement with the latest date, of several the last taken, whatever the leg.
  [[nodiscard]] const std::optional<messages::SnrMeasurement>& newest() const { return newest_; }

 private:
  /// The measurements of one second of the clock, or of several.
  struct Second {
    Decibels loudest;        ///< of the measured, if any was
    Decibels highest_floor;  ///< of the others, if there are any
    Decibels sum;            ///< of the measured
    std::uint32_t measurements = 0;
    std::uint32_t measured = 0;
    void add(const messages::SnrMeasurement& measurement);
    void add(const Second& other);
  };

  void forget_up_to(std::int64_t second);

  std::array<Second, config::kMaxListeningSeconds> seconds_{};  ///< a ring: second s lies at s modulo its size
  std::int64_t last_second_ = 0;                                ///< the latest that is in the ring
  bool is_empty_ = true;                                        ///< no measurement since the leg began
  std::optional<Time> leg_began_;                               ///< before the first leg: none, and every measurement counts
  std::optional<messages::SnrMeasurement> newest_;
};

}  // namespace earshot::detector
