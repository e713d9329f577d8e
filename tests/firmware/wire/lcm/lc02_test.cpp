#include "firmware/wire/lcm/lc02.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace earshot::wire {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr Sender kAlice{0x0100007F, 1000};
constexpr Sender kBob{0x0100007F, 1001};

Bytes counting(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
  return bytes;
}

/// The datagrams of a message as they go over the wire.
std::vector<Bytes> datagrams_of(std::string_view channel, const Bytes& data, std::uint32_t sequence_number) {
  std::vector<Bytes> all;
  const Lc02Message message{channel, data};
  for (std::size_t i = 0; i < datagram_count(message); ++i) {
    Datagram datagram;
    EXPECT_EQ(compose(message, sequence_number, i, datagram), Status::kOk);
    Bytes bytes(datagram.head.begin(), datagram.head.begin() + static_cast<std::ptrdiff_t>(datagram.head_size));
    bytes.insert(bytes.end(), datagram.data.begin(), datagram.data.end());
    all.push_back(bytes);
  }
  return all;
}

void append_u32(Bytes& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

/// A fragment with any numbers in its header.
struct RawFragment {
  std::uint32_t sequence_number = 1;
  std::uint32_t size = 0;
  std::uint32_t offset = 0;
  std::uint16_t number = 0;
  std::uint16_t count = 0;
  std::string channel;
  Bytes data;

  [[nodiscard]] Bytes bytes() const {
    Bytes all;
    append_u32(all, 0x4c433033);
    append_u32(all, sequence_number);
    append_u32(all, size);
    append_u32(all, offset);
    append_u32(all, (std::uint32_t{number} << 16U) | count);
    if (number == 0) all.insert(all.end(), channel.begin(), channel.end());
    if (number == 0) all.push_back(0);
    all.insert(all.end(), data.begin(), data.end());
    return all;
  }
};

class Lc02 : public ::testing::Test {
 protected:
  Status accept(const Bytes& datagram, Sender sender = kAlice) { return reassembly_->accept(datagram, sender, message_); }
  [[nodiscard]] Bytes data() const { return {message_.data.begin(), message_.data.end()}; }

  std::unique_ptr<Reassembly> reassembly_ = std::make_unique<Reassembly>();
  Lc02Message message_;
};

TEST_F(Lc02, ComposesAShortMessageAsTheProtocolPrintsIt) {
  const auto all = datagrams_of("AB", {9, 8, 7}, 0x01020304);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0], (Bytes{'L', 'C', '0', '2', 1, 2, 3, 4, 'A', 'B', 0, 9, 8, 7}));
}

