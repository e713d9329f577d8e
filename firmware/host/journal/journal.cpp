#include "firmware/host/journal/journal.hpp"

#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "firmware/config/capacities.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::host {

namespace {

/// Between two writes: a fast simulation's records are written by the hundred, and waking the writer costs the appender nothing meanwhile.
constexpr std::chrono::milliseconds kPause{1};
constexpr std::chrono::milliseconds kRetry{100};  ///< after a write that failed

/// Of the reserve, kept from what steers: for orders that are still to come, and for the closing record.
constexpr std::uint64_t kReserveForOrders = kJournalReserveBytes / 2;
constexpr std::size_t kClosingBytes = kRecordHeaderSize + wire::kJournalEndChannel.size() + wire::kLcmSize<messages::ClosingRecord>;

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

JournalFile kept(JournalFile file, const JournalOptions& options) {
  file.keep_to(options.limits);
  if (options.survives == JournalOptions::Survives::kPowerCut) file.keep_entry();
  return file;
}

}  // namespace

/// A ring between the thread that appends and the thread that writes. Bytes are copied outside the lock; the lock guards the positions
/// only, and is never held over a system call on the file.
struct Journal::Writer {
  /// Between two records: all that were ever put into the ring before it.
  struct Place {
    std::uint64_t bytes = 0;
    std::uint64_t records = 0;
  };

  using Clock = std::chrono::steady_clock;
  static constexpr Clock::time_point kIdle = Clock::time_point::max();

  JournalFile file;
  JournalOptions options;
  RecordRing ring;
  std::mutex mutex;
  // Two for the writer, so that nobody who appends wakes it from its pause: at some 3 records a tick that cost half of a flight.
  std::condition_variable more;   ///< for an idle writer: there is something to write, or it is to end
  std::condition_variable ended;  ///< for a writer that pauses: it is to end
  std::condition_variable less;   ///< for the appender: the ring has room again
  Place appended;
  Place whole;                ///< before it every record is in the file or lost
  std::uint64_t taken = 0;    ///< bytes: those before `whole`, and what is in the file of the record behind it, which is kept in the ring
  std::uint64_t in_file = 0;  ///< bytes: `taken`, and what is in the file and on its way to the disk
  bool idle = false;          ///< the writer waits for `more`
  bool ending = false;
  std::atomic<bool> failing = false;            ///< the last write took nothing; changed under the lock
  bool is_whole = true;                         ///< of who closes: everything is in the file
  std::atomic<bool> unsynced = false;           ///< the kernel failed to bring something to the disk, and does not try again
  std::atomic<Clock::time_point> seen = kIdle;  ///< what waits was appended after it
  std::atomic<Clock::duration> longest_wait{};
  std::uint32_t next_number = 0;
  PerPriority lost{};
  std::uint64_t accepted = 0;                      ///< of the appender
  std::uint64_t refused = 0;                       ///< likewise
  std::optional<messages::ClosingRecord> closing;  ///< likewise
  std::atomic<std::uint64_t> write_errors = 0;
  std::atomic<bool> is_part_asked_for = false;
  std::atomic<std::uint64_t> deleted = 0;  ///< older journals
  std::atomic<int> last_deleted = 0;
  std::thread thread;

  Writer(JournalFile opened, std::uint32_t number, JournalOptions chosen)
      : file(kept(std::move(opened), chosen)), options(chosen), next_number(number), thread([this] { run(); }) {}

  /// Waits, if it may, until `size` bytes fit; not for a disk that takes nothing.
  bool make_room(std::size_t size, Priority priority) {
    std::unique_lock lock(mutex);
    const auto fits = [&] { return appended.bytes + size - whole.bytes <= RecordRing::limit(priority); };
    if (options.when_full == JournalOptions::WhenFull::kWait) less.wait(lock, [&] { return fits() || failing; });
    if (fits()) return true;
    ++of(lost, priority);
    return false;
  }

  void publish(Place place) {
    bool wake = false;
    {
      const std::lock_guard lock(mutex);
      appended = place;
      wake = std::exchange(idle, false);
    }
    if (wake) more.notify_one();
  }

  void run() {
    (void)::pthread_setname_np(::pthread_self(), "journal");  // for who looks at the threads of a flight
    std::unique_lock lock(mutex);
    seen = Clock::now();
    for (;;) {
      while (appended.bytes == taken && !ending) {
        idle = true;
        seen = kIdle;
        more.wait(lock);
        seen = Clock::now();
      }
      idle = false;
      if (appended.bytes == taken || (ending && failing)) return;
      const Place end = appended;
      lock.unlock();
      const Clock::time_point polled = Clock::now();
      if (taken == whole.bytes && (file.is_part_full() || is_part_asked_for)) begin_part();
      const std::size_t done = write_some(ring.piece(taken, end.bytes));
      const std::optional<PerPriority> given_up = done == 0 ? write_orders_into_reserve(end) : std::nullopt;
      // A failing disk lets records wait for longer; its trouble is told in its own words.
      if (done > 0 && !failing) longest_wait = std::max(longest_wait.load(), Clock::now() - seen.load());
      if (taken + done == end.bytes) seen = polled;
      lock.lock();
      failing = done == 0;
      if (failing) ++write_errors;
      if (given_up) {
        whole = end;
        taken = end.bytes;
        note_lost(*given_up);
      } else {
        taken += done;
        note_whole();
      }
      in_file = taken;
      less.notify_all();
      // Bytes that were not taken are tried again, so that the file never has a hole.
      ended.wait_for(lock, failing ? kRetry : kPause, [this] { return ending; });
    }
  }

