#include "firmware/runtime/legs.hpp"

namespace earshot::runtime {

void Legs::begin(const guidance::Leg& leg, Time now) {
  leg_ = leg;
  decided_ = now;
  ++decisions_;
}

bool Legs::would_be_over(Time now, MetersPerSecond speed) const {
  return (now - decided_).to_seconds() * speed.value >= leg_.length().value;
}

}  // namespace earshot::runtime
