#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/core/time.hpp"
#include "firmware/host/program/child_process.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "hil/bench/at_sea/narrow_queue.hpp"
#include "hil/bench/at_sea/wall_clock.hpp"
#include "hil/bench/case.hpp"

namespace earshot::hil {

/// What earshotd finds at sea on the computer that it runs on, as far as a case lets a fault be injected into it: its disk, its files, its
/// clock, and who else is on its bus.
class SeaComputer {
 public:
  /// @param interface  on which earshotd flies   @param folder  of its journal
  /// @throws NotFlown where this kernel cannot do what the case wants
  SeaComputer(const Case& c, std::string interface, std::filesystem::path folder);

  /// Adds to how earshotd is started: some faults of the disk are there from its start on. @throws std::system_error
  void set_up(program::ChildSettings& settings) const;
  /// Whether a file that earshotd reads when it is started is missing. @param file  of kFiles
  [[nodiscard]] bool is_gone(std::string_view file, Time now) const;

  /// @throws NoMaker of a fault of nothing that it has; std::system_error
  void begin(const TimedFault& fault);
  void end(const TimedFault& fault);
  /// The interface takes all frames again.
  void widen_queue();
  /// Frames for which there was no room, by the kernel's counter of the queues that are gone.
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

 private:
  [[nodiscard]] std::filesystem::path disk_is_sick() const { return folder_ / "disk_is_sick"; }

  const Case& case_;
  std::string interface_;
  std::filesystem::path folder_;
  std::optional<WallClockAhead> clock_;
  std::optional<NarrowQueue> queue_;
  std::optional<host::BusLock> taken_;
  std::uint64_t refused_ = 0;
};

}  // namespace earshot::hil
