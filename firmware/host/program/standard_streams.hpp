#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <span>
#include <streambuf>
#include <string_view>
#include <utility>

namespace earshot::program {

/// Opens /dev/null for reading on every one of the descriptors 0, 1 and 2 that is closed, so that no socket and no file of the program's
/// own gets such a number, and what is printed into it. Reading finds the end there, and writing fails as on a closed one.
void open_standard_streams();

/// While it lives, nobody waits for who reads what a stream says: lines go out whole, when they fit into the pipe or the terminal; those of
/// a reader who has let it wait for a second in all are left out, and the next line that goes out is preceded by their number. A reader who
/// is gone makes writing fail.
class NonBlockingStream : private std::streambuf {
 public:
  /// Says a line otherwise. @param line  without its end   @param into  what it may be written into, kLineBytes
  using LineFormat = std::function<std::string_view(std::string_view line, std::span<char> into)>;

  static constexpr std::chrono::milliseconds kPatience{1000};
  static constexpr std::size_t kLineBytes = 4096;  ///< PIPE_BUF: what a pipe takes at once; longer: in pieces

  NonBlockingStream(std::ostream& stream, int descriptor);
  NonBlockingStream(const NonBlockingStream&) = delete;
  NonBlockingStream& operator=(const NonBlockingStream&) = delete;
  ~NonBlockingStream() override;

  /// From the next line on.
  void set_format(LineFormat format) { format_ = std::move(format); }

 private:
  int_type overflow(int_type character) override;
  int sync() override;
  [[nodiscard]] bool is_writable();
  [[nodiscard]] bool write(std::string_view text) const;
  [[nodiscard]] bool write_line(std::string_view line) const;

  LineFormat format_;  ///< empty: as they are
  std::ostream& stream_;
  std::streambuf* before_;
  std::ios_base::fmtflags flags_before_;
  int descriptor_;
  std::chrono::milliseconds patience_ = kPatience;
  std::uint64_t left_out_ = 0;
  std::size_t size_ = 0;
  std::array<char, kLineBytes> line_{};
};

/// Standard output and error of a program that outlives who reads them. A reader who is gone makes writing fail and does not end it
/// (SIGPIPE).
class NonBlockingStdio {
 public:
  NonBlockingStdio();

  /// Every line of standard error from now on.
  void set_error_format(NonBlockingStream::LineFormat format) { error_.set_format(std::move(format)); }

 private:
  NonBlockingStream output_;
  NonBlockingStream error_;
};

}  // namespace earshot::program
