#include "firmware/host/transport/can/send_queue.hpp"

#include <algorithm>

namespace earshot::host {

namespace {

/// 0 is the most urgent.
unsigned priority_of(std::span<const n2k::Frame> frames) {
  unsigned priority = 7;
  for (const n2k::Frame& frame : frames) priority = std::min(priority, (frame.identifier >> 26U) & 7U);
  return priority;
}

}  // namespace

Status CanSendQueue::push(std::span<const n2k::Frame> frames, Time now, const Waiting& waiting) {
  if (frames.empty() || frames.size() > CanGroup::capacity()) return Status::kOutOfRange;
  ++counters_.pushed;
  if (waiting.kept == WhileWaiting::kKeepNewest) give_up_older(frames.front());
  const unsigned priority = priority_of(frames);
  Slot* slot = find_slot(priority);
  if (slot == nullptr) {
    ++counters_.refused;
    return Status::kFull;
  }
  slot->frames.clear();
  for (const n2k::Frame& frame : frames) (void)slot->frames.push_back(frame);
  slot->gone = 0;
  slot->priority = priority;
  slot->number = number_++;
  slot->since = now;
  slot->longest = waiting.longest;
  return Status::kOk;
}

/// A free one, or that of the oldest of the least urgent if that is no more urgent than the new group; what has begun is let go on.
CanSendQueue::Slot* CanSendQueue::find_slot(unsigned priority) {
  Slot* victim = nullptr;
  for (Slot& slot : slots_) {
    if (slot.frames.empty()) return &slot;
    if (slot.gone > 0 || slot.priority < priority) continue;
    if (victim == nullptr || slot.priority > victim->priority || (slot.priority == victim->priority && slot.number < victim->number))
      victim = &slot;
  }
  if (victim != nullptr) ++counters_.shed;
  return victim;
}

void CanSendQueue::give_up_older(const n2k::Frame& first) {
  for (Slot& slot : slots_) {
    if (slot.frames.empty() || slot.frames[0].identifier != first.identifier) continue;
    slot.frames.clear();
    ++counters_.replaced;
  }
}

const CanSendQueue::Slot* CanSendQueue::head() const {
  const Slot* head = nullptr;
  for (const Slot& slot : slots_) {
    if (slot.frames.empty()) continue;
    if (head == nullptr || slot.priority < head->priority) {
      head = &slot;
    } else if (slot.priority == head->priority) {
      const bool has_begun = slot.gone > 0;
      if (has_begun != (head->gone > 0) ? has_begun : slot.number < head->number) head = &slot;
    }
  }
  return head;
}

const n2k::Frame* CanSendQueue::next() const {
  const Slot* slot = head();
  return slot == nullptr ? nullptr : &slot->frames[slot->gone];
}

void CanSendQueue::pop(Time now) {
  const Slot* first = head();
  if (first == nullptr) return;
  Slot& slot = slots_[static_cast<std::size_t>(first - slots_.data())];
  slot.since = now;
  if (++slot.gone < slot.frames.size()) return;
  slot.frames.clear();
  ++counters_.sent;
}

void CanSendQueue::expire(Time now) {
  for (Slot& slot : slots_) {
    if (slot.frames.empty() || lies_within(slot.since, now, slot.gone > 0 ? kLongestGap : slot.longest)) continue;
    ++(slot.gone > 0 ? counters_.abandoned : counters_.expired);
    slot.frames.clear();
  }
}

std::size_t CanSendQueue::waiting() const {
  return static_cast<std::size_t>(std::ranges::count_if(slots_, [](const Slot& slot) { return !slot.frames.empty(); }));
}

bool CanSendQueue::holds_newest() const {
  return std::ranges::any_of(slots_, [this](const Slot& slot) { return !slot.frames.empty() && slot.number + 1 == number_; });
}

}  // namespace earshot::host
