#include "policy/evaluate/evaluation.hpp"
#include "sim/search/actions/compass_directions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "policy/baselines/learned.hpp"
#include "sim/search/episode/vector_search.hpp"

namespace earshot::evaluate {
namespace {

using search::EpisodeEnd;
using search::EpisodeRecord;

const policy::OceanTables kNoOceans;  // a policy that sees no belief needs none

TEST(Quantile, InterpolatesBetweenOrderStatisticsAsNumPyDoes) {
  // numpy.quantile([4, 1, 3, 2], [0, 0.25, 0.5, 0.75, 1]) = [1, 1.75, 2.5, 3.25, 4]
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.25), 1.75);
  EXPECT_EQ(quantile(values, 0.5), 2.5);
  EXPECT_EQ(quantile(values, 0.75), 3.25);
  EXPECT_EQ(quantile(values, 1.0), 4.0);
}

TEST(Summary, CountsEndsAndAveragesRewardStepsAndDetections) {
  const std::array<EpisodeRecord, 4> records{{{-1.0, 10, 4, EpisodeEnd::kFound},
                                              {-2.0, 20, 0, EpisodeEnd::kLeftDomain},
                                              {-3.0, 30, 8, EpisodeEnd::kFound},
                                              {-10.0, 100, 4, EpisodeEnd::kTimeLimit}}};
  const Summary s = summarise(records);
  EXPECT_EQ(s.episodes, 4U);
  EXPECT_DOUBLE_EQ(s.mean_reward, -4.0);
  EXPECT_DOUBLE_EQ(s.median_reward, -2.5);
  EXPECT_EQ(s.found, 2U);
  EXPECT_DOUBLE_EQ(s.found_fraction, 0.5);
  EXPECT_DOUBLE_EQ(s.left_domain_fraction, 0.25);
  EXPECT_DOUBLE_EQ(s.mean_steps, 40.0);
  EXPECT_DOUBLE_EQ(s.mean_detections, 4.0);
}

std::vector<Flight> mismatched_after(const std::vector<double>& measurements) {
  std::vector<Flight> flights(measurements.size());
  for (std::size_t i = 0; i < measurements.size(); ++i) flights[i].measurements_to_mismatch = measurements[i];
  return flights;
}

TEST(Mismatches, AreTheShareOfTheSearchesAndTheMedianMeasurementOfThoseOnly) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Mismatches some = mismatches(mismatched_after({kNever, 9.0, 4.0, kNever, kNever, 20.0, kNever, kNever}));
  EXPECT_EQ(some.fraction, 0.375);
  EXPECT_EQ(some.median_measurement, 9.0);
  const Mismatches none = mismatches(mismatched_after({kNever, kNever}));
  EXPECT_EQ(none.fraction, 0.0);
  EXPECT_TRUE(std::isnan(none.median_measurement));
  EXPECT_TRUE(std::isnan(mismatches(std::vector<Flight>(3)).fraction)) << "of a searcher that does not judge it";
}

/// Goes north; has a mismatch from one measurement on.
class MismatchedFrom : public baselines::Searcher {
 public:
  explicit MismatchedFrom(std::size_t measurement) : measurement_(measurement) {}
  void begin(Pcg32 /*random*/) override { measurements_ = 0; }
  [[nodiscard]] std::size_t choose(const baselines::DecisionInput& /*input*/) override {
    ++measurements_;
    return 0;
  }
  [[nodiscard]] std::optional<bool> is_mismatched() const override { return measurements_ >= measurement_; }

 private:
  std::size_t measurement_;
  std::size_t measurements_ = 0;
};

TEST(Fly, NotesTheFirstMeasurementThatIsAMismatch) {
  search::SearchSettings settings;
  settings.direction_count = 4;
  const sonar::SnrCurve curve(Meters{100.0}, {0.0F});
  const search::World world(settings, curve);
  constexpr double kNever = std::numeric_limits<double>::infinity();
  MismatchedFrom third(3);
  for (const Flight& flight : fly(third, world, {.end = 5}, 1))
    EXPECT_EQ(flight.measurements_to_mismatch, flight.record.steps < 3 ? kNever : 3.0);
  MismatchedFrom never(1'000);
  for (const Flight& flight : fly(never, world, {.end = 5}, 1)) EXPECT_EQ(flight.measurements_to_mismatch, kNever);
}

/// A policy that goes north (action 0) by a margin of logits: others have logit 0.
std::unique_ptr<policy::FrozenPolicy> goes_north(float margin) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->observation.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}});
  policy->actions = search::compass_directions(4);
  policy->step_length = Meters{1'000.0};
  policy->area_size = {Meters{25'000.0}, Meters{25'000.0}};
  policy->detection_threshold = Decibels{10.0};
  policy->draw = policy::ActionDraw::kArgmax;
  policy->network.observation_size = 2;
  policy->network.hidden_sizes = {1, 1};
  policy->network.action_count = 4;
  policy->network.layer(2).bias[0] = margin;
  return policy;
}