  void note_whole() {
    while (whole.bytes < taken && whole.bytes + ring.record(whole.records).size() <= taken)
      whole.bytes += ring.record(whole.records++).size();
  }

  /// @return how many bytes are in the file now; 0 on failure, or when they would take of the reserve
  std::size_t write_some(std::span<const std::uint8_t> bytes) {
    const std::size_t count = file.write_some(bytes, kJournalReserveBytes);
    deleted = file.deleted();
    last_deleted = file.last_deleted();
    if (options.survives == JournalOptions::Survives::kPowerCut) note_in_file(count);
    if (count > 0) bring_to_disk();
    return count;
  }

  /// Before the disk has it.
  void note_in_file(std::size_t bytes) {
    const std::lock_guard lock(mutex);
    in_file = taken + bytes;
    less.notify_all();
  }

  void begin_part() {
    is_part_asked_for = false;
    if (file.begin_part(options.survives == JournalOptions::Survives::kPowerCut) != PartBegun::kMayNotSurvive) return;
    ++write_errors;
    unsynced = true;
  }

  void bring_to_disk() {
    if (options.survives != JournalOptions::Survives::kPowerCut || file.bring_to_disk()) return;
    ++write_errors;
    unsynced = true;
  }

  // When the disk is full.

  /// Once an order waits that fits into the reserve: brings it and what steered before it into the file.
  /// @return how many of the records that waited it gave up instead; nothing: all of them still wait
  std::optional<PerPriority> write_orders_into_reserve(const Place& end) {
    const PerPriority waiting = sizes_until(end);
    const std::uint64_t begin = end_of_whole_records();
    const std::uint64_t room = file.room(begin, kClosingBytes);
    if (of(waiting, Priority::kOrder) == 0 || of(waiting, Priority::kOrder) > room || !file.go_back(begin)) return std::nullopt;
    const PerPriority given_up = write_by_priority(end, shares_of({0, file.room(begin, kReserveForOrders), room}, waiting));
    bring_to_disk();
    return given_up;
  }

  /// In the file.
  [[nodiscard]] std::uint64_t end_of_whole_records() const { return file.size() - (taken - whole.bytes); }

  void note_lost(const PerPriority& records) {
    for (std::size_t i = 0; i < kPriorities; ++i) lost[i] += records[i];
  }

  /// Bytes of the records that wait.
  PerPriority sizes_until(const Place& end) {
    PerPriority sizes{};
    for (std::uint64_t index = whole.records; index < end.records; ++index) {
      const RecordRing::Record record = ring.record(index);
      of(sizes, record.priority()) += record.size();
    }
    return sizes;
  }

  /// Gives the room to the priorities, the highest first.
  /// @param room  how many bytes a priority and those above it may take together
  static PerPriority shares_of(const PerPriority& room, const PerPriority& waiting) {
    PerPriority shares{};
    std::uint64_t given = 0;
    for (std::size_t i = kPriorities; i-- > 0; given += shares[i]) shares[i] = std::min(waiting[i], room[i] > given ? room[i] - given : 0);
    return shares;
  }

  /// Writes every record for which its priority's share has room, the older before the newer, whole ones only.
  /// @return how many it left out
  PerPriority write_by_priority(const Place& end, PerPriority shares) {
    PerPriority left_out{};
    std::uint64_t at = whole.bytes;
    for (std::uint64_t index = whole.records; index < end.records; ++index) {
      const RecordRing::Record record = ring.record(index);
      std::uint64_t& share = of(shares, record.priority());
      if (record.size() <= share && write_whole(at, at + record.size())) {
        share -= record.size();
      } else {
        share = 0;
        ++of(left_out, record.priority());
      }
      at += record.size();
    }
    return left_out;
  }

  /// Writes one record; when the disk does not take all of it, none of it stays in the file.
  bool write_whole(std::uint64_t begin, std::uint64_t end) {
    const std::uint64_t before = file.size();
    if (write_all(begin, end)) return true;
    (void)file.go_back(before);
    return false;
  }

  /// Writes these bytes of the ring, into the reserve too. False: the disk did not take all of them.
  bool write_all(std::uint64_t begin, std::uint64_t end) {
    while (begin < end) {
      const std::size_t done = file.write_some(ring.piece(begin, end), 0);
      if (done == 0) return false;
      begin += done;
    }
    return true;
  }

  // After the writer has ended.

