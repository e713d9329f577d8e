#include "firmware/host/safety_record/safety_copies.hpp"

#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

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
    std::uint64_t written = 0;    ///< sequence of the record that it holds
    std::uint64_t attempted = 0;  ///< likewise, that it was last given: above `written` it was not taken
    std::mutex files;
    std::thread thread{};
  };

  std::deque<Copy> copies;  // whose elements stay where they are
  std::optional<SafetyRecord> found;
  std::vector<std::uint8_t> kept;
  mutable std::mutex mutex;
  std::condition_variable more;     ///< for the writers
  std::condition_variable settled;  ///< for who waits for them
  SafetyRecord record;              ///< to be written
  std::uint64_t newest_news = 0;    ///< the sequence of the last that was no stamp
  bool ending = false;

  explicit Writers(const std::vector<SafetyCopy>& wanted) {
    for (const SafetyCopy& copy : wanted) {
      Copy& made = copies.emplace_back(copy);
      if (!made.file.open()) continue;
      if (!made.file.claim()) throw RecordInUse(made.file.holder());
      if (const std::optional<SafetyRecord> newest = made.file.newest(); newest && (!found || newest->sequence > found->sequence))
        found = newest;
    }
    if (found) record.sequence = found->sequence;
    for (Copy& copy : copies) copy.written = copy.attempted = record.sequence;
    for (Copy& copy : copies) copy.thread = std::thread([this, &copy] { run(copy); });
  }

  ~Writers() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    more.notify_all();
    for (Copy& copy : copies) copy.thread.join();
  }

  void run(Copy& copy) {
    (void)::pthread_setname_np(::pthread_self(), "safety");  // for who looks at the threads of a flight
    std::unique_lock lock(mutex);
    for (;;) {
      more.wait(lock, [&] { return ending || copy.written != record.sequence; });
      if (copy.written == record.sequence) return;
      const SafetyRecord wanted = record;
      lock.unlock();
      const bool is_taken = take(copy, wanted);
      lock.lock();
      copy.attempted = wanted.sequence;
      if (is_taken) copy.written = wanted.sequence;
      settled.notify_all();
      if (is_taken) continue;
      if (ending) return;
      (void)more.wait_for(lock, kRetry, [&] { return ending || record.sequence != wanted.sequence; });
    }
  }

  /// Under the lock.
  void give(const SafetyRecord& wanted) {
    const std::uint64_t last = record.sequence;
    record = wanted;
    record.sequence = last + 1;
    more.notify_all();
  }

  [[nodiscard]] bool take(Copy& copy, const SafetyRecord& wanted) {
    const std::lock_guard lock(copy.files);
    if (!kept.empty() && !copy.is_prepared) copy.is_prepared = copy.file.prepare(kept);
    return copy.file.write(wanted);
  }

  /// A copy in memory takes it at once; of the disks the first will do, or all have refused it.
  [[nodiscard]] bool is_settled() const {
    const bool is_kept = is_durable();
    return std::ranges::all_of(copies,
                               [&](const Copy& copy) { return copy.attempted >= newest_news || (is_kept && copy.survives_power_cut); });
  }
  [[nodiscard]] bool is_durable() const {
    return std::ranges::any_of(copies, [this](const Copy& copy) { return copy.survives_power_cut && copy.written >= newest_news; });
  }
};

SafetyCopies::SafetyCopies(const std::vector<SafetyCopy>& copies) : writers_(std::make_unique<Writers>(copies)) {}

SafetyCopies::~SafetyCopies() = default;

const std::optional<SafetyRecord>& SafetyCopies::found() const {
  return writers_->found;
}

std::vector<std::uint8_t> SafetyCopies::kept() const {
  for (Writers::Copy& copy : writers_->copies) {
    const std::lock_guard lock(copy.files);
    std::vector<std::uint8_t> bytes = writers_->found ? copy.file.kept(writers_->found->kept_crc32) : std::vector<std::uint8_t>();
    if (!bytes.empty()) return bytes;
  }
  return {};
}

void SafetyCopies::prepare(std::span<const std::uint8_t> kept) {
  for (Writers::Copy& copy : writers_->copies) {
    const std::lock_guard lock(copy.files);
    copy.is_prepared = copy.file.prepare(kept);
  }
  // Of the threads, which look at it once a record is written.
  writers_->kept.assign(kept.begin(), kept.end());
}

bool SafetyCopies::write(const SafetyRecord& record, std::chrono::milliseconds patience) {
  Writers& writers = *writers_;
  std::unique_lock lock(writers.mutex);
  writers.give(record);
  writers.newest_news = writers.record.sequence;
  (void)writers.settled.wait_for(lock, patience, [&] { return writers.is_settled(); });
  return writers.is_durable();
}

void SafetyCopies::stamp(const SafetyRecord& record) {
  const std::lock_guard lock(writers_->mutex);
  writers_->give(record);
}

bool SafetyCopies::is_durable() const {
  const std::lock_guard lock(writers_->mutex);
  return writers_->is_durable();
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
