#include "policy/freeze/freeze.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "firmware/policy/network.hpp"
#include "sim/search/belief_model.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::freeze {
namespace {

/// A trained-looking checkpoint of the memory state.
ppo::Checkpoint made_up_checkpoint() {
  ppo::Checkpoint checkpoint;
  checkpoint.observation.spec = policy::memory_state(2, Meters{1'000.0}, Decibels{10.0}).value();
  checkpoint.direction_count = 8;
  checkpoint.step_length = Meters{1'000.0};
  checkpoint.area_size = {Meters{25'000.0}, Meters{30'000.0}};
  checkpoint.detection_threshold = Decibels{11.0};
  checkpoint.provenance = {{"command", "earshot-train"}, {"seed", "3"}};
  ppo::ActorCritic<float> networks(checkpoint.shape());
  Pcg32 random(3);
  networks.initialise(random);
  for (float& p : networks.parameters()) p += 0.2F * (random.uniform_float() - 0.5F);
  checkpoint.parameters.assign(networks.parameters().begin(), networks.parameters().end());
  return checkpoint;
}

TEST(Freeze, GivesTheLogitsOfTheTrainedActor) {
  const ppo::Checkpoint checkpoint = made_up_checkpoint();
  const auto frozen = freeze(checkpoint, policy::ActionDraw::kSampled);
  ppo::ActorCritic<float> trained(checkpoint.shape());
  std::ranges::copy(checkpoint.parameters, trained.parameters().begin());
  ppo::Activations<float> activations(checkpoint.shape(), 1);
  Pcg32 random(8);
  for (int i = 0; i < 100; ++i) {
    std::array<float, 6> observation{};
    for (float& x : observation) x = 4.0F * random.uniform_float() - 2.0F;
    std::array<float, 8> logits{};
    policy::forward(frozen->network, observation, logits);
    trained.forward(observation.data(), 1, activations);
    for (std::size_t a = 0; a < logits.size(); ++a) {
      // Two tanh of some ulp, sums of 64 floats of order 1 in another order.
      ASSERT_NEAR(logits[a], activations.logits(static_cast<Eigen::Index>(a), 0), 2e-5F);
    }
  }
}

TEST(Freeze, KeepsWhatThePolicySeesDoesAndComesFrom) {
  const ppo::Checkpoint checkpoint = made_up_checkpoint();
  const auto frozen = freeze(checkpoint, policy::ActionDraw::kArgmax);
  EXPECT_TRUE(std::ranges::equal(frozen->observation.spec, checkpoint.observation.spec));
  EXPECT_EQ(frozen->actions.size(), 8U);
  EXPECT_EQ(frozen->actions[2], (UnitNorthEast{0.0, 1.0}));
  EXPECT_EQ(frozen->step_length, Meters{1'000.0});
  EXPECT_EQ(frozen->area_size, checkpoint.area_size);
  EXPECT_EQ(frozen->detection_threshold, Decibels{11.0});
  EXPECT_EQ(frozen->draw, policy::ActionDraw::kArgmax);
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()), "command = earshot-train\nseed = 3\n");
}

TEST(Freeze, SaysInTheProvenanceThatAPolicyListensOtherwiseThanItWasTrained) {
  const auto frozen = freeze(made_up_checkpoint(), policy::ActionDraw::kSampled);
  const std::string trained(frozen->provenance.begin(), frozen->provenance.end());
  listen_over(*frozen, {config::Listening::kMean, Duration::seconds(30)});
  EXPECT_EQ(frozen->observation.listening, (config::ListeningWindow{config::Listening::kMean, Duration::seconds(30)}));
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()), trained + "listening = mean of 30 s (before: newest)\n");
  listen_over(*frozen, {config::Listening::kMean, Duration::seconds(30)});
  EXPECT_EQ(frozen->provenance.size(), trained.size() + 42) << "said once";
}

TEST(Freeze, SaysInOneLineOverWhichWindowAPolicyListensHoweverOftenThatChanges) {
  const config::ListeningWindow mean{config::Listening::kMean, Duration::seconds(30)};
  const config::ListeningWindow loudest{config::Listening::kLoudest, Duration::seconds(20)};
  ppo::Checkpoint checkpoint = made_up_checkpoint();
  checkpoint.observation.listening = mean;
  checkpoint.provenance.emplace_back("listening", "mean");
  const auto frozen = freeze(checkpoint, policy::ActionDraw::kSampled);
  const std::string trained(frozen->provenance.begin(), frozen->provenance.end());
  for (int i = 0; i < 40; ++i) {
    listen_over(*frozen, {});
    listen_over(*frozen, loudest);
  }
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()),
            trained + "listening = loudest of 20 s (before: mean of 30 s)\n");
  listen_over(*frozen, mean);
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()), trained) << "as it was trained";
}

