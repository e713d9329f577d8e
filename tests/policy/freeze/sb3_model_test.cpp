#include "policy/freeze/sb3_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>

#include "firmware/policy/network.hpp"
#include "policy/description/search_description.hpp"
#include "policy/freeze/freeze.hpp"
#include "policy/freeze/model_file.hpp"
#include "policy/freeze/state_dict.hpp"
#include "tests/policy/freeze/bytes.hpp"
#include "tests/support/layer_weights.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::freeze {
namespace {

using test::refusal;

std::unique_ptr<policy::FrozenPolicy> frozen(const std::string& name) {
  const TrainedActor actor = read_model(test::model(name), name);
  return freeze(actor, description::from_text(actor.search.value()), policy::ActionDraw::kArgmax);
}

std::string refused_model(const std::string& name) {
  return refusal([&] { (void)frozen(name); });
}

/// memory.zip with one entry changed by `change`.
template <class Change>
std::string refused_with(const std::string& entry, Change change) {
  auto entries = test::unzipped(test::model("memory.zip"));
  change(entries[entry]);
  const std::string bytes = test::zip_of(entries);
  return refusal([&] { (void)read_model(bytes, "model.zip"); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

int decisions_that_differ(const policy::Network& network) {
  const std::string expected = test::model_oracle().at("actions");
  int differ = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    std::array<float, 6> observation{};
    for (std::uint32_t e = 0; e < observation.size(); ++e) {
      observation[e] = static_cast<float>(3.0 * test::uniform(e, static_cast<std::uint32_t>(i)) - 1.5);
    }
    std::array<float, 8> logits{};
    policy::forward(network, observation, logits);
    differ += std::ranges::max_element(logits) - logits.begin() == expected[i] - '0' ? 0 : 1;
  }
  return differ;
}

TEST(Sb3Model, FrozenMakesTheTenThousandDecisionsOfPredict) {
  ASSERT_EQ(test::model_oracle().at("actions").get<std::string>().size(), 10'000U);
  EXPECT_EQ(decisions_that_differ(frozen("memory.zip")->network), 0);
  EXPECT_EQ(decisions_that_differ(frozen("memory.onnx")->network), 0);
}

TEST(Sb3Model, FreezesEveryWeightOfTheActorBitForBit) {
  const StateDict state = read_state_dict(test::unzipped(test::model("memory.zip")).at("policy.pth"));
  const auto flown = frozen("memory.zip");
  const policy::Network& network = flown->network;
  const auto same_bits = [](const std::vector<float>& from, std::span<const float> to) {
    return std::ranges::equal(from, to.first(from.size()),
                              [](float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); });
  };
  EXPECT_TRUE(same_bits(state.at("mlp_extractor.policy_net.0.weight").values, tests::weights_of(network.layer(0), 64, 6)));
  EXPECT_TRUE(same_bits(state.at("mlp_extractor.policy_net.0.bias").values, network.layer(0).bias));
  EXPECT_TRUE(same_bits(state.at("mlp_extractor.policy_net.2.weight").values, tests::weights_of(network.layer(1), 64, 64)));
  EXPECT_TRUE(same_bits(state.at("mlp_extractor.policy_net.2.bias").values, network.layer(1).bias));
  EXPECT_TRUE(same_bits(state.at("action_net.weight").values, tests::weights_of(network.layer(2), 8, 64)));
  EXPECT_TRUE(same_bits(state.at("action_net.bias").values, network.layer(2).bias));
}

TEST(Sb3Model, SaysWhatItWasTrainedToSearch) {
  const auto policy = frozen("memory.zip");
  EXPECT_EQ(policy->observation.spec.size(), 6U);
  EXPECT_EQ(policy->observation.spec[2].feature, policy::Feature::kStepSnr);
  EXPECT_EQ(policy->actions.size(), 8U);
  EXPECT_EQ(policy->step_length, Meters{1'000.0});
  EXPECT_EQ(policy->area_size, (NorthEast{Meters{25'000.0}, Meters{25'000.0}}));
  const std::string provenance(policy->provenance.begin(), policy->provenance.end());
  EXPECT_NE(provenance.find("trained_by = stable-baselines3 2.3.2 PPO"), std::string::npos);
}

TEST(Sb3Model, TakesTanhAndLayersNamedInItsArguments) {
  const auto policy = frozen("named_tanh.zip");
  EXPECT_EQ(policy->network.hidden_sizes, (std::array<std::size_t, 3>{32, 16}));
}

TEST(Sb3Model, TakesReluAndThreeLayers) {
  const auto relu = frozen("relu.zip");
  EXPECT_EQ(relu->network.activation, policy::Activation::kRelu);
  EXPECT_EQ(relu->network.hidden_sizes, (std::array<std::size_t, 3>{4, 4}));
  const auto three = frozen("three_layers.zip");
  EXPECT_EQ(three->network.activation, policy::Activation::kTanh);
  EXPECT_EQ(three->network.hidden_sizes, (std::array<std::size_t, 3>{4, 4, 4}));
}

TEST(Sb3Model, RefusesWhatItCannotBeSureOf) {
  EXPECT_NE(refused_model("named_extractor.zip").find("features_extractor_class"), std::string::npos);
  EXPECT_NE(refused_model("own_policy.zip").find("policy_class"), std::string::npos);
  EXPECT_NE(refused_model("continuous.zip").find("action_space"), std::string::npos);
}

TEST(Sb3Model, RefusesAModelThatSomebodyChanged) {
  const auto with_data = [](const std::string& from, const std::string& to) {
    return refused_with("data", [&](std::string& data) { data = replaced(data, from, to); });
  };
  EXPECT_NE(with_data("\"use_sde\": false", "\"use_sde\": true").find("use_sde"), std::string::npos);
  EXPECT_NE(with_data("\"start\": \"0\"", "\"start\": \"1\"").find("starts at 0"), std::string::npos);
  EXPECT_NE(with_data("\"policy_kwargs\": {}", "\"policy_kwargs\": {\"squash_output\": true}").find("squash_output"), std::string::npos);
  EXPECT_NE(with_data("\"policy_kwargs\": {}", "\"policy_kwargs\": {\"a\\nb\": 1}").find("a?b"), std::string::npos);
  EXPECT_NE(with_data("\"policy_class\"", "\"policy_clasp\"").find("policy_class"), std::string::npos);
  EXPECT_NE(refused_with("data", [](std::string& data) { data.resize(100); }).find("cut short"), std::string::npos);
  EXPECT_NE(refused_with("policy.pth", [](std::string& weights) { weights.resize(1'000); }).find("policy.pth"), std::string::npos);
}

TEST(Sb3Model, SaysNothingOfASearchWhereItsFileDoesNot) {
  EXPECT_FALSE(read_sb3_model(test::model("plain_save.zip")).search.has_value());
}

TEST(Sb3Model, RefusesAnArchiveOfSomethingElse) {
  for (const char* missing : {"data", "policy.pth"}) {
    auto entries = test::unzipped(test::model("memory.zip"));
    entries.erase(missing);
    EXPECT_NE(refusal([&] { (void)read_sb3_model(test::zip_of(entries)); }).find("no model of Stable-Baselines3"), std::string::npos);
  }
}

TEST(Sb3Model, RefusesSpacesThatNoSearchHas) {
  const auto with_data = [](const std::string& from, const std::string& to) {
    return refused_with("data", [&](std::string& data) { data = replaced(data, from, to); });
  };
  EXPECT_NE(with_data("discrete.Discrete'", "multi_discrete.MultiDiscrete'").find("action_space: only"), std::string::npos);
  EXPECT_NE(with_data("spaces.box.Box'", "spaces.dict.Dict'").find("observation_space: only a flat Box"), std::string::npos);
  EXPECT_NE(with_data("\"dtype\": \"float32\"", "\"dtype\": \"float64\"").find("observation_space: only a flat Box"), std::string::npos);
  const auto at = test::unzipped(test::model("memory.zip")).at("data").find("\"_shape\": [");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(with_data("\"_shape\": [", "\"_shape\": [1,").find("observation_space: only a flat Box"), std::string::npos);
}

TEST(Sb3Model, RefusesArgumentsItCannotRead) {
  const auto with_arguments = [](const std::string& arguments) {
    return refused_with("data",
                        [&](std::string& data) { data = replaced(data, "\"policy_kwargs\": {}", "\"policy_kwargs\": " + arguments); });
  };
  EXPECT_EQ(with_arguments("{\"net_arch\": [64, 64]}"), "");
  EXPECT_NE(with_arguments("[]").find("policy_kwargs: not a dictionary"), std::string::npos);
  EXPECT_NE(with_arguments("{\"activation_fn\": \"Tanh\"}").find("activation_fn: unknown"), std::string::npos);
  EXPECT_NE(with_arguments("{\":serialized:\": \"!\"}").find("policy_kwargs: not base64"), std::string::npos);
  EXPECT_NE(with_arguments("{\":serialized:\": \"gAJdLg==\"}").find("policy_kwargs: not a dictionary"), std::string::npos);  // pickled []
  EXPECT_EQ(with_arguments("{\":serialized:\": \"gAJ9Lg==\"}"), "");                                                         // pickled {}
  // pickle.dumps({1: 2}, protocol=2) and {"net_arch": 2}
  EXPECT_NE(with_arguments("{\":serialized:\": \"gAJ9cQBLAUsCcy4=\"}").find("a name that is not a text"), std::string::npos);
  EXPECT_EQ(with_arguments("{\":serialized:\": \"gAJ9cQBYCAAAAG5ldF9hcmNocQFLAnMu\"}"), "");
}

TEST(Sb3Model, RefusesAPolicyWithoutOneOfItsLayers) {
  const auto without = [](const std::string& name) {
    return refused_with("policy.pth", [&](std::string& weights) {
      auto inner = test::unzipped(weights);
      std::string& pickle = inner.at("archive/data.pkl");
      std::string other = name;
      other.back() = '_';
      pickle = replaced(pickle, name, other);
      weights = test::zip_of(inner);
    });
  };
  EXPECT_NE(without("action_net.weight").find("policy.pth: has no action_net"), std::string::npos);
  EXPECT_NE(without("action_net.bias").find("policy.pth: has no action_net"), std::string::npos);
  EXPECT_NE(without("mlp_extractor.policy_net.2.bias").find("has no mlp_extractor.policy_net.2"), std::string::npos);
  EXPECT_NE(without("mlp_extractor.policy_net.2.weight").find("mlp_extractor.policy_net.2.bias: not a weight"), std::string::npos);
}

TEST(Sb3Model, RefusesAStateDictWithMoreInIt) {
  const std::string message = refused_with("policy.pth", [](std::string& weights) {
    auto inner = test::unzipped(weights);
    std::string& pickle = inner.at("archive/data.pkl");
    pickle = replaced(pickle, "value_net.bias", "value_mat.bias");
    weights = test::zip_of(inner);
  });
  EXPECT_NE(message.find("value_mat.bias"), std::string::npos);
}

TEST(SearchDescription, SurvivesItsText) {
  const std::string text = read_model(test::model("memory.zip"), "m").search.value();
  const description::SearchDescription search = description::from_text(text);
  EXPECT_EQ(description::to_text(description::from_text(description::to_text(search))), description::to_text(search));
}

TEST(SearchDescription, IsRefusedWhenObservationsWereNormalisedOrNothingSaysThatTheyWereNot) {
  const std::string text = read_model(test::model("memory.zip"), "m").search.value();
  const auto refused_text = [](const std::string& changed) { return refusal([&] { (void)description::from_text(changed); }); };
  EXPECT_EQ(refused_text(text), "");
  EXPECT_NE(refused_text(replaced(text, "\"normalisation\": \"none\", ", "")).find("normalisation: missing"), std::string::npos);
  EXPECT_NE(refused_text(replaced(text, "\"none\"", "\"VecNormalize\"")).find("normalisation"), std::string::npos);
  EXPECT_NE(refused_text(replaced(text, "\"feature\": 5", "\"feature\": 200")).find("unknown feature"), std::string::npos);
  EXPECT_NE(refused_text(replaced(text, "\"direction_count\": 8", "\"direction_count\": 0")).find("direction_count"), std::string::npos);
  EXPECT_NE(refused_text(replaced(text, "\"step_length_m\": 1000.0", "\"step_length_m\": -1")).find("step_length_m"), std::string::npos);
  EXPECT_NE(refused_text(text.substr(0, 50)).find("cut short"), std::string::npos);
}

/// The model's search with a belief of 50 x 50 cells.
std::string text_with_belief() {
  description::SearchDescription search = description::from_text(read_model(test::model("memory.zip"), "m").search.value());
  EXPECT_EQ(search.observation.spec.push_back({.feature = policy::Feature::kEffectiveCells}), Status::kOk);
  policy::BeliefModel& belief = search.observation.belief;
  belief.cells_north = 50;
  belief.cells_east = 50;
  belief.border_width = Meters{1'000.0};
  return description::to_text(search);
}

TEST(SearchDescription, RefusesWholeNumbersThatWouldWrapOrLoseTheirFraction) {
  const auto refused_with = [text = text_with_belief()](const std::string& from, const std::string& to) {
    return refusal([&] { (void)description::from_text(replaced(text, from, to)); });
  };
  EXPECT_EQ(refused_with("\"cells_north\":50", "\"cells_north\":25"), "");
  for (const std::string cells : {"65586", "0", "-1", "2501", "50.5", "18446744073709551615", "1e300"}) {  // 65586 = 65536 + 50
    const std::string expected = ": must be a whole number, 1 to 2500";
    EXPECT_NE(refused_with("\"cells_north\":50", "\"cells_north\":" + cells).find("cells_north" + expected), std::string::npos) << cells;
    EXPECT_NE(refused_with("\"cells_east\":50", "\"cells_east\":" + cells).find("cells_east" + expected), std::string::npos) << cells;
  }
  EXPECT_TRUE(support::has_line(refused_with("\"direction_count\":8", "\"direction_count\":8.5"), {"direction_count", "1 to 32"}));
  EXPECT_NE(refused_with("\"age\":0", "\"age\":256").find("age: must be a whole number, 0 to 255"), std::string::npos);
}

}  // namespace
}  // namespace earshot::freeze
