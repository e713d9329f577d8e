#include "sim/listening/stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "sim/listening/levels.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::listening {
namespace {

constexpr Wanted kWithLevels{.every_threshold = false, .spectrogram = false, .levels_interval_s = 10.0};
const recording::SoundFormat kFloat{.sample_rate = Hertz{1000}, .channels = 1, .bits = 24, .stored_bits = 32, .is_float = true};
const Progress kNobody = [](double) {};

/// Noise with a call of a second at 20 Hz every ten seconds.
std::vector<float> song(std::size_t seconds, double rate = 1000.0) {
  Pcg32 random(7);
  std::vector<float> samples(static_cast<std::size_t>(rate) * seconds);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i) / rate;
    const double call = std::fmod(t, 10.0) < 1.0 ? 0.2 * std::sin(2.0 * std::numbers::pi * 20.0 * t) : 0.0;
    samples[i] = static_cast<float>(call + 0.1 * (static_cast<double>(random.next()) / 4294967296.0 - 0.5));
  }
  return samples;
}

/// What there is to tell, in the order in which it was told.
struct Told {
  std::vector<double> rows;  ///< six numbers each
  std::vector<double> intervals_s;
  std::vector<float> levels;
  std::vector<float> percentiles;
  std::vector<double> end;

  void add(const std::vector<Row>& more) {
    for (const Row& row : more)
      for (const double number : {row.begin_s, row.duration_s, row.peak_s, row.level_db, row.snr_db, row.place.offset.to_seconds()})
        rows.push_back(number);
  }
  void add(const Levels& more) {
    intervals_s.insert(intervals_s.end(), more.begin_s.begin(), more.begin_s.end());
    levels.insert(levels.end(), more.level_db.begin(), more.level_db.end());
    percentiles.insert(percentiles.end(), more.level_percentile_db.begin(), more.level_percentile_db.end());
  }
  void add_end(const Heard& heard) {
    end = {heard.listened_s, heard.noise_db};
    for (const Heard::Obstacle& obstacle : heard.obstacles) end.push_back(obstacle.seconds);
  }
  friend bool operator==(const Told&, const Told&) = default;
};

Told of_file(const std::vector<float>& samples, double divisor = 1.0, std::uint32_t rate = 1000) {
  const support::TemporaryFolder folder;
  tests::write(folder / "a.wav",
               tests::WavBytes{.sample_rate = rate, .bits = 32, .format = 3, .samples = tests::float_samples(samples)}.bytes());
  Plan plan = plan_for(recording::Sequence({folder / "a.wav"}), {});
  plan.chain.divisor = divisor;
  const Heard heard = listen_to(plan, kWithLevels, kNobody);
  Told told;
  told.add(heard.rows);
  told.add(levels_of(*heard.levels, plan));
  told.add_end(heard);
  return told;
}

/// @param sizes  of the blocks, over and over
Told of_blocks(const std::vector<float>& samples, const std::vector<std::size_t>& sizes, double divisor = 1.0, double rate = 1000.0) {
  recording::SoundFormat format = kFloat;
  format.sample_rate = Hertz{rate};
  Plan plan = plan_for(sequence_of_samples(format, {}), {});
  plan.chain.divisor = divisor;
  Stream stream(std::move(plan), kWithLevels);
  Told told;
  std::size_t rows = 0;
  std::size_t intervals = 0;
  const auto tell = [&](const std::vector<Row>& more, const spectrum::BandLevels& levels) {
    told.add(more);
    rows += more.size();
    told.add(levels_of(levels, stream.plan(), intervals));
    intervals = levels.begins().size();
  };
  std::span<const float> left(samples);
  for (std::size_t i = 0; !left.empty(); ++i) {
    const std::size_t size = std::min(sizes[i % sizes.size()], left.size());
    stream.push(left.first(size), kNobody);
    left = left.subspan(size);
    tell(stream.listening().rows(rows), *stream.listening().levels());
  }
  const Heard heard = stream.finish(kNobody);
  tell({heard.rows.begin() + static_cast<std::ptrdiff_t>(rows), heard.rows.end()}, *heard.levels);
  told.add_end(heard);
  return told;
}

