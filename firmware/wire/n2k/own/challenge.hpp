#pragma once

#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/messages/challenge.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/own/orders.hpp"

namespace earshot::n2k {

// What the marks of orders are made for besides the order: 130953, from the vehicle to all.

[[nodiscard]] Status compose_challenge(const messages::PublishedChallenge& published, const Route& route, FastPacketFrames& frames);
/// kUnsupported: not ours. Fails as decode() does.
[[nodiscard]] Result<messages::PublishedChallenge> read_challenge(std::span<const std::uint8_t> bytes);

}  // namespace earshot::n2k
