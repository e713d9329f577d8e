#include "firmware/wire/n2k/node/address_claim.hpp"

#include <algorithm>

namespace earshot::n2k {

void AddressClaim::accept(std::uint8_t source, Name name, Time now) {
  if (name == name_) {
    ++counters_.own;
    return;
  }
  if (source > kLastAddress) return;
  taken_.set(source, name < name_);
  if (source != wanted_ || state_ == State::kWithout) return;
  if (name < name_) {
    ++counters_.lost;
    if (state_ != State::kStarting) note_loss(now);  // of what was not claimed yet nobody can have taken it away
    yield_address(now);
  } else {
    ++counters_.defended;
    due_ = true;
  }
}

void AddressClaim::note_loss(Time now) {
  lost_in_a_row_ = lost_in_a_row_ > 0 && now - lost_ <= kWarMemory ? std::min(lost_in_a_row_ + 1, kLostInWar) : 1;
  lost_ = now;
  is_at_war_ = lost_in_a_row_ == kLostInWar;
}

void AddressClaim::yield_address(Time now) {
  for (unsigned step = 1; step <= kLastAddress; ++step) {
    const auto address = static_cast<std::uint8_t>((wanted_ + step) % (kLastAddress + 1U));
    if (!taken_[address]) {
      claim(address);
      return;
    }
  }
  ++counters_.given_up;
  state_ = State::kWithout;
  since_ = now;
  due_ = true;
  not_before_ = now + cannot_claim_delay(name_);
}

void AddressClaim::ask(Time now) {
  if (!due_) not_before_ = now + cannot_claim_delay(name_);  // who asks again and again does not put the answer off
  due_ = true;
}

void AddressClaim::claim(std::uint8_t address) {
  wanted_ = address;
  state_ = State::kStarting;
  due_ = true;
}

Status AddressClaim::move_to(std::uint8_t address) {
  if (address > kLastAddress) return Status::kOutOfRange;
  if (address == wanted_ && state_ != State::kWithout) return Status::kOk;
  claim(address);
  return Status::kOk;
}

bool AddressClaim::claim_due(Time now) {
  is_at_war_ = is_at_war_ && now - lost_ <= kWarMemory;
  if (state_ == State::kWithout && now - since_ >= (is_at_war_ ? kClaimAgainInWar : kClaimAgain)) {
    taken_.reset();
    claim(preferred_);
  }
  if (state_ == State::kClaiming && now - began_ >= kClaimTime) state_ = State::kHolding;
  if (!due_ || (sent_ && now - *sent_ < kLeastClaimGap)) return false;
  if (state_ == State::kWithout && now < not_before_) return false;
  due_ = false;
  sent_ = now;
  ++counters_.claims;
  if (state_ == State::kStarting) {
    state_ = State::kClaiming;
    began_ = now;
  }
  return true;
}

}  // namespace earshot::n2k
