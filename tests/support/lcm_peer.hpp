#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/lcm/encoding.hpp"

// lcm-gen's own types, as autopilots and tools on the bus use them: the other side of firmware/wire/lcm.
namespace earshot::support {

template <class Peer>
std::vector<std::uint8_t> bytes_of(const Peer& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  if (message.encode(bytes.data(), 0, static_cast<int>(bytes.size())) != static_cast<int>(bytes.size()))
    throw std::runtime_error(std::string("lcm-gen's ") + Peer::getTypeName() + " was not written");
  return bytes;
}

/// kMalformed: the bytes are no message of this type.
template <class Peer>
[[nodiscard]] Status read_peer(std::span<const std::uint8_t> bytes, Peer& message) {
  const int size = message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return size == static_cast<int>(bytes.size()) ? Status::kOk : Status::kMalformed;
}

/// What lcm-gen's type reads of our message. @param sent  of a message that does not hold its own date
template <class Peer, class Message>
Peer as_peer(const Message& message, Time sent = {}) {
  Peer peer{};
  if (read_peer(wire::Encoded(message, sent).bytes(), peer) != Status::kOk)
    throw std::runtime_error(std::string("lcm-gen's ") + Peer::getTypeName() + " does not read it");
  return peer;
}

/// Our message, of what lcm-gen's type writes.
template <class Message, class Peer>
Message from_peer(const Peer& peer) {
  Message message;
  if (wire::decode(bytes_of(peer), message) != Status::kOk)
    throw std::runtime_error(std::string("lcm-gen's ") + Peer::getTypeName() + " is not read");
  return message;
}

}  // namespace earshot::support
