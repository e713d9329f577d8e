#include "policy/watch/foxglove/viewer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace earshot::watch {
namespace {

using namespace std::string_literals;

std::vector<Frame> all_frames(Viewer& viewer) {
  std::vector<Frame> frames;
  while (std::optional<Frame> frame = viewer.next()) frames.push_back(std::move(*frame));
  return frames;
}

/// Message Data of the protocol: 0x01, the subscription and the time as little-endian integers, the message.
TEST(Viewer, IsSentWhatItSubscribesToInTheProtocolsBytes) {
  Viewer viewer;
  EXPECT_TRUE(viewer.subscribe(0x01020304, 5));
  viewer.send(5, 0x0102030405060708, "{}");
  viewer.send(6, 1, "of a channel that it did not ask for");
  const std::vector<Frame> frames = all_frames(viewer);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(frames[0].is_binary);
  EXPECT_EQ(frames[0].bytes, "\x01\x04\x03\x02\x01\x08\x07\x06\x05\x04\x03\x02\x01{}"s);
}

TEST(Viewer, IsToldTheTimeInTheProtocolsBytes) {
  Viewer viewer;
  viewer.send_time(258);
  EXPECT_EQ(all_frames(viewer).at(0).bytes, "\x02\x02\x01\x00\x00\x00\x00\x00\x00"s);
}

TEST(Viewer, IsToldWhatItMustNotMissBeforeItsMessages) {
  Viewer viewer;
  ASSERT_TRUE(viewer.subscribe(1, 0));
  viewer.send(0, 0, "{}");
  viewer.control("first");
  EXPECT_EQ(all_frames(viewer).at(0).bytes, "first");
}

TEST(Viewer, HasOneSubscriptionOfAChannelAndOneChannelOfASubscription) {
  Viewer viewer;
  EXPECT_TRUE(viewer.subscribe(1, 0));
  EXPECT_FALSE(viewer.subscribe(2, 0));
  EXPECT_FALSE(viewer.subscribe(1, 3));
  EXPECT_TRUE(viewer.unsubscribe(1));
  EXPECT_FALSE(viewer.unsubscribe(1));
  viewer.send(0, 0, "{}");
  EXPECT_FALSE(viewer.is_waiting());
}

/// 5 messages of 1 MiB do not fit 4 MiB with their 13 bytes each: the oldest two go, and the viewer is told so once.
TEST(Viewer, LosesItsOldestMessagesWhereItReadsTooSlowlyAndIsToldHowMany) {
  Viewer viewer;
  ASSERT_TRUE(viewer.subscribe(1, 0));
  for (char name = 'a'; name <= 'e'; ++name) viewer.send(0, 0, std::string(1U << 20U, name));
  const std::vector<Frame> frames = all_frames(viewer);
  ASSERT_EQ(frames.size(), 4U);
  const nlohmann::json told = nlohmann::json::parse(frames[0].bytes);
  EXPECT_EQ(told["op"], "status");
  EXPECT_EQ(told["level"], 1);
  EXPECT_TRUE(told["message"].get<std::string>().starts_with("2 messages were left out")) << told["message"];
  EXPECT_EQ(frames[1].bytes.back(), 'c');
  EXPECT_EQ(frames[3].bytes.back(), 'e');
}

}  // namespace
}  // namespace earshot::watch
