#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::n2k {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The plain model: all frames of a sender since its last first frame. They are a message when they are its frames one after the other and
/// nothing else, no two over 750 ms apart; a frame that came twice in a row counts once, and one of less than eight bytes not at all.
class History {
 public:
  std::optional<Bytes> add(const Frame& frame, Time now) {
    if (frame.size != 8) return std::nullopt;  // nobody's
    const bool first = (frame.data[0] & 0x1FU) == 0;
    if (first) {
      frames_.clear();
      broken_ = false;
    } else if (frames_.empty() || now - last_ > Duration::milliseconds(750)) {
      broken_ = true;
    } else if (frames_.size() > 1 && frames_.back() == frame) {
      return std::nullopt;
    }
    frames_.push_back(frame);
    last_ = now;
    const std::optional<Bytes> message = broken_ ? std::nullopt : whole();
    if (message) frames_.clear();
    return message;
  }

 private:
  [[nodiscard]] std::optional<Bytes> whole() {
    const std::size_t size = frames_[0].data[1];
    Bytes bytes;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (frames_[i].data[0] != ((frames_[0].data[0] & 0xE0U) | i)) broken_ = true;
      bytes.insert(bytes.end(), frames_[i].data.begin() + (i == 0 ? 2 : 1), frames_[i].data.end());
    }
    if (broken_ || size == 0 || size > 223 || bytes.size() < size) return std::nullopt;
    bytes.resize(size);
    return bytes;
  }

  std::vector<Frame> frames_;
  Time last_;
  bool broken_ = false;
};

/// Sends messages as a bad bus would deliver them.
class Sender {
 public:
  Sender(std::mt19937& random, const Identifier& identifier) : random_(random), identifier_(identifier) {}

  [[nodiscard]] const Identifier& identifier() const { return identifier_; }

  std::vector<Frame> next() {
    if (at_ >= packet_.size()) begin();
    Frame frame = packet_[at_++];
    const auto chance = random_() % 200;
    if (chance < 3) return {};                                                       // lost
    if (chance < 6) return {frame, frame};                                           // repeated
    if (chance == 6) frame.data[0] = static_cast<std::uint8_t>(frame.data[0] + 32);  // another sequence
    if (chance == 7) frame.data[0] = static_cast<std::uint8_t>(random_());           // any frame of any message
    if (chance == 8) at_ = 0;                                                        // from the beginning
    if (chance == 9) return {frame, swapped(frame)};                                 // repeated with another content
    if (chance == 10) return {cut(frame, random_() % 8), frame};                     // cut short, then whole
    if (chance == 11) return {cut(frame, random_() % 8)};                            // lost but for its beginning
    if (chance == 12 && at_ < packet_.size()) return {packet_[at_++], frame};        // after the one behind it
    return {frame};
  }

 private:
  void begin() {
    Bytes bytes(1 + random_() % 223);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    EXPECT_EQ(compose_fast_packet(identifier_, sequence_++, bytes, packet_), Status::kOk);
    if (random_() % 20 == 0) packet_[0].data[1] = static_cast<std::uint8_t>(random_());
    at_ = 0;
  }
  static Frame swapped(Frame frame) {
    frame.data[7] ^= 1U;
    return frame;
  }

  static Frame cut(Frame frame, std::size_t size) {
    frame.size = static_cast<std::uint8_t>(size);
    return frame;
  }

  std::mt19937& random_;
  Identifier identifier_;
  FastPacketFrames packet_;
  std::size_t at_ = 0;
  std::uint8_t sequence_ = 0;
};

/// Messages under way side by side differ in their sender, their group, or whom they are for.
Identifier identifier_of(std::size_t number) {
  const auto source = static_cast<std::uint8_t>(number / 3);
  if (number % 3 == 0) return {.pgn = kGnssPgn, .priority = 3, .source = source};
  return {.pgn = kPeerPgn, .priority = 3, .source = source, .destination = static_cast<std::uint8_t>(0x40 + number % 3)};
}

/// What some senders' frames become, as the assembly has it and as the plain model does.
struct Outcome {
  std::size_t expected = 0;
  std::size_t completed = 0;
  std::size_t wrong = 0;  ///< completed where the model has none, or other bytes
  FastPacketCounters counters;
};

Outcome outcome_of(std::uint32_t seed, std::size_t sender_count) {
  std::mt19937 random(seed);
  std::vector<Sender> senders;
  for (std::size_t i = 0; i < sender_count; ++i) senders.emplace_back(random, identifier_of(i));
  std::vector<History> model(sender_count);
  FastPacketAssembly assembly;
  Time now{1'000'000};
  Outcome outcome;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t which = random() % senders.size();
    for (const Frame& frame : senders[which].next()) {
      const std::optional<Bytes> expected = model[which].add(frame, now);
      Assembled message;
      const bool is_whole = assembly.accept(senders[which].identifier(), frame, now, message) == Status::kOk;
      const bool is_right = is_whole && expected == Bytes(message.bytes.begin(), message.bytes.end());
      outcome.expected += expected ? 1 : 0;
      outcome.completed += is_whole ? 1 : 0;
      outcome.wrong += is_whole && !is_right ? 1 : 0;
    }
    now = now + Duration{static_cast<std::int64_t>(random() % 1000 == 0 ? random() % 1'500'000 : random() % 3'000)};
  }
  outcome.counters = assembly.counters();
  return outcome;
}

TEST(FastPacketProperty, IsPutTogetherExactlyWhenAPlainModelSaysSo) {
  std::size_t completed = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Outcome outcome = outcome_of(seed, config::kFastPacketSlots);
    ASSERT_EQ(outcome.wrong, 0U) << "seed " << seed;
    ASSERT_EQ(outcome.completed, outcome.expected) << "seed " << seed;
    ASSERT_EQ(outcome.completed, outcome.counters.completed) << "seed " << seed;
    completed += outcome.completed;
  }
  EXPECT_GT(completed, 5'000U);
}

TEST(FastPacketProperty, IsNeverPutTogetherWronglyThoughMoreSendThanThereAreSlots) {
  std::size_t completed = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const Outcome outcome = outcome_of(seed, config::kFastPacketSlots + 4);
    ASSERT_EQ(outcome.wrong, 0U) << "seed " << seed;
    ASSERT_LT(outcome.completed, outcome.expected) << "nothing was given up, seed " << seed;
    ASSERT_LE(outcome.expected - outcome.completed, outcome.counters.abandoned) << "seed " << seed;
    completed += outcome.completed;
  }
  EXPECT_GT(completed, 500U);
}

}  // namespace
}  // namespace earshot::n2k
