#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include "firmware/wire/n2k/fast_packet.hpp"

namespace earshot::n2k {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The plain model: all frames of a sender since its last first frame. They are a message when they are its frames one after the other and
/// nothing else, no two over 750 ms apart; a frame that came twice in a row counts once.
class History {
 public:
  std::optional<Bytes> add(const Frame& frame, Time now) {
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
  Sender(std::mt19937& random, std::uint8_t source) : random_(random), identifier_{.pgn = kGnssPgn, .priority = 3, .source = source} {}

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

  std::mt19937& random_;
  Identifier identifier_;
  FastPacketFrames packet_;
  std::size_t at_ = 0;
  std::uint8_t sequence_ = 0;
};

TEST(FastPacketProperty, IsPutTogetherExactlyWhenAPlainModelSaysSo) {
  std::size_t completed = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<Sender> senders;
    for (std::uint8_t i = 0; i < config::kFastPacketSlots; ++i) senders.emplace_back(random, i);
    std::map<std::uint8_t, History> model;
    FastPacketAssembly assembly;
    Time now{1'000'000};
    for (int i = 0; i < 20'000; ++i) {
      Sender& sender = senders[random() % senders.size()];
      for (const Frame& frame : sender.next()) {
        const std::optional<Bytes> expected = model[sender.identifier().source].add(frame, now);
        Assembled message;
        const Status status = assembly.accept(sender.identifier(), frame, now, message);
        ASSERT_EQ(status == Status::kOk, expected.has_value()) << "seed " << seed << ", turn " << i;
        if (!expected) continue;
        ASSERT_EQ(Bytes(message.bytes.begin(), message.bytes.end()), *expected);
        ++completed;
      }
      now = now + Duration{static_cast<std::int64_t>(random() % 1000 == 0 ? random() % 1'500'000 : random() % 3'000)};
    }
  }
  EXPECT_GT(completed, 5'000U);
}

}  // namespace
}  // namespace earshot::n2k
