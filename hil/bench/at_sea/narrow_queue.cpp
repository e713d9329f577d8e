#include "hil/bench/at_sea/narrow_queue.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/host/program/child_process.hpp"

namespace earshot::hil {
namespace {

/// iproute2's. @return what it said
std::string tc(const std::vector<std::string>& arguments) {
  const std::filesystem::path said = std::filesystem::temp_directory_path() / ("earshot-tc-" + std::to_string(::getpid()));
  program::ChildProcess child("/sbin/tc", arguments, {.words = said});
  for (child.poll(); child.running(); child.poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::ifstream file(said);
  std::string words{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(said);
  if (child.status() != 0) throw std::system_error(EIO, std::generic_category(), "tc " + arguments.front() + ": " + words);
  return words;
}

}  // namespace

NarrowQueue::NarrowQueue(std::string interface, double frames_per_s) : interface_(std::move(interface)) {
  constexpr double kBitsOfAFrame = 128.0;  // struct can_frame, by which the queue counts
  const std::string rate = std::to_string(std::llround(frames_per_s * kBitsOfAFrame)) + "bit";
  (void)tc({"qdisc", "add", "dev", interface_, "root", "netem", "rate", rate, "limit", "10"});
}

NarrowQueue::~NarrowQueue() {
  try {
    (void)tc({"qdisc", "del", "dev", interface_, "root"});
  } catch (const std::system_error&) {  // the interface is gone, and its queue with it
  }
}

std::uint64_t NarrowQueue::refused() const {
  constexpr std::string_view kDropped = "(dropped ";
  const std::string words = tc({"-s", "qdisc", "show", "dev", interface_, "root"});
  const std::size_t at = words.find(kDropped);
  std::uint64_t count = 0;
  if (at == std::string::npos) throw std::system_error(EIO, std::generic_category(), "tc tells no counter: " + words);
  (void)std::from_chars(words.data() + at + kDropped.size(), words.data() + words.size(), count);
  return count;
}

}  // namespace earshot::hil
