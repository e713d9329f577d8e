#include "firmware/policy/frozen_policy.hpp"

#include <algorithm>
#include <bit>

#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/random.hpp"
#include "firmware/policy/byte_stream.hpp"

namespace earshot::policy {
namespace {

// The format; README.md of this folder has it as a table.
constexpr std::array<std::uint8_t, 8> kMagic = {'E', 'A', 'R', 'S', 'H', 'O', 'T', 'P'};
constexpr std::uint8_t kTanh = 1;
constexpr std::size_t kHeaderSize = 64;
constexpr std::size_t kElementSize = 12;
constexpr std::size_t kDirectionSize = 16;
constexpr std::size_t kBeliefSize = 36;  // without hypotheses and SNR against range
constexpr std::size_t kHypothesisSize = 12;
constexpr std::size_t kChecksumSize = 4;
constexpr std::size_t kTrailerSize = kPublicKeySize + kChecksumSize + kSignatureSize;
constexpr double kUnitLengthTolerance = 1e-9;  // a direction written with 10 digits is a direction; a forgotten normalisation is not

/// The sizes that fix where everything lies.
struct Shape {
  std::size_t observation = 0;
  std::size_t actions = 0;
  std::array<std::size_t, config::kMaxHiddenLayers> hidden{};
  std::size_t provenance = 0;
  std::size_t hypotheses = 0;  ///< 0: no belief
  std::size_t ranges = 0;      ///< 0: no belief

  [[nodiscard]] constexpr bool fits() const {
    const auto within = [](std::size_t size, std::size_t capacity) { return size >= 1 && size <= capacity; };
    return within(observation, config::kMaxObservation) && within(actions, config::kMaxActions) && within(hidden[0], Network::kWidth) &&
           within(hidden[1], Network::kWidth) && provenance <= config::kMaxProvenance && hypotheses <= config::kMaxBeliefHypotheses &&
           ranges <= config::kMaxBeliefRanges && (hypotheses == 0) == (ranges == 0);
  }

  [[nodiscard]] constexpr std::size_t serialised_size() const {
    const std::size_t parameters = (observation + 1) * hidden[0] + (hidden[0] + 1) * hidden[1] + (hidden[1] + 1) * actions;
    const std::size_t golden = config::kGoldenPairs * (observation + actions);
    const std::size_t belief = hypotheses == 0 ? 0 : kBeliefSize + kHypothesisSize * hypotheses + sizeof(float) * ranges;
    return kHeaderSize + kElementSize * observation + kDirectionSize * actions + belief + sizeof(float) * (parameters + golden) +
           provenance + kTrailerSize;
  }
};

constexpr Shape kLargest = {config::kMaxObservation, config::kMaxActions,          {Network::kWidth, Network::kWidth},
                            config::kMaxProvenance,  config::kMaxBeliefHypotheses, config::kMaxBeliefRanges};

Shape shape_of(const FrozenPolicy& policy) {
  const bool believes = needs_belief(policy.observation.spec);
  return {.observation = policy.observation.spec.size(),
          .actions = policy.actions.size(),
          .hidden = policy.network.hidden_sizes,
          .provenance = policy.provenance.size(),
          .hypotheses = believes ? policy.observation.belief.hypotheses.size() : 0,
          .ranges = believes ? policy.observation.belief.snr_db.size() : 0};
}

bool is_unit(const UnitNorthEast& direction) {
  const double excess = direction.north * direction.north + direction.east * direction.east - 1.0;
  return excess <= kUnitLengthTolerance && -excess <= kUnitLengthTolerance;
}

bool is_length(Meters length) {
  return length.value > 0.0 && is_finite(length.value);
}

/// False for a NaN too.
bool is_within_tolerance(Meters a, Meters b) {
  return a - b <= kAreaSizeTolerance && b - a <= kAreaSizeTolerance;
}

bool is_known(ActionDraw draw) {
  return draw == ActionDraw::kArgmax || draw == ActionDraw::kSampled;
}
bool all_finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return is_finite(value); });
}

template <class Layer>
bool is_finite_layer(const Layer& layer, std::size_t outputs, std::size_t inputs) {
  for (std::size_t o = 0; o < outputs; ++o) {
    for (std::size_t i = 0; i < inputs; ++i) {
      if (!is_finite(layer.weight(o, i))) return false;
    }
  }
  return all_finite(std::span(layer.bias).first(outputs));
}

