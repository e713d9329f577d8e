#pragma once

#include <filesystem>
#include <string>

#include "firmware/host/file/output_file.hpp"
#include "firmware/host/trust/keys.hpp"

namespace earshot::host {

/// A pair of keys is two files: the secret half, and beside it the public one under the same name, which ends in .pub.
[[nodiscard]] std::filesystem::path public_file_of(std::filesystem::path secret_file);

/// Whether a .pub without its secret half, which a vehicle may trust, goes.
enum class LonePublicHalf : std::uint8_t { kStays, kReplaced };

/// What a person may do about a half that is there and stays.
struct WaysOut {
  std::string lone_public = "move it away, or name another key";
  std::string secret = "name another";
};

/// A new pair, the secret half for its owner alone. Both halves or none: they are written before either has its name. A secret half that is
/// there stays, whatever is said: of two programs that make one pair, one does.
/// @throws BadInput naming the file
/// Oracle: KeyPair.*
[[nodiscard]] SecretKey make_key_pair(const std::filesystem::path& secret_file, LonePublicHalf lone, const WaysOut& ways_out = {});

/// What is signed with one key and shipped with another's public half would be refused at sea.
/// @throws BadInput when the .pub beside the secret half is another's, or is not there
void require_public_half(const SecretKey& key, const std::filesystem::path& secret_file);

/// @throws BadInput for a secret file that is named like a public one
void require_secret_name(const std::filesystem::path& secret_file);

}  // namespace earshot::host
