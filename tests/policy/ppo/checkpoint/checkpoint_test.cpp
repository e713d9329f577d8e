#include "policy/ppo/checkpoint/checkpoint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/core/crc32.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/ppo/checkpoint/training_state_text.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::ppo {
namespace {

Checkpoint made_up() {
  Checkpoint checkpoint;
  checkpoint.observation.spec = policy::simple_state({Meters{25'000.0}, Meters{25'000.0}});
  checkpoint.direction_count = 8;
  checkpoint.step_length = Meters{1'000.0};
  checkpoint.area_size = {Meters{25'000.0}, Meters{30'000.0}};
  checkpoint.detection_threshold = Decibels{11.0};
  checkpoint.provenance = {{"seed", "1"}, {"command", "say \"when\""}};
  Pcg32 random(1);
  ActorCritic<float> networks(checkpoint.shape());
  networks.initialise(random);
  checkpoint.parameters.assign(networks.parameters().begin(), networks.parameters().end());
  return checkpoint;
}

std::string refusal(const std::string& text) {
  try {
    (void)from_text(text, "a.checkpoint");
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "accepted";
}

/// A checkpoint's second line.
std::string with_checksum(const std::string& json) {
  std::ostringstream line;
  line << "\ncrc32 " << std::hex << std::setw(8) << std::setfill('0')
       << crc32({reinterpret_cast<const std::uint8_t*>(json.data()), json.size()}) << '\n';
  return json + line.str();
}

std::string refusal_with(const std::string& key, const nlohmann::json& value) {
  const std::string text = to_text(made_up());
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text.substr(0, text.find('\n')));
  json[key] = value;
  return refusal(with_checksum(json.dump()));
}

TEST(Checkpoint, SurvivesItsTextExactly) {
  const Checkpoint written = made_up();
  const Checkpoint read = from_text(to_text(written), "a");
  EXPECT_EQ(read.parameters, written.parameters);
  EXPECT_EQ(read.provenance, written.provenance);
  EXPECT_TRUE(std::ranges::equal(read.observation.spec, written.observation.spec));
  EXPECT_EQ(read.direction_count, written.direction_count);
  EXPECT_EQ(read.step_length, written.step_length);
  EXPECT_EQ(read.area_size, written.area_size);
  EXPECT_EQ(read.detection_threshold, written.detection_threshold);
  EXPECT_EQ(read.observation.listening, config::ListeningWindow{});
}

TEST(Checkpoint, KeepsTheWindowThatItsPolicyListensOver) {
  Checkpoint checkpoint = made_up();
  checkpoint.observation.listening = {config::Listening::kLoudest, Duration::seconds(30)};
  EXPECT_EQ(from_text(to_text(checkpoint), "a").observation.listening, checkpoint.observation.listening);
  EXPECT_EQ(to_text(made_up()).find("listening"), std::string::npos) << "of the newest look nothing need be said";
  EXPECT_NE(refusal_with("listening", "softest").find("listening"), std::string::npos) << refusal_with("listening", "softest");
}

TEST(Checkpoint, IsRefusedWhenCutShortAnywhere) {
  const std::string whole = to_text(made_up());
  for (std::size_t size = 0; size < whole.size(); size += size < 100 ? 1 : 1'009) {
    EXPECT_TRUE(support::tells(refusal(whole.substr(0, size)), {"a.checkpoint", "not", "checkpoint", "cut short", "damaged"}));
  }
}

TEST(Checkpoint, IsRefusedWhenABitHasFlipped) {
  const std::string whole = to_text(made_up());
  for (std::size_t at = 40; at < whole.size(); at += 997) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    EXPECT_TRUE(support::tells(refusal(flipped), {"a.checkpoint", "not", "checkpoint", "cut short", "damaged"})) << at;
  }
}

TEST(Checkpoint, OfAnotherVersionIsRefusedAsThat) {
  EXPECT_NE(refusal(R"({"format":"earshot checkpoint 2","observation":[]})"
                    "\n")
                .find("a.checkpoint: of another version"),
            std::string::npos);
}

TEST(Checkpoint, KeepsWhatTrainingGoesOnFromExactly) {
  Checkpoint written = made_up();
  const std::uint64_t big = 0xFEDC'BA98'7654'3211ULL;  // beyond what a double holds
  written.continuation = Continuation{.state = {.steps = 4'096,
                                                .seed = big,
                                                .optimiser = {7, {0.1F, -2e-30F}, {3e-12F, 1.0F / 3.0F}},
                                                .workers = {{{big, 5}, {{{big - 1, 3}, {1, 2, 0}}, {{9, 7}, {}}}}, {{2, 3}, {}}}},
                                      .arguments = {"run.toml", "-o", "a b"},
                                      .directory = "/somewhere",
                                      .settings_crc32 = 0xDEADBEEF,
                                      .episodes = {100, 1},
                                      .updates = {200, 2},
                                      .curve = "curves/a.csv"};
  const Checkpoint read = from_text(to_text(written), "a");
  ASSERT_TRUE(read.continuation);
  const TrainingState& state = read.continuation->state;
  EXPECT_EQ(state.steps, 4'096U);
  EXPECT_EQ(state.seed, big);
  EXPECT_EQ(state.optimiser.steps, 7U);
  EXPECT_EQ(state.optimiser.first_moment, written.continuation->state.optimiser.first_moment);
  EXPECT_EQ(state.optimiser.second_moment, written.continuation->state.optimiser.second_moment);
  ASSERT_EQ(state.workers.size(), 2U);
  EXPECT_EQ(state.workers[0].random, (Pcg32::State{big, 5}));
  EXPECT_EQ(state.workers[0].episodes, written.continuation->state.workers[0].episodes);
  EXPECT_EQ(read.continuation->arguments, written.continuation->arguments);
  EXPECT_EQ(state.workers[1].random, (Pcg32::State{2, 3}));
  EXPECT_EQ(read.continuation->directory, "/somewhere");
  EXPECT_EQ(read.continuation->settings_crc32, 0xDEADBEEF);
  EXPECT_EQ(read.continuation->episodes.bytes, 100U);
  EXPECT_EQ(read.continuation->episodes.crc32, 1U);
  EXPECT_EQ(read.continuation->updates.bytes, 200U);
  EXPECT_EQ(read.continuation->updates.crc32, 2U);
  EXPECT_EQ(read.continuation->curve, "curves/a.csv");
}

TEST(Checkpoint, OfAProgramThatDidNotSayWhereItsCurveIsCanBeGoneOnWith) {
  Checkpoint written = made_up();
  written.continuation = Continuation{};
  const std::string text = to_text(written);
  EXPECT_EQ(text.find("\"curve\""), std::string::npos);
  const Checkpoint read = from_text(text, "a");
  ASSERT_TRUE(read.continuation);
  EXPECT_FALSE(read.continuation->curve);
}

TEST(Checkpoint, IsRefusedForANumberThatIsNotFinite) {
  std::vector<double> parameters(made_up().parameters.size(), 0.5);
  EXPECT_EQ(refusal_with("parameters", parameters), "accepted");
  parameters.back() = 1e39;  // more than a float holds
  EXPECT_TRUE(support::tells(refusal_with("parameters", parameters), {"a.checkpoint", "parameters", "not"}));
}

TEST(Checkpoint, IsOneLineAndItsChecksum) {
  const std::string text = to_text(made_up());
  EXPECT_EQ(text, with_checksum(text.substr(0, text.find('\n'))));
  EXPECT_TRUE(support::tells(refusal(text + "\n"), {"a.checkpoint", "not", "checkpoint", "cut short", "damaged"}));
  EXPECT_TRUE(support::tells(refusal(text.substr(0, text.find('\n') + 1)), {"a.checkpoint", "not", "checkpoint", "cut short", "damaged"}));
  EXPECT_TRUE(support::tells(refusal("{\"format\":\"earshot checkpoint 3"), {"a.checkpoint", "not", "checkpoint", "cut short", "damaged"}));
}

TEST(WorkerState, SurvivesItsText) {
  const WorkerState written{.random = {0xFEDC'BA98'7654'3211ULL, 5}, .episodes = {{{7, 3}, {1, 2, 0}}, {{9, 11}, {}}}};
  const WorkerState read = worker_from_text(to_text(written));
  EXPECT_EQ(read.random, written.random);
  EXPECT_EQ(read.episodes, written.episodes);
}

TEST(Checkpoint, IsRefusedWithTheFileAndThePartThatIsWrong) {
  EXPECT_NE(refusal_with("format", "other").find("a.checkpoint: not an earshot checkpoint"), std::string::npos);
  EXPECT_NE(refusal_with("direction_count", 0).find("direction_count"), std::string::npos);
  EXPECT_NE(refusal_with("direction_count", -1).find("direction_count"), std::string::npos);
  EXPECT_NE(refusal_with("step_length_m", -5).find("step_length_m"), std::string::npos);
  EXPECT_NE(refusal_with("area_north_m", 0).find("area_north_m"), std::string::npos);
  EXPECT_NE(refusal_with("area_east_m", -1).find("area_east_m"), std::string::npos);
  EXPECT_TRUE(support::has_line(refusal_with("parameters", {1.0, 2.0}), {"parameters", "2 numbers", "needs 9289"}));
  EXPECT_NE(refusal_with("observation", nlohmann::json::array()).find("observation"), std::string::npos);
  EXPECT_NE(refusal_with("observation", {{{"feature", 99}, {"age", 0}, {"offset", 0}, {"scale", 1}}}).find("unknown feature"),
            std::string::npos);
  EXPECT_NE(refusal_with("provenance", 7), "accepted");
  EXPECT_NE(refusal_with("continuation", 7), "accepted");
  EXPECT_NE(refusal(with_checksum("[]")), "accepted");
  EXPECT_NE(refusal(with_checksum("{}")), "accepted");
}

}  // namespace
}  // namespace earshot::ppo