/// Starts on a line 5 to 6 km south of the source and at most 900 m to its side: due north finds it.
search::SearchSettings south_of_the_source(const policy::FrozenPolicy& policy) {
  search::SearchSettings settings = search_of(policy);
  settings.start_region = {{Meters{4'000.0}, Meters{9'100.0}}, {Meters{5'000.0}, Meters{10'900.0}}};
  return settings;
}

class EvaluateTest : public testing::Test {
 protected:
  sonar::SnrCurve curve{Meters{1'000.0}, std::vector<float>(40, 20.0F)};
};

TEST(SearchOf, IsInTheAreaAndWithTheThresholdThePolicyWasTrainedWith) {
  const auto policy = goes_north(1.0F);
  policy->area_size = {Meters{40'000.0}, Meters{50'000.0}};
  policy->detection_threshold = Decibels{12.0};
  policy->observation.listening = {config::Listening::kMean, Duration::seconds(30)};
  const search::SearchSettings settings = search_of(*policy);
  EXPECT_EQ(settings.domain.south_west, (NorthEast{}));
  EXPECT_EQ(settings.domain.north_east, (NorthEast{Meters{40'000.0}, Meters{50'000.0}}));
  EXPECT_EQ(settings.start_region.north_east, settings.domain.north_east);
  EXPECT_EQ(settings.detection_threshold, Decibels{12.0});
  EXPECT_EQ(settings.listening, policy->observation.listening);
  EXPECT_EQ(settings.direction_count, 4U);
  EXPECT_EQ(search::check(settings), Status::kOk);
}

TEST_F(EvaluateTest, FliesThePolicysActionsWithItsOwnStepLength) {
  const auto policy = goes_north(1.0F);
  policy->step_length = Meters{1'500.0};
  const auto records = evaluate(*policy, kNoOceans, policy->draw, world_of(*policy, south_of_the_source(*policy), curve), 20, 1);
  for (const EpisodeRecord& record : records) {
    EXPECT_EQ(record.end, EpisodeEnd::kFound);
    EXPECT_LE(record.steps, 4U);  // 5 to 6 km in steps of 1.5 km, to within 1.5 km
    EXPECT_GE(record.steps, 3U);
  }
}

TEST_F(EvaluateTest, GivesTheSameEpisodesForTheSameSeedAndTheSameStartsForEveryPolicy) {
  const auto north = goes_north(0.5F);
  const auto world = world_of(*north, south_of_the_source(*north), curve);
  auto rewards = [&](const policy::FrozenPolicy& policy, policy::ActionDraw draw, std::uint64_t seed) {
    std::vector<std::uint32_t> steps;
    for (const EpisodeRecord& record : evaluate(policy, kNoOceans, draw, world, 30, seed)) steps.push_back(record.steps);
    return steps;
  };
  EXPECT_EQ(rewards(*north, policy::ActionDraw::kSampled, 1), rewards(*north, policy::ActionDraw::kSampled, 1));
  EXPECT_NE(rewards(*north, policy::ActionDraw::kSampled, 1), rewards(*north, policy::ActionDraw::kSampled, 2));
  EXPECT_NE(rewards(*north, policy::ActionDraw::kSampled, 1), rewards(*north, policy::ActionDraw::kArgmax, 1));
  EXPECT_EQ(rewards(*north, policy::ActionDraw::kArgmax, 1), rewards(*goes_north(9.0F), policy::ActionDraw::kArgmax, 1));
}

/// Where an episode begins: its start, then its source.
using Beginning = std::array<double, 4>;

Beginning beginning_of(const search::Episode& episode) {
  return {episode.position().north.value, episode.position().east.value, episode.source().north.value, episode.source().east.value};
}

TEST_F(EvaluateTest, FliesNoSearchThatATrainingOfTheSameSeedBeginsWith) {
  // With one space of streams for both, 16 of 3000 searches were among what 32 environments began with.
  const auto north = goes_north(1.0F);
  search::SearchSettings settings = search_of(*north);
  settings.placement = search::SourcePlacement::kChanging;
  const search::World world = world_of(*north, settings, curve);
  std::set<Beginning> learned_from;
  const search::VectorSearch training(world, north->observation, kNoOceans, 32, 1);
  for (const search::EpisodeScript& script : training.scripts()) {
    Pcg32 random(script.random);
    search::Episode episode;
    episode.start(world, north->observation, kNoOceans, random);
    learned_from.insert(beginning_of(episode));
  }
  EXPECT_EQ(learned_from.size(), 32U);
  std::size_t flown = 0;
  std::size_t known = 0;
  baselines::Learned learned(*north, kNoOceans, north->draw, settings.domain, {});
  static_cast<void>(
      fly(learned, world, {.end = 3'000}, 1, [&](std::size_t /*number*/, const search::Episode& episode, search::EpisodeEnd /*end*/) {
        if (episode.record().steps > 0) return;
        ++flown;
        known += learned_from.contains(beginning_of(episode)) ? 1 : 0;
      }));
  EXPECT_EQ(flown, 3'000U);
  EXPECT_EQ(known, 0U);
}

/// Goes north; keeps what it would draw from.
class Draws : public baselines::Searcher {
 public:
  void begin(Pcg32 random) override { begun.push_back(random.next()); }
  [[nodiscard]] std::size_t choose(const baselines::DecisionInput& /*input*/) override { return 0; }
  std::vector<std::uint32_t> begun;
};

/// The first number that the starts of a world are drawn by stands in no searcher's stream, or what a searcher draws would know the world.
TEST_F(EvaluateTest, DrawsForASearcherFromAnotherStreamThanItsWorld) {
  const auto north = goes_north(1.0F);
  search::SearchSettings settings = search_of(*north);
  settings.start_region = settings.domain;
  const search::World world = world_of(*north, settings, curve);
  Draws searcher;
  std::vector<NorthEast> starts;
  static_cast<void>(fly(searcher, world, {.end = 50}, 3, [&](std::size_t /*number*/, const search::Episode& episode, EpisodeEnd /*end*/) {
    if (episode.record().steps == 0) starts.push_back(episode.position());
  }));
  ASSERT_EQ(starts.size(), 50U);
  ASSERT_EQ(searcher.begun.size(), 50U);
  EXPECT_EQ(std::set<std::uint32_t>(searcher.begun.begin(), searcher.begun.end()).size(), 50U) << "every search has a stream of its own";
  for (const std::uint32_t number : searcher.begun) {
    // A start is uniform over 25 km: as far north as its number's share of 2^32, to 25 km / 2^27 (its upper 27 bits count).
    const double share_m = 25'000.0 * static_cast<double>(number) / 4'294'967'296.0;
    for (const NorthEast start : starts) EXPECT_GT(std::abs(start.north.value - share_m), 0.001);
  }
}

/// Counts how often it may refine.
class CountsRefinements : public baselines::Searcher {
 public:
  void begin(Pcg32 /*random*/) override {}
  [[nodiscard]] std::size_t choose(const baselines::DecisionInput& /*input*/) override { return 0; }
  void refine() override { ++refined; }
  std::size_t refined = 0;
};

TEST_F(EvaluateTest, LetsASearcherRefineOnceAfterEveryDecisionThatAStepFollows) {
  const auto north = goes_north(1.0F);
  CountsRefinements searcher;
  std::size_t steps = 0;
  for (const Flight& flight : fly(searcher, world_of(*north, south_of_the_source(*north), curve), {.end = 10}, 1))
    steps += flight.record.steps;
  EXPECT_EQ(searcher.refined, steps);
}

TEST(DecisionTime, IsApartFromTheRefinementOnTheWay) {
  std::vector<Flight> all(2);
  for (Flight& flight : all) {
    flight.record.steps = 5;
    flight.decision_s = 0.010;
    flight.refinement_s = 0.050;
  }
  EXPECT_DOUBLE_EQ(decision_time_s(all), 0.002);
  EXPECT_DOUBLE_EQ(refinement_time_s(all), 0.010);
}

/// Goes north, and says whether it has found the source as it is told to.
class SaysSo : public baselines::Searcher {
 public:
  using Rule = std::function<bool(Meters to_source)>;
  explicit SaysSo(Rule rule) : rule_(std::move(rule)) {}
  void begin(Pcg32 /*random*/) override { says_ = false; }
  [[nodiscard]] std::size_t choose(const baselines::DecisionInput& input) override {
    says_ = rule_(range_between(input.vehicle, input.source));
    return 0;
  }
  [[nodiscard]] std::optional<bool> declares_found() const override { return says_; }

 private:
  Rule rule_;
  bool says_ = false;
};

/// 20 searches that start due south of the source, 5 to 6 km away: after five steps the vehicle is within 1 km, after the sixth too, on the
/// other side of it.
class DeclarationsTest : public EvaluateTest {
 protected:
  std::vector<Flight> flights(const SaysSo::Rule& rule, search::FoundBy found_by) {
    const auto policy = goes_north(1.0F);
    search::SearchSettings settings = search_of(*policy);
    settings.start_region = {{Meters{4'100.0}, Meters{10'000.0}}, {Meters{4'900.0}, Meters{10'001.0}}};
    settings.found_by = found_by;
    SaysSo searcher(rule);
    return fly(searcher, world_of(*policy, settings, curve), {.end = 20}, 1);
  }
  static DeclarationShares shares(const std::vector<Flight>& of) {
    const auto all = declaration_shares(of);
    EXPECT_TRUE(all);
    return all.value_or(DeclarationShares{});
  }
};

TEST_F(DeclarationsTest, MadeNearTheSourceAloneAreNeverFalseAndNeverMissed) {
  for (const search::FoundBy found_by : {search::FoundBy::kSimulator, search::FoundBy::kSearcher}) {
    const auto all = flights([](Meters off) { return off.value <= 1'000.0; }, found_by);
    for (const Flight& flight : all) {
      EXPECT_EQ(flight.record.end, EpisodeEnd::kFound);
      EXPECT_EQ(flight.record.steps, 5U);
      EXPECT_NEAR(flight.path_m, 5'000.0, 1e-6);
    }
    EXPECT_EQ(shares(all).falsely, 0.0);
    EXPECT_EQ(shares(all).missed, 0.0);
  }
}

TEST_F(DeclarationsTest, MadeTooFarAwayAreFalseAndEndNoSearch) {
  // After four steps 1.1 to 1.9 km are left, to about half of the starts no more than 1.5.
  const auto beside = flights([](Meters off) { return off.value > 1'000.0 && off.value <= 1'500.0; }, search::FoundBy::kSimulator);
  EXPECT_GT(shares(beside).falsely, 0.2);
  EXPECT_LT(shares(beside).falsely, 0.8);
  EXPECT_EQ(shares(beside).far_off, 0.0);
  for (const search::FoundBy found_by : {search::FoundBy::kSimulator, search::FoundBy::kSearcher}) {
    const auto always = flights([](Meters) { return true; }, found_by);
    EXPECT_EQ(shares(always).falsely, 1.0);
    EXPECT_EQ(shares(always).far_off, 1.0);
    EXPECT_EQ(shares(always).missed, 0.0);
    for (const Flight& flight : always) EXPECT_EQ(flight.record.steps, 5U);
  }
}

TEST_F(DeclarationsTest, NotMadeAreMissedAndAtSeaNothingIsFoundThen) {
  const auto never = [](Meters) { return false; };
  const auto told = flights(never, search::FoundBy::kSimulator);
  EXPECT_EQ(shares(told).missed, 1.0);
  EXPECT_EQ(told.front().record.end, EpisodeEnd::kFound);
  const auto at_sea = flights(never, search::FoundBy::kSearcher);
  EXPECT_EQ(shares(at_sea).missed, 1.0);
  EXPECT_EQ(at_sea.front().record.end, EpisodeEnd::kLeftDomain) << "it goes on north";
}

TEST_F(DeclarationsTest, MadeAMeasurementLateEndASearchAtSeaThatTheSimulatorWouldHaveEndedBefore) {
  // Within 600 m: of starts from 4.1 to 4.9 km north those below 4.4 km are there after six steps, the others, up to 5 km, after five.
  const auto all = flights([](Meters off) { return off.value <= 600.0; }, search::FoundBy::kSearcher);
  std::set<std::uint32_t> steps;
  for (const Flight& flight : all) {
    EXPECT_EQ(flight.record.end, EpisodeEnd::kFound);
    steps.insert(flight.record.steps);
  }
  EXPECT_EQ(steps, (std::set<std::uint32_t>{5, 6}));
  EXPECT_EQ(shares(all).missed, 0.0);
}

TEST_F(DeclarationsTest, AreNobodysWhoLeavesThatToOthers) {
  const auto policy = goes_north(1.0F);
  baselines::Learned learned(*policy, {}, policy->draw, {}, {});
  EXPECT_FALSE(declaration_shares(fly(learned, world_of(*policy, south_of_the_source(*policy), curve), {.end = 3}, 1)));
}

}  // namespace
}  // namespace earshot::evaluate
