#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"

namespace earshot::board {

/// Who signed what would be flown, each by the file of the key that the vehicle trusts.
struct Signatures {
  std::filesystem::path policy;
  std::filesystem::path tables;
  std::filesystem::path mission;  ///< empty: none is asked for
  std::uint64_t counter = 0;      ///< of the mission's signature
};

/// The checklist before a dive, as text: files, ports, authority, vehicle, search, places, budgets of time, way and energy, every rule in
/// words, memory. Of a mission that has been read and judged. Opens nothing.
/// @param shown  the mission's path as it was given
[[nodiscard]] std::string checklist(const host::MissionFile& file, const host::SignedSearch& with, const std::string& shown,
                                    const Signatures& signatures);

}  // namespace earshot::board
