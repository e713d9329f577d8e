#include "policy/freeze/freeze.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <sstream>
#include <string>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "policy/freeze/golden_search.hpp"
#include "policy/ppo/actor_critic.hpp"
#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/settings.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;
using Networks = ppo::ActorCritic<float>;

/// Logit of the action of least regret; one whose regret is a tenth of a step more has 0.9 less: in shares of a softmax, which explanations
/// and sampled draws show, 40 % of it.
constexpr float kAdviceSharpness = 10.0F;

const std::string kListening = "listening";
const std::string kBefore = " (before: ";  // and the window that the policy was trained with

/// A dense layer where its trainer left it: weights[output * per_output + input * per_input].
struct LayerView {
  std::size_t inputs;
  std::size_t outputs;
  std::span<const float> weights;
  std::size_t per_output;
  std::size_t per_input;
  std::span<const float> bias;
};

LayerView view_of(const DenseLayer& layer) {
  return {.inputs = layer.inputs,
          .outputs = layer.outputs,
          .weights = layer.weights,
          .per_output = layer.inputs,
          .per_input = 1,
          .bias = layer.bias};
}

/// The first `outputs` of a layer of a checkpoint, whose rows are as long as all of its outputs.
LayerView view_of(std::span<const float> parameters, const Networks::Layer& layer, std::size_t outputs) {
  return {.inputs = static_cast<std::size_t>(layer.inputs),
          .outputs = outputs,
          .weights = parameters.subspan(static_cast<std::size_t>(layer.offset)),
          .per_output = 1,
          .per_input = static_cast<std::size_t>(layer.outputs),
          .bias = parameters.subspan(static_cast<std::size_t>(layer.bias()), outputs)};
}

void copy_layer(const LayerView& from, const policy::Network::Layer& to) {
  for (std::size_t o = 0; o < from.outputs; ++o) {
    for (std::size_t i = 0; i < from.inputs; ++i) to.weight(o, i) = from.weights[o * from.per_output + i * from.per_input];
  }
  std::ranges::copy(from.bias, to.bias.begin());
}

/// The only way of a trained weight to its place on the vehicle. @param layers  of sizes that fit, the last the output
void copy_network(const std::vector<LayerView>& layers, policy::Activation activation, policy::Network& network) {
  network.observation_size = layers.front().inputs;
  network.hidden_sizes = {};
  for (std::size_t l = 0; l + 1 < layers.size(); ++l) network.hidden_sizes[l] = layers[l].outputs;
  network.action_count = layers.back().outputs;
  network.activation = activation;
  for (std::size_t l = 0; l < layers.size(); ++l) copy_layer(layers[l], network.layer(l));
}

void append(const std::string& text, policy::FrozenPolicy& policy) {
  for (const char c : text) {
    if (policy.provenance.push_back(c) != Status::kOk)
      throw BadInput("provenance: longer than the " + std::to_string(config::kMaxProvenance) + " bytes a policy can hold");
  }
}

/// Adds a line to the provenance, one whatever stands in a name or value.
void note(const std::string& name, const std::string& value, policy::FrozenPolicy& policy) {
  append(host::printable(name) + " = " + host::printable(value) + "\n", policy);
}

/// Takes out of the provenance what listen_over() noted there.
/// @return the window that stands in it as the one before; nothing when nothing was noted
std::optional<std::string> taken_listening_note(policy::FrozenPolicy& policy) {
  std::optional<std::string> window;
  std::string rest;
  std::istringstream lines(std::string(policy.provenance.begin(), policy.provenance.end()));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t before = line.find(kBefore);
    const bool is_note = line.starts_with(kListening + " = ") && line.ends_with(')') && before != std::string::npos;
    if (is_note) {
      window = line.substr(before + kBefore.size(), line.size() - 1 - before - kBefore.size());
    } else {
      rest += line + "\n";
    }
  }
  policy.provenance.clear();
  append(rest, policy);
  return window;
}

/// Everything but the network.
std::unique_ptr<policy::FrozenPolicy> without_network(const description::SearchDescription& source, policy::ActionDraw draw) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->observation = source.observation;
  policy->actions = search::compass_directions(source.direction_count);
  policy->step_length = source.step_length;
  policy->area_size = source.area_size;
  policy->detection_threshold = source.detection_threshold;
  policy->draw = draw;
  for (const auto& [name, value] : source.provenance) note(name, value, *policy);
  return policy;
}

