#include "firmware/boards/linux/can/can_device.hpp"

#include <algorithm>

#include "firmware/host/program/version.hpp"

namespace earshot::board {
namespace {

constexpr std::size_t kLongestText = 32;  ///< of product information

/// How many frames from the first on go together: those of one group, as the longest packets come in one step. Two of them in a row may.
std::size_t frames_together(std::span<const n2k::Frame> frames) {
  const std::size_t most = std::min(frames.size(), host::CanGroup::capacity());
  std::size_t count = 1;
  while (count < most && frames[count].identifier == frames[0].identifier) ++count;
  return count;
}

/// The mission file's ranges are those of the NAME's parts.
n2k::Name name_of(const host::N2kSettings& settings) {
  return n2k::name_of({.unique_number = settings.unique_number, .device_instance = settings.device_instance}).value();
}

}  // namespace

CanDevice::CanDevice(const host::PortSettings& settings, const HostClock& host, host::IfMissing if_missing)
    : host_(host),
      software_version_(program::version().substr(0, kLongestText)),
      serial_(std::to_string(settings.n2k.unique_number)),
      identity_{.name = name_of(settings.n2k),
                .preferred_address = settings.n2k.address,
                .product = {.software_version = software_version_, .serial = serial_},
                .configuration = {}},
      pgns_sent_(pgns_sent(settings.roles)),
      pgns_read_(pgns_read(settings.roles)),
      socket_(settings.address, if_missing, {.filters = filters_of(settings.roles)}),
      was_up_(socket_.is_up()),
      node_(new_node()) {}

void CanDevice::serve() {
  // What the bus knew of us before it went down it may have forgotten, and given to others.
  if (socket_.is_up() && !was_up_) node_ = new_node();
  was_up_ = socket_.is_up();
  if (was_up_) {
    n2k::NodeFrames frames;
    node_.set_controller_state(socket_.controller_state());
    node_.step(now(), frames);
    for (std::span<const n2k::Frame> rest = frames.span(); !rest.empty();) {
      const std::size_t whole = frames_together(rest);
      (void)pass_to_socket(rest.first(whole));
      rest = rest.subspan(whole);
    }
  }
  socket_.flush(now());
}

bool CanDevice::pass_to_socket(std::span<const n2k::Frame> frames, const host::Waiting& waiting) {
  if (!socket_.is_up()) return false;
  const Status status = socket_.send_whole(frames, now(), waiting);
  return status == Status::kOk || status == Status::kNotReady;
}

void CanDevice::add_to(messages::PortReport& report) const {
  const host::CanCounters can = socket_.counters();
  report.link_up = socket_.is_up();
  report.lost += can.lost_by_kernel + can.controller.overflows;
  report.unsent += unsent_ + can.groups.replaced + can.groups.expired + can.groups.abandoned + can.groups.shed;
}

}  // namespace earshot::board