TEST(Freeze, KeepsTheProvenanceInLinesWhateverANameHolds) {
  ppo::Checkpoint checkpoint = made_up_checkpoint();
  checkpoint.provenance = {{"command", "earshot-train a\nb.toml"}, {"folder", "\xff"}};
  const auto frozen = freeze(checkpoint, policy::ActionDraw::kArgmax);
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()), "command = earshot-train a\\nb.toml\nfolder = \\xff\n");
}

TEST(Freeze, RefusesProvenanceThatAPolicyCannotHold) {
  ppo::Checkpoint checkpoint = made_up_checkpoint();
  checkpoint.provenance.emplace_back("story", std::string(config::kMaxProvenance, 'x'));
  EXPECT_THROW((void)freeze(checkpoint, policy::ActionDraw::kSampled), host::BadInput);
  checkpoint.provenance = {{"", "of no name"}};
  EXPECT_THROW((void)freeze(checkpoint, policy::ActionDraw::kSampled), host::BadInput);
}

/// Dense layers of these sizes from one to the next, every weight and bias of each a number of its own.
TrainedActor actor_of(const std::vector<std::size_t>& sizes) {
  TrainedActor actor;
  float number = 0.0F;
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
    DenseLayer layer{.inputs = sizes[i], .outputs = sizes[i + 1], .weights = {}, .bias = {}};
    for (std::size_t w = 0; w < sizes[i] * sizes[i + 1]; ++w) layer.weights.push_back(number += 1e-4F);
    for (std::size_t b = 0; b < sizes[i + 1]; ++b) layer.bias.push_back(number += 1e-4F);
    actor.layers.push_back(layer);
  }
  return actor;
}

TEST(Freeze, PutsEveryWeightOfAnActorTrainedElsewhereInItsPlace) {
  const TrainedActor actor = actor_of({6, 5, 4, 8});
  const auto frozen = freeze(actor, made_up_checkpoint(), policy::ActionDraw::kArgmax);
  const policy::Network& network = frozen->network;
  EXPECT_EQ(network.observation_size, 6U);
  EXPECT_EQ(network.hidden_sizes, (std::array<std::size_t, 3>{5, 4}));
  EXPECT_EQ(network.action_count, 8U);
  const auto expect_layer = [](const DenseLayer& from, const auto& to) {
    for (std::size_t o = 0; o < from.outputs; ++o) {
      for (std::size_t i = 0; i < from.inputs; ++i) EXPECT_EQ(to.weight(o, i), from.weights[o * from.inputs + i]) << o << ' ' << i;
      EXPECT_EQ(to.bias[o], from.bias[o]) << o;
    }
  };
  expect_layer(actor.layers[0], network.layer(0));
  expect_layer(actor.layers[1], network.layer(1));
  expect_layer(actor.layers[2], network.layer(2));
  EXPECT_EQ(frozen->draw, policy::ActionDraw::kArgmax);
  EXPECT_TRUE(policy::repeats_golden(*frozen, *std::make_unique<policy::SearchMemory>(), *std::make_unique<policy::OceanTables>()));
}

