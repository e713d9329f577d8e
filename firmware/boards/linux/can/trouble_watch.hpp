#pragma once

#include <cstdint>
#include <optional>

#include "firmware/boards/linux/port/bus_trouble.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/wire/n2k/node/node.hpp"
#include "firmware/wire/n2k/sensors/readings.hpp"

namespace earshot::board {

/// What a CAN port sees of itself and of its bus; counters only grow while its link is up.
struct BusSigns {
  bool has_address = false;
  std::uint64_t own_name_claims = 0;  ///< claims with our NAME that others sent
  n2k::ControllerState controller = n2k::ControllerState::kErrorActive;
  std::uint64_t frames_lost = 0;
  std::uint64_t unsent = 0;
  std::uint64_t fixes = 0;
  std::uint64_t measurements = 0;  ///< SNR
  std::uint64_t no_variation = 0;  ///< magnetic headings that could not be made true
  struct NotChosen {
    std::uint64_t position = 0;
    std::uint64_t heading = 0;
    std::uint64_t pressure = 0;
    std::uint64_t snr = 0;
  };
  NotChosen not_chosen;  ///< messages of devices that the mission does not name
  n2k::Readings readings;
};

/// Knows from a port's signs what is wrong with it. Nothing is wrong with what has lasted for less than kPatience of the host's time and of
/// the mission's: a rehearsal may run faster, a simulator may pause.
class TroubleWatch {
 public:
  static constexpr Duration kPatience = Duration::seconds(5);
  /// Without an address: an undisputed claim takes a quarter of a second.
  static constexpr Duration kClaimPatience = Duration::seconds(1);
  /// Frames that are lost once are told of for so long.
  static constexpr Duration kLossTime = Duration::seconds(60);

  TroubleWatch(host::Roles roles, Duration oldest_part) : roles_(roles), oldest_part_(oldest_part) {}

  struct Now {
    Time host;
    Time mission;
  };
  /// To be called whenever the bus has been read, while the link is up.
  [[nodiscard]] BusTroubles check(const BusSigns& signs, Now now);
  /// The link has come back: what happened while it was down was the link's trouble.
  void restart(const BusSigns& signs, Now now);

 private:
  /// When a counter was last seen to grow, or first looked at.
  class Growth {
   public:
    void check(std::uint64_t count, Now now);
    void restart(std::uint64_t count, Now now);
    /// Whether it has stood still for so long.
    [[nodiscard]] bool is_silent(Now now) const { return now.host - last_.host >= kPatience && now.mission - last_.mission >= kPatience; }
    /// Whether it has grown in the last `time` of the host's.
    [[nodiscard]] bool has_grown_within(Duration time, Now now) const { return grown_ && now.host - last_.host < time; }

   private:
    std::optional<std::uint64_t> count_;
    bool grown_ = false;
    Now last_;
  };
  /// What is said of something that is missing: that other devices have it, or else `missing`.
  [[nodiscard]] static BusTrouble missing(BusTrouble nobodys, BusTrouble others, const Growth& not_chosen, Now now) {
    return not_chosen.has_grown_within(kPatience, now) ? others : nobodys;
  }
  void note_missing_parts(const n2k::Readings& readings, Now now, BusTroubles& troubles) const;

  host::Roles roles_;
  Duration oldest_part_;
  Growth fixes_;
  Growth measurements_;
  Growth no_variation_;
  Growth other_positions_;
  Growth other_headings_;
  Growth other_pressures_;
  Growth other_measurements_;
  Growth lost_;
  Growth unsent_;
  std::optional<Time> without_address_since_;
};

}  // namespace earshot::board
