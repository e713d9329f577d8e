#include "firmware/host/trust/signature_file.hpp"

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/trust/line_reader.hpp"

namespace earshot::host {
namespace {

constexpr FileKind kSignatureFile{"a mission's signature", 1024};
constexpr const char* kTitle = "Earshot mission signature 1";
constexpr const char* kKey = "public_key";
constexpr const char* kSignature = "ed25519";

}  // namespace

std::filesystem::path signature_file_of(std::filesystem::path mission) {
  return mission += ".sig";
}

authority::SignedManifest sign(const authority::MissionManifest& manifest, const SecretKey& key) {
  return {.manifest = manifest, .key = public_key_of(key), .signature = sign(authority::signed_bytes(manifest), key)};
}

bool is_signed(const authority::SignedManifest& signed_manifest) {
  return is_signed(authority::signed_bytes(signed_manifest.manifest), signed_manifest.signature, signed_manifest.key);
}

std::string to_text(const authority::SignedManifest& signed_manifest) {
  return std::string(kTitle) + "\n" + lines_of(signed_manifest.manifest) + kKey + " " + to_hex(signed_manifest.key) + "\n" + kSignature +
         " " + to_hex(signed_manifest.signature) + "\n";
}

authority::SignedManifest read_signature(const std::filesystem::path& file) {
  const std::string text = read_text(file, kSignatureFile);
  LineReader reader(text, file);
  reader.title(kTitle);
  authority::SignedManifest signed_manifest;
  signed_manifest.manifest = reader.manifest();
  reader.bytes(kKey, signed_manifest.key);
  reader.bytes(kSignature, signed_manifest.signature);
  reader.end();
  return signed_manifest;
}

}  // namespace earshot::host