TEST(Freeze, RefusesAnActorThatDoesNotFitItsSearchOrAVehicle) {
  const auto refused = [](const TrainedActor& actor) {
    try {
      (void)freeze(actor, made_up_checkpoint(), policy::ActionDraw::kArgmax);
    } catch (const host::BadInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(actor_of({6, 64, 64, 8})), "");
  EXPECT_EQ(refused({}), "has no layers");
  EXPECT_EQ(refused(actor_of({6, 64, 8})), "");
  EXPECT_EQ(refused(actor_of({6, 4, 4, 4, 8})), "");
  EXPECT_EQ(refused(actor_of({6, 8})), "has 0 hidden layers; 1 to 3 fly");
  EXPECT_EQ(refused(actor_of({6, 4, 4, 4, 4, 8})), "has 4 hidden layers; 1 to 3 fly");
  EXPECT_TRUE(support::tells(refused(actor_of({6, 257, 64, 8})), {"layer 1", "257 units", "at most 256 fly"}));
  EXPECT_TRUE(support::tells(refused(actor_of({6, 64, 257, 8})), {"layer 2", "257 units", "at most 256 fly"}));
  EXPECT_TRUE(support::tells(refused(actor_of({5, 4, 4, 8})), {"5 inputs", "8 outputs", "6 observations", "8 directions"}));
  EXPECT_TRUE(support::tells(refused(actor_of({6, 4, 4, 7})), {"6 inputs", "7 outputs", "6 observations", "8 directions"}));
  TrainedActor broken = actor_of({6, 5, 4, 8});
  broken.layers[1] = actor_of({3, 4}).layers[0];
  EXPECT_TRUE(support::tells(refused(broken), {"layer 2 takes", "3 inputs", "before", "5"}));
}

TEST(Freeze, KeepsEveryLineOfProvenanceThatIsNotItsOwnNoteOfAWindow) {
  ppo::Checkpoint checkpoint = made_up_checkpoint();
  checkpoint.provenance = {{"listening", "mean (quiet)"}, {"listening", "mean (before: noon"}, {"note", "a (before: b)"}};
  const auto frozen = freeze(checkpoint, policy::ActionDraw::kSampled);
  const std::string trained(frozen->provenance.begin(), frozen->provenance.end());
  listen_over(*frozen, {config::Listening::kMean, Duration::seconds(30)});
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()), trained + "listening = mean of 30 s (before: newest)\n");
  listen_over(*frozen, {});
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()), trained);
}

TEST(Freeze, RefusesTheLineOfAWindowWhereTheProvenanceIsFull) {
  ppo::Checkpoint checkpoint = made_up_checkpoint();
  checkpoint.provenance = {{"a", std::string(config::kMaxProvenance - 5, 'x')}};  // with " = " and the line's end
  const auto frozen = freeze(checkpoint, policy::ActionDraw::kSampled);
  EXPECT_EQ(frozen->provenance.size(), config::kMaxProvenance);
  EXPECT_THROW(listen_over(*frozen, {config::Listening::kMean, Duration::seconds(30)}), host::BadInput);
}

TEST(Freeze, RefusesWeightsWithWhichLogitsCouldOverflow) {
  ppo::Checkpoint checkpoint = made_up_checkpoint();
  std::ranges::fill(checkpoint.parameters, 1e38F);
  EXPECT_THROW((void)freeze(checkpoint, policy::ActionDraw::kSampled), host::BadInput);
  TrainedActor actor = actor_of({6, 5, 4, 8});
  std::ranges::fill(actor.layers[2].weights, 3e38F);
  EXPECT_THROW((void)freeze(actor, made_up_checkpoint(), policy::ActionDraw::kSampled), host::BadInput);
}

/// The search of the paper with a belief.
description::SearchDescription search_with_belief() {
  const search::SearchSettings settings;
  policy::ObservationModel observation;
  observation.belief = search::belief_model(settings);
  observation.spec = policy::belief_state(observation.belief);
  description::SearchDescription search = description::describe(settings, observation);
  search.provenance = {{"run", "shipped.toml"}};
  return search;
}

TEST(Freeze, DrawsActionsAsItIsTold) {
  for (const policy::ActionDraw draw : {policy::ActionDraw::kSampled, policy::ActionDraw::kArgmax}) {
    EXPECT_EQ(freeze(made_up_checkpoint(), draw)->draw, draw);
    EXPECT_EQ(freeze_advice(search_with_belief(), draw)->draw, draw);
  }
}

