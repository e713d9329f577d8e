#include "firmware/host/journal/journal.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "firmware/config/capacities.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::host {

namespace {

/// Between two writes: a fast simulation's records are written by the hundred, and waking the writer costs the appender nothing meanwhile.
constexpr std::chrono::milliseconds kPause{1};
constexpr std::chrono::milliseconds kRetry{100};  ///< after a write that failed
constexpr int kMostJournals = 9999;               ///< in one folder

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

/// "journal-2.lcmlog" for "journal.lcmlog"
std::filesystem::path numbered(const std::filesystem::path& path, int number) {
  std::filesystem::path name = path.stem();
  name += "-" + std::to_string(number);
  name += path.extension();
  return path.parent_path() / name;
}

struct Created {
  std::filesystem::path path;
  FileDescriptor file;
};

Created create(const std::filesystem::path& wanted, JournalOptions::Existing existing) {
  using Existing = JournalOptions::Existing;
  const int mode = existing == Existing::kReplace ? O_TRUNC : O_EXCL;
  std::filesystem::path path = wanted;
  for (int number = 2;; ++number) {
    FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | mode, 0644));
    if (file.number() >= 0) return {std::move(path), std::move(file)};
    if (errno != EEXIST || existing != Existing::kKeep || number > kMostJournals) fail(path);
    path = numbered(wanted, number);
  }
}

/// Brings the folder's entry of a new file to the disk.
void keep_entry(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const FileDescriptor entries(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (entries.number() < 0 || ::fsync(entries.number()) != 0) fail(folder);
}

Created create(const std::filesystem::path& wanted, const JournalOptions& options) {
  Created created = create(wanted, options.existing);
  if (options.survives == JournalOptions::Survives::kPowerCut) keep_entry(created.path);
  return created;
}

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

}  // namespace

/// A byte ring between the thread that appends and the thread that writes. Bytes are copied outside the lock; the lock guards the two
/// positions only, and is never held over a system call on the file.
struct Journal::Writer {
  std::filesystem::path path;
  FileDescriptor file;
  JournalOptions options;
  std::array<std::uint8_t, config::kJournalBufferBytes> ring;
  std::mutex mutex;
  // Two for the writer, so that nobody who appends wakes it from its pause: at some 3 records a tick that cost half of a flight.
  std::condition_variable more;   ///< for an idle writer: there is something to write, or it is to end
  std::condition_variable ended;  ///< for a writer that pauses: it is to end
  std::condition_variable less;   ///< for the appender: something was written
  std::uint64_t appended = 0;     ///< bytes ever put into the ring
  std::uint64_t written = 0;      ///< bytes ever taken out of it
  bool idle = false;              ///< the writer waits for `more`
  bool ending = false;
  bool failing = false;   ///< the last write took nothing
  bool unsynced = false;  ///< the kernel failed to bring something to the disk, and does not try again; of the writer until it has ended
  std::uint32_t next_number = 0;
  JournalCounters counters;  ///< of the appender
  std::atomic<std::uint64_t> write_errors = 0;
  std::thread thread;

  Writer(Created created, JournalOptions chosen)
      : path(std::move(created.path)), file(std::move(created.file)), options(chosen), thread([this] { run(); }) {}

  void copy_in(std::uint64_t& position, std::span<const std::uint8_t> bytes) {
    const std::size_t at = position % ring.size();
    const std::size_t before_end = std::min(bytes.size(), ring.size() - at);
    std::ranges::copy(bytes.first(before_end), ring.begin() + static_cast<std::ptrdiff_t>(at));
    std::ranges::copy(bytes.subspan(before_end), ring.begin());
    position += bytes.size();
  }

  /// Waits, if it may, until `size` bytes fit; not for a disk that takes nothing.
  bool make_room(std::size_t size) {
    std::unique_lock lock(mutex);
    const auto fits = [&] { return appended + size - written <= ring.size(); };
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
      const std::size_t at = written % ring.size();
      const std::size_t size = std::min<std::size_t>(appended - written, ring.size() - at);
      lock.unlock();
      const std::size_t done = write_some(std::span(ring).subspan(at, size));
      lock.lock();
      written += done;
      failing = done == 0;
      if (failing) ++write_errors;
      less.notify_all();
      // Bytes that were not taken are tried again, so that the file never has a hole.
      ended.wait_for(lock, failing ? kRetry : kPause, [this] { return ending; });
    }
  }

  /// @return how many bytes are in the file now; 0 on failure
  std::size_t write_some(std::span<const std::uint8_t> bytes) {
    const ssize_t count = ::write(file.number(), bytes.data(), bytes.size());
    if (count <= 0) return 0;
    if (options.survives == JournalOptions::Survives::kPowerCut && ::fdatasync(file.number()) != 0) {
      ++write_errors;
      unsynced = true;
    }
    return static_cast<std::size_t>(count);
  }
};

Journal::Journal(const std::filesystem::path& path, JournalOptions options) : writer_(new Writer(create(path, options), options)) {}

Journal::~Journal() {
  static_cast<void>(close());
}

Status Journal::append(Time time, std::string_view channel, std::span<const std::uint8_t> data) {
  if (channel.empty() || channel.size() > wire::kMaxChannelLength || data.size() > config::kLcmMessageBytes ||
      !writer_->thread.joinable()) {
    ++writer_->counters.refused;
    return Status::kOutOfRange;
  }
  const std::uint32_t number = writer_->next_number++;
  if (!writer_->make_room(kRecordHeaderSize + channel.size() + data.size())) {
    ++writer_->counters.dropped;
    return Status::kFull;
  }
  const auto header = header_of(number, time, channel, data);
  std::uint64_t position = writer_->appended;
  writer_->copy_in(position, header);
  writer_->copy_in(position, bytes_of(channel));
  writer_->copy_in(position, data);
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
  if (writer_->thread.joinable()) {
    {
      const std::lock_guard lock(writer_->mutex);
      writer_->ending = true;
    }
    writer_->more.notify_one();
    writer_->ended.notify_one();
    writer_->thread.join();
    writer_->file = FileDescriptor();
  }
  return writer_->appended == writer_->written && !writer_->unsynced ? Status::kOk : Status::kNotReady;
}

JournalCounters Journal::counters() const {
  JournalCounters counters = writer_->counters;
  counters.write_errors = writer_->write_errors;
  return counters;
}

const std::filesystem::path& Journal::path() const {
  return writer_->path;
}

}  // namespace earshot::host