bool is_finite_network(const Network& network) {
  return is_finite_layer(network.first, network.hidden_sizes[0], network.observation_size) &&
         is_finite_layer(network.second, network.hidden_sizes[1], network.hidden_sizes[0]) &&
         is_finite_layer(network.output, network.action_count, network.hidden_sizes[1]);
}

/// How many `age`s a feature of this policy may have.
std::size_t count_of(Feature feature, const FrozenPolicy& policy) {
  if (feature >= Feature::kStepEast && feature <= Feature::kStepSnr) return config::kMaxRememberedSteps;
  if (feature == Feature::kHypothesis) return policy.observation.belief.hypotheses.size();
  if (feature >= Feature::kFound) return policy.actions.size();
  return 1;
}

PolicyFault fault_in_elements(const FrozenPolicy& policy) {
  for (const ObservationElement& element : policy.observation.spec) {
    if (!is_known(element.feature)) return PolicyFault::kUnknownFeature;
    if (element.age >= count_of(element.feature, policy)) return PolicyFault::kBadShape;
    if (!is_finite(element.offset) || !is_finite(element.scale)) return PolicyFault::kNotFinite;
  }
  return PolicyFault::kNone;
}

/// Whether the belief is about the search that the policy is for.
bool agrees(const BeliefModel& model, const FrozenPolicy& policy) {
  return model.area_size == policy.area_size && model.step_length == policy.step_length &&
         model.detection_threshold == policy.detection_threshold &&
         std::equal(model.actions.begin(), model.actions.end(), policy.actions.begin(), policy.actions.end());
}

PolicyFault fault_in_belief(const FrozenPolicy& policy) {
  const BeliefModel& model = policy.observation.belief;
  if (needs_area(policy.observation.spec) && model.area_size != policy.area_size) return PolicyFault::kBadShape;
  if (!needs_belief(policy.observation.spec)) return PolicyFault::kNone;
  if (!has_valid_shape(model) || !agrees(model, policy)) return PolicyFault::kBadShape;
  return has_valid_numbers(model) ? PolicyFault::kNone : PolicyFault::kNotFinite;
}

/// What would be wrong with the policy itself, however its bytes came about; golden pairs not looked at.
PolicyFault fault_in(const FrozenPolicy& policy) {
  const Shape shape = shape_of(policy);
  if (!shape.fits() || policy.network.observation_size != shape.observation || policy.network.action_count != shape.actions) {
    return PolicyFault::kBadShape;
  }
  if (!is_known(policy.draw)) return PolicyFault::kUnknownDraw;
  if (const PolicyFault fault = fault_in_elements(policy); fault != PolicyFault::kNone) return fault;
  if (!std::all_of(policy.actions.begin(), policy.actions.end(), is_unit)) return PolicyFault::kNotFinite;
  if (!is_length(policy.step_length) || !is_length(policy.area_size.north) || !is_length(policy.area_size.east))
    return PolicyFault::kNotFinite;
  if (!is_finite(policy.detection_threshold.value)) return PolicyFault::kNotFinite;
  if (!is_finite_network(policy.network)) return PolicyFault::kNotFinite;
  return fault_in_belief(policy);
}

Status status_of(PolicyFault fault) {
  switch (fault) {
    case PolicyFault::kNone:
      return Status::kOk;
    case PolicyFault::kTooShort:
    case PolicyFault::kBadMagic:
    case PolicyFault::kBadShape:
      return Status::kMalformed;
    case PolicyFault::kUnknownVersion:
    case PolicyFault::kUnknownActivation:
    case PolicyFault::kUnknownFeature:
    case PolicyFault::kUnknownDraw:
      return Status::kUnsupported;
    case PolicyFault::kBadChecksum:
    case PolicyFault::kGoldenMismatch:
      return Status::kCorrupt;
    case PolicyFault::kNotFinite:
      return Status::kOutOfRange;
  }
  return Status::kMalformed;
}

void read(ByteReader& reader, std::span<float> values) {
  for (float& value : values) value = reader.f32();
}

void write(ByteWriter& writer, std::span<const float> values) {
  for (const float value : values) writer.f32(value);
}

