#pragma once

#include <filesystem>
#include <memory>

#include "firmware/core/time.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/messages/challenge.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::host {

/// The secret that a vehicle shares with those who may command it. Whoever knows it marks an order for one vehicle, one start of its
/// program and one mission, with the BLAKE2b hash (RFC 7693, key of 32 bytes, 16 bytes long) of 143 bytes, little-endian:
///
///   "EARSHOT ORDER2", nonce 16, vehicle 32, mission 32 (of the challenge, as challenge_t tells it),
///   int64 time, int64 expiry (us since 1970, UTC), uint32 issuer, uint32 number, uint8 order, double max_depth_m, max_speed_mps,
///   max_time_s
///
/// A limit that is not said is the NaN 0x7ff8000000000000. The challenge keeps a recording from being obeyed elsewhere or after a restart;
/// a number that rises and a date keep it from being obeyed twice. An old mark is the hash of the last 49 bytes alone, without a challenge.
/// What a vehicle tells of its challenge bears the same hash of 106 bytes: "EARSHOT CHALLENGE1", int64 time (likewise), nonce, vehicle,
/// mission.
/// Copies share one place in memory, which is kept off the disk and wiped with the last of them.
class CommandKey {
 public:
  explicit CommandKey(const KeyBytes& key);
  /// @throws host::BadInput as read_secret_key_file does
  explicit CommandKey(const std::filesystem::path& file);

  [[nodiscard]] messages::CommandMark mark_of(const messages::OperatorCommand& command, const messages::Challenge& challenge) const;
  [[nodiscard]] messages::CommandMark old_mark_of(const messages::OperatorCommand& command) const;
  [[nodiscard]] messages::CommandMark mark_of(const messages::Challenge& challenge, Time published) const;

  // Each in a time that does not tell how much of the mark is right.
  [[nodiscard]] bool verifies(const messages::OperatorCommand& command, const messages::Challenge& challenge) const;
  [[nodiscard]] bool verifies_old(const messages::OperatorCommand& command) const;
  [[nodiscard]] bool verifies(const messages::PublishedChallenge& published) const;

  /// A key that nobody drew.
  [[nodiscard]] bool is_all_zero() const { return *key_ == KeyBytes{}; }

 private:
  std::shared_ptr<const KeyBytes> key_;
};

}  // namespace earshot::host
