#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"
#include "hil/bus/candump/log_line.hpp"

namespace earshot::hil {

/// What may stand where a recording is to begin.
enum class OlderRecording : std::uint8_t { kIsKept, kIsReplaced };

/// A log of candump (-l) that is being written. Only whole lines go out, and all that was added has gone to the kernel when flush() comes
/// back: a program that is killed leaves whole lines, and perhaps the beginning of one more, since the kernel may end a write between two
/// pages; a power cut may take what the kernel has not brought to the disk yet.
class Recording {
 public:
  /// Throws BadInput naming the file when it is none that may be written: it is not regular, has content and kIsKept, or is being written
  /// by another.
  Recording(std::filesystem::path path, OlderRecording older);
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// @param entry  with a frame
  void add(const LogEntry& entry);
  /// Throws BadInput naming the file, such as on a full disk: there are whole lines in it then, and no more can be added.
  void flush();
  /// flush(), and the disk has it all. Throws likewise.
  void finish();

  [[nodiscard]] std::uint64_t frames() const { return frames_; }  ///< that went out

 private:
  [[noreturn]] void fail(int error);
  /// Of so many bytes that waited and are in the file now.
  void keep_whole_lines(std::size_t written);

  std::filesystem::path path_;
  host::FileDescriptor file_;
  std::string waiting_;  ///< whole lines
  std::uint64_t frames_ = 0;
  std::uint64_t size_ = 0;  ///< of the whole lines in the file
};

}  // namespace earshot::hil