TEST(Stream, GivesTheSameBitsAsTheFileInBlocksOfAnySize) {
  const std::vector<float> samples = song(400);
  const Told whole = of_file(samples);
  ASSERT_EQ(whole.rows.size(), 6U * 40);
  ASSERT_EQ(whole.intervals_s.size(), 40U);
  EXPECT_EQ(of_blocks(samples, {samples.size()}), whole);
  EXPECT_EQ(of_blocks(samples, {1, 4096, 4095, 4097, 3, 0, 131'072, 500}), whole);
  EXPECT_EQ(of_blocks(samples, {997}), whole);
}

TEST(Stream, GivesTheSameBitsAsTheFileWhereTheNoiseIsKnownOnlyAtItsEnd) {
  for (const std::size_t seconds : {7U, 60U, 120U, 121U, 124U, 125U}) {
    const std::vector<float> samples = song(seconds);
    EXPECT_EQ(of_blocks(samples, {313}), of_file(samples)) << seconds << " s";
  }
}

TEST(Stream, GivesTheSameBitsAsTheFileThatIsDecimated) {
  const std::vector<float> samples = song(24, 200'000.0);
  EXPECT_EQ(of_blocks(samples, {70'001}, 1.0, 200'000.0), of_file(samples, 1.0, 200'000));
}

TEST(Stream, GivesTheSameBitsAsTheFileWhoseSamplesGoBeyondFullScale) {
  std::vector<float> samples = song(150);
  for (float& sample : samples) sample *= 1000.0F;
  const Told whole = of_file(samples, 512.0);
  EXPECT_EQ(of_blocks(samples, {1000}, 512.0), whole);
  EXPECT_EQ(whole.rows.size(), 6U * 15);
}

TEST(Stream, TellsADetectionSoonAfterItsEnd) {
  const std::vector<float> samples = song(200);
  Stream stream(plan_for(sequence_of_samples(kFloat, {}), {}), {});
  std::vector<std::size_t> told;  // by the second
  for (std::size_t second = 0; second < 200; ++second) {
    stream.push(std::span(samples).subspan(1000 * second, 1000), kNobody);
    told.push_back(stream.listening().rows().size());
  }
  EXPECT_EQ(told[119], 0U) << "two minutes of noise are not there yet";
  // The calls from 0 to 150 s are over at 151 s; the filters, a pause of 1.5 s and a piece of 4.1 s come before the row.
  EXPECT_EQ(told[159], 16U);
}

TEST(Stream, EndsWhereSomebodyWantsItTo) {
  Stream stream(plan_for(sequence_of_samples(kFloat, {}), {}), {});
  const std::vector<float> samples = song(200);
  EXPECT_THROW(stream.push(samples, [](double) { throw std::runtime_error("enough"); }), std::runtime_error);
}

TEST(Stream, RefusesASampleRateThatNoRecorderHasWithoutSearchingForItsDivisor) {
  for (const double rate : {1'000'001.0, 1e15, 9007199254740992.0, 9223372036854775808.0, 1e300}) {
    recording::SoundFormat format = kFloat;
    format.sample_rate = Hertz{rate};
    try {
      (void)plan_for(sequence_of_samples(format, {}), {});
      ADD_FAILURE() << rate;
    } catch (const host::BadInput& e) {
      EXPECT_TRUE(support::tells(e.what(), {"no more than 1000000 Hz"})) << e.what();
    }
  }
}

TEST(Stream, RefusesWhatIsTooShortByItsName) {
  for (const std::size_t count : {0U, 1000U}) {
    Stream stream(plan_for(sequence_of_samples(kFloat, {}), {}), {});
    stream.push(std::vector<float>(count, 0.1F), kNobody);
    try {
      (void)stream.finish(kNobody);
      ADD_FAILURE() << count;
    } catch (const host::BadInput& e) {
      EXPECT_TRUE(support::tells(e.what(), {"samples", "cannot be listened to"})) << e.what();
    }
  }
}

}  // namespace
}  // namespace earshot::listening