void check_fit(const TrainedActor& actor, const description::SearchDescription& search) {
  check_chain(actor);
  const std::size_t hidden = actor.layers.size() - 1;
  if (hidden < 1 || hidden > config::kMaxHiddenLayers) {
    throw BadInput("has " + std::to_string(hidden) + " hidden layers; 1 to " + std::to_string(config::kMaxHiddenLayers) + " fly");
  }
  for (std::size_t i = 0; i < hidden; ++i) {
    if (actor.layers[i].outputs <= policy::Network::kWidth) continue;
    throw BadInput("hidden layer " + std::to_string(i + 1) + " has " + std::to_string(actor.layers[i].outputs) + " units; at most " +
                   std::to_string(policy::Network::kWidth) + " fly");
  }
  const std::size_t inputs = actor.layers.front().inputs;
  const std::size_t outputs = actor.layers.back().outputs;
  if (inputs == search.observation.spec.size() && outputs == search.direction_count) return;
  throw BadInput("has " + std::to_string(inputs) + " inputs and " + std::to_string(outputs) + " outputs; its search description has " +
                 std::to_string(search.observation.spec.size()) + " observations and " + std::to_string(search.direction_count) +
                 " directions");
}

}  // namespace

std::unique_ptr<policy::FrozenPolicy> freeze(const ppo::Checkpoint& checkpoint, policy::ActionDraw draw) {
  auto policy = without_network(checkpoint, draw);
  const Networks::Layout layout = Networks::layout_of(checkpoint.shape());
  const auto view = [&](const Networks::Layer& layer, std::size_t outputs) { return view_of(checkpoint.parameters, layer, outputs); };
  constexpr auto kWidth = static_cast<std::size_t>(ppo::kWidth);
  // Of the first layer the actor's half stands above the critic's.
  copy_network({view(layout.first, kWidth), view(layout.actor_second, kWidth), view(layout.logits, checkpoint.direction_count)},
               policy::Activation::kTanh, policy->network);
  check_flies(*policy, "the policy");
  fly_golden_searches(*policy);
  return policy;
}

std::unique_ptr<policy::FrozenPolicy> freeze(const TrainedActor& actor, const description::SearchDescription& search,
                                             policy::ActionDraw draw) {
  check_fit(actor, search);
  auto policy = without_network(search, draw);
  std::vector<LayerView> layers;
  for (const DenseLayer& layer : actor.layers) layers.push_back(view_of(layer));
  copy_network(layers, actor.activation, policy->network);
  check_flies(*policy, "the policy");
  fly_golden_searches(*policy);
  return policy;
}

std::unique_ptr<policy::FrozenPolicy> freeze_advice(const description::SearchDescription& search, policy::ActionDraw draw) {
  auto policy = without_network(search, draw);
  policy->network.observation_size = search.observation.spec.size();
  policy->network.action_count = search.direction_count;
  policy::ObservationSpec sharpened;
  for (policy::ObservationElement element : search.observation.spec) {
    if (element.feature == policy::Feature::kPreference) element.scale = kAdviceSharpness;
    [[maybe_unused]] const Status status = sharpened.push_back(element);
  }
  policy->observation.spec = sharpened;
  check_flies(*policy, "the policy");
  fly_golden_searches(*policy);
  return policy;
}

void listen_over(policy::FrozenPolicy& policy, config::ListeningWindow window) {
  if (policy.observation.listening == window) return;
  const std::string listening = host::to_string(window);
  const std::string trained = taken_listening_note(policy).value_or(host::to_string(policy.observation.listening));
  if (listening != trained) note(kListening, listening + kBefore + trained + ")", policy);
  policy.observation.listening = window;
}

void check_flies(const policy::FrozenPolicy& policy, const std::string& name) {
  const policy::PolicyComplaint complaint = policy::check(policy);
  if (!complaint.is_none()) throw BadInput(host::to_string(complaint, name));
  host::require_provenance({policy.provenance.begin(), policy.provenance.end()}, name);
}

std::vector<std::uint8_t> sign(const policy::FrozenPolicy& policy, const host::SecretKey& key) {
  std::vector<std::uint8_t> bytes(policy::max_serialised_size());
  const Result<std::size_t> size = policy::serialise(policy, host::public_key_of(key), bytes);
  if (!size.ok()) throw BadInput("the policy does not fit the vehicle: a size, weight or scale is out of range");
  bytes.resize(size.value());
  host::sign_at_end(bytes, key);
  return bytes;
}

}  // namespace earshot::freeze
