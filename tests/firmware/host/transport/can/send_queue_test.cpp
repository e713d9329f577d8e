#include "firmware/host/transport/can/send_queue.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace earshot::host {
namespace {

constexpr Time kStart{};
constexpr Waiting kNewest{.kept = WhileWaiting::kKeepNewest, .longest = Duration::seconds(1)};

Time at_ms(std::int64_t ms) {
  return kStart + Duration::milliseconds(ms);
}

/// Frames of one group: identical but for their number.
std::vector<n2k::Frame> group(unsigned priority, std::uint8_t tag, std::size_t frames = 1) {
  std::vector<n2k::Frame> result;
  for (std::size_t i = 0; i < frames; ++i)
    result.push_back({.identifier = priority << 26U | 0xFF0A40U, .size = 2, .data = {tag, static_cast<std::uint8_t>(i)}});
  return result;
}

/// Tags in the order in which everything goes.
std::vector<int> drain(CanSendQueue& queue) {
  std::vector<int> tags;
  for (const n2k::Frame* frame = queue.next(); frame != nullptr; frame = queue.next()) {
    tags.push_back(frame->data[0]);
    queue.pop(kStart);
  }
  return tags;
}

Status push(CanSendQueue& queue, const std::vector<n2k::Frame>& frames, const Waiting& waiting = {}) {
  return queue.push(frames, kStart, waiting);
}

TEST(CanSendQueue, GivesTheMostUrgentFirstAndEqualsInTheOrderOfTheirComing) {
  CanSendQueue queue;
  for (const auto& [priority, tag] : std::vector<std::pair<unsigned, std::uint8_t>>{{6, 1}, {3, 2}, {6, 3}, {2, 4}, {3, 5}})
    ASSERT_EQ(push(queue, group(priority, tag)), Status::kOk);
  EXPECT_EQ(drain(queue), (std::vector{4, 2, 5, 1, 3}));
  EXPECT_EQ(queue.counters().sent, 5U);
}

// The third takes the room that the first left.
TEST(CanSendQueue, GivesEqualsInTheOrderOfTheirComingWhateverWentBefore) {
  CanSendQueue queue;
  ASSERT_EQ(push(queue, group(6, 1)), Status::kOk);
  ASSERT_EQ(push(queue, group(6, 2)), Status::kOk);
  queue.pop(kStart);
  ASSERT_EQ(push(queue, group(6, 3)), Status::kOk);
  EXPECT_EQ(drain(queue), (std::vector{2, 3}));
}

// Its oldest does not always lie in the first place.
TEST(CanSendQueue, ShedsTheOldestOfEqualsAgainAndAgain) {
  CanSendQueue queue;
  std::vector<int> kept;
  std::uint8_t tag = 0;
  while (queue.counters().shed == 0) ASSERT_EQ(push(queue, group(6, tag++)), Status::kOk);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(push(queue, group(6, tag++)), Status::kOk);
  for (int one = 4; one < tag; ++one) kept.push_back(one);
  EXPECT_EQ(drain(queue), kept);
}

TEST(CanSendQueue, IsAsUrgentAsTheMostUrgentFrameOfAGroup) {
  CanSendQueue queue;
  std::vector<n2k::Frame> setpoint = group(3, 1);
  setpoint.push_back(group(2, 2)[0]);
  ASSERT_EQ(push(queue, group(3, 9)), Status::kOk);
  ASSERT_EQ(push(queue, setpoint), Status::kOk);
  EXPECT_EQ(drain(queue), (std::vector{1, 2, 9}));
}

TEST(CanSendQueue, LetsAGroupThatHasBegunGoOnBeforeAllThatAreNoMoreUrgent) {
  CanSendQueue queue;
  ASSERT_EQ(push(queue, group(3, 1, 3)), Status::kOk);
  queue.pop(kStart);
  ASSERT_EQ(push(queue, group(3, 2)), Status::kOk);
  ASSERT_EQ(push(queue, group(2, 3)), Status::kOk);
  ASSERT_EQ(push(queue, group(6, 4)), Status::kOk);
  EXPECT_EQ(drain(queue), (std::vector{3, 1, 1, 2, 4}));
}

TEST(CanSendQueue, LetsTheNewestSetpointTakeThePlaceOfOneThatStillWaits) {
  CanSendQueue queue;
  ASSERT_EQ(push(queue, group(3, 1, 2), kNewest), Status::kOk);
  ASSERT_EQ(push(queue, group(6, 7)), Status::kOk);
  ASSERT_EQ(push(queue, group(3, 2, 2), kNewest), Status::kOk);
  EXPECT_EQ(drain(queue), (std::vector{2, 2, 7}));
  EXPECT_EQ(queue.counters().replaced, 1U);
}

TEST(CanSendQueue, GivesUpTheRestOfASetpointOnceThereIsANewer) {
  CanSendQueue queue;
  ASSERT_EQ(push(queue, group(3, 1, 5), kNewest), Status::kOk);
  queue.pop(kStart);
  ASSERT_EQ(push(queue, group(3, 2, 2), kNewest), Status::kOk);
  EXPECT_EQ(drain(queue), (std::vector{2, 2}));
}

TEST(CanSendQueue, ShedsTheOldestOfTheLeastUrgentWhenItIsFull) {
  CanSendQueue queue;
  ASSERT_EQ(push(queue, group(6, 1)), Status::kOk);
  ASSERT_EQ(push(queue, group(7, 2)), Status::kOk);
  ASSERT_EQ(push(queue, group(7, 3)), Status::kOk);
  while (queue.waiting() < config::kCanWaitingGroups) ASSERT_EQ(push(queue, group(5, 4)), Status::kOk);
  ASSERT_EQ(push(queue, group(6, 5)), Status::kOk);
  EXPECT_EQ(queue.counters().shed, 1U);
  std::vector<int> tags = drain(queue);
  tags.erase(tags.begin(), tags.end() - 3);
  EXPECT_EQ(tags, (std::vector{1, 5, 3})) << "2 was the oldest of the least urgent";
}

TEST(CanSendQueue, RefusesWhatIsLessUrgentThanAllThatWait) {
  CanSendQueue queue;
  while (queue.waiting() < config::kCanWaitingGroups) ASSERT_EQ(push(queue, group(3, 1)), Status::kOk);
  EXPECT_EQ(push(queue, group(4, 2)), Status::kFull);
  EXPECT_EQ(queue.counters().refused, 1U);
  EXPECT_EQ(queue.counters().shed, 0U);
}

TEST(CanSendQueue, ShedsNothingOfWhichAPartHasGone) {
  CanSendQueue queue;
  ASSERT_EQ(push(queue, group(7, 1, 2)), Status::kOk);
  queue.pop(kStart);
  while (queue.waiting() < config::kCanWaitingGroups) ASSERT_EQ(push(queue, group(3, 2)), Status::kOk);
  EXPECT_EQ(push(queue, group(5, 3)), Status::kFull);
  EXPECT_EQ(drain(queue).back(), 1);
}

TEST(CanSendQueue, GivesUpWhatWaitedTooLong) {
  CanSendQueue queue;
  ASSERT_EQ(queue.push(group(3, 1), at_ms(0), {.longest = Duration::milliseconds(200)}), Status::kOk);
  ASSERT_EQ(queue.push(group(3, 2), at_ms(0), {.longest = Duration::seconds(10)}), Status::kOk);
  queue.expire(at_ms(200));
  EXPECT_EQ(queue.waiting(), 2U);
  queue.expire(at_ms(201));
  EXPECT_EQ(queue.counters().expired, 1U);
  EXPECT_EQ(drain(queue), (std::vector{2}));
}

TEST(CanSendQueue, GivesUpAGroupThatHasBegunBeforeItsReceiversDo) {
  CanSendQueue queue;
  ASSERT_EQ(queue.push(group(3, 1, 3), at_ms(0), {.longest = Duration::seconds(10)}), Status::kOk);
  queue.expire(at_ms(9000));
  queue.pop(at_ms(9000));
  queue.expire(at_ms(9500));
  EXPECT_EQ(queue.waiting(), 1U);
  queue.expire(at_ms(9501));
  EXPECT_EQ(queue.waiting(), 0U);
  EXPECT_EQ(queue.counters().abandoned, 1U);
  EXPECT_LT(CanSendQueue::kLongestGap, n2k::kFastPacketTimeout);
}

TEST(CanSendQueue, TakesNoGroupWithoutFramesOrWithTooMany) {
  CanSendQueue queue;
  EXPECT_EQ(push(queue, {}), Status::kOutOfRange);
  EXPECT_EQ(push(queue, group(3, 1, CanGroup::capacity())), Status::kOk);
  EXPECT_EQ(push(queue, group(3, 1, CanGroup::capacity() + 1)), Status::kOutOfRange);
}

TEST(CanSendQueue, KnowsOfEveryGroupWhatBecameOfIt) {
  CanSendQueue queue;
  std::mt19937 dice(7);
  Time now = kStart;
  for (int i = 0; i < 20'000; ++i) {
    const bool bus_stands_still = i % 500 < 100;
    if (i % 500 == 100) now = now + Duration::milliseconds(700);
    if (!bus_stands_still) now = now + Duration::milliseconds(static_cast<std::int64_t>(dice() % 20));
    const WhileWaiting kept = dice() % 16 == 0 ? WhileWaiting::kKeepNewest : WhileWaiting::kKeepEach;
    const unsigned priority = dice() % 8 == 0 ? 7U : static_cast<unsigned>(dice() % 3);
    (void)queue.push(group(priority, 1, 1 + dice() % 3), now, {.kept = kept, .longest = Duration::milliseconds(600)});
    queue.expire(now);
    for (auto pops = bus_stands_still ? 0 : dice() % 4; pops > 0; --pops) queue.pop(now);
  }
  const CanSendQueueCounters& told = queue.counters();
  EXPECT_EQ(told.pushed, 20'000U);
  EXPECT_EQ(told.pushed, told.sent + told.replaced + told.expired + told.abandoned + told.shed + told.refused + queue.waiting());
  for (const std::uint64_t count : {told.sent, told.replaced, told.expired, told.abandoned, told.shed, told.refused})
    EXPECT_GT(count, 0U) << "the dice must throw every case";
}

}  // namespace
}  // namespace earshot::host
