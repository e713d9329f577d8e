#pragma once

#include <cstdint>
#include <string>

namespace earshot::hil {

/// A queue before a CAN interface that gives it so many frames a second and holds ten: what comes when it is full the kernel refuses
/// (ENOBUFS), as before a controller whose bus is busy with the frames of others. It is gone with this. Root only.
class NarrowQueue {
 public:
  /// @throws std::system_error
  NarrowQueue(std::string interface, double frames_per_s);
  ~NarrowQueue();
  NarrowQueue(const NarrowQueue&) = delete;
  NarrowQueue& operator=(const NarrowQueue&) = delete;

  /// Frames, by the kernel's counter of the queue. @throws std::system_error
  [[nodiscard]] std::uint64_t refused() const;

 private:
  std::string interface_;
};

}  // namespace earshot::hil
