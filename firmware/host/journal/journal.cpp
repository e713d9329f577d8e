#include "firmware/host/journal/journal.hpp"

#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <ranges>
#include <thread>
#include <utility>

#include "firmware/config/capacities.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::host {

namespace {

/// Between two writes: a fast simulation's records are written by the hundred, and waking the writer costs the appender nothing meanwhile.
constexpr std::chrono::milliseconds kPause{1};
constexpr std::chrono::milliseconds kRetry{100};  ///< after a write that failed

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::array<std::uint8_t, kRecordHeaderSize> header_of(std::uint32_t number, Time time, std::string_view channel,
                                                      std::span<const std::uint8_t> data) {
  std::array<std::uint8_t, kRecordHeaderSize> header{};
  HeaderWriter rest{header, kCheckedFrom};
  rest.field(4, number);
  rest.field(8, static_cast<std::uint64_t>(time.us));
  rest.field(4, channel.size());
  rest.field(4, data.size());
  const std::uint32_t checksum = crc32(data, crc32(bytes_of(channel), crc32(std::span(header).subspan(kCheckedFrom))));
  HeaderWriter start{header};
  start.field(4, kRecordSync);
  start.field(4, checksum);
  return header;
}

JournalFile create(const std::filesystem::path& wanted, const JournalOptions& options) {
  JournalFile file(wanted, options.existing);
  if (options.survives == JournalOptions::Survives::kPowerCut) file.keep_entry();
  return file;
}

}  // namespace

/// A ring between the thread that appends and the thread that writes. Bytes are copied outside the lock; the lock guards the positions
/// only, and is never held over a system call on the file.
struct Journal::Writer {
  JournalFile file;
  JournalOptions options;
  RecordRing ring;
  std::mutex mutex;
  // Two for the writer, so that nobody who appends wakes it from its pause: at some 3 records a tick that cost half of a flight.
  std::condition_variable more;        ///< for an idle writer: there is something to write, or it is to end
  std::condition_variable ended;       ///< for a writer that pauses: it is to end
  std::condition_variable less;        ///< for the appender: something was written
  std::uint64_t appended = 0;          ///< bytes ever put into the ring
  std::uint64_t appended_records = 0;  ///< likewise records; of the appender until the writer has ended
  std::uint64_t written = 0;           ///< bytes ever written: the size of the file
  std::uint64_t whole = 0;             ///< of these, those of whole records; what follows is kept in the ring
  std::uint64_t whole_records = 0;     ///< likewise records; of the writer until it has ended
  bool idle = false;                   ///< the writer waits for `more`
  bool ending = false;
  bool failing = false;   ///< the last write took nothing
  bool is_whole = true;   ///< of who closes: everything in the ring was written
  bool unsynced = false;  ///< the kernel failed to bring something to the disk, and does not try again; of the writer until it has ended
  std::uint32_t next_number = 0;
  JournalCounters counters;  ///< of the appender
  std::atomic<std::uint64_t> write_errors = 0;
  std::thread thread;

  Writer(const std::filesystem::path& path, JournalOptions chosen)
      : file(create(path, chosen)), options(chosen), thread([this] { run(); }) {}

  /// Waits, if it may, until `size` bytes fit; not for a disk that takes nothing.
  bool make_room(std::size_t size, Weight weight) {
    std::unique_lock lock(mutex);
    const auto fits = [&] { return appended + size - whole <= RecordRing::limit(weight); };
    if (options.when_full == JournalOptions::WhenFull::kWait) less.wait(lock, [&] { return fits() || failing; });
    return fits();
  }

  void publish(std::uint64_t position) {
    bool wake = false;
    {
      const std::lock_guard lock(mutex);
      appended = position;
      wake = std::exchange(idle, false);
    }
    if (wake) more.notify_one();
  }

  void run() {
    (void)::pthread_setname_np(::pthread_self(), "journal");  // for who looks at the threads of a flight
    std::unique_lock lock(mutex);
    for (;;) {
      while (appended == written && !ending) {
        idle = true;
        more.wait(lock);
      }
      idle = false;
      if (appended == written || (ending && failing)) return;
      const std::span<const std::uint8_t> bytes = ring.piece(written, appended);
      lock.unlock();
      const std::size_t done = write_some(bytes);
      lock.lock();
      written += done;
      note_whole();
      failing = done == 0;
      if (failing) ++write_errors;
      less.notify_all();
      // Bytes that were not taken are tried again, so that the file never has a hole.
      ended.wait_for(lock, failing ? kRetry : kPause, [this] { return ending; });
    }
  }

  void note_whole() {
    while (whole < written && whole + ring.record(whole_records).size() <= written) whole += ring.record(whole_records++).size();
  }

