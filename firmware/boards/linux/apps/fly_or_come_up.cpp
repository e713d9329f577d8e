#include "firmware/boards/linux/apps/fly_or_come_up.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <thread>

#include "firmware/boards/linux/apps/coming_up_flight.hpp"
#include "firmware/boards/linux/outage/lost_record.hpp"
#include "firmware/boards/linux/outage/safety_log.hpp"
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

void read_copies(const Options& o, host::Claim claim, std::optional<host::SafetyCopies>& safety) {
  safety.reset();
  safety.emplace(safety_places(o.out, o.safety_copies, SafetyFolders::of_this_process()), record_owner(o.out), claim);
}

constexpr const char* kIsKilled = "but has been killed, and does not end: a disk hangs";
constexpr const char* kHangs = "but has not written the record for half a minute: it hangs, or does not fly";
/// Between two readings at a record that may be left alone, or whose killed owner may have ended by then.
constexpr std::chrono::seconds kPollInterval{2};

/// For how long nobody has written it, at the least.
Duration age_of(const host::SafetyRecord& record, const HostClock& host) {
  const Duration running = host.since_boot();
  return record.boot == host.boot() ? running - record.since_boot : running;
}

/// A mission is under way, and whoever has its record has not written it for long, nor does he between two readings.
bool is_left_alone(const Options& o, const HostClock& host, std::optional<host::SafetyCopies>& safety) {
  std::optional<host::SafetyRecord> first;
  for (int reading = 0; reading < 2; ++reading) {
    if (reading > 0) std::this_thread::sleep_for(kPollInterval);
    read_copies(o, host::Claim::kWaived, safety);
    if (!is_under_way(*safety) || age_of(*safety->found(), host) < SafetyLog::kHangs) return false;
    if (first && !(*first == *safety->found())) return false;
    first = safety->found();
  }
  return true;
}

/// Likewise, and whoever has its record has been killed, so that nobody commands the vehicle.
bool is_left_by_the_killed(const Options& o, std::optional<host::SafetyCopies>& safety) {
  read_copies(o, host::Claim::kWaived, safety);
  return is_under_way(*safety);
}

/// A process that has been killed ends within a moment, unless a disk holds it.
void claim_copies(const Options& o, std::optional<host::SafetyCopies>& safety) {
  try {
    read_copies(o, host::Claim::kNeeded, safety);
  } catch (const host::RecordInUse& e) {
    if (!o.resume || !e.is_killed()) throw;
    std::this_thread::sleep_for(kPollInterval);
    read_copies(o, host::Claim::kNeeded, safety);
  }
}

/// A service's limit of open files may be low, and more be allowed.
void use_every_descriptor() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  (void)::setrlimit(RLIMIT_NOFILE, &limit);
}

/// Whatever comes in between, the status is none that a service takes for the end.
int bring_up(const Options& o, host::SafetyCopies& safety, const HostClock& host, const std::string& why) {
  try {
    return come_up(o, safety, host, why);
  } catch (const std::exception& e) {
    std::cerr << "earshotd: " << host::printable(e.what()) << "\n";
    return program::kLost;
  }
}

}  // namespace

int fly_or_come_up(const Options& o, const HostClock& host, const std::function<int(host::SafetyCopies&)>& fly) {
  use_every_descriptor();
  std::optional<host::SafetyCopies> safety;
  try {
    try {
      claim_copies(o, safety);
    } catch (const host::RecordInUse& e) {
      const char* const why = e.is_killed() ? kIsKilled : kHangs;
      if (o.resume && (e.is_killed() ? is_left_by_the_killed(o, safety) : is_left_alone(o, host, safety)))
        return bring_up(o, *safety, host, std::string(e.what()) + ", " + why);
      std::cerr << "earshotd: " << host::printable(e.what()) << ": it commands the vehicle\n";
      return o.resume ? program::kLost : program::kBadInput;  // a service tries again
    }
  } catch (const std::exception& e) {  // whether a vehicle is under way cannot be told
    if (!o.resume) throw;
    std::cerr << "earshotd: " << host::printable(e.what()) << "\n";
    return program::kLost;
  }
  for (const std::string& copy : safety->left_out())
    std::cerr << "earshotd: warning: safety record " << host::printable(copy) << ": it does not count\n";
  const SafetyFolders folders = SafetyFolders::of_this_process();
  for (const std::string& warning : warnings_about(safety_places(o.out, o.safety_copies, folders), folders))
    std::cerr << "earshotd: warning: " << host::printable(warning) << "\n";
  const bool lacks_record = o.resume && !safety->found() && safety->is_damaged();  // a vehicle may be under way
  if (lacks_record) {
    if (const std::optional<host::SafetyRecord> record = record_by_journal(o.out / "journal.lcmlog"); record) {
      (void)safety->write(*record, kPatience);
      return bring_up(o, *safety, host, "every copy of its safety record is damaged");
    }
  }
  if (!is_under_way(*safety)) {
    try {
      return fly(*safety);
    } catch (const std::exception& e) {
      if (!lacks_record) throw;
      std::cerr << "earshotd: " << host::printable(e.what()) << "; nor can its safety record be read: tried again\n";
      return program::kLost;  // none that a service takes for the end
    }
  }
  if (!o.resume) {
    const bool is_over = safety->found()->state != messages::MissionState::kSearch;
    std::cerr
        << "earshotd: warning: the earlier mission of this folder " << (is_over ? "is over" : "was not over")
        << ", but its vehicle was not known to be up, and may still be below. It is given up: nobody commands the vehicle until START. "
           "With --resume earshotd "
        << (is_over ? "brings it up" : "goes on, or brings it up") << ". For another rehearsal name another folder (--out)\n";
    return fly(*safety);
  }
  if (safety->found()->starts >= kMostStarts)
    return bring_up(
        o, *safety, host,
        "earshotd ended " + std::to_string(kMostStarts) + " times within a minute of its start: it does not try the mission a fourth time");
  count_start(*safety);
  std::string why;
  try {
    return fly(*safety);
  } catch (const std::exception& e) {
    why = e.what();
  }
  return bring_up(o, *safety, host, why);
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
    std::optional<host::SafetyCopies> safety;
    read_copies(o, host::Claim::kNeeded, safety);
    if (!is_under_way(*safety)) return std::nullopt;
    return bring_up(o, *safety, HostClock(), "an option is wrong (above), and a mission was under way");
  } catch (const std::exception& e) {
    std::cerr << "earshotd: " << host::printable(e.what()) << "\n";
    return program::kLost;
  }
}

}  // namespace earshot::board
