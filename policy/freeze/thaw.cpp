#include "policy/freeze/thaw.hpp"

#include <algorithm>

#include "firmware/core/crc32.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/format/byte_stream.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "policy/freeze/freeze.hpp"
#include "policy/freeze/golden_search.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;
using policy::ByteReader;

constexpr std::string_view kMagic = "EARSHOTP";
constexpr std::size_t kTrailerSize = policy::kPublicKeySize + 4 + policy::kSignatureSize;  // with the CRC-32, in every version
constexpr std::size_t kGoldenPairs = 8;                                                    // of version 3

/// Of version 3, as they stand at its beginning.
struct Shape {
  std::size_t observation = 0;
  std::size_t actions = 0;
  std::array<std::size_t, config::kMaxHiddenLayers> hidden{};
  std::size_t provenance = 0;
  std::size_t hypotheses = 0;  ///< 0: no belief
  std::size_t ranges = 0;

  [[nodiscard]] bool fits() const {
    const auto within = [](std::size_t size, std::size_t capacity) { return size >= 1 && size <= capacity; };
    return within(observation, config::kMaxObservation) && within(actions, config::kMaxActions) &&
           std::ranges::all_of(hidden, [within](std::size_t size) { return within(size, policy::Network::kWidth); }) &&
           provenance <= config::kMaxProvenance && hypotheses <= config::kMaxBeliefHypotheses && ranges <= config::kMaxBeliefRanges;
  }
};

/// The capacities were asked first: nothing is full.
template <class Vector, class Value>
void append(Vector& vector, const Value& value) {
  if (vector.push_back(value) != Status::kOk) throw BadInput("holds more than a vehicle can");
}

NorthEast read_place(ByteReader& reader) {
  const double north = reader.f64();
  return {Meters{north}, Meters{reader.f64()}};
}

template <class Layer>
void read_layer(ByteReader& reader, Layer& layer, std::size_t outputs, std::size_t inputs) {
  for (std::size_t i = 0; i < outputs * inputs; ++i) layer.weight(i / inputs, i % inputs) = reader.f32();
  for (std::size_t i = 0; i < outputs; ++i) layer.bias[i] = reader.f32();
}

Shape read_header(ByteReader& reader, policy::FrozenPolicy& policy) {
  Shape shape;
  if (reader.u8() != 1) throw BadInput("has another activation than tanh");
  policy.draw = static_cast<policy::ActionDraw>(reader.u8());
  shape.observation = reader.u8();
  shape.actions = reader.u8();
  for (std::size_t& size : shape.hidden) size = reader.u16();
  policy.step_length = Meters{reader.f64()};
  policy.area_size = read_place(reader);
  policy.detection_threshold = Decibels{reader.f64()};
  shape.provenance = reader.u32();
  shape.hypotheses = reader.u16();
  shape.ranges = reader.u16();
  if (!shape.fits()) throw BadInput("has a size that is zero or more than a vehicle can hold");
  return shape;
}

void read_belief(ByteReader& reader, const Shape& shape, policy::BeliefModel& model) {
  model.cells_north = reader.u16();
  model.cells_east = reader.u16();
  model.border_width = Meters{reader.f64()};
  model.range_step = Meters{reader.f64()};
  model.outlier_share = reader.f32();
  model.silence_share = reader.f32();
  model.forgotten_share = reader.f32();
  (void)reader.f32();  // reserved
  for (std::size_t i = 0; i < shape.hypotheses; ++i) {
    policy::BeliefHypothesis hypothesis;
    hypothesis.level_offset_db = reader.f32();
    hypothesis.spread_db = reader.f32();
    hypothesis.prior = reader.f32();
    append(model.hypotheses, hypothesis);
  }
  for (std::size_t i = 0; i < shape.ranges; ++i) append(model.snr_db, reader.f32());
}

/// The bytes between header and trailer.
void read_body(ByteReader& reader, const Shape& shape, policy::FrozenPolicy& policy) {
  for (std::size_t i = 0; i < shape.observation; ++i) {
    policy::ObservationElement element;
    element.feature = static_cast<policy::Feature>(reader.u8());
    element.age = reader.u8();
    (void)reader.u16();  // reserved
    element.offset = reader.f32();
    element.scale = reader.f32();
    append(policy.observation.spec, element);
  }
  for (std::size_t i = 0; i < shape.actions; ++i) {
    const double north = reader.f64();
    append(policy.actions, UnitNorthEast{.north = north, .east = reader.f64()});
  }
  policy::BeliefModel& belief = policy.observation.belief;
  belief.area_size = policy.area_size;
  belief.step_length = policy.step_length;
  belief.detection_threshold = policy.detection_threshold;
  belief.actions = policy.actions;
  if (shape.hypotheses > 0) read_belief(reader, shape, belief);
  policy.network.observation_size = shape.observation;
  policy.network.hidden_sizes = shape.hidden;
  policy.network.action_count = shape.actions;
  read_layer(reader, policy.network.first, shape.hidden[0], shape.observation);
  read_layer(reader, policy.network.second, shape.hidden[1], shape.hidden[0]);
  read_layer(reader, policy.network.output, shape.actions, shape.hidden[1]);
  (void)reader.take(kGoldenPairs * (shape.observation + shape.actions) * sizeof(float));
  for (std::size_t i = 0; i < shape.provenance; ++i) append(policy.provenance, static_cast<char>(reader.u8()));
}

std::unique_ptr<policy::FrozenPolicy> read_version_3(std::span<const std::uint8_t> bytes) {
  ByteReader whole(bytes.subspan(kMagic.size() + sizeof(std::uint32_t)));
  if (whole.u32() != bytes.size() || bytes.size() < kTrailerSize) throw BadInput("is not as long as it says");
  ByteReader checksum(bytes.last(policy::kSignatureSize + 4));
  if (checksum.u32() != crc32(bytes.first(bytes.size() - policy::kSignatureSize - 4))) throw BadInput("is damaged: its CRC-32 is wrong");
  auto policy = std::make_unique<policy::FrozenPolicy>();
  const Shape shape = read_header(whole, *policy);
  read_body(whole, shape, *policy);
  if (whole.past_end() || whole.remaining() != kTrailerSize) throw BadInput("is not as long as what it holds");
  return policy;
}

std::uint32_t version_of(std::span<const std::uint8_t> bytes) {
  return ByteReader(bytes.subspan(kMagic.size())).u32();
}

std::unique_ptr<policy::FrozenPolicy> thawed_version_3(std::span<const std::uint8_t> bytes, const std::string& file) {
  try {
    return read_version_3(bytes);
  } catch (const BadInput& e) {
    throw BadInput(file + ": " + e.what());
  }
}

}  // namespace

bool is_policy(std::string_view bytes) {
  return bytes.starts_with(kMagic);
}

host::PublicKey signer_of(std::span<const std::uint8_t> bytes) {
  return policy::format::carried_key(bytes);
}

std::unique_ptr<policy::FrozenPolicy> thaw(std::span<const std::uint8_t> bytes, const std::string& file) {
  auto policy = version_of(bytes) == 3 ? thawed_version_3(bytes, file) : host::unproven_policy_from(bytes, file);
  if (!host::is_signed_at_end(bytes, signer_of(bytes))) throw BadInput(file + ": its signature is not that of the key it carries");
  check_flies(*policy, file);
  fly_golden_searches(*policy);
  return policy;
}

}  // namespace earshot::freeze
