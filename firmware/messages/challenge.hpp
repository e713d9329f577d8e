#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::messages {

/// Drawn anew whenever a vehicle's program starts.
using Nonce = std::array<std::uint8_t, 16>;
/// A vehicle's name; zeros behind it. Nothing but zeros: it has none.
using VehicleId = std::array<std::uint8_t, 32>;
/// SHA-256 of a mission's bytes.
using MissionDigest = std::array<std::uint8_t, 32>;

/// What an order's mark is made for, besides the order: this vehicle, this start of its program, this mission. An order that was recorded
/// with another of them is none here.
struct Challenge {
  Nonce nonce{};
  VehicleId vehicle{};
  MissionDigest mission{};
  friend constexpr bool operator==(const Challenge&, const Challenge&) = default;
};

/// A vehicle says so to those who may command it.
struct PublishedChallenge {
  Time time;  ///< when it was told
  Challenge challenge;
  CommandMark mark{};  ///< of who knows the key: nobody else can make people mark orders for another vehicle
  friend constexpr bool operator==(const PublishedChallenge&, const PublishedChallenge&) = default;
};

}  // namespace earshot::messages
