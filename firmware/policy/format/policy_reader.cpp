#include <span>

#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/envelope/byte_stream.hpp"
#include "firmware/policy/envelope/provenance.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/format/sections.hpp"

namespace earshot::policy {
namespace {

using namespace format;

void read(ByteReader& reader, std::span<float> values) {
  for (float& value : values) value = reader.f32();
}

NorthEast read_place(ByteReader& reader) {
  const double north = reader.f64();
  return {.north = Meters{north}, .east = Meters{reader.f64()}};
}

void read_layer(ByteReader& reader, const Network::Layer& layer) {
  for (std::size_t o = 0; o < layer.outputs; ++o) {
    for (std::size_t i = 0; i < layer.inputs; ++i) layer.weight(o, i) = reader.f32();
  }
  read(reader, layer.bias.first(layer.outputs));
}

PolicyFault read_network(ByteReader& reader, FrozenPolicy& policy) {
  Network& network = policy.network;
  network.hidden_sizes = {};
  network.activation = Activation::kTanh;
  const std::uint8_t form = reader.u8();
  if (form > kStatedLayers) return PolicyFault::kUnknownActivation;
  if (form == kStatedLayers) network.activation = static_cast<Activation>(reader.u8());
  network.observation_size = reader.u8();
  std::size_t hidden_count = form == kTwoTanhLayers ? 2 : 0;
  if (form == kStatedLayers) hidden_count = reader.u8();
  if (hidden_count > config::kMaxHiddenLayers) return PolicyFault::kBadShape;
  for (std::size_t l = 0; l < hidden_count; ++l) network.hidden_sizes[l] = reader.u16();
  network.action_count = reader.u8();
  if (form == kNoNetwork) return PolicyFault::kNone;
  if (network.hidden_count() != hidden_count) return PolicyFault::kBadShape;  // one of them has no units
  if (const PolicyFault fault = fault_in_shape(network); fault != PolicyFault::kNone) return fault;
  for (std::size_t l = 0; l <= hidden_count; ++l) read_layer(reader, network.layer(l));
  return PolicyFault::kNone;
}

PolicyFault read_observation(ByteReader& reader, FrozenPolicy& policy) {
  policy.area_size = read_place(reader);
  policy.detection_threshold = Decibels{reader.f64()};
  config::ListeningWindow& listening = policy.observation.listening;
  listening.listening = static_cast<config::Listening>(reader.u8());
  listening.length = Duration::seconds(reader.u16());
  policy.observation.spec.clear();
  const std::size_t count = reader.u8();
  for (std::size_t i = 0; i < count; ++i) {
    ObservationElement element;
    element.feature = static_cast<Feature>(reader.u8());
    element.age = reader.u8();
    element.offset = reader.f32();
    element.scale = reader.f32();
    if (policy.observation.spec.push_back(element) != Status::kOk) return PolicyFault::kBadShape;
  }
  return PolicyFault::kNone;
}

PolicyFault read_actions(ByteReader& reader, FrozenPolicy& policy) {
  policy.step_length = Meters{reader.f64()};
  policy.actions.clear();
  const std::size_t count = reader.u8();
  for (std::size_t i = 0; i < count; ++i) {
    const double north = reader.f64();
    if (policy.actions.push_back({.north = north, .east = reader.f64()}) != Status::kOk) return PolicyFault::kBadShape;
  }
  return PolicyFault::kNone;
}

PolicyFault read_draw(ByteReader& reader, FrozenPolicy& policy) {
  policy.draw = static_cast<ActionDraw>(reader.u8());
  return PolicyFault::kNone;
}

/// What the file says about the belief; the rest is the policy's own.
PolicyFault read_belief(ByteReader& reader, FrozenPolicy& policy) {
  BeliefModel& model = policy.observation.belief;
  model.area_size = policy.area_size;
  model.step_length = policy.step_length;
  model.detection_threshold = policy.detection_threshold;
  model.actions = policy.actions;
  if (!needs_belief(policy.observation.spec)) return PolicyFault::kNone;
  model.cells_north = reader.u16();
  model.cells_east = reader.u16();
  model.border_width = Meters{reader.f64()};
  model.outlier_share = reader.f32();
  BeliefCosts& costs = model.costs;
  for (float* const cost :
       {&costs.step, &costs.log_step_discount, &costs.find_probability, &costs.find_discount, &costs.edge, &costs.most_regret})
    *cost = reader.f32();
  return PolicyFault::kNone;
}

PolicyFault read_golden_step(ByteReader& reader, const Network& network, GoldenStep& step) {
  step = GoldenStep{};
  step.place = read_place(reader);
  step.reception.snr = Decibels{reader.f64()};
  const std::uint8_t too_faint = reader.u8();
  step.reception.too_faint = too_faint == 1;
  step.belief.likeliest = read_place(reader);
  step.belief.mean = read_place(reader);
  step.belief.spread = Meters{reader.f64()};
  step.belief.likeliest_share = reader.f32();
  step.belief.effective_cells = reader.f32();
  step.fingerprint = reader.u32();
  read(reader, std::span(step.observation).first(network.observation_size));
  read(reader, std::span(step.logits).first(network.action_count));
  return too_faint <= 1 ? PolicyFault::kNone : PolicyFault::kOutOfRange;
}

PolicyFault read_golden(ByteReader& reader, FrozenPolicy& policy) {
  if (reader.u8() != config::kGoldenTrajectories || reader.u8() != config::kGoldenSteps) return PolicyFault::kBadShape;
  for (GoldenTrajectory& trajectory : policy.golden) {
    for (GoldenStep& step : trajectory)
      if (const PolicyFault fault = read_golden_step(reader, policy.network, step); fault != PolicyFault::kNone) return fault;
  }
  return PolicyFault::kNone;
}

PolicyFault read_content(ByteReader& reader, Content content, FrozenPolicy& policy) {
  switch (content) {
    case Content::kNetwork:
      return read_network(reader, policy);
    case Content::kObservation:
      return read_observation(reader, policy);
    case Content::kActions:
      return read_actions(reader, policy);
    case Content::kDraw:
      return read_draw(reader, policy);
    case Content::kBelief:
      return read_belief(reader, policy);
    case Content::kProvenance:
      return read_provenance(reader, policy.provenance);
    case Content::kGolden:
      return read_golden(reader, policy);
  }
  return PolicyFault::kUnknownSection;
}

PolicyComplaint complaint_about(std::span<const std::uint8_t> bytes, FrozenPolicy& policy) {
  const PolicyComplaint complaint = read_file(bytes, kPolicyFile, [&policy](ByteReader& content, std::size_t index) {
    return read_content(content, static_cast<Content>(index), policy);
  });
  return complaint.is_none() ? check(policy) : with_size(complaint, policy.network);
}

}  // namespace

Status parse(std::span<const std::uint8_t> bytes, FrozenPolicy& policy, PolicyComplaint& complaint) {
  complaint = complaint_about(bytes, policy);
  return status_of(complaint.fault);
}

}  // namespace earshot::policy