TEST(FreezeAdvice, MakesAPolicyWithoutANetworkWhoseLogitsAreTenTimesThePreferences) {
  const auto frozen = freeze_advice(search_with_belief(), policy::ActionDraw::kArgmax);
  EXPECT_FALSE(policy::has_network(frozen->network));
  EXPECT_EQ(frozen->draw, policy::ActionDraw::kArgmax);
  EXPECT_EQ(std::string(frozen->provenance.begin(), frozen->provenance.end()), "run = shipped.toml\n");
  // A first measurement in the corner: a tenth of the logits are 1 / (1 + regret), 1 for the best.
  const auto tables = std::make_unique<policy::OceanTables>();
  policy::make_golden_tables(frozen->area_size, *tables);
  const auto memory = std::make_unique<policy::SearchMemory>();
  memory->start(frozen->observation, *tables, {Meters{2'000.0}, Meters{2'000.0}}, {.snr = Decibels{12.0}});
  std::vector<float> observation(frozen->observation.spec.size());
  std::array<float, 8> logits{};
  policy::observe(*memory, frozen->observation, observation);
  policy::find_logits(*frozen, observation, logits);
  for (std::size_t a = 0; a < logits.size(); ++a)
    EXPECT_NEAR(logits[a], 10.0F / (1.0F + memory->belief().action_values(a).regret), 1e-5F) << a;  // float roundings
  EXPECT_EQ(*std::ranges::max_element(logits), 10.0F);
  EXPECT_LT(*std::ranges::min_element(logits), 9.0F);
}

TEST(FreezeAdvice, FliesItsGoldenSearchesAndIsReadBackFromItsSignedBytes) {
  const auto frozen = freeze_advice(search_with_belief(), policy::ActionDraw::kArgmax);
  EXPECT_TRUE(policy::repeats_golden(*frozen, *std::make_unique<policy::SearchMemory>(), *std::make_unique<policy::OceanTables>()));
  const std::vector<std::uint8_t> bytes = sign(*frozen, host::make_key());
  EXPECT_LT(bytes.size(), 10'000U) << "a network of 64 units alone has 33 KiB";
  const auto read = host::policy_from(bytes, "a.policy");
  EXPECT_FALSE(policy::has_network(read->network));
  EXPECT_EQ(read->observation.belief.costs, search_with_belief().observation.belief.costs);
}

TEST(FreezeAdvice, RefusesASearchThatDoesNotShowEveryActionsPreference) {
  const auto refused = [](const description::SearchDescription& search) {
    try {
      (void)freeze_advice(search, policy::ActionDraw::kArgmax);
    } catch (const host::BadInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string said =
      "the policy: section OBSV does not show the preference of every action, by which a policy without a network goes";
  EXPECT_EQ(refused(search_with_belief()), "");
  EXPECT_EQ(refused(made_up_checkpoint()), said);
  description::SearchDescription without_one = search_with_belief();
  for (policy::ObservationElement& element : without_one.observation.spec)
    if (element.feature == policy::Feature::kPreference && element.age == 3) element.feature = policy::Feature::kRegret;
  EXPECT_EQ(refused(without_one), said);
}

TEST(Sign, RefusesAPolicyOfASizeThatNoFileHolds) {
  const auto frozen = freeze(made_up_checkpoint(), policy::ActionDraw::kSampled);
  frozen->network.hidden_sizes[0] = 257;
  EXPECT_THROW((void)sign(*frozen, host::make_key()), host::BadInput);
}

TEST(Sign, MakesBytesThatTheVehicleParses) {
  const auto frozen = freeze(made_up_checkpoint(), policy::ActionDraw::kSampled);
  const std::vector<std::uint8_t> bytes = sign(*frozen, host::make_key());
  auto parsed = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyComplaint complaint;
  ASSERT_EQ(policy::parse(bytes, *parsed, complaint), Status::kOk);
  EXPECT_EQ(parsed->network.numbers, frozen->network.numbers);
}

TEST(Sign, CoversEveryByteAndOnlyItsOwnKey) {
  const host::SecretKey key = host::make_key();
  std::vector<std::uint8_t> bytes = sign(*freeze(made_up_checkpoint(), policy::ActionDraw::kSampled), key);
  EXPECT_TRUE(host::is_signed_at_end(bytes, host::public_key_of(key)));
  EXPECT_FALSE(host::is_signed_at_end(bytes, host::public_key_of(host::make_key())));
  EXPECT_FALSE(host::is_signed_at_end(std::span(bytes).first(10), host::public_key_of(key)));
  for (std::size_t i = 0; i < bytes.size(); i += 97) {
    bytes[i] ^= 1U;
    EXPECT_FALSE(host::is_signed_at_end(bytes, host::public_key_of(key))) << "byte " << i;
    bytes[i] ^= 1U;
  }
}

}  // namespace
}  // namespace earshot::freeze