template <class Layer>
void read_layer(ByteReader& reader, Layer& layer, std::size_t outputs, std::size_t inputs) {
  for (std::size_t o = 0; o < outputs; ++o) {
    for (std::size_t i = 0; i < inputs; ++i) layer.weight(o, i) = reader.f32();
  }
  read(reader, std::span(layer.bias).first(outputs));
}

template <class Layer>
void write_layer(ByteWriter& writer, const Layer& layer, std::size_t outputs, std::size_t inputs) {
  for (std::size_t o = 0; o < outputs; ++o) {
    for (std::size_t i = 0; i < inputs; ++i) writer.f32(layer.weight(o, i));
  }
  write(writer, std::span(layer.bias).first(outputs));
}

/// Magic, version, length and checksum: is this a whole `.policy` of our version?
PolicyFault fault_in_envelope(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeaderSize) return PolicyFault::kTooShort;
  if (!std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) return PolicyFault::kBadMagic;
  ByteReader reader(bytes.subspan(kMagic.size()));
  if (reader.u32() != kFormatVersion) return PolicyFault::kUnknownVersion;
  const std::size_t length = reader.u32();
  if (bytes.size() < length || length < kHeaderSize + kTrailerSize) return PolicyFault::kTooShort;
  if (bytes.size() > length) return PolicyFault::kBadShape;
  const std::size_t covered = length - kSignatureSize - kChecksumSize;
  ByteReader checksum(bytes.subspan(covered));
  return checksum.u32() == crc32(bytes.first(covered)) ? PolicyFault::kNone : PolicyFault::kBadChecksum;
}

/// Header after magic, version and length; leaves the reader at the observation elements.
PolicyFault read_header(ByteReader& reader, std::size_t length, FrozenPolicy& policy, Shape& shape) {
  const std::uint8_t activation = reader.u8();
  policy.draw = static_cast<ActionDraw>(reader.u8());
  shape.observation = reader.u8();
  shape.actions = reader.u8();
  for (std::size_t& hidden : shape.hidden) hidden = reader.u16();
  policy.step_length = Meters{reader.f64()};
  policy.area_size.north = Meters{reader.f64()};
  policy.area_size.east = Meters{reader.f64()};
  policy.detection_threshold = Decibels{reader.f64()};
  shape.provenance = reader.u32();
  shape.hypotheses = reader.u16();
  shape.ranges = reader.u16();
  if (activation != kTanh) return PolicyFault::kUnknownActivation;
  return shape.fits() && shape.serialised_size() == length ? PolicyFault::kNone : PolicyFault::kBadShape;
}

/// What the file says about the belief; the rest is the policy's own.
Status read_belief(ByteReader& reader, const Shape& shape, BeliefModel& model) {
  model.cells_north = reader.u16();
  model.cells_east = reader.u16();
  model.border_width = Meters{reader.f64()};
  model.range_step = Meters{reader.f64()};
  model.outlier_share = reader.f32();
  model.silence_share = reader.f32();
  model.forgotten_share = reader.f32();
  static_cast<void>(reader.f32());  // reserved
  Status status = Status::kOk;
  for (std::size_t i = 0; i < shape.hypotheses && status == Status::kOk; ++i) {
    BeliefHypothesis hypothesis;
    hypothesis.level_offset_db = reader.f32();
    hypothesis.spread_db = reader.f32();
    hypothesis.prior = reader.f32();
    status = model.hypotheses.push_back(hypothesis);
  }
  for (std::size_t i = 0; i < shape.ranges && status == Status::kOk; ++i) status = model.snr_db.push_back(reader.f32());
  return status;
}

void write_belief(ByteWriter& writer, const BeliefModel& model) {
  writer.u16(model.cells_north);
  writer.u16(model.cells_east);
  writer.f64(model.border_width.value);
  writer.f64(model.range_step.value);
  writer.f32(model.outlier_share);
  writer.f32(model.silence_share);
  writer.f32(model.forgotten_share);
  writer.f32(0.0F);  // reserved
  for (const BeliefHypothesis& hypothesis : model.hypotheses) {
    writer.f32(hypothesis.level_offset_db);
    writer.f32(hypothesis.spread_db);
    writer.f32(hypothesis.prior);
  }
  for (const float snr : model.snr_db) writer.f32(snr);
}

