#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <string_view>
#include <thread>

#include "firmware/host/transport/wake_event.hpp"

namespace earshot::board {

/// Lines for a person, written by a thread of its own: who says one never waits for a slow disk, a pipe that nobody empties or a terminal
/// that is held. Nothing allocates after construction. At its end it writes what waits, and gives up after a second in which nobody reads.
class LineWriter {
 public:
  static constexpr std::size_t kLines = 64;       ///< waiting to be written; full: the newest goes, counted
  static constexpr std::size_t kLineBytes = 513;  ///< of a line with its end; longer: cut

  /// @param descriptor  must stay open while it lives; a reader who goes away ends nothing
  /// @throws std::system_error.
  explicit LineWriter(int descriptor);
  ~LineWriter() = default;
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  /// In one thread only. @param line  without its end
  void append(std::string_view line);
  /// Lines for which there was no room.
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

 private:
  struct Line {
    std::size_t size = 0;
    std::array<char, kLineBytes> text{};
  };
  using Lines = std::array<Line, kLines>;

  void write(const std::stop_token& stop);
  [[nodiscard]] bool is_writable(const std::stop_token& stop) const;

  int descriptor_;
  std::unique_ptr<Lines> lines_ = std::make_unique<Lines>();
  // Each written by one thread, read by the other.
  std::atomic<std::uint64_t> appended_{0};
  std::atomic<std::uint64_t> written_{0};
  std::uint64_t left_out_ = 0;
  host::WakeEvent wake_event_;  ///< a line, or the end
  std::jthread writing_;        ///< last: it goes first
};

}  // namespace earshot::board
