#include "sim/link/run_slot.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>

namespace earshot::link {
namespace {

/// One folder for every user of the machine: ports are the machine's, not a user's.
std::filesystem::path lock_file(std::uint32_t number) {
  return "/tmp/earshot-run-" + std::to_string(number) + ".lock";
}

}  // namespace

RunSlot::RunSlot() {
  for (number_ = 0; number_ <= kHighestDomain - kLowestDomain; ++number_) {
    file_ = open(lock_file(number_).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ >= 0 && lockf(file_, F_TLOCK, 0) == 0) return;
    if (file_ >= 0) close(file_);
  }
  throw LinkError("simulation link: every one of the " + std::to_string(kHighestDomain - kLowestDomain + 1) +
                  " run slots is taken (see /tmp/earshot-run-*.lock)");
}

RunSlot::~RunSlot() {
  close(file_);
}

std::string RunSlot::lcm_url() const {
  return "udpm://239.255.76.67:" + std::to_string(7667 + number_) + "?ttl=0";
}

}  // namespace earshot::link
