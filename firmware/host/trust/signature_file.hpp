#pragma once

#include <filesystem>
#include <string>

#include "firmware/authority/mission_manifest.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/trust/keys.hpp"

namespace earshot::host {

inline constexpr OutputKind kSignatureOutput{"a mission's signature", {"Earshot mission signature ", {}}};

/// A mission's signature stands beside it: "search.toml.sig". The mission itself stays as it was written.
[[nodiscard]] std::filesystem::path signature_file_of(std::filesystem::path mission);

[[nodiscard]] authority::SignedManifest sign(const authority::MissionManifest& manifest, const SecretKey& key);
[[nodiscard]] bool is_signed(const authority::SignedManifest& signed_manifest);

/// Six lines of text that say what is vouched for, by whom, and the signature.
/// Oracle: SignatureFile.IsWhatPythonVerifies
[[nodiscard]] std::string to_text(const authority::SignedManifest& signed_manifest);
/// @throws BadInput, "FILE:LINE: must be ...", for anything but what to_text() writes. The signature is not looked at.
[[nodiscard]] authority::SignedManifest read_signature(const std::filesystem::path& file);

}  // namespace earshot::host
