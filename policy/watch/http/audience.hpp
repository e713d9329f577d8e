#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "policy/watch/http/browser.hpp"

namespace earshot::watch {

/// The browsers that look on, so many at most. Its methods may be called by any thread, and none of them waits for a browser.
/// Oracle: Audience.*
class Audience {
 public:
  static constexpr std::size_t kMostBrowsers = 64;

  /// A place for another browser, which is free again when nobody holds it any more. Nothing: all places are taken.
  [[nodiscard]] std::shared_ptr<Browser> join();

  void publish(const Frame& frame);
  /// To all that ask for it.
  void give(const Frame& whole);
  /// Another flight begins: everybody asks for it.
  void restart();
  [[nodiscard]] bool has_followers() const;  ///< somebody was given the whole
  [[nodiscard]] bool asks() const;           ///< somebody waits for it

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] std::uint64_t dropped_frames() const { return dropped_; }  ///< of browsers that read too slowly

 private:
  [[nodiscard]] std::vector<std::shared_ptr<Browser>> present() const;

  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<Browser>> browsers_;
  std::atomic<std::uint64_t> dropped_ = 0;
};

}  // namespace earshot::watch
