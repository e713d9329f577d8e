#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "firmware/host/transport/wake_event.hpp"

namespace earshot::watch {

/// Bytes that are sent in one piece; all browsers share them.
using Frame = std::shared_ptr<const std::string>;

/// The frames that wait for one browser. The thread of the flight puts them in and never waits; the thread that sends takes them out. So
/// many wait at most: of a browser that reads too slowly all are dropped and counted, and it is given the whole flight again once it reads
/// on.
/// Oracle: Browser.*
class Browser {
 public:
  static constexpr std::size_t kMostFrames = 64;
  static constexpr std::size_t kMostBytes = std::size_t{8} << 20U;  ///< of more than one frame

  /// What has come since what it was given before. Passed over where it has not been given the whole.
  /// @return how many frames were dropped
  std::uint64_t push(Frame frame);
  /// It waits for the whole flight.
  [[nodiscard]] bool asks() const;
  void give(Frame whole);
  /// What waits is of a flight that another has taken the place of: it asks for the whole.
  void restart();

  /// The next frame; nothing: none waits, and wake() rings when one does.
  [[nodiscard]] Frame next();
  [[nodiscard]] const host::WakeEvent& wake() const { return wake_; }

 private:
  enum class State : std::uint8_t {
    kAsks,     ///< for the whole
    kFollows,  ///< was given the whole, and gets the news
    kLost,     ///< frames were dropped; it asks for the whole when it has sent what it had
  };

  mutable std::mutex mutex_;
  State state_ = State::kAsks;
  std::deque<Frame> frames_;
  std::size_t bytes_ = 0;
  host::WakeEvent wake_;
};

}  // namespace earshot::watch
