#include "firmware/wire/n2k/node/commanded_address.hpp"

#include <gtest/gtest.h>

namespace earshot::n2k {
namespace {

constexpr Time kNow{1'000'000};
constexpr std::uint8_t kCommander = 0x23;
constexpr std::uint8_t kOther = 0x24;
// The NAME of tests/reference/n2k/frames.txt, source 204, lowest byte first, in 9 bytes with address 0x55 behind it; 2 packets of 65240.
constexpr Frame kAnnouncement{0x1CECFF23, 8, {32, 9, 0, 2, 0xFF, 0xD8, 0xFE, 0x00}};
constexpr Frame kFirst{0x1CEBFF23, 8, {1, 0x1F, 0xEE, 0x72, 0xE7, 0x35, 0x96, 0x50}};
constexpr Frame kSecond{0x1CEBFF23, 8, {2, 0xC0, 0x55, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}};
constexpr Name kName = 0x4050'9635'E772'EE1F;  // without its highest bit, that it can claim any address, which commands leave open

class CommandedAddressTest : public ::testing::Test {
 protected:
  std::optional<AddressCommand> accept(Frame frame, std::uint8_t source = kCommander, Time now = kNow) {
    frame.identifier = (frame.identifier & ~0xFFU) | source;
    return commanded_.accept(parse_identifier(frame.identifier).value(), frame, now);
  }
  void expect_whole(const std::optional<AddressCommand>& command) {
    ASSERT_TRUE(command.has_value());
    EXPECT_EQ(command->name, kName);
    EXPECT_EQ(command->address, 0x55);
  }

  CommandedAddress commanded_;
};

TEST_F(CommandedAddressTest, IsPutTogetherOfAnAnnouncementAndTwoPackets) {
  EXPECT_FALSE(accept(kAnnouncement));
  EXPECT_FALSE(accept(kFirst));
  expect_whole(accept(kSecond));
  EXPECT_FALSE(accept(kSecond)) << "once";
  EXPECT_FALSE(accept(kFirst)) << "not announced any more";
  EXPECT_FALSE(accept(kSecond));
}

TEST_F(CommandedAddressTest, IsNotDisturbedByWhatOthersTransport) {
  Frame other_announcement = kAnnouncement;
  other_announcement.data[1] = 20;  // another message, of 20 bytes
  EXPECT_FALSE(accept(kAnnouncement));
  EXPECT_FALSE(accept(other_announcement, kOther));
  EXPECT_FALSE(accept(kFirst));
  EXPECT_FALSE(accept(kSecond, kOther)) << "another's second packet";
  expect_whole(accept(kSecond));
}

TEST_F(CommandedAddressTest, IsGivenUpWhenItsSenderTransportsSomethingElse) {
  Frame abort = kAnnouncement;
  abort.data[0] = 255;  // the transport protocol's abort
  EXPECT_FALSE(accept(kAnnouncement));
  EXPECT_FALSE(accept(kFirst));
  EXPECT_FALSE(accept(abort));
  EXPECT_FALSE(accept(kSecond));
}

TEST_F(CommandedAddressTest, IsGivenUpWithAPacketCutShortOrOutOfOrder) {
  for (const bool cut : {true, false}) {
    Frame bad = cut ? kFirst : kSecond;
    if (cut) bad.size = 7;
    EXPECT_FALSE(accept(kAnnouncement));
    EXPECT_FALSE(accept(bad));
    EXPECT_FALSE(accept(kFirst));
    EXPECT_FALSE(accept(kSecond)) << (cut ? "cut short" : "out of order");
  }
}

TEST_F(CommandedAddressTest, WaitsForEachPacketFor750Milliseconds) {
  constexpr Duration kMost = Duration::milliseconds(750);
  EXPECT_FALSE(accept(kAnnouncement));
  EXPECT_FALSE(accept(kFirst, kCommander, kNow + kMost));
  expect_whole(accept(kSecond, kCommander, kNow + kMost + kMost));
  EXPECT_FALSE(accept(kAnnouncement));
  EXPECT_FALSE(accept(kFirst, kCommander, kNow + kMost + Duration{1}));
  EXPECT_FALSE(accept(kSecond, kCommander, kNow + kMost + Duration{1}));
}

TEST_F(CommandedAddressTest, IsTakenOnlyWhenItIsSaidToAll) {
  Frame to_one = kAnnouncement;
  to_one.identifier = 0x1CEC4023;
  Frame first_to_one = kFirst;
  first_to_one.identifier = 0x1CEB4023;
  EXPECT_FALSE(accept(to_one));
  EXPECT_FALSE(accept(kFirst));
  EXPECT_FALSE(accept(kSecond));
  EXPECT_FALSE(accept(kAnnouncement));
  EXPECT_FALSE(accept(first_to_one));
  EXPECT_FALSE(accept(kFirst));
  expect_whole(accept(kSecond));
}

TEST_F(CommandedAddressTest, IsTakenAnewWhenItIsAnnouncedAnew) {
  for (const Frame& frame : {kAnnouncement, kFirst, kAnnouncement}) EXPECT_FALSE(accept(frame));
  EXPECT_FALSE(accept(kSecond)) << "the first packet of the new one has not come";
  Frame cut = kAnnouncement;
  cut.size = 7;
  EXPECT_FALSE(accept(cut));
  EXPECT_FALSE(accept(kFirst)) << "an announcement cut short is none";
  EXPECT_FALSE(accept(kSecond));
}

TEST_F(CommandedAddressTest, TellsADeviceByAllButItsSpareBitAndTheOneForAnyAddress) {
  EXPECT_EQ(commanded_bits(0xFFFF'FFFF'FFFF'FFFF), 0x7FFE'FFFF'FFFF'FFFF);
  EXPECT_EQ(commanded_bits(0xC050'9635'E772'EE1F), kName);
}

}  // namespace
}  // namespace earshot::n2k