  /// Writes what is left of the records, the heaviest when not all fit, and the closing record.
  /// @return whether all of them are in the file
  bool finish() {
    const std::uint64_t begin = end_of_whole_records();
    const bool fits = write_all(taken, appended.bytes) && write_closing_record();
    const bool is_written = fits || finish_by_priority(begin);
    if (taken < appended.bytes || closing) bring_to_disk();
    return file.close() && is_written;
  }

  bool finish_by_priority(std::uint64_t begin) {
    // What cannot be given up ends in the middle of a record: nothing may follow it.
    const bool goes_on = file.go_back(begin);
    const std::uint64_t room = goes_on ? file.room(begin, closing ? kClosingBytes : 0) : 0;
    const PerPriority given_up = write_by_priority(appended, shares_of({room, room, room}, sizes_until(appended)));
    note_lost(given_up);
    return goes_on && write_closing_record() && given_up == PerPriority{};
  }

  /// True: it is in the file, or there is none.
  bool write_closing_record() {
    if (!closing) return true;
    closing->lost = lost_records(lost);
    const wire::Encoded data(*closing);
    const LoneRecord record(next_number, closing->time, wire::kJournalEndChannel, data.bytes());
    return file.write_some(record.bytes(), 0) == record.bytes().size();
  }
};

Journal::Journal(const std::filesystem::path& path, JournalOptions options) : Journal(JournalFile(path, options.existing), 0, options) {}

Journal::Journal(JournalFile file, std::uint32_t next_number, JournalOptions options)
    : writer_(new Writer(std::move(file), next_number, options)) {}

Journal::~Journal() {
  static_cast<void>(close());
}

Status Journal::append(Time time, std::string_view channel, std::span<const std::uint8_t> data, Priority priority) {
  if (channel.empty() || channel.size() > wire::kMaxChannelLength || data.size() > config::kLcmMessageBytes ||
      !writer_->thread.joinable()) {
    ++writer_->refused;
    return Status::kOutOfRange;
  }
  const std::uint32_t number = writer_->next_number++;
  const std::size_t size = kRecordHeaderSize + channel.size() + data.size();
  if (!writer_->make_room(size, priority)) return Status::kFull;
  const auto header = record_header(number, time, channel, data);
  Writer::Place place = writer_->appended;
  writer_->ring.copy_in(place.bytes, header);
  writer_->ring.copy_in(place.bytes, bytes_of(channel));
  writer_->ring.copy_in(place.bytes, data);
  writer_->ring.record(place.records++) = {size, priority};
  writer_->publish(place);
  ++writer_->accepted;
  return Status::kOk;
}

void Journal::begin_part() {
  writer_->is_part_asked_for = true;
}

void Journal::conclude(const messages::ClosingRecord& closing) {
  writer_->closing = closing;
}

Status Journal::flush() {
  std::unique_lock lock(writer_->mutex);
  const auto is_done = [this] { return writer_->appended.bytes == writer_->taken; };
  writer_->less.wait(lock, [&] { return is_done() || writer_->failing; });
  return is_done() ? Status::kOk : Status::kNotReady;
}

Status Journal::flush(std::chrono::milliseconds most, Reach reach) {
  std::unique_lock lock(writer_->mutex);
  const auto is_done = [this, reach] { return writer_->appended.bytes == (reach == Reach::kFile ? writer_->in_file : writer_->taken); };
  (void)writer_->less.wait_for(lock, most, [&] { return is_done() || writer_->failing; });
  return is_done() ? Status::kOk : Status::kNotReady;
}

Status Journal::close() {
  Writer& writer = *writer_;
  if (writer.thread.joinable()) {
    {
      const std::lock_guard lock(writer.mutex);
      writer.ending = true;
    }
    writer.more.notify_one();
    writer.ended.notify_one();
    writer.thread.join();
    writer.is_whole = writer.finish();
  }
  return writer.is_whole && !writer.unsynced ? Status::kOk : Status::kNotReady;
}

JournalCounters Journal::counters() const {
  const std::lock_guard lock(writer_->mutex);
  return {.appended = writer_->accepted,
          .lost = writer_->lost,
          .refused = writer_->refused,
          .write_errors = writer_->write_errors,
          .deleted = writer_->deleted,
          .last_deleted = writer_->last_deleted};
}

JournalTrouble Journal::trouble() const {
  if (writer_->failing) return JournalTrouble::kTakesNothing;
  if (writer_->unsynced) return JournalTrouble::kMayNotSurvive;
  if (writer_->options.when_full == JournalOptions::WhenFull::kWait) return JournalTrouble::kNone;
  const Writer::Clock::time_point seen = writer_->seen;
  return seen != Writer::kIdle && Writer::Clock::now() - seen > kJournalBudget ? JournalTrouble::kLags : JournalTrouble::kNone;
}

double Journal::longest_wait_s() const {
  return std::chrono::duration<double>(writer_->longest_wait.load()).count();
}

const std::filesystem::path& Journal::path() const {
  return writer_->file.path();
}

}  // namespace earshot::host
