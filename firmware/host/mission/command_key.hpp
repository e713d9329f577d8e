#pragma once

#include <filesystem>

#include "firmware/host/trust/key_file.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::host {

/// The secret that a vehicle shares with those who may command it. Whoever knows it marks a command with the BLAKE2b hash (RFC 7693, key of
/// 32 bytes, 16 bytes long) of 49 bytes, little-endian:
///
///   int64 time, int64 expiry (us since 1970, UTC), uint32 issuer, uint32 number, uint8 order, double max_depth_m, max_speed_mps,
///   max_time_s
///
/// A limit that is not said is the NaN 0x7ff8000000000000. A number that rises and a date keep a mark from being used twice.
class CommandKey {
 public:
  explicit CommandKey(const KeyBytes& key) : key_(key) {}
  /// @throws host::BadInput as read_secret_key_file does
  explicit CommandKey(const std::filesystem::path& file) : CommandKey(read_secret_key_file(file, "a command key")) {}

  [[nodiscard]] messages::CommandMark mark_of(const messages::OperatorCommand& command) const;
  /// In a time that does not tell how much of the mark is right.
  [[nodiscard]] bool verifies(const messages::OperatorCommand& command) const;
  /// A key that nobody drew.
  [[nodiscard]] bool is_all_zero() const { return key_ == KeyBytes{}; }

 private:
  KeyBytes key_;
};

}  // namespace earshot::host
