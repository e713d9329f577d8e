#include "firmware/wire/n2k/own/challenge.hpp"

#include <array>
#include <cstddef>

#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {
namespace {

constexpr std::array<FieldName, 4> kNonce{"Nonce0", "Nonce1", "Nonce2", "Nonce3"};
constexpr std::array<FieldName, 8> kVehicle{"Vehicle0", "Vehicle1", "Vehicle2", "Vehicle3", "Vehicle4", "Vehicle5", "Vehicle6", "Vehicle7"};
constexpr std::array<FieldName, 8> kMission{"Mission0", "Mission1", "Mission2", "Mission3", "Mission4", "Mission5", "Mission6", "Mission7"};
constexpr std::array<FieldName, 4> kMark{"ChallengeMark0", "ChallengeMark1", "ChallengeMark2", "ChallengeMark3"};

/// Four bytes to a field, little-endian, as everything on this bus.
void put(std::span<const std::uint8_t> bytes, std::span<const FieldName> fields, MessageWriter& writer) {
  for (std::size_t part = 0; part < fields.size(); ++part) {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::int64_t{bytes[4 * part + i]} << (8 * i);
    writer.set_raw(fields[part], value);
  }
}

void take(MessageReader& reader, std::span<const FieldName> fields, std::span<std::uint8_t> bytes) {
  for (std::size_t part = 0; part < fields.size(); ++part) {
    const std::int64_t value = reader.raw(fields[part]);
    for (std::size_t i = 0; i < 4; ++i) bytes[4 * part + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

}  // namespace

Status compose_challenge(const messages::ToldChallenge& told, const Route& route, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(table::kChallenge);
  writer.set_raw("Time", told.time.us);
  put(told.challenge.nonce, kNonce, writer);
  put(told.challenge.vehicle, kVehicle, writer);
  put(told.challenge.mission, kMission, writer);
  put(told.mark, kMark, writer);
  if (writer.status() != Status::kOk) return writer.status();
  return compose_fast_packet(writer.identifier(route.source, route.destination), route.sequence, writer.bytes(), frames);
}

Result<messages::ToldChallenge> read_challenge(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kChallenge, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kChallenge, bytes);
  messages::ToldChallenge told;
  told.time = Time{reader.raw("Time")};
  take(reader, kNonce, told.challenge.nonce);
  take(reader, kVehicle, told.challenge.vehicle);
  take(reader, kMission, told.challenge.mission);
  take(reader, kMark, told.mark);
  if (reader.status() != Status::kOk) return reader.status();
  return told;
}

}  // namespace earshot::n2k
