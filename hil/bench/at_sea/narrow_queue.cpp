#include "hil/bench/at_sea/narrow_queue.hpp"

#include <cerrno>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "hil/bench/at_sea/kernel_counts.hpp"

namespace earshot::hil {

NarrowQueue::NarrowQueue(std::string interface, double frames_per_s) : interface_(std::move(interface)) {
  constexpr double kBitsOfAFrame = 128.0;  // struct can_frame, by which the queue counts
  const std::string rate = std::to_string(std::llround(frames_per_s * kBitsOfAFrame)) + "bit";
  if (!set_netem(interface_, "rate " + rate + " limit 10"))
    throw std::system_error(EIO, std::generic_category(), "tc sets no queue before " + interface_);
}

NarrowQueue::~NarrowQueue() {
  (void)set_netem(interface_, "");  // where the interface is gone, its queue is, too
}

std::uint64_t NarrowQueue::refused() const {
  const std::optional<NetemCounts> counts = netem_counts(interface_);
  if (!counts) throw std::system_error(EIO, std::generic_category(), "tc gives no counter of the queue before " + interface_);
  return counts->dropped;
}

}  // namespace earshot::hil
