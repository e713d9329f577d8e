#pragma once

#include <chrono>
#include <cstdint>
#include <span>

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/host/safety_record/safety_record.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/depth_estimate.hpp"

namespace earshot::board {

/// Keeps the safety record of a flight: after every turn it says how the vehicle stands, before anybody else hears of it. Nothing
/// allocates. Oracle: SafetyLog.*
class SafetyLog {
 public:
  /// While a search is under way or over the record is written again so often, for its clocks.
  static constexpr Duration kBetweenStamps = Duration::seconds(10);
  /// A program that has not written for so long hung: another may command by now.
  static constexpr Duration kHangs = Duration::seconds(30);
  /// A program that has flown for so long since it started was not killed by what it resumed from.
  static constexpr Duration kFlownForAWhile = Duration::seconds(60);

  /// Both must outlive it. @param record  of the flight that goes on, or of the one that begins
  SafetyLog(host::SafetyCopies& copies, const HostClock& host, const host::SafetyRecord& record)
      : copies_(copies), host_(host), boot_(host.boot()), record_(record), began_(host.since_boot()) {
    start_from(record.deepest);
  }

  /// A flight begins. @return as note()
  bool begin(Time now, const config::Mission& mission, std::uint32_t journal_crc32, std::span<const std::uint8_t> kept,
             std::chrono::milliseconds patience);
  /// A turn was made. Where that changes what must not be forgotten, it is written before this returns, but waits for slow disks no longer
  /// than `patience`. What no disk takes is tried again for as long as it takes.
  /// @return whether all of it is durable
  bool note(Time turn, const runtime::Outputs& outputs, const config::Mission& mission, std::chrono::milliseconds patience);
  /// A fix has come that says how deep the vehicle is.
  void hear(const messages::Navigation& fix) { depth_.take(fix); }
  /// An operator aborted the mission before its first turn. @return as note()
  bool abort(std::chrono::milliseconds patience);
  /// The drop weight was asked to be released before it. @return as note()
  bool release(std::chrono::milliseconds patience);
  /// Before it, too, the record is written again once it is kBetweenStamps old.
  void stamp(Time now);
  /// The program was stopped in order. A vehicle that is up, or that was never commanded, is somebody else's again; one that is below stays
  /// under way: nobody else brings it up. @param is_up  besides what the depth and the time since it was told to come up say
  /// @return whether nothing is under way any more, by a record that is durable
  bool close(std::chrono::milliseconds patience, bool is_up = false);

  [[nodiscard]] const host::SafetyRecord& record() const { return record_; }
  [[nodiscard]] bool is_durable() const { return copies_.is_durable(); }
  /// Another process has gone on with the flight, while this one hung.
  [[nodiscard]] bool is_overtaken() const { return copies_.is_overtaken(); }

 private:
  void date();
  void start_from(Meters deepest);

  host::SafetyCopies& copies_;
  const HostClock& host_;
  const BootId boot_;
  host::SafetyRecord record_;  ///< as it was written last
  Duration began_;             ///< on the host's clock
  config::VehicleLimits vehicle_;
  safety::DepthEstimate depth_;
};

/// How a vehicle stands after a turn, put into its record. @return whether anything changed that must not be forgotten
bool put_standing(const runtime::Outputs& outputs, const config::Mission& mission, host::SafetyRecord& record);

}  // namespace earshot::board
