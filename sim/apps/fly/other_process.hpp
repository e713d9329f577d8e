#pragma once

#include <sys/types.h>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::fly {

/// A process that this one need not have started, watched from outside: whether it has ended, however it ended. Unlike a death signal of
/// the kernel's (PR_SET_PDEATHSIG) it looks at the process, of which threads may come and go.
/// Oracle: OtherProcess.*
class OtherProcess {
 public:
  explicit OtherProcess(pid_t id);

  /// Also true of one that had ended before it was looked at.
  [[nodiscard]] bool has_ended() const;

 private:
  pid_t id_;
  host::FileDescriptor file_;  ///< none where the kernel has no such thing: then the number is asked, which another process may get
};

}  // namespace earshot::fly
