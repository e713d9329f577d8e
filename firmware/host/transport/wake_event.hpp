#pragma once

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// One thread wakes another that polls. Rung several times before it is answered, it has rung once.
class WakeEvent {
 public:
  /// @throws std::system_error.
  WakeEvent();
  void signal() const;
  /// Stops ringing.
  void clear() const;
  /// Readable while it rings.
  [[nodiscard]] int file_descriptor() const { return event_.number(); }

 private:
  FileDescriptor event_;
};

}  // namespace earshot::host