TEST_F(Lc02, ComposesTheSecondFragmentWhereTheFirstEnded) {
  const auto all = datagrams_of("AB", counting(70'000), 5);
  ASSERT_EQ(all.size(), 2U);
  // 70000 = 0x11170; fragment 0 holds 65487 - 3 = 65484 = 0xFFCC bytes of data after the channel and its zero.
  EXPECT_EQ(Bytes(all[1].begin(), all[1].begin() + 20),
            (Bytes{'L', 'C', '0', '3', 0, 0, 0, 5, 0, 1, 0x11, 0x70, 0, 0, 0xFF, 0xCC, 0, 1, 0, 2}));
  EXPECT_EQ(all[1].size(), 20U + 70'000U - 65'484U);
}

TEST_F(Lc02, FragmentsOnlyWhatDoesNotFitOneDatagram) {
  EXPECT_EQ(datagrams_of("A", counting(65'497), 1).size(), 1U);
  EXPECT_EQ(datagrams_of("A", counting(65'498), 1).size(), 2U);
}

TEST_F(Lc02, RefusesToSendWhatLcmCannotCarry) {
  const Bytes too_much(config::kLcmMessageBytes + 1);
  EXPECT_EQ(datagram_count({"A", too_much}), 0U);
  EXPECT_EQ(datagram_count({"", {}}), 0U);
  EXPECT_EQ(datagram_count({std::string(64, 'A'), {}}), 0U);
  EXPECT_EQ(datagram_count({std::string(63, 'A'), {}}), 1U);
  EXPECT_EQ(datagram_count({std::string_view("A\0B", 3), {}}), 0U);
}

TEST_F(Lc02, GivesBackAMessageOfAnySize) {
  for (const std::size_t size : {0UL, 1UL, 65'000UL, 65'498UL, 100'000UL, config::kLcmMessageBytes}) {
    const auto all = datagrams_of("CHANNEL", counting(size), 7);
    for (std::size_t i = 0; i + 1 < all.size(); ++i) EXPECT_EQ(accept(all[i]), Status::kNotReady);
    ASSERT_EQ(accept(all.back()), Status::kOk) << size;
    EXPECT_EQ(message_.channel, "CHANNEL");
    EXPECT_EQ(data(), counting(size));
  }
}

TEST_F(Lc02, PutsFragmentsTogetherInAnyOrderAndOnceOnly) {
  const auto all = datagrams_of("CHANNEL", counting(131'000), 7);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(accept(all[2]), Status::kNotReady);
  EXPECT_EQ(accept(all[2]), Status::kNotReady);
  EXPECT_EQ(accept(all[0]), Status::kNotReady);
  ASSERT_EQ(accept(all[1]), Status::kOk);
  EXPECT_EQ(data(), counting(131'000));
}

TEST_F(Lc02, KeepsTheFragmentsOfTwoSendersApartUnderTheSameNumber) {
  const auto of_alice = datagrams_of("A", counting(100'000), 7);
  const auto of_bob = datagrams_of("B", Bytes(100'000, 0xBB), 7);
  EXPECT_EQ(accept(of_alice[0], kAlice), Status::kNotReady);
  EXPECT_EQ(accept(of_bob[0], kBob), Status::kNotReady);
  ASSERT_EQ(accept(of_alice[1], kAlice), Status::kOk);
  EXPECT_EQ(data(), counting(100'000));
  ASSERT_EQ(accept(of_bob[1], kBob), Status::kOk);
  EXPECT_EQ(data(), Bytes(100'000, 0xBB));
}

TEST_F(Lc02, KeepsMessagesApartWhereTheirNumbersBeginAnew) {
  const auto last = datagrams_of("A", counting(100'000), 0xFFFFFFFF);
  const auto first = datagrams_of("B", Bytes(100'000, 0xBB), 0);
  EXPECT_EQ(Bytes(last[0].begin() + 4, last[0].begin() + 8), Bytes(4, 0xFF));
  EXPECT_EQ(accept(last[0]), Status::kNotReady);
  EXPECT_EQ(accept(first[0]), Status::kNotReady);
  ASSERT_EQ(accept(first[1]), Status::kOk);
  EXPECT_EQ(data(), Bytes(100'000, 0xBB));
  ASSERT_EQ(accept(last[1]), Status::kOk);
  EXPECT_EQ(data(), counting(100'000));
}

TEST_F(Lc02, GivesUpTheMessageThatWaitedLongestWhenAllSlotsAreTaken) {
  std::vector<std::vector<Bytes>> messages;
  for (std::uint32_t number = 0; number <= config::kLcmReassemblySlots; ++number)
    messages.push_back(datagrams_of("A", counting(100'000), number));
  for (const auto& message : messages) EXPECT_EQ(accept(message[0]), Status::kNotReady);
  EXPECT_EQ(reassembly_->counters().incomplete, 1U);
  EXPECT_EQ(accept(messages[1][1]), Status::kOk);        // the second oldest is still there
  EXPECT_EQ(accept(messages[0][1]), Status::kNotReady);  // the oldest is not: its second half starts anew
}

TEST_F(Lc02, DropsTruncatedHeadersAndUnknownMagics) {
  const Bytes whole = datagrams_of("A", counting(10), 1)[0];
  for (std::size_t size = 0; size < 10; ++size)
    EXPECT_EQ(accept(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), Status::kMalformed) << size;
  const Bytes fragment = datagrams_of("A", counting(100'000), 1)[0];
  for (std::size_t size = 0; size < 22; ++size)
    EXPECT_EQ(accept(Bytes(fragment.begin(), fragment.begin() + static_cast<std::ptrdiff_t>(size))), Status::kMalformed) << size;
  // The second fragment has no channel: its header alone is as short as it can be.
  const Bytes second = RawFragment{.size = 10, .offset = 0, .number = 1, .count = 2, .channel = {}, .data = {}}.bytes();
  ASSERT_EQ(second.size(), 20U);
  for (std::size_t size = 0; size < 20; ++size)
    EXPECT_EQ(accept(Bytes(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(size))), Status::kMalformed) << size;
  EXPECT_EQ(accept(second), Status::kNotReady);
  EXPECT_EQ(accept({'L', 'C', '0', '4', 0, 0, 0, 0, 'A', 0}), Status::kMalformed);
  EXPECT_EQ(reassembly_->counters().malformed, 10U + 22U + 20U + 1U);
}

TEST_F(Lc02, CountsEveryMessageThatItHandsOut) {
  EXPECT_EQ(accept(datagrams_of("A", counting(10), 1)[0]), Status::kOk);
  EXPECT_EQ(reassembly_->counters().completed, 1U);
  for (const Bytes& datagram : datagrams_of("A", counting(100'000), 2)) static_cast<void>(accept(datagram));
  EXPECT_EQ(reassembly_->counters().completed, 2U);
  EXPECT_EQ(reassembly_->counters().incomplete, 0U);
  EXPECT_EQ(reassembly_->counters().malformed, 0U);
  EXPECT_EQ(reassembly_->counters().too_large, 0U);
}

TEST_F(Lc02, GivesUpAMessageByWhenItsLastFragmentCameAndNotByWhenItBegan) {
  const auto fragment = [](std::uint32_t message, std::uint16_t number) {
    return RawFragment{
        .sequence_number = message, .size = 3, .offset = number, .number = number, .count = 3, .channel = "A", .data = Bytes(1, 7)}
        .bytes();
  };
  for (std::uint32_t message = 0; message < config::kLcmReassemblySlots; ++message)
    EXPECT_EQ(accept(fragment(message, 0)), Status::kNotReady);
  EXPECT_EQ(accept(fragment(0, 1)), Status::kNotReady);
  EXPECT_EQ(accept(fragment(100, 0)), Status::kNotReady) << "in the place of message 1, whose fragment is the oldest by now";
  EXPECT_EQ(accept(fragment(0, 2)), Status::kOk);
  EXPECT_EQ(accept(fragment(2, 1)), Status::kNotReady);
  EXPECT_EQ(accept(fragment(2, 2)), Status::kOk);
  EXPECT_EQ(reassembly_->counters().incomplete, 1U);
}

TEST_F(Lc02, TakesMessagesInUpTo256Fragments) {
  for (std::uint16_t number = 0; number < 256; ++number) {
    const RawFragment fragment{.size = 256, .offset = number, .number = number, .count = 256, .channel = "A", .data = Bytes(1, 7)};
    ASSERT_EQ(accept(fragment.bytes()), number < 255 ? Status::kNotReady : Status::kOk) << number;
  }
  EXPECT_EQ(data(), Bytes(256, 7));
  EXPECT_EQ(accept(RawFragment{.size = 257, .offset = 0, .number = 0, .count = 257, .channel = "A", .data = Bytes(1)}.bytes()),
            Status::kFull);
}

TEST_F(Lc02, DropsAChannelThatIsEmptyOrDoesNotEnd) {
  EXPECT_EQ(accept({'L', 'C', '0', '2', 0, 0, 0, 0, 0, 1, 2}), Status::kMalformed);
  Bytes endless{'L', 'C', '0', '2', 0, 0, 0, 0};
  endless.insert(endless.end(), 5000, 'A');
  EXPECT_EQ(accept(endless), Status::kMalformed);
  endless[8 + 64] = 0;  // 64 characters: one more than LCM allows
  EXPECT_EQ(accept(endless), Status::kMalformed);
  endless[8 + 63] = 0;
  EXPECT_EQ(accept(endless), Status::kOk);
}

TEST_F(Lc02, DropsFragmentsWhoseNumbersLie) {
  const Bytes ten(10);
  EXPECT_EQ(accept(RawFragment{.size = 10, .offset = 0, .number = 0, .count = 0, .channel = "A", .data = ten}.bytes()), Status::kMalformed);
  EXPECT_EQ(accept(RawFragment{.size = 10, .offset = 0, .number = 2, .count = 2, .channel = "A", .data = ten}.bytes()), Status::kMalformed);
  EXPECT_EQ(accept(RawFragment{.size = 9, .offset = 0, .number = 0, .count = 2, .channel = "A", .data = ten}.bytes()), Status::kMalformed);
  EXPECT_EQ(accept(RawFragment{.size = 100, .offset = 91, .number = 1, .count = 2, .channel = {}, .data = ten}.bytes()),
            Status::kMalformed);
  EXPECT_EQ(accept(RawFragment{.size = 100, .offset = 0xFFFFFFFB, .number = 1, .count = 2, .channel = {}, .data = ten}.bytes()),
            Status::kMalformed);
}

TEST_F(Lc02, RefusesFourGigabytesAndSixtyThousandFragmentsAsTooLarge) {
  EXPECT_EQ(accept(RawFragment{.size = 0xFFFFFFFF, .offset = 0, .number = 0, .count = 2, .channel = "A", .data = Bytes(10)}.bytes()),
            Status::kFull);
  EXPECT_EQ(accept(RawFragment{.size = 100, .offset = 0, .number = 0, .count = 65'535, .channel = "A", .data = Bytes(10)}.bytes()),
            Status::kFull);
  EXPECT_EQ(reassembly_->counters().too_large, 2U);
}

TEST_F(Lc02, DropsFragmentsThatContradictTheFirstAndStillCompletesIt) {
  EXPECT_EQ(accept(RawFragment{.size = 20, .offset = 0, .number = 0, .count = 2, .channel = "A", .data = Bytes(10, 1)}.bytes()),
            Status::kNotReady);
  EXPECT_EQ(accept(RawFragment{.size = 30, .offset = 10, .number = 1, .count = 2, .channel = {}, .data = Bytes(20, 9)}.bytes()),
            Status::kMalformed);
  EXPECT_EQ(accept(RawFragment{.size = 20, .offset = 10, .number = 1, .count = 3, .channel = {}, .data = Bytes(10, 9)}.bytes()),
            Status::kMalformed);
  ASSERT_EQ(accept(RawFragment{.size = 20, .offset = 10, .number = 1, .count = 2, .channel = {}, .data = Bytes(10, 2)}.bytes()),
            Status::kOk);
  EXPECT_EQ(message_.data[9], 1);
  EXPECT_EQ(message_.data[10], 2);
}

TEST_F(Lc02, NeverHandsOutAMessageWithAHoleInIt) {
  EXPECT_EQ(accept(RawFragment{.size = 20, .offset = 0, .number = 0, .count = 2, .channel = "A", .data = Bytes(10)}.bytes()),
            Status::kNotReady);
  EXPECT_EQ(accept(RawFragment{.size = 20, .offset = 5, .number = 1, .count = 2, .channel = {}, .data = Bytes(10)}.bytes()),
            Status::kMalformed)
      << "20 bytes came, but the last five of the message are not among them";
}

TEST_F(Lc02, SurvivesAMillionRandomAndMangledDatagramsAndStillReceives) {
  std::mt19937 random(1);
  const auto short_message = datagrams_of("EARSHOT_NAV_STATE", counting(56), 1)[0];
  const auto fragments = datagrams_of("EARSHOT_NAV_STATE", counting(66'000), 1);
  const Bytes small_fragment = RawFragment{.size = 40, .offset = 20, .number = 1, .count = 2, .channel = {}, .data = Bytes(20)}.bytes();
  for (int i = 0; i < 1'000'000; ++i) {
    Bytes datagram = i % 3 == 0 ? short_message : i % 3 == 1 ? small_fragment : Bytes(random() % 100);
    if (i % 3 == 2) std::ranges::generate(datagram, [&] { return static_cast<std::uint8_t>(random()); });
    for (unsigned flips = random() % 4; flips > 0 && !datagram.empty(); --flips)
      datagram[random() % datagram.size()] = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) datagram.resize(random() % (datagram.size() + 1));
    if (accept(datagram, Sender{static_cast<std::uint32_t>(random() % 3), 1}) == Status::kOk) {
      ASSERT_LE(message_.channel.size(), kMaxChannelLength);
      ASSERT_LE(message_.data.size(), config::kLcmMessageBytes);
      static_cast<void>(std::accumulate(message_.data.begin(), message_.data.end(), 0U));  // AddressSanitizer looks at every byte
    }
  }
  EXPECT_EQ(accept(fragments[0]), Status::kNotReady);
  ASSERT_EQ(accept(fragments[1]), Status::kOk);
  EXPECT_EQ(data(), counting(66'000));
}

}  // namespace
}  // namespace earshot::wire
