#pragma once

#include <cstdint>
#include <filesystem>

namespace earshot::hil {

/// A power cut: the last `bytes` of a journal that nobody writes never came to the disk, wherever in a record that is. What stands before
/// its second turn was there long ago, and stays.
/// @throws host::BadInput if it cannot be read
void tear_journal(const std::filesystem::path& journal, std::uint64_t bytes);

}  // namespace earshot::hil
