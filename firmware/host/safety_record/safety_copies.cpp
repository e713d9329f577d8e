#include "firmware/host/safety_record/safety_copies.hpp"

#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/safety_record/record_file.hpp"

namespace earshot::host {
namespace {

constexpr std::chrono::milliseconds kRetry{100};

}  // namespace

struct SafetyCopies::Writers {
  struct Copy {
    explicit Copy(SafetyCopy copy) : file(std::move(copy.file)), survives_power_cut(copy.survives_power_cut) {}

    RecordFile file;  ///< of its thread once that runs, but in prepare(), which holds `files`
    bool survives_power_cut;
    bool is_prepared = false;     ///< of its thread, likewise
    bool is_given_up = false;     ///< likewise
    std::uint64_t written = 0;    ///< sequence of the record that it holds
    std::uint64_t attempted = 0;  ///< likewise, that it was last given: above `written` it was not taken
    std::mutex files;
    std::thread thread{};
  };

  std::deque<Copy> copies;  // whose elements stay where they are
  RecordOwner owner;
  std::optional<SafetyRecord> found;
  std::vector<std::string> left_out;
  std::vector<std::uint8_t> kept;
  mutable std::mutex mutex;
  std::condition_variable more;     ///< for the writers
  std::condition_variable settled;  ///< for who waits for them
  SafetyRecord record;              ///< to be written
  std::uint64_t newest_change = 0;  ///< the sequence of the last that was no stamp
  bool makes_files = false;         ///< `kept` is known
  bool is_given = false;            ///< any record was
  bool is_damaged = false;          ///< a file was found that holds no whole record, or cannot be read
  bool is_overtaken = false;
  bool ending = false;

  Writers(const std::vector<SafetyCopy>& wanted, const RecordOwner& whose, Claim claim) : owner(whose) {
    std::vector<SafetyRecord> records;
    for (const SafetyCopy& copy : wanted) read(copies.emplace_back(copy), claim, records);
    found = newest_of(records);
    kept = kept_of_found();
    makes_files = !kept.empty();
    for (Copy& copy : copies) copy.written = copy.attempted = record.sequence;
    for (Copy& copy : copies) {
      try {
        copy.thread = std::thread([this, &copy] { run(copy); });
      } catch (const std::system_error&) {  // then give() does its work
      }
    }
  }

  ~Writers() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    more.notify_all();
    for (Copy& copy : copies)
      if (copy.thread.joinable()) copy.thread.join();
  }

  void read(Copy& copy, Claim claim, std::vector<SafetyRecord>& records) {
    const std::string path = copy.file.path().string();
    if (!copy.file.open()) {
      if (copy.file.out_of_reach() != 0) throw std::system_error(copy.file.out_of_reach(), std::generic_category(), path);
      note_unread(copy.file, path);
      return;
    }
    if (claim == Claim::kNeeded && !copy.file.claim()) refuse_if_used(copy.file);
    const std::optional<SafetyRecord> newest = copy.file.newest();
    is_damaged = is_damaged || !newest;
    if (!newest) return;
    record.sequence = std::max(record.sequence, newest->sequence);
    if (may_be_same(newest->owner, owner)) {
      records.push_back(*newest);
    } else {
      left_out.push_back(path + ": it is of another vehicle, or of another folder's flights");
    }
  }

  static void refuse_if_used(const RecordFile& file) {
    const MarkedBy holder = file.marked_by();
    if (holder != MarkedBy::kAnotherProgram) throw RecordInUse(file.holder(), holder == MarkedBy::kTheKilled);
  }

  void note_unread(const RecordFile& file, const std::string& path) {
    if (!file.is_unreadable()) return;
    left_out.push_back(path + (file.is_anybodys() ? ": others than root and this program's user may change it" : ": it cannot be read"));
    const bool is_of_another_vehicle = file.unbelieved() && !may_be_same(file.unbelieved()->owner, owner);
    is_damaged = is_damaged || !is_of_another_vehicle;
  }

  [[nodiscard]] std::vector<std::uint8_t> kept_of_found() {
    for (Copy& copy : copies) {
      const std::lock_guard lock(copy.files);
      std::vector<std::uint8_t> bytes = found ? copy.file.kept(found->kept_crc32) : std::vector<std::uint8_t>();
      if (!bytes.empty()) return bytes;
    }
    return {};
  }

  void run(Copy& copy) {
    (void)::pthread_setname_np(::pthread_self(), "safety");  // for who looks at the threads of a flight
    std::unique_lock lock(mutex);
    for (;;) {
      more.wait(lock, [&] { return ending || copy.written != record.sequence; });
      if (copy.written == record.sequence) return;
      if (take_newest(copy, lock)) continue;
      if (ending) return;
      const std::uint64_t refused = copy.attempted;
      (void)more.wait_for(lock, kRetry, [&] { return ending || record.sequence != refused; });
    }
  }

