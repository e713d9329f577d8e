#include "firmware/host/transport/wake_event.hpp"

#include <sys/eventfd.h>

#include <cerrno>
#include <system_error>

namespace earshot::host {

WakeEvent::WakeEvent() : event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (event_.number() < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

void WakeEvent::signal() const {
  (void)::eventfd_write(event_.number(), 1);  // refused only when it has rung 2^64 times, and then it rings
}

void WakeEvent::clear() const {
  eventfd_t rung = 0;
  (void)::eventfd_read(event_.number(), &rung);
}

}  // namespace earshot::host
