#include "hil/bench/at_sea/sea_computer.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/host/file/shipped.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/messages/operator_command.hpp"
#include "hil/bench/at_sea/given_order.hpp"
#include "hil/bench/bench_flight.hpp"
#include "hil/bench/torn_journal.hpp"
#include "hil/nodes/scaled_clock.hpp"

namespace earshot::hil {
namespace {

/// A library that stands between earshotd and its disk. @param is_sick  the disk is, as long as there is this file
std::vector<std::string> sick_disk(const std::string& sickness, const std::filesystem::path& is_sick) {
  const std::filesystem::path library = host::shipped_library("libearshot-sick-disk.so");
  if (library.empty()) throw std::system_error(ENOENT, std::generic_category(), "libearshot-sick-disk.so (without it no disk falls ill)");
  return {"LD_PRELOAD=" + library.string(), "EARSHOT_TEST_DISK=" + sickness, "EARSHOT_TEST_DISK_IS_SICK=" + is_sick.string(),
          "EARSHOT_TEST_DISK_HAS_RECORD=1"};
}

}  // namespace

SeaComputer::SeaComputer(const Case& c, std::string interface, std::filesystem::path folder)
    : case_(c), interface_(std::move(interface)), folder_(std::move(folder)) {
  if (c.has(Fault::kWallClock) && !has_clock_of_its_own())
    throw NotFlown("the wall clock is set in user-mode Linux alone, which has one of its own");
}

void SeaComputer::set_up(program::ChildSettings& settings) const {
  for (const TimedFault& fault : case_.faults) {
    if (fault.fault == Fault::kFullDisk) settings.most_bytes_of_a_file = static_cast<std::uint64_t>(fault.amount);
    if (fault.fault == Fault::kSlowDisk) settings.environment = sick_disk("slow", disk_is_sick());
    if (fault.fault == Fault::kReadOnlyDisk) settings.environment = sick_disk("read-only", disk_is_sick());
  }
}

bool SeaComputer::is_gone(std::string_view file, Time now) const {
  return std::ranges::any_of(
      case_.faults, [&](const TimedFault& fault) { return fault.fault == Fault::kFileGone && fault.device == file && fault.acts_at(now); });
}

void SeaComputer::begin(const TimedFault& fault) {
  switch (fault.fault) {
    case Fault::kSlowDisk:
    case Fault::kReadOnlyDisk:
      std::ofstream(disk_is_sick()) << "";
      return;
    case Fault::kNoRoom:
      queue_.emplace(interface_, fault.amount);
      return;
    case Fault::kWallClock:
      clock_.emplace(fault.amount);
      return;
    case Fault::kFlippedBit:
      return flip_bit(host::newest_journal_in(folder_));
    case Fault::kBusTaken:
      taken_.emplace(host::lock_can(interface_));
      return;
    case Fault::kOrder:
      return give_order(interface_, fault.device == kPauseOrder ? messages::Order::kPause : messages::Order::kAbort, ScaledClock::utc());
    case Fault::kFullDisk:
    case Fault::kFileGone:
      return;  // earshotd is started with it
    default:
      throw NoMaker(fault.fault, "of the computer at sea");
  }
}

void SeaComputer::end(const TimedFault& fault) {
  switch (fault.fault) {
    case Fault::kSlowDisk:
    case Fault::kReadOnlyDisk:
      std::filesystem::remove(disk_is_sick());
      return;
    case Fault::kNoRoom:
      return widen_queue();
    case Fault::kWallClock:
      return clock_.reset();
    case Fault::kBusTaken:
      return taken_.reset();
    case Fault::kFlippedBit:
    case Fault::kOrder:
    case Fault::kFullDisk:
    case Fault::kFileGone:
      return;  // what it did stays
    default:
      throw NoMaker(fault.fault, "of the computer at sea");
  }
}

void SeaComputer::widen_queue() {
  if (queue_) refused_ += queue_->refused();
  queue_.reset();
}

}  // namespace earshot::hil
