#include "firmware/wire/lcm/hydrophone_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "tests/support/hydrophone_driver.hpp"

namespace earshot::wire {
namespace {

using Bytes = std::vector<std::uint8_t>;
using support::encoded;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Three samples of two channels.
hydrophone_block_t small_block() {
  hydrophone_block_t m;
  m.utime = 1'795'000'000'123'456;
  m.sequence = 77;
  m.first_sample = 123'456'789'012;
  m.sample_rate_hz = 44'100;
  m.gain_db = -6.5;
  m.overflow_count = 2;
  m.channels = 2;
  m.sample_count = 6;
  m.samples = {0.25F, -1.0F, 1e-30F, kNan, 0.0F, 1.0F};
  return m;
}

Status read(const Bytes& bytes) {
  HydrophoneMessage message;
  return read_hydrophone_block(bytes, message);
}

TEST(HydrophoneMessage, IsReadAsLcmGensOwnTypeWroteIt) {
  const Bytes bytes = encoded(small_block());
  HydrophoneMessage message;
  ASSERT_EQ(read_hydrophone_block(bytes, message), Status::kOk);
  EXPECT_EQ(message.block, (messages::HydrophoneBlock{.time = {1'795'000'000'123'456},
                                                      .sequence = 77,
                                                      .first_sample = 123'456'789'012,
                                                      .sample_rate = Hertz{44'100},
                                                      .gain = Decibels{-6.5},
                                                      .samples_per_channel = 3,
                                                      .overflow_count = 2,
                                                      .channels = 2}));
  std::vector<float> samples(message.sample_count());
  copy_samples(message, samples);
  const std::vector<float> expected = small_block().samples;
  ASSERT_EQ(samples.size(), expected.size());
  EXPECT_EQ(std::memcmp(samples.data(), expected.data(), expected.size() * sizeof(float)), 0) << "bit for bit, NaN too";
}

TEST(HydrophoneMessage, MayBeAsLargeAsAMessageIs) {
  hydrophone_block_t m = small_block();
  m.channels = 1;
  m.sample_count = (static_cast<std::int32_t>(config::kLcmMessageBytes) - 57) / 4;
  EXPECT_EQ(m.sample_count, 32'753) << "the number that hydrophone_block_t.lcm names";
  m.samples.assign(static_cast<std::size_t>(m.sample_count), 0.5F);
  EXPECT_EQ(read(encoded(m)), Status::kOk);
  ++m.sample_count;
  m.samples.push_back(0.5F);
  EXPECT_EQ(read(encoded(m)), Status::kMalformed);
}

struct Fault {
  const char* name;
  std::function<void(hydrophone_block_t&)> make;
};

class ImpossibleHydrophoneMessage : public testing::TestWithParam<Fault> {};

TEST_P(ImpossibleHydrophoneMessage, IsRefused) {
  hydrophone_block_t m = small_block();
  GetParam().make(m);
  EXPECT_EQ(read(encoded(m)), Status::kMalformed);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(Field, ImpossibleHydrophoneMessage,
                         testing::Values(Fault{"NoChannel", [](hydrophone_block_t& m) { m.channels = 0; }},
                                         Fault{"NegativeChannels", [](hydrophone_block_t& m) { m.channels = -2; }},
                                         Fault{"NineChannels",
                                               [](hydrophone_block_t& m) {
                                                 m.channels = 9;
                                                 m.sample_count = 9;
                                                 m.samples.resize(9);
                                               }},
                                         Fault{"ASampleThatNotEveryChannelHas", [](hydrophone_block_t& m) { m.channels = 4; }},
                                         Fault{"NoSamples",
                                               [](hydrophone_block_t& m) {
                                                 m.sample_count = 0;
                                                 m.overflow_count = 0;
                                                 m.samples.clear();
                                               }},
                                         Fault{"TooSlow", [](hydrophone_block_t& m) { m.sample_rate_hz = 249.9; }},
                                         Fault{"TooFast", [](hydrophone_block_t& m) { m.sample_rate_hz = 96'000.1; }},
                                         Fault{"RateNan", [](hydrophone_block_t& m) { m.sample_rate_hz = std::nan(""); }},
                                         Fault{"RateInfinite", [](hydrophone_block_t& m) { m.sample_rate_hz = kInfinity; }},
                                         Fault{"GainNan", [](hydrophone_block_t& m) { m.gain_db = std::nan(""); }},
                                         Fault{"GainTooHigh", [](hydrophone_block_t& m) { m.gain_db = 200.1; }},
                                         Fault{"GainTooLow", [](hydrophone_block_t& m) { m.gain_db = -200.1; }},
                                         Fault{"NegativeOverflow", [](hydrophone_block_t& m) { m.overflow_count = -1; }},
                                         Fault{"MoreOverflowThanSamples", [](hydrophone_block_t& m) { m.overflow_count = 7; }},
                                         Fault{"BeforeTheFirstSample", [](hydrophone_block_t& m) { m.first_sample = -1; }},
                                         Fault{"SampleCounterBeyondAllAges",
                                               [](hydrophone_block_t& m) { m.first_sample = (std::int64_t{1} << 53) + 1; }},
                                         Fault{"NegativeSequence", [](hydrophone_block_t& m) { m.sequence = -1; }},
                                         Fault{"BeforeUtcBegan", [](hydrophone_block_t& m) { m.utime = -1; }}),
                         [](const testing::TestParamInfo<Fault>& fault) { return std::string(fault.param.name); });

TEST(HydrophoneMessage, IsRefusedAtEveryLengthButItsOwn) {
  const Bytes bytes = encoded(small_block());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto exact = std::make_unique<std::uint8_t[]>(size);  // no byte beyond it to be read unseen
    std::copy_n(bytes.begin(), size, exact.get());
    HydrophoneMessage message;
    EXPECT_EQ(read_hydrophone_block({exact.get(), size}, message), Status::kMalformed) << size;
  }
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_EQ(read(longer), Status::kMalformed);
}

TEST(HydrophoneMessage, OfRandomlyDamagedBytesIsReadOnlyAsLcmGensOwnTypeReadsThem) {
  std::mt19937_64 random(20261122);
  const auto below = [&random](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
  const Bytes whole = encoded(small_block());
  int read_count = 0;
  for (int round = 0; round < 200'000; ++round) {
    Bytes bytes = whole;
    if (below(4) == 0) bytes.resize(below(2 * whole.size()));
    for (std::size_t hits = below(4); hits > 0 && !bytes.empty(); --hits) bytes[below(bytes.size())] = static_cast<std::uint8_t>(random());
    HydrophoneMessage message;
    if (read_hydrophone_block(bytes, message) != Status::kOk) continue;
    ++read_count;
    hydrophone_block_t other;
    ASSERT_EQ(other.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
    const messages::HydrophoneBlock& block = message.block;
    ASSERT_EQ(block.time.us, other.utime);
    ASSERT_EQ(block.sequence, other.sequence);
    ASSERT_EQ(block.first_sample, other.first_sample);
    ASSERT_EQ(block.sample_rate.value, other.sample_rate_hz);
    ASSERT_EQ(block.gain.value, other.gain_db);
    ASSERT_EQ(block.overflow_count, static_cast<std::uint32_t>(other.overflow_count));
    ASSERT_EQ(block.channels * block.samples_per_channel, static_cast<std::uint32_t>(other.sample_count));
    ASSERT_TRUE(block.channels >= 1 && block.channels <= 8 && block.sample_rate >= Hertz{250} && block.sample_rate <= Hertz{96'000});
    std::vector<float> samples(message.sample_count());
    copy_samples(message, samples);
    ASSERT_EQ(samples.size(), other.samples.size());
    ASSERT_EQ(std::memcmp(samples.data(), other.samples.data(), samples.size() * sizeof(float)), 0);
  }
  EXPECT_GT(read_count, 10'000) << "damage to samples and to most digits of a counter is no fault of the format";
}

}  // namespace
}  // namespace earshot::wire