  /// @return how many bytes are in the file now; 0 on failure
  std::size_t write_some(std::span<const std::uint8_t> bytes) {
    const std::size_t count = file.write_some(bytes);
    if (count > 0) bring_to_disk();
    return count;
  }

  void bring_to_disk() {
    if (options.survives != JournalOptions::Survives::kPowerCut || file.bring_to_disk()) return;
    ++write_errors;
    unsynced = true;
  }

  // After the writer has ended: what the disk did not take.

  /// Writes of the records that are left the heaviest for which there is room, and counts the others as lost.
  /// @return whether it wrote them all
  bool write_what_fits() {
    // What cannot be cut ends in the middle of a record: nothing may follow it.
    const std::uint64_t room = written == whole || file.cut(whole) ? write_all(whole, appended) : 0;
    const bool is_all = whole + room == appended;
    if (!is_all) write_by_weight(room > 0 && !file.cut(whole) ? 0 : room);
    bring_to_disk();
    return is_all;
  }

  /// Writes the ring's bytes from `begin` to `end`. @return how many of them the disk took
  std::uint64_t write_all(std::uint64_t begin, std::uint64_t end) {
    std::uint64_t at = begin;
    while (at < end) {
      const std::size_t done = file.write_some(ring.piece(at, end));
      if (done == 0) break;
      at += done;
    }
    return at - begin;
  }

  void write_by_weight(std::uint64_t room) {
    PerWeight left = shares(room);
    std::uint64_t at = whole;
    for (std::uint64_t index = whole_records; index < appended_records; ++index) {
      const RecordRing::Record record = ring.record(index);
      std::uint64_t& share = of(left, record.weight());
      if (record.size() <= share && write_whole(at, at + record.size())) {
        share -= record.size();
      } else {
        share = 0;  // the older before the newer
        ++of(counters.lost, record.weight());
      }
      at += record.size();
    }
  }

  /// Gives the room to the weights, the heaviest first.
  PerWeight shares(std::uint64_t room) {
    PerWeight shares{};
    for (std::uint64_t index = whole_records; index < appended_records; ++index) {
      const RecordRing::Record record = ring.record(index);
      of(shares, record.weight()) += record.size();
    }
    for (std::uint64_t& share : std::views::reverse(shares)) {
      share = std::min(share, room);
      room -= share;
    }
    return shares;
  }

  /// Writes one record; when the disk does not take all of it, none of it stays in the file.
  bool write_whole(std::uint64_t begin, std::uint64_t end) {
    const std::uint64_t done = write_all(begin, end);
    if (done == end - begin) {
      whole += done;
      return true;
    }
    if (done > 0) (void)file.cut(whole);
    return false;
  }
};

Journal::Journal(const std::filesystem::path& path, JournalOptions options) : writer_(new Writer(path, options)) {}

Journal::~Journal() {
  static_cast<void>(close());
}

Status Journal::append(Time time, std::string_view channel, std::span<const std::uint8_t> data, Weight weight) {
  if (channel.empty() || channel.size() > wire::kMaxChannelLength || data.size() > config::kLcmMessageBytes ||
      !writer_->thread.joinable()) {
    ++writer_->counters.refused;
    return Status::kOutOfRange;
  }
  const std::uint32_t number = writer_->next_number++;
  const std::size_t size = kRecordHeaderSize + channel.size() + data.size();
  if (!writer_->make_room(size, weight)) {
    ++of(writer_->counters.lost, weight);
    return Status::kFull;
  }
  const auto header = header_of(number, time, channel, data);
  std::uint64_t position = writer_->appended;
  writer_->ring.copy_in(position, header);
  writer_->ring.copy_in(position, bytes_of(channel));
  writer_->ring.copy_in(position, data);
  writer_->ring.record(writer_->appended_records++) = {size, weight};
  writer_->publish(position);
  ++writer_->counters.appended;
  return Status::kOk;
}

Status Journal::flush() {
  std::unique_lock lock(writer_->mutex);
  writer_->less.wait(lock, [this] { return writer_->appended == writer_->written || writer_->failing; });
  return writer_->appended == writer_->written ? Status::kOk : Status::kNotReady;
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
    writer.is_whole = writer.appended == writer.written || writer.write_what_fits();
    writer.file.close();
  }
  return writer.is_whole && !writer.unsynced ? Status::kOk : Status::kNotReady;
}

JournalCounters Journal::counters() const {
  JournalCounters counters = writer_->counters;
  counters.write_errors = writer_->write_errors;
  return counters;
}

const std::filesystem::path& Journal::path() const {
  return writer_->file.path();
}

}  // namespace earshot::host
