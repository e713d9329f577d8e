#include "policy/freeze/sb3_model.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/json_fault.hpp"
#include "policy/freeze/pickle.hpp"
#include "policy/freeze/state_dict.hpp"
#include "policy/freeze/zip_archive.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;
using Json = nlohmann::json;
using Kind = PickleValue::Kind;

constexpr std::string_view kPolicyClass = "stable_baselines3.common.policies.ActorCriticPolicy";
constexpr std::string_view kTanh = "torch.nn.modules.activation.Tanh";
constexpr std::string_view kRelu = "torch.nn.modules.activation.ReLU";

/// Arguments of the policy that change how it was initialised or trained, not what it computes.
constexpr std::array<std::string_view, 5> kHarmlessArguments = {"net_arch", "ortho_init", "log_std_init", "optimizer_class",
                                                                "optimizer_kwargs"};

std::string from_base64(const std::string& text) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  unsigned bit_count = 0;
  const std::size_t padding = std::min(text.find('='), text.size());
  for (const char c : text.substr(0, padding)) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) throw BadInput("not base64");
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes.push_back(static_cast<char>((bits >> bit_count) & 0xFFU));
  }
  return bytes;
}

/// What save() wrote for one attribute of the model that is not plain JSON. Names are read, nothing is called.
Pickle pickled(const std::string& name, const Json& item) {
  static const PickleRules kNamesOnly{.may_name = [](std::string_view) { return true; },
                                      .may_call = [](std::string_view) { return false; }};
  try {
    return read_pickle(from_base64(item.at(":serialized:").get<std::string>()), kNamesOnly);
  } catch (const BadInput& e) {
    throw BadInput(name + ": " + e.what());
  }
}

void check_policy_class(const Json& item) {
  const Pickle pickle = pickled("policy_class", item);
  const PickleValue& top = pickle.top();
  if (top.kind != Kind::kGlobal || top.text != kPolicyClass) {
    throw BadInput("policy_class: " + (top.kind == Kind::kGlobal ? top.text : "unknown") + "; only " + std::string(kPolicyClass) +
                   " (PPO or A2C with MlpPolicy) can be frozen");
  }
}

policy::Activation activation_of(const PickleValue* value) {
  const bool is_named = value != nullptr && value->kind == Kind::kGlobal;
  if (is_named && value->text == kTanh) return policy::Activation::kTanh;
  if (is_named && value->text == kRelu) return policy::Activation::kRelu;
  throw BadInput("policy_kwargs: activation_fn: " + (is_named ? value->text : "unknown") + "; only " + std::string(kTanh) + " and " +
                 std::string(kRelu) + " fly");
}

void take_policy_argument(std::string_view name, const PickleValue* value, policy::Activation& activation) {
  if (name == "activation_fn") {
    activation = activation_of(value);
    return;
  }
  if (std::ranges::find(kHarmlessArguments, name) != kHarmlessArguments.end()) return;
  throw BadInput("policy_kwargs: " + std::string(name) + ": not known to leave what the policy computes as it is");
}

/// The activation that the policy's arguments name; without one Stable-Baselines3's own.
policy::Activation check_policy_arguments(const Json& item) {
  policy::Activation activation = policy::Activation::kTanh;
  if (!item.is_object()) throw BadInput("policy_kwargs: not a dictionary");
  if (!item.contains(":serialized:")) {
    for (const auto& [name, value] : item.items()) take_policy_argument(name, nullptr, activation);
    return activation;
  }
  const Pickle pickle = pickled("policy_kwargs", item);
  const PickleValue& top = pickle.top();
  if (top.kind != Kind::kDictionary) throw BadInput("policy_kwargs: not a dictionary");
  for (std::size_t i = 0; i + 1 < top.items.size(); i += 2) {
    const PickleValue& name = pickle.at(top.items[i]);
    if (name.kind != Kind::kText) throw BadInput("policy_kwargs: a name that is not a text");
    take_policy_argument(name.text, &pickle.at(top.items[i + 1]), activation);
  }
  return activation;
}

void check_spaces(const Json& data) {
  const Json& actions = data.at("action_space");
  if (actions.at(":type:") != "<class 'gymnasium.spaces.discrete.Discrete'>" || actions.at("start") != "0") {
    throw BadInput("action_space: only gymnasium's Discrete that starts at 0 can be frozen");
  }
  const Json& observations = data.at("observation_space");
  const bool flat = observations.at(":type:") == "<class 'gymnasium.spaces.box.Box'>" && observations.at("_shape").size() == 1;
  if (!flat || observations.at("dtype") != "float32") throw BadInput("observation_space: only a flat Box of float32 can be frozen");
}

/// Everything about the model that decides how its weights are used. @return what its hidden units do
policy::Activation check_data(const std::string& text) {
  try {
    const Json data = Json::parse(text);
    check_policy_class(data.at("policy_class"));
    const policy::Activation activation = check_policy_arguments(data.at("policy_kwargs"));
    check_spaces(data);
    if (data.at("use_sde") != false) throw BadInput("use_sde: state-dependent exploration cannot be frozen");
    return activation;
  } catch (const Json::exception& e) {
    throw BadInput("data: not a model of Stable-Baselines3: " + description::to_string(e));
  } catch (const BadInput& e) {
    throw BadInput(std::string("data: ") + e.what());
  }
}

DenseLayer layer_from(StateDict& state, const std::string& name) {
  const auto weights = state.find(name + ".weight");
  const auto bias = state.find(name + ".bias");
  if (weights == state.end() || bias == state.end()) throw BadInput("has no " + name);
  const std::vector<std::size_t>& shape = weights->second.shape;
  if (shape.size() != 2 || bias->second.shape != std::vector<std::size_t>{shape[0]}) throw BadInput(name + ": not a dense layer");
  DenseLayer layer{
      .inputs = shape[1], .outputs = shape[0], .weights = std::move(weights->second.values), .bias = std::move(bias->second.values)};
  state.erase(weights);
  state.erase(bias);
  return layer;
}

TrainedActor actor_from(StateDict state, policy::Activation activation) {
  TrainedActor actor;
  actor.activation = activation;
  for (std::size_t i = 0; state.contains("mlp_extractor.policy_net." + std::to_string(2 * i) + ".weight"); ++i) {
    actor.layers.push_back(layer_from(state, "mlp_extractor.policy_net." + std::to_string(2 * i)));
  }
  actor.layers.push_back(layer_from(state, "action_net"));
  for (const auto& [name, tensor] : state) {
    if (name.starts_with("mlp_extractor.value_net.") || name.starts_with("value_net.")) continue;  // the critic does not fly
    throw BadInput(name + ": not a weight of Stable-Baselines3's MlpPolicy for discrete actions");
  }
  check_chain(actor);
  return actor;
}

}  // namespace

TrainedActor read_sb3_model(std::string_view bytes) {
  const ZipArchive archive(bytes);
  if (!archive.has("data") || !archive.has("policy.pth")) throw BadInput("a zip archive, but no model of Stable-Baselines3");
  const policy::Activation activation = check_data(archive.read("data"));
  const std::string weights = archive.read("policy.pth");
  try {
    TrainedActor actor = actor_from(read_state_dict(weights), activation);
    if (const std::string entry(kSearchEntry); archive.has(entry)) actor.search = archive.read(entry);
    return actor;
  } catch (const BadInput& e) {
    throw BadInput(std::string("policy.pth: ") + e.what());
  }
}

}  // namespace earshot::freeze
