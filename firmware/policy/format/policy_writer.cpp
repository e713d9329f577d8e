#include <span>

#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/envelope/byte_stream.hpp"
#include "firmware/policy/envelope/provenance.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/format/sections.hpp"

namespace earshot::policy {
namespace {

using namespace format;

void write(ByteWriter& writer, std::span<const float> values) {
  for (const float value : values) writer.f32(value);
}

void write(ByteWriter& writer, NorthEast place) {
  writer.f64(place.north.value);
  writer.f64(place.east.value);
}

void write_layer(ByteWriter& writer, const Network::ConstLayer& layer) {
  for (std::size_t o = 0; o < layer.outputs; ++o) {
    for (std::size_t i = 0; i < layer.inputs; ++i) writer.f32(layer.weight(o, i));
  }
  write(writer, layer.bias.first(layer.outputs));
}

/// Two layers with tanh as every program reads them.
std::uint8_t form_of(const Network& network) {
  if (!has_network(network)) return kNoNetwork;
  return network.activation == Activation::kTanh && network.hidden_count() == 2 ? kTwoTanhLayers : kStatedLayers;
}

void write_network(ByteWriter& writer, const FrozenPolicy& policy) {
  const Network& network = policy.network;
  const std::uint8_t form = form_of(network);
  const std::size_t hidden_count = network.hidden_count();
  writer.u8(form);
  if (form == kStatedLayers) writer.u8(static_cast<std::uint8_t>(network.activation));
  writer.u8(static_cast<std::uint8_t>(network.observation_size));
  if (form == kStatedLayers) writer.u8(static_cast<std::uint8_t>(hidden_count));
  for (std::size_t l = 0; l < hidden_count; ++l) writer.u16(static_cast<std::uint16_t>(network.hidden_sizes[l]));
  writer.u8(static_cast<std::uint8_t>(network.action_count));
  if (form == kNoNetwork) return;
  for (std::size_t l = 0; l <= hidden_count; ++l) write_layer(writer, network.layer(l));
}

void write_observation(ByteWriter& writer, const FrozenPolicy& policy) {
  write(writer, policy.area_size);
  writer.f64(policy.detection_threshold.value);
  const config::ListeningWindow& listening = policy.observation.listening;
  writer.u8(static_cast<std::uint8_t>(listening.listening));
  writer.u16(static_cast<std::uint16_t>(listening.length.us / Duration::seconds(1).us));
  writer.u8(static_cast<std::uint8_t>(policy.observation.spec.size()));
  for (const ObservationElement& element : policy.observation.spec) {
    writer.u8(static_cast<std::uint8_t>(element.feature));
    writer.u8(element.age);
    writer.f32(element.offset);
    writer.f32(element.scale);
  }
}

void write_actions(ByteWriter& writer, const FrozenPolicy& policy) {
  writer.f64(policy.step_length.value);
  writer.u8(static_cast<std::uint8_t>(policy.actions.size()));
  for (const UnitNorthEast& direction : policy.actions) {
    writer.f64(direction.north);
    writer.f64(direction.east);
  }
}

void write_draw(ByteWriter& writer, const FrozenPolicy& policy) {
  writer.u8(static_cast<std::uint8_t>(policy.draw));
}

/// Nothing, when no element of the observation sees a belief.
void write_belief(ByteWriter& writer, const FrozenPolicy& policy) {
  if (!needs_belief(policy.observation.spec)) return;
  const BeliefModel& model = policy.observation.belief;
  writer.u16(model.cells_north);
  writer.u16(model.cells_east);
  writer.f64(model.border_width.value);
  writer.f32(model.outlier_share);
  const BeliefCosts& costs = model.costs;
  for (const float cost : {costs.step, costs.log_step_discount, costs.find_probability, costs.find_discount, costs.edge, costs.most_regret})
    writer.f32(cost);
}

void write_golden(ByteWriter& writer, const FrozenPolicy& policy) {
  writer.u8(static_cast<std::uint8_t>(config::kGoldenTrajectories));
  writer.u8(static_cast<std::uint8_t>(config::kGoldenSteps));
  for (const GoldenTrajectory& trajectory : policy.golden) {
    for (const GoldenStep& step : trajectory) {
      write(writer, step.place);
      writer.f64(step.reception.snr.value);
      writer.u8(step.reception.too_faint ? 1 : 0);
      write(writer, step.belief.likeliest);
      write(writer, step.belief.mean);
      writer.f64(step.belief.spread.value);
      writer.f32(step.belief.likeliest_share);
      writer.f32(step.belief.effective_cells);
      writer.u32(step.fingerprint);
      write(writer, std::span(step.observation).first(policy.network.observation_size));
      write(writer, std::span(step.logits).first(policy.network.action_count));
    }
  }
}

void write_content(ByteWriter& writer, const FrozenPolicy& policy, Content content) {
  switch (content) {
    case Content::kNetwork:
      return write_network(writer, policy);
    case Content::kObservation:
      return write_observation(writer, policy);
    case Content::kActions:
      return write_actions(writer, policy);
    case Content::kDraw:
      return write_draw(writer, policy);
    case Content::kBelief:
      return write_belief(writer, policy);
    case Content::kProvenance:
      return write_provenance(writer, policy.provenance);
    case Content::kGolden:
      return write_golden(writer, policy);
  }
}

}  // namespace

std::size_t max_serialised_size() {
  constexpr std::size_t kObservation = config::kMaxObservation;
  constexpr std::size_t kActions = config::kMaxActions;
  constexpr std::size_t kNetwork = 5 + 2 * config::kMaxHiddenLayers + 4 * config::kMaxNetworkNumbers;
  constexpr std::size_t kObservationSize = 28 + 10 * kObservation;
  constexpr std::size_t kActionsSize = 9 + 16 * kActions;
  constexpr std::size_t kBelief = 40;
  constexpr std::size_t kGoldenStep = 77 + 4 * (kObservation + kActions);
  constexpr std::size_t kGolden = 2 + config::kGoldenTrajectories * config::kGoldenSteps * kGoldenStep;
  return size_around(kPolicyFile, kNetwork + kObservationSize + kActionsSize + 1 + kBelief + config::kMaxProvenance + kGolden);
}

Result<std::size_t> serialise(const FrozenPolicy& policy, std::span<const std::uint8_t, kPublicKeySize> public_key,
                              std::span<std::uint8_t> bytes) {
  if (!check(policy).is_none()) return Status::kOutOfRange;
  return write_file(kPolicyFile, public_key, bytes,
                    [&policy](ByteWriter& writer, std::size_t index) { write_content(writer, policy, static_cast<Content>(index)); });
}

}  // namespace earshot::policy
