#include "firmware/host/transport/can/bus_off_wait.hpp"

#include <algorithm>

namespace earshot::host {

void BusOffWait::begin(Time now) {
  const bool is_again = until_ || (ended_ && lies_within(*ended_, now, kForgottenAfter));
  length_ = is_again ? std::min(length_ + length_, kLongest) : kFirst;
  began_ = now;
  until_ = now + length_;
}

bool BusOffWait::ends(Time now) {
  // A clock that was set back would otherwise wait for its own past.
  if (!until_ || (now < *until_ && now >= began_)) return false;
  until_.reset();
  ended_ = now;
  return true;
}

}  // namespace earshot::host
