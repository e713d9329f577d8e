#include "firmware/boards/linux/apps/at_sea.hpp"

#include <chrono>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>

#include "firmware/boards/linux/apps/coming_up_flight.hpp"
#include "firmware/boards/linux/outage/safety_places.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/exit_status.hpp"

namespace earshot::board {
namespace {

/// A flight that ends as often within a minute of its start ends by what it resumes from.
constexpr std::uint32_t kMostStarts = 3;
/// With disks, for the count of starts.
constexpr std::chrono::seconds kPatience{1};

bool is_under_way(const host::SafetyCopies& safety) {
  return safety.found() && host::is_under_way(*safety.found());
}

void count_start(host::SafetyCopies& safety) {
  host::SafetyRecord record = safety.found().value();
  ++record.starts;
  (void)safety.write(record, kPatience);
}

}  // namespace

int fly_at_sea(const Options& o, const HostClock& host, const std::function<int(host::SafetyCopies&)>& fly) {
  std::optional<host::SafetyCopies> safety;
  try {
    safety.emplace(safety_places(o.out, o.safety_copies, SafetyFolders::of_this_process()));
  } catch (const host::RecordInUse& e) {
    std::cerr << "earshotd: " << host::printable(e.what()) << ": it commands the vehicle\n";
    return o.resume ? program::kLost : program::kBadInput;  // a service tries again
  }
  if (!is_under_way(*safety)) return fly(*safety);
  if (!o.resume) {
    std::cerr << "earshotd: warning: a mission was under way in this folder; without --resume it is given up, and nobody commands the "
                 "vehicle until START (with --resume it goes on or comes up)\n";
    return fly(*safety);
  }
  if (safety->found()->starts >= kMostStarts)
    return come_up(
        o, *safety, host,
        "earshotd ended " + std::to_string(kMostStarts) + " times within a minute of its start: it does not try the mission a fourth time");
  count_start(*safety);
  std::string why;
  try {
    return fly(*safety);
  } catch (const std::exception& e) {
    why = e.what();
  }
  return come_up(o, *safety, host, why);
}

std::optional<int> come_up_by(int argc, const char* const* argv) {
  constexpr std::string_view kOut = "--out";
  Options o;
  bool is_at_sea = true;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const bool is_last = i + 1 == argc;
    if (word == kOut && !is_last) o.out = argv[++i];
    if (word.starts_with("--out=")) o.out = word.substr(kOut.size() + 1);
    if (word == "--safety-copy" && !is_last) o.safety_copies.emplace_back(argv[++i]);
    if (word == "--resume") o.resume = true;
    if (word.starts_with("--simulation") || word == "--check") is_at_sea = false;
  }
  if (!o.resume || !is_at_sea) return std::nullopt;
  try {
    host::SafetyCopies safety(safety_places(o.out, o.safety_copies, SafetyFolders::of_this_process()));
    if (!is_under_way(safety)) return std::nullopt;
    return come_up(o, safety, HostClock(), "an option is wrong (above), and a mission was under way");
  } catch (const std::exception& e) {
    std::cerr << "earshotd: " << host::printable(e.what()) << "\n";
    return program::kLost;
  }
}

}  // namespace earshot::board
