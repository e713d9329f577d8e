#pragma once

#include <cstdint>
#include <filesystem>

namespace earshot::hil {

/// A power cut: the last `bytes` of a journal that nobody writes never came to the disk, wherever in a record that is; nothing of it
/// did if it has no more. @throws host::BadInput if it is no journal
/// @return how many turns it still holds
[[nodiscard]] std::uint64_t tear_journal(const std::filesystem::path& journal, std::uint64_t bytes);

/// One bit of it is another from now on, in the middle of what it holds. @throws as tear_journal(), std::ios_base::failure
void flip_bit(const std::filesystem::path& journal);

}  // namespace earshot::hil
