#include "firmware/host/trust/signed_bytes.hpp"

#include <algorithm>
#include <tuple>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {
namespace {

constexpr std::size_t kSignatureSize = std::tuple_size_v<Signature>;

}  // namespace

void sign_at_end(std::span<std::uint8_t> bytes, const SecretKey& key) {
  const Signature signature = sign(bytes.first(bytes.size() - kSignatureSize), key);
  std::ranges::copy(signature, bytes.last(kSignatureSize).begin());
}

bool is_signed_at_end(std::span<const std::uint8_t> bytes, const PublicKey& key) {
  if (bytes.size() < kSignatureSize) return false;
  return is_signed(bytes.first(bytes.size() - kSignatureSize), bytes.last<kSignatureSize>(), key);
}

void require_signed_by(std::span<const std::uint8_t> bytes, const std::filesystem::path& path, const TrustedKey& trusted) {
  if (!is_signed_at_end(bytes, trusted.key))
    throw BadInput(path.string() + ": is not signed by the trusted key " + trusted.file.string() +
                   "; --public-key names the public half of the key that signed it");
}

std::filesystem::path signer_of(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                                const std::vector<TrustedKey>& trusted, const std::string& trusted_by) {
  const auto signer = std::ranges::find_if(trusted, [&](const TrustedKey& key) { return is_signed_at_end(bytes, key.key); });
  if (signer == trusted.end()) throw BadInput(path.string() + ": is signed by none of " + trusted_by + " (" + files_of(trusted) + ")");
  return signer->file;
}

}  // namespace earshot::host
