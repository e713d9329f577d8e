#include "hil/bus/decode/decoder.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/node/information.hpp"

namespace earshot::hil {
namespace {

using Taken = Decoder::Taken;

LogEntry entry_of(const n2k::Frame& frame, std::int64_t ms = 0, const std::string& interface = "can0") {
  return {.time = Time{1000 * ms}, .interface = interface, .frame = frame};
}

/// Product information of a device at that address.
n2k::FastPacketFrames product(std::uint8_t source, std::string_view model) {
  const auto bytes = n2k::product_information({.model = model}).value();
  n2k::FastPacketFrames frames;
  EXPECT_EQ(n2k::compose_fast_packet({126996, 6, source, n2k::kBroadcast}, 0, bytes, frames), Status::kOk);
  return frames;
}

n2k::Frame heading_from(std::uint8_t source) {
  return {.identifier = 0x09F11200U | source, .size = 8, .data = {0xFF, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};
}

n2k::Frame claim_of(std::uint8_t source, std::uint8_t unique_number) {
  return {.identifier = 0x18EEFF00U | source, .size = 8, .data = {unique_number, 0xE0, 0x6F, 0xE7, 0x1C, 0x96, 0xA0, 0xC0}};
}

TEST(Decoder, PutsTogetherWhatManyDevicesSendAtOnce) {
  constexpr std::uint8_t kDevices = 200;  // more than have a slot in the vehicle's own
  std::vector<n2k::FastPacketFrames> packets;
  for (std::uint8_t source = 0; source < kDevices; ++source) packets.push_back(product(source, "device " + std::to_string(source)));
  Decoder decoder;
  Heard heard;
  int whole = 0;
  for (std::size_t i = 0; i < packets[0].size(); ++i) {
    for (const n2k::FastPacketFrames& packet : packets) {
      if (decoder.accept(entry_of(packet[i]), heard) != Taken::kMessage) continue;
      EXPECT_EQ(heard.source_name, "device " + std::to_string(heard.identifier.source));
      ++whole;
    }
  }
  EXPECT_EQ(whole, kDevices);
  EXPECT_EQ(decoder.counters().incomplete, 0U);
}

TEST(Decoder, KeepsInterfacesApart) {
  const auto packet = product(7, "x");
  Decoder decoder;
  Heard heard;
  ASSERT_EQ(decoder.accept(entry_of(packet[0], 0, "can0"), heard), Taken::kNothingYet);
  ASSERT_EQ(decoder.accept(entry_of(packet[1], 0, "can1"), heard), Taken::kNothingYet);
  EXPECT_EQ(decoder.counters().incomplete, 2U);
}

TEST(Decoder, GivesAMessageTheTimeOfItsFirstFrame) {
  const auto packet = product(7, "x");
  Decoder decoder;
  Heard heard;
  std::int64_t ms = 100;
  auto taken = Taken::kNothingYet;
  for (const n2k::Frame& frame : packet) taken = decoder.accept(entry_of(frame, ms++), heard);
  ASSERT_EQ(taken, Taken::kMessage);
  EXPECT_EQ(heard.time, Time{100'000});
}

// As gateways write them: neighbours swapped, and 134 = 6 + 18 * 7 + 2 bytes, of which the last frame holds no more.
TEST(Decoder, TakesSwappedFramesAndALastOneWithoutPadding) {
  auto packet = product(7, "x");
  ASSERT_EQ(packet.size(), 20U);
  packet[19].size = 3;
  std::swap(packet[0], packet[1]);
  std::swap(packet[7], packet[9]);
  Decoder decoder;
  Heard heard;
  auto taken = Taken::kNothingYet;
  for (const n2k::Frame& frame : packet) taken = decoder.accept(entry_of(frame), heard);
  ASSERT_EQ(taken, Taken::kMessage);
  EXPECT_EQ(heard.source_name, "x");
  EXPECT_EQ(decoder.counters().incomplete, 0U);
}

TEST(Decoder, TakesAMessageThatItsRecorderPutTogether) {
  const auto bytes = n2k::product_information({.model = "compass"}).value();
  LogEntry entry{.time = Time{5}, .interface = "can0", .frame = std::nullopt};
  entry.message = WholeMessage{.identifier = {126996, 6, 7, n2k::kBroadcast}, .bytes = {bytes.begin(), bytes.end()}};
  Decoder decoder;
  Heard heard;
  ASSERT_EQ(decoder.accept(entry, heard), Taken::kMessage);
  EXPECT_EQ(heard.message->name, "ProductInformation");
  EXPECT_EQ(heard.source_name, "compass");
  EXPECT_EQ(heard.time, Time{5});
  const n2k::Frame claim = claim_of(8, 0x9D);
  entry.message = WholeMessage{.identifier = {60928, 6, 8, n2k::kBroadcast}, .bytes = {claim.data.begin(), claim.data.end()}};
  ASSERT_EQ(decoder.accept(entry, heard), Taken::kMessage);
  EXPECT_EQ(heard.source_name, "NAME 0xC0A0961CE76FE09D");
}

TEST(Decoder, NamesADeviceByItsModelElseByItsClaimUntilAnotherClaimsTheAddress) {
  Decoder decoder;
  Heard heard;
  ASSERT_EQ(decoder.accept(entry_of(heading_from(7)), heard), Taken::kMessage);
  EXPECT_EQ(heard.source_name, "");
  (void)decoder.accept(entry_of(claim_of(7, 0x9D)), heard);
  (void)decoder.accept(entry_of(heading_from(7)), heard);
  EXPECT_EQ(heard.source_name, "NAME 0xC0A0961CE76FE09D");
  for (const n2k::Frame& frame : product(7, "compass")) (void)decoder.accept(entry_of(frame), heard);
  (void)decoder.accept(entry_of(claim_of(7, 0x9D)), heard);
  (void)decoder.accept(entry_of(heading_from(7)), heard);
  EXPECT_EQ(heard.source_name, "compass");
  (void)decoder.accept(entry_of(claim_of(7, 0x9E)), heard);
  (void)decoder.accept(entry_of(heading_from(7)), heard);
  EXPECT_EQ(heard.source_name, "NAME 0xC0A0961CE76FE09E");
}

TEST(Decoder, DoesNotReadAnotherMakersProprietaryMessages) {
  // Our set-point's number; maker 1851 (0x73B) of the marine industry: 0x3B, 0x9F.
  n2k::Frame frame{.identifier = 0x0CFF0A40, .size = 8, .data = {0xFC, 0x9F, 0xC8, 0x00, 0x30, 0x75, 0x00, 0x00}};
  Decoder decoder;
  Heard heard;
  ASSERT_EQ(decoder.accept(entry_of(frame), heard), Taken::kMessage);
  ASSERT_NE(heard.message, nullptr);
  EXPECT_EQ(heard.message->name, "EarshotSpeedDepth");
  frame.data[0] = 0x3B;
  ASSERT_EQ(decoder.accept(entry_of(frame), heard), Taken::kMessage);
  EXPECT_EQ(heard.message, nullptr);
  EXPECT_EQ(heard.bytes, (std::vector<std::uint8_t>{0x3B, 0x9F, 0xC8, 0x00, 0x30, 0x75, 0x00, 0x00}));
  EXPECT_EQ(decoder.counters().unknown, 1U);
}

TEST(Decoder, TellsAnAbortFromTheFastPacketsThatShareItsNumber) {
  const n2k::Frame abort{.identifier = 0x0DEFFF23, .size = 8, .data = {0xFC, 0x9F, 0x03, 0x34, 0x12, 0x9A, 0x78, 0x56}};
  const n2k::Message& command = *n2k::find_message(126720, 1);
  n2k::MessageWriter writer(command);
  writer.set_raw("ManufacturerCode", 2044).set_raw("IndustryGroup", 4).set_raw("Kind", 1).set_raw("Order", 3);
  n2k::FastPacketFrames packet;
  ASSERT_EQ(n2k::compose_fast_packet(writer.identifier(0x23), 0, writer.bytes(), packet), Status::kOk);
  Decoder decoder;
  Heard heard;
  ASSERT_EQ(decoder.accept(entry_of(abort), heard), Taken::kMessage);
  EXPECT_EQ(heard.message->name, "EarshotAbort");
  auto taken = Taken::kNothingYet;
  for (const n2k::Frame& frame : packet) taken = decoder.accept(entry_of(frame), heard);
  ASSERT_EQ(taken, Taken::kMessage);
  EXPECT_EQ(heard.message->name, "EarshotCommand");
}

TEST(Decoder, TakesNoMoreInterfacesThanCandumpDoes) {
  Decoder decoder;
  Heard heard;
  for (int i = 0; i < 16; ++i) EXPECT_EQ(decoder.accept(entry_of(heading_from(1), 0, "can" + std::to_string(i)), heard), Taken::kMessage);
  EXPECT_EQ(decoder.accept(entry_of(heading_from(1), 0, "can16"), heard), Taken::kTooManyInterfaces);
  EXPECT_EQ(decoder.accept(entry_of(heading_from(1), 0, "can3"), heard), Taken::kMessage);
}

// Frames of noise, half of them with a known group, at any time: each is counted, and none is read beyond its bytes.
TEST(Decoder, OutlivesNoise) {
  std::mt19937_64 dice(3);
  Decoder decoder;
  Heard heard;
  for (int i = 0; i < 200'000; ++i) {
    LogEntry entry =
        entry_of({.identifier = static_cast<std::uint32_t>(dice()) & 0x1FFF'FFFFU, .size = static_cast<std::uint8_t>(dice() % 9)},
                 static_cast<std::int64_t>(dice() % 100'000));
    for (std::uint8_t& byte : entry.frame->data) byte = static_cast<std::uint8_t>(dice());
    const auto& message = n2k::messages()[dice() % n2k::messages().size()];
    const auto known = n2k::compose({message.pgn, 3, static_cast<std::uint8_t>(dice() % 4), n2k::kBroadcast});
    if (dice() % 2 == 0) entry.frame->identifier = known.value();
    if (message.framing == n2k::Framing::kFast && dice() % 2 == 0) entry.frame->data[0] = static_cast<std::uint8_t>(dice() % 4);
    if (dice() % 10 == 0) entry.time.reset();
    if (decoder.accept(entry, heard) != Taken::kMessage) continue;
    for (const Value& value : heard.values) ASSERT_FALSE(to_string(value).empty()) << value.name;
  }
  EXPECT_EQ(decoder.counters().frames, 200'000U);
  EXPECT_GT(decoder.counters().messages, 50'000U);
}

}  // namespace
}  // namespace earshot::hil