/// Everything between header and trailer. The shape fits, so that nothing is full and nothing reads past the end.
Status read_body(ByteReader& reader, const Shape& shape, FrozenPolicy& policy) {
  Status status = Status::kOk;
  const auto keep_first = [&status](Status next) { status = status == Status::kOk ? next : status; };
  policy.observation.spec.clear();
  policy.observation.listening = {};
  policy.actions.clear();
  policy.provenance.clear();
  for (std::size_t i = 0; i < shape.observation; ++i) {
    ObservationElement element;
    element.feature = static_cast<Feature>(reader.u8());
    element.age = reader.u8();
    static_cast<void>(reader.u16());  // reserved
    element.offset = reader.f32();
    element.scale = reader.f32();
    keep_first(policy.observation.spec.push_back(element));
  }
  for (std::size_t i = 0; i < shape.actions; ++i) {
    const double north = reader.f64();
    keep_first(policy.actions.push_back({.north = north, .east = reader.f64()}));
  }
  BeliefModel& belief = policy.observation.belief;
  belief.hypotheses.clear();
  belief.snr_db.clear();
  belief.area_size = policy.area_size;
  belief.step_length = policy.step_length;
  belief.detection_threshold = policy.detection_threshold;
  belief.actions = policy.actions;
  if (shape.hypotheses > 0) keep_first(read_belief(reader, shape, belief));
  policy.network.observation_size = shape.observation;
  policy.network.hidden_sizes = shape.hidden;
  policy.network.action_count = shape.actions;
  read_layer(reader, policy.network.first, shape.hidden[0], shape.observation);
  read_layer(reader, policy.network.second, shape.hidden[1], shape.hidden[0]);
  read_layer(reader, policy.network.output, shape.actions, shape.hidden[1]);
  for (GoldenPair& pair : policy.golden) {
    read(reader, std::span(pair.observation).first(shape.observation));
    read(reader, std::span(pair.logits).first(shape.actions));
  }
  for (std::size_t i = 0; i < shape.provenance; ++i) keep_first(policy.provenance.push_back(static_cast<char>(reader.u8())));
  if (reader.past_end()) keep_first(Status::kMalformed);
  return status;
}

bool gives_golden_logits(const FrozenPolicy& policy) {
  std::array<float, config::kMaxActions> logits{};
  for (const GoldenPair& pair : policy.golden) {
    const std::size_t count = policy.network.action_count;
    forward(policy.network, std::span(pair.observation).first(policy.network.observation_size), std::span(logits).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_finite(logits[i])) return false;  // overflow: the bits of such a NaN differ between machines
      if (std::bit_cast<std::uint32_t>(logits[i]) != std::bit_cast<std::uint32_t>(pair.logits[i])) return false;
    }
  }
  return true;
}

PolicyFault parse_to_fault(std::span<const std::uint8_t> bytes, FrozenPolicy& policy) {
  if (const PolicyFault fault = fault_in_envelope(bytes); fault != PolicyFault::kNone) return fault;
  ByteReader reader(bytes);
  for (std::size_t i = 0; i < kMagic.size(); ++i) static_cast<void>(reader.u8());
  static_cast<void>(reader.u32());  // version
  const std::size_t length = reader.u32();
  Shape shape;
  if (const PolicyFault fault = read_header(reader, length, policy, shape); fault != PolicyFault::kNone) return fault;
  if (read_body(reader, shape, policy) != Status::kOk) return PolicyFault::kBadShape;
  if (const PolicyFault fault = fault_in(policy); fault != PolicyFault::kNone) return fault;
  if (shape_of(policy).serialised_size() != length) return PolicyFault::kBadShape;  // a belief that nothing sees
  return gives_golden_logits(policy) ? PolicyFault::kNone : PolicyFault::kGoldenMismatch;
}

