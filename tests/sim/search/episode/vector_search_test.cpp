#include "sim/search/episode/vector_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <vector>

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;  // NOLINT: the counting allocator itself
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}  // NOLINT
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}  // NOLINT

namespace earshot::search {
namespace {

const policy::OceanTables kNoOceans;

class VectorSearchTest : public testing::Test {
 protected:
  VectorSearchTest() { settings.placement = SourcePlacement::kChanging; }

  sonar::SnrCurve curve{Meters{1'000.0}, std::vector<float>{30.0F, 25.0F, 20.0F, 15.0F, 10.0F, 5.0F, 0.0F}};
  SearchSettings settings;
  policy::ObservationModel model{.spec = policy::memory_state(2, Meters{1'000.0}, Decibels{10.0}).value(), .belief = {}};
};

TEST_F(VectorSearchTest, AllocatesNothingWhileStepping) {
  const World world(settings, curve);
  VectorSearch search(world, model, kNoOceans, 16, 1);
  std::array<std::size_t, 16> actions{};
  Pcg32 random(3);
  const std::size_t before = allocations;
  for (int i = 0; i < 2'000; ++i) {
    for (std::size_t& action : actions) action = random.next() % 8;
    search.step(actions);
  }
  EXPECT_EQ(allocations - before, 0U);
  { const std::vector<float> control(1); }
  EXPECT_EQ(allocations - before, 1U) << "the counting allocator does not count";
}

TEST_F(VectorSearchTest, GivesTheSameEpisodesForTheSameSeedAndOthersForAnother) {
  const World world(settings, curve);
  auto fly = [&](std::uint64_t seed) {
    VectorSearch search(world, model, kNoOceans, 3, seed);
    std::vector<float> seen;
    for (std::size_t i = 0; i < 300; ++i) {
      search.step(std::array<std::size_t, 3>{i % 8, (3 * i) % 8, (5 * i) % 8});
      for (std::size_t e = 0; e < 3; ++e) {
        seen.insert(seen.end(), search.observation(e).begin(), search.observation(e).end());
        seen.push_back(search.reward(e));
      }
    }
    return seen;
  };
  EXPECT_EQ(fly(1), fly(1));
  EXPECT_NE(fly(1), fly(2));
}

TEST_F(VectorSearchTest, FliesAnEnvironmentsEpisodesAlikeHoweverManyOthersRunBesideIt) {
  const World world(settings, curve);
  VectorSearch alone(world, model, kNoOceans, 1, 9);
  VectorSearch among(world, model, kNoOceans, 4, 9);
  for (std::size_t i = 0; i < 500; ++i) {
    alone.step(std::array<std::size_t, 1>{i % 8});
    among.step(std::array<std::size_t, 4>{i % 8, 0, 1, 2});
    ASSERT_EQ(alone.reward(0), among.reward(0));
  }
}

TEST_F(VectorSearchTest, FliesEachEnvironmentAsAnEpisodeWithAStreamOfItsOwn) {
  const World world(settings, curve);
  constexpr std::size_t kCount = 3;
  for (const std::uint64_t first_stream : {0U, 7U}) {
    VectorSearch search = first_stream == 0 ? VectorSearch(world, model, kNoOceans, kCount, 9)
                                            : VectorSearch(world, model, kNoOceans, kCount, 9, first_stream);
    std::vector<Pcg32> random;
    std::vector<Episode> episodes(kCount);
    std::array<float, 6> seen{};
    for (std::size_t e = 0; e < kCount; ++e) {
      random.emplace_back(9, first_stream + e);
      episodes[e].start(world, model, kNoOceans, random[e]);
      episodes[e].observe(seen);
      ASSERT_TRUE(std::ranges::equal(search.observation(e), seen)) << e;
    }
    EXPECT_EQ(search.environment_count(), kCount);
    int ended = 0;
    for (std::size_t t = 0; t < 400; ++t) {
      const std::array<std::size_t, kCount> actions{t % 8, (3 * t) % 8, (5 * t) % 8};
      search.step(actions);
      for (std::size_t e = 0; e < kCount; ++e) {
        ASSERT_EQ(search.reward(e), static_cast<float>(episodes[e].step(world, actions[e])));
        ASSERT_EQ(search.ended(e).end, episodes[e].record().end);
        if (search.ended(e).end != EpisodeEnd::kRunning) {
          ++ended;
          episodes[e].observe(seen);
          ASSERT_TRUE(std::ranges::equal(search.final_observation(e), seen));
          episodes[e].start(world, model, kNoOceans, random[e]);
        }
        episodes[e].observe(seen);
        ASSERT_TRUE(std::ranges::equal(search.observation(e), seen));
      }
    }
    EXPECT_GT(ended, 5);
  }
}

/// Three oceans, one 20 dB louder than the next, and pauses in the last.
class SeveralWorlds : public VectorSearchTest {
 protected:
  static sonar::SnrCurve louder(float by_db) {
    return sonar::SnrCurve(Meters{1'000.0}, std::vector<float>{by_db + 30.0F, by_db + 20.0F, by_db + 10.0F, by_db});
  }
  [[nodiscard]] std::vector<World> worlds() const {
    Conditions pauses;
    pauses.floor = Decibels{0.0};
    pauses.calls = CallPattern{.interval_s = 10.0, .song_s = 500.0, .pause_s = 500.0, .listening_s = 10.0};
    return {World(settings, louder(0.0F)), World(settings, louder(20.0F)), World(settings, Soundscape({louder(40.0F)}), pauses)};
  }
};

TEST_F(SeveralWorlds, AreDrawnForEveryEpisodeFromItsEnvironmentsOwnStreamBeforeItsStart) {
  settings.max_steps = 5;
  const std::vector<World> all = worlds();
  constexpr std::size_t kCount = 3;
  VectorSearch search(all, model, kNoOceans, kCount, 9, 4);
  std::vector<Pcg32> random;
  std::vector<Episode> episodes(kCount);
  std::array<std::size_t, kCount> in{};
  std::array<std::size_t, 3> met{};
  const auto start = [&](std::size_t e) {
    in[e] = random[e].next() % all.size();
    ++met[in[e]];
    episodes[e].start(all[in[e]], model, kNoOceans, random[e]);
  };
  for (std::size_t e = 0; e < kCount; ++e) {
    random.emplace_back(9, 4 + e);
    start(e);
  }
  std::array<float, 6> seen{};
  for (std::size_t t = 0; t < 1'000; ++t) {
    const std::array<std::size_t, kCount> actions{t % 8, (3 * t) % 8, (5 * t) % 8};
    search.step(actions);
    for (std::size_t e = 0; e < kCount; ++e) {
      ASSERT_EQ(search.reward(e), static_cast<float>(episodes[e].step(all[in[e]], actions[e])));
      if (episodes[e].record().end != EpisodeEnd::kRunning) start(e);
      ASSERT_EQ(search.world_of(e), in[e]);
      episodes[e].observe(seen);
      ASSERT_TRUE(std::ranges::equal(search.observation(e), seen));
    }
  }
  const auto episodes_begun = static_cast<double>(met[0] + met[1] + met[2]);
  EXPECT_GT(episodes_begun, 600.0);
  // Each a third of them; four standard deviations of a binomial draw.
  for (const std::size_t times : met)
    EXPECT_NEAR(static_cast<double>(times), episodes_begun / 3.0, 4.0 * std::sqrt(episodes_begun * 2.0 / 9.0));
}

TEST_F(SeveralWorlds, AreThoseOfBeforeWhereASearchGoesOnFromItsScripts) {
  settings.max_steps = 7;
  const std::vector<World> all = worlds();
  VectorSearch uninterrupted(all, model, kNoOceans, 5, 3);
  const auto step = [](VectorSearch& environments, std::size_t t) {
    std::array<std::size_t, 5> actions{};
    for (std::size_t e = 0; e < actions.size(); ++e) actions[e] = (3 * t + e) % 8;
    environments.step(actions);
  };
  for (std::size_t t = 0; t < 24; ++t) step(uninterrupted, t);
  VectorSearch resumed(all, model, kNoOceans, 5, 99);
  ASSERT_TRUE(resumed.resume(uninterrupted.scripts()));
  for (std::size_t t = 24; t < 60; ++t) {
    for (std::size_t e = 0; e < 5; ++e) {
      ASSERT_EQ(resumed.world_of(e), uninterrupted.world_of(e));
      ASSERT_TRUE(std::ranges::equal(resumed.observation(e), uninterrupted.observation(e)));
    }
    step(uninterrupted, t);
    step(resumed, t);
  }
}

TEST_F(VectorSearchTest, DoesNotGoOnFromScriptsThatAreNotOfItsEpisodes) {
  settings.max_steps = 4;
  settings.placement = SourcePlacement::kFixed;
  settings.source = {Meters{1'000.0}, Meters{1'000.0}};
  settings.start_region = {{Meters{10'000.0}, Meters{10'000.0}}, {Meters{12'000.0}, Meters{12'000.0}}};
  const World world(settings, curve);
  const VectorSearch whole(world, model, kNoOceans, 2, 3);
  const auto goes_on = [&](std::vector<EpisodeScript> scripts, std::vector<std::uint8_t> actions) {
    VectorSearch resumed(world, model, kNoOceans, 2, 99);
    scripts.back().actions = std::move(actions);
    return resumed.resume(scripts);
  };
  EXPECT_TRUE(goes_on(whole.scripts(), {0, 7, 0}));
  EXPECT_FALSE(goes_on(whole.scripts(), {0, 8, 0})) << "there are eight directions, from 0";
  EXPECT_FALSE(goes_on(whole.scripts(), {0, 0, 0, 0})) << "its last step ended it";
  EXPECT_FALSE(goes_on(whole.scripts(), {0, 0, 0, 0, 0})) << "it goes on after its end";
  EXPECT_FALSE(goes_on({whole.scripts()[0]}, {})) << "one script for two environments";
}

TEST_F(VectorSearchTest, StartsAnewInTheStepThatEndsAnEpisodeAndKeepsItsLastObservation) {
  settings.max_steps = 3;
  settings.border_width = Meters{1.0};
  settings.start_region = {{Meters{5'000.0}, Meters{5'000.0}}, {Meters{20'000.0}, Meters{20'000.0}}};
  settings.placement = SourcePlacement::kFixed;
  settings.source = {Meters{1'000.0}, Meters{1'000.0}};
  const World world(settings, curve);
  VectorSearch search(world, model, kNoOceans, 1, 1);
  const std::array<std::size_t, 1> north{0};
  search.step(north);
  search.step(north);
  EXPECT_EQ(search.ended(0).end, EpisodeEnd::kRunning);
  EXPECT_EQ(search.observation(0)[1], 1.0F);  // went north by one step length
  search.step(north);
  EXPECT_EQ(search.ended(0).end, EpisodeEnd::kTimeLimit);
  EXPECT_EQ(search.ended(0).steps, 3U);
  EXPECT_EQ(search.final_observation(0)[1], 1.0F);
  EXPECT_EQ(search.observation(0)[1], 0.0F) << "the new episode remembers no step";
  search.step(north);
  EXPECT_EQ(search.ended(0).end, EpisodeEnd::kRunning);
}

TEST_F(VectorSearchTest, GoesOnFromItsScriptsAsIfNothingHadHappened) {
  settings.max_steps = 7;  // some episodes have just begun, others not
  const World world(settings, curve);
  VectorSearch uninterrupted(world, model, kNoOceans, 5, 3);
  std::vector<std::size_t> actions(5);
  auto step = [&actions](VectorSearch& environments, std::size_t t) {
    for (std::size_t e = 0; e < actions.size(); ++e) actions[e] = (3 * t + e) % 8;
    environments.step(actions);
  };
  for (std::size_t t = 0; t < 24; ++t) step(uninterrupted, t);
  VectorSearch resumed(world, model, kNoOceans, 5, 99);
  ASSERT_TRUE(resumed.resume(uninterrupted.scripts()));
  for (std::size_t t = 24; t < 60; ++t) {
    for (std::size_t e = 0; e < actions.size(); ++e) ASSERT_TRUE(std::ranges::equal(resumed.observation(e), uninterrupted.observation(e)));
    step(uninterrupted, t);
    step(resumed, t);
    for (std::size_t e = 0; e < actions.size(); ++e) {
      ASSERT_EQ(resumed.reward(e), uninterrupted.reward(e));
      ASSERT_EQ(resumed.ended(e).end, uninterrupted.ended(e).end);
      ASSERT_EQ(resumed.ended(e).reward, uninterrupted.ended(e).reward);
    }
  }
}

}  // namespace
}  // namespace earshot::search
