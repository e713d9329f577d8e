// A journal on a disk that is slow, stands still and runs full, and a power cut behind every call that the journal makes of it: what was
// brought to the disk must be read back, and what is lost beyond the stated budget must have been told before.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/program/run.hpp"
#include "tests/outage/power_cut.hpp"
#include "tests/outage/recorded_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::outage {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Seconds = std::chrono::duration<double>;

constexpr int kNotHeld = 1;  ///< exit status: something of what is promised was not held
constexpr const char* kFirstFile = "journal.lcmlog";

struct Options {
  std::uint64_t seed = 1;
  double seconds = 12.0;
  std::uint64_t torn = 3;
  std::uint64_t part_kb = 40;
  std::string plant = "nothing";
};

/// A record as it was appended.
struct Appended {
  SteadyClock::time_point when;
  std::vector<std::uint8_t> data;
};

/// What the journal said of itself at some moment.
struct Reported {
  SteadyClock::time_point when;
  bool is_in_trouble = false;
};

struct Recording {
  std::map<std::uint32_t, Appended> appended;
  std::vector<Reported> reported;
  std::vector<DiskCall> calls;
  std::uint64_t lost = 0;     ///< counted by the journal
  std::uint64_t refused = 0;  ///< of these, when they were to be appended
  bool is_whole = false;      ///< as close() says
};

std::uint32_t below(Pcg32& random, std::uint32_t bound) {
  return static_cast<std::uint32_t>(random.uniform_double() * bound);
}

