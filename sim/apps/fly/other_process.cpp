#include "sim/apps/fly/other_process.hpp"

#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace earshot::fly {

OtherProcess::OtherProcess(pid_t id) : id_(id), file_(static_cast<int>(syscall(SYS_pidfd_open, id, 0U))) {}

bool OtherProcess::has_ended() const {
  if (file_.number() < 0) return kill(id_, 0) != 0 && errno == ESRCH;
  pollfd end{.fd = file_.number(), .events = POLLIN, .revents = 0};
  return poll(&end, 1, 0) > 0;
}

}  // namespace earshot::fly
