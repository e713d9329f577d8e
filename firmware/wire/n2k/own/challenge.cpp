#include "firmware/wire/n2k/own/challenge.hpp"

#include "firmware/messages/dictionary/command_fields.hpp"
#include "firmware/wire/n2k/own/fields.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {

Status compose_challenge(const messages::PublishedChallenge& published, const Route& route, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(table::kChallenge);
  write_fields(published, {}, writer);
  if (writer.status() != Status::kOk) return writer.status();
  return compose_fast_packet(writer.identifier(route.source, route.destination), route.sequence, writer.bytes(), frames);
}

Result<messages::PublishedChallenge> read_challenge(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kChallenge, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kChallenge, bytes);
  messages::PublishedChallenge published;
  if (const Status status = read_fields(reader, published); status != Status::kOk) return status;
  return published;
}

}  // namespace earshot::n2k