/// The disk's moods, each for a fifth of the time: quick, slow, standing still now and then, full, quick again and writing little at once.
DiskMood mood_of(int fifth, std::uint64_t seed, std::uint64_t written_bytes) {
  auto random = std::make_shared<Pcg32>(seed, static_cast<std::uint64_t>(fifth));
  switch (fifth) {
    case 1:
      return {.delay = [random] { return microseconds(below(*random, 200'000)); }};
    case 2:
      return {.delay = [random] { return microseconds(below(*random, 4) == 0 ? 1'300'000 : 1'000); }};
    case 3:
      return {.room_bytes = written_bytes + 3 * host::kJournalReserveBytes};
    case 4:
      return {.delay = [random] { return microseconds(below(*random, 3'000)); }, .most_at_once = 700};
    default:
      return {.delay = [random] { return microseconds(below(*random, 3'000)); }};
  }
}

Recording record(const Options& o) {
  const support::TemporaryFolder folder;
  RecordedDisk disk(folder.path());
  Recording recording;
  Pcg32 random(o.seed);
  using J = host::JournalOptions;
  J options{.survives = o.plant == "no sync" ? J::Survives::kProcess : J::Survives::kPowerCut, .limits = {.part_bytes = o.part_kb * 1000}};
  host::Journal journal(folder / kFirstFile, options);
  std::uint32_t number = 0;
  std::uint64_t bytes = 0;
  const auto began = SteadyClock::now();
  for (int fifth = -1;;) {
    const double passed = Seconds(SteadyClock::now() - began).count() / o.seconds;
    if (passed >= 1.0) break;
    if (const int now = static_cast<int>(5 * passed); now != fifth) disk.be(mood_of(fifth = now, o.seed, bytes));
    for (std::uint32_t burst = below(random, 4); burst > 0; --burst) {
      std::vector<std::uint8_t> data(below(random, 100) == 0 ? 3'000 : 20 + below(random, 200));
      for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random.next());
      const std::uint32_t kind = below(random, 60);
      const host::Priority priority = kind == 0 ? host::Priority::kOrder : (kind < 8 ? host::Priority::kSteering : host::Priority::kStream);
      const Appended record{.when = SteadyClock::now(), .data = data};
      // A number is spent even on a record that finds no room.
      if (journal.append(Time{number}, "OUTAGE", data, priority) == Status::kOk) {
        recording.appended[number] = record;
      } else {
        ++recording.refused;
      }
      ++number;
      bytes += data.size() + 34;
    }
    recording.reported.push_back({.when = SteadyClock::now(), .is_in_trouble = journal.trouble() != host::JournalTrouble::kNone});
    std::this_thread::sleep_for(milliseconds(2));
  }
  journal.conclude({});
  recording.is_whole = journal.close() == Status::kOk;
  recording.calls = disk.calls();
  recording.lost = journal.counters().all_lost();
  return recording;
}

/// The numbers of the records that are read back out of what a power cut left; each must be what was appended.
std::set<std::uint32_t> read_back(const Files& files, const std::map<std::uint32_t, Appended>& appended, bool& is_invented) {
  const support::TemporaryFolder folder;
  for (const auto& [name, bytes] : files) {
    std::ofstream file(folder / name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  std::set<std::uint32_t> numbers;
  if (!files.contains(kFirstFile)) return numbers;
  host::JournalReader reader(folder / kFirstFile);
  for (host::JournalRecord record; reader.next(record);) {
    if (record.channel != "OUTAGE") continue;  // the closing record
    const auto found = appended.find(record.number);
    is_invented = is_invented || found == appended.end() || found->second.data != record.data;
    numbers.insert(record.number);
  }
  return numbers;
}

/// What the power cuts cost.
struct Findings {
  std::uint64_t cuts = 0;
  std::uint64_t not_read_back = 0;    ///< records that the disk had been told to keep
  std::uint64_t not_counted = 0;      ///< records that are not in the file in the end, though the journal says that they are
  bool is_invented = false;           ///< something was read that nobody appended
  double longest_s = 0.0;             ///< the age of the oldest record that a cut cost
  double longest_unreported_s = 0.0;  ///< likewise, while the journal had not said that it is in trouble
};

/// Whether the journal, asked last before the cut and after the record was older than the budget, said that it is in trouble; true also
/// when nobody asked it in between.
bool was_reported(const std::vector<Reported>& reported, SteadyClock::time_point appended, SteadyClock::time_point cut) {
  const auto to = std::ranges::lower_bound(reported, cut, {}, &Reported::when);
  return to == reported.begin() || std::prev(to)->when < appended + host::kJournalBudget || std::prev(to)->is_in_trouble;
}

/// Were the power to fail at `cut`, and all that was kept is what `kept` holds.
/// @param in_the_end  what the journal did not give up, and count as lost
void count_cost(const Recording& recording, const std::set<std::uint32_t>& kept, const std::set<std::uint32_t>& in_the_end,
                SteadyClock::time_point cut, Findings& findings) {
  for (const std::uint32_t number : in_the_end) {
    const Appended& record = recording.appended.at(number);
    if (record.when >= cut || kept.contains(number)) continue;
    const double age_s = Seconds(cut - record.when).count();
    findings.longest_s = std::max(findings.longest_s, age_s);
    if (cut > record.when + host::kJournalBudget && was_reported(recording.reported, record.when, cut)) continue;
    findings.longest_unreported_s = std::max(findings.longest_unreported_s, age_s);
  }
}

Findings cut_everywhere(const Recording& recording, const Options& o) {
  Findings findings;
  Pcg32 random(o.seed, 1);
  FolderOnDisk whole;
  for (const DiskCall& call : recording.calls) whole.follow(call);
  const std::set<std::uint32_t> in_the_end =
      read_back(whole.after_power_cut(Unsynced::kThere, random), recording.appended, findings.is_invented);
  // Records that found no room in the buffer were never appended; those that were given up afterwards are counted, too.
  findings.not_counted = recording.lost - recording.refused + in_the_end.size() - recording.appended.size();
  FolderOnDisk folder;
  for (auto call = recording.calls.begin(); call != recording.calls.end(); ++call) {
    folder.follow(*call);
    const auto next = std::next(call);
    const std::set<std::uint32_t> kept =
        read_back(folder.after_power_cut(Unsynced::kLost, random), recording.appended, findings.is_invented);
    // The worst moment is the last before the next call has returned.
    if (next != recording.calls.end()) count_cost(recording, kept, in_the_end, next->when, findings);
    ++findings.cuts;
    for (std::uint64_t i = 0; i <= o.torn; ++i, ++findings.cuts) {
      const Unsynced unsynced = i == 0 ? Unsynced::kThere : Unsynced::kTorn;
      const std::set<std::uint32_t> read = read_back(folder.after_power_cut(unsynced, random), recording.appended, findings.is_invented);
      findings.not_read_back +=
          static_cast<std::uint64_t>(std::ranges::count_if(kept, [&read](std::uint32_t number) { return !read.contains(number); }));
    }
  }
  return findings;
}

/// Says what came of it. @return exit status
int judge(const Recording& recording, const Findings& findings) {
  const double budget_s = Seconds(host::kJournalBudget).count();
  // Twice the budget: a busy computer wakes the journal's thread late, and its clock begins with that.
  const bool is_reported = findings.longest_unreported_s <= 2 * budget_s;
  std::printf(
      "%zu records, %llu lost and counted; %zu calls of the disk, %llu power cuts\n"
      "records that the disk had been told to keep and that were not read back: %llu%s\n"
      "records that are not in the file in the end and that nobody counted: %lld%s\n"
      "records read back that nobody appended: %s\n"
      "the oldest record that a power cut cost was %.3f s old; while the journal said nothing of trouble %.3f s, of %.1f s stated%s\n",
      recording.appended.size(), static_cast<unsigned long long>(recording.lost), recording.calls.size(),
      static_cast<unsigned long long>(findings.cuts), static_cast<unsigned long long>(findings.not_read_back),
      findings.not_read_back > 0 ? "  WRONG" : "", static_cast<long long>(findings.not_counted), findings.not_counted != 0 ? "  WRONG" : "",
      findings.is_invented ? "some  WRONG" : "none", findings.longest_s, findings.longest_unreported_s, budget_s,
      is_reported ? "" : "  WRONG");
  return findings.not_read_back == 0 && findings.not_counted == 0 && !findings.is_invented && is_reported ? program::kDone : kNotHeld;
}

}  // namespace
}  // namespace earshot::outage

int main(int argc, char** argv) {
  using namespace earshot;
  program::CommandLine line(
      "power_cuts",
      "power_cuts writes a journal on a disk that is slow, stands still and runs full, and cuts the power behind every\n"
      "call of the disk. Exit status: 0 all as promised, 1 not, 2 bad input.");
  outage::Options o;
  line.option("--seed", &o.seed, "of the records and the disk's moods").shows_default();
  line.option("--seconds", &o.seconds, "how long the journal is written").between(1.0, 3600.0).shows_default();
  line.option("--torn", &o.torn, "how many ways what was not kept is torn at each cut").from(0, 1000).shows_default();
  line.option("--part-kb", &o.part_kb, "size of a part of the journal, kilobytes; 0: it is one file").from(0, 1'000'000).shows_default();
  line.option("--plant", &o.plant, "a fault that must be found: the journal leaves its records to the kernel")
      .one_of({"nothing", "no sync"})
      .shows_default();
  return program::run(line, argc, argv, [&] {
    const outage::Recording recording = outage::record(o);
    return outage::judge(recording, outage::cut_everywhere(recording, o));
  });
}