void write_header(ByteWriter& writer, const FrozenPolicy& policy, const Shape& shape) {
  for (const std::uint8_t byte : kMagic) writer.u8(byte);
  writer.u32(kFormatVersion);
  writer.u32(static_cast<std::uint32_t>(shape.serialised_size()));
  writer.u8(kTanh);
  writer.u8(static_cast<std::uint8_t>(policy.draw));
  writer.u8(static_cast<std::uint8_t>(shape.observation));
  writer.u8(static_cast<std::uint8_t>(shape.actions));
  for (const std::size_t hidden : shape.hidden) writer.u16(static_cast<std::uint16_t>(hidden));
  writer.f64(policy.step_length.value);
  writer.f64(policy.area_size.north.value);
  writer.f64(policy.area_size.east.value);
  writer.f64(policy.detection_threshold.value);
  writer.u32(static_cast<std::uint32_t>(shape.provenance));
  writer.u16(static_cast<std::uint16_t>(shape.hypotheses));
  writer.u16(static_cast<std::uint16_t>(shape.ranges));
}

/// Observations spread over [-1, 1), the same for every policy of one shape, with the logits that this build gives for them.
/// @return whether every logit is finite.
bool write_golden_pairs(ByteWriter& writer, const Network& network) {
  Pcg32 random(1);
  std::array<float, config::kMaxObservation> observation_storage{};
  std::array<float, config::kMaxActions> logits_storage{};
  const std::span<float> observation = std::span(observation_storage).first(network.observation_size);
  const std::span<float> logits = std::span(logits_storage).first(network.action_count);
  bool finite = true;
  for (std::size_t pair = 0; pair < config::kGoldenPairs; ++pair) {
    for (float& value : observation) value = 2.0F * random.uniform_float() - 1.0F;
    forward(network, observation, logits);
    write(writer, observation);
    write(writer, logits);
    finite = finite && all_finite(logits);
  }
  return finite;
}

/// @return whether the golden logits are finite.
bool write_body(ByteWriter& writer, const FrozenPolicy& policy, const Shape& shape) {
  for (const ObservationElement& element : policy.observation.spec) {
    writer.u8(static_cast<std::uint8_t>(element.feature));
    writer.u8(element.age);
    writer.u16(0);  // reserved
    writer.f32(element.offset);
    writer.f32(element.scale);
  }
  for (const UnitNorthEast& direction : policy.actions) {
    writer.f64(direction.north);
    writer.f64(direction.east);
  }
  if (shape.hypotheses > 0) write_belief(writer, policy.observation.belief);
  write_layer(writer, policy.network.first, shape.hidden[0], shape.observation);
  write_layer(writer, policy.network.second, shape.hidden[1], shape.hidden[0]);
  write_layer(writer, policy.network.output, shape.actions, shape.hidden[1]);
  const bool finite = write_golden_pairs(writer, policy.network);
  for (const char character : policy.provenance) writer.u8(static_cast<std::uint8_t>(character));
  return finite;
}

}  // namespace

Misfit misfit(const FrozenPolicy& policy, const config::Mission& mission) {
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  const bool same_size = is_within_tolerance(policy.area_size.north, size.north) && is_within_tolerance(policy.area_size.east, size.east);
  if (policy.step_length != mission.step_length) return Misfit::kStepLength;
  if (!same_size) return Misfit::kAreaSize;
  if (policy.detection_threshold != mission.detection_threshold) return Misfit::kDetectionThreshold;
  if (policy.observation.listening != mission.listening) return Misfit::kListening;
  return Misfit::kNone;
}

std::size_t max_serialised_size() {
  return kLargest.serialised_size();
}

Status parse(std::span<const std::uint8_t> bytes, FrozenPolicy& policy, PolicyFault& fault) {
  fault = parse_to_fault(bytes, policy);
  return status_of(fault);
}

Result<std::size_t> serialise(const FrozenPolicy& policy, std::span<const std::uint8_t, kPublicKeySize> public_key,
                              std::span<std::uint8_t> bytes) {
  if (fault_in(policy) != PolicyFault::kNone) return Status::kOutOfRange;
  if (policy.observation.listening != config::ListeningWindow{}) return Status::kUnsupported;
  const Shape shape = shape_of(policy);
  if (bytes.size() < shape.serialised_size()) return Status::kFull;
  ByteWriter writer(bytes);
  write_header(writer, policy, shape);
  if (!write_body(writer, policy, shape)) return Status::kOutOfRange;
  for (const std::uint8_t byte : public_key) writer.u8(byte);
  writer.u32(crc32(bytes.first(writer.position())));
  for (std::size_t i = 0; i < kSignatureSize; ++i) writer.u8(0);
  return writer.position();
}

}  // namespace earshot::policy