  /// @param lock  of the mutex; not held while the disk writes
  bool take_newest(Copy& copy, std::unique_lock<std::mutex>& lock) {
    const SafetyRecord wanted = record;
    lock.unlock();
    const bool is_taken = take(copy, wanted);
    lock.lock();
    copy.attempted = wanted.sequence;
    if (is_taken) copy.written = wanted.sequence;
    is_overtaken = is_overtaken || copy.file.is_overtaken();
    settled.notify_all();
    return is_taken;
  }

  void give(const SafetyRecord& wanted, std::unique_lock<std::mutex>& lock) {
    const std::uint64_t last = record.sequence;
    record = wanted;
    record.sequence = last + 1;
    record.owner = owner;
    is_given = true;
    more.notify_all();
    for (Copy& copy : copies)
      if (!copy.thread.joinable()) (void)take_newest(copy, lock);
  }

  [[nodiscard]] bool take(Copy& copy, const SafetyRecord& wanted) {
    const std::lock_guard lock(copy.files);
    if (copy.is_given_up) return false;
    if (copy.is_prepared && !copy.file.is_in_place()) {
      copy.file.let_go();
      copy.is_prepared = false;
    }
    if (makes_files && !copy.is_prepared) copy.is_prepared = copy.file.prepare(kept);
    return copy.file.write(wanted);
  }

  /// A copy in memory takes it at once; of the disks the first will do, or all have refused it.
  [[nodiscard]] bool is_settled() const {
    const bool is_kept = is_durable();
    return std::ranges::all_of(copies,
                               [&](const Copy& copy) { return copy.attempted >= newest_change || (is_kept && copy.survives_power_cut); });
  }
  [[nodiscard]] bool is_durable() const {
    return std::ranges::any_of(copies, [this](const Copy& copy) { return copy.survives_power_cut && copy.written >= newest_change; });
  }
};

SafetyCopies::SafetyCopies(const std::vector<SafetyCopy>& copies, const RecordOwner& owner, Claim claim)
    : writers_(std::make_unique<Writers>(copies, owner, claim)) {}

SafetyCopies::~SafetyCopies() = default;

const std::optional<SafetyRecord>& SafetyCopies::found() const {
  return writers_->found;
}

bool SafetyCopies::is_damaged() const {
  return writers_->is_damaged;
}

std::optional<SafetyRecord> SafetyCopies::newest() const {
  const std::lock_guard lock(writers_->mutex);
  return writers_->is_given ? std::optional(writers_->record) : writers_->found;
}

const std::vector<std::string>& SafetyCopies::left_out() const {
  return writers_->left_out;
}

std::vector<std::uint8_t> SafetyCopies::kept() const {
  return writers_->kept_of_found();
}

void SafetyCopies::prepare(std::span<const std::uint8_t> kept) {
  for (Writers::Copy& copy : writers_->copies) {
    const std::lock_guard lock(copy.files);
    copy.is_prepared = copy.file.prepare(kept);
  }
  // Of the threads, which look at it once a record is written.
  writers_->kept.assign(kept.begin(), kept.end());
  writers_->makes_files = true;
}

bool SafetyCopies::give_up_one() {
  Writers::Copy* last = nullptr;
  std::size_t open = 0;
  for (Writers::Copy& copy : writers_->copies) {
    const std::lock_guard lock(copy.files);
    if (!copy.file.is_open()) continue;
    last = &copy;
    ++open;
  }
  if (open < 2) return false;
  const std::lock_guard lock(last->files);
  last->file.let_go();
  last->is_given_up = true;
  return true;
}

bool SafetyCopies::write(const SafetyRecord& record, std::chrono::milliseconds patience) {
  Writers& writers = *writers_;
  std::unique_lock lock(writers.mutex);
  writers.newest_change = writers.record.sequence + 1;
  writers.give(record, lock);
  (void)writers.settled.wait_for(lock, patience, [&] { return writers.is_settled(); });
  return writers.is_durable();
}

void SafetyCopies::stamp(const SafetyRecord& record) {
  std::unique_lock lock(writers_->mutex);
  writers_->give(record, lock);
}

bool SafetyCopies::is_durable() const {
  const std::lock_guard lock(writers_->mutex);
  return writers_->is_durable();
}

bool SafetyCopies::is_overtaken() const {
  const std::lock_guard lock(writers_->mutex);
  return writers_->is_overtaken;
}

std::string SafetyCopies::complaints() const {
  const std::lock_guard lock(writers_->mutex);
  std::string text;
  for (const Writers::Copy& copy : writers_->copies) {
    if (copy.written != writers_->record.sequence) text += (text.empty() ? "" : ", ") + copy.file.path().string();
  }
  return text;
}

}  // namespace earshot::host
