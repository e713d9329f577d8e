#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace earshot::host {

/// Whether what is written there is in memory alone, and gone with a power cut: tmpfs, ramfs, or an overlay (as a root that is to stay
/// unchanged has) whose upper layer is. Of a folder that is not there yet: where it would be made. An overlay whose upper layer cannot be
/// seen, as in a container, counts as a disk.
/// Oracle: InMemory.*
[[nodiscard]] bool is_in_memory(const std::filesystem::path& folder);

/// The upper layer of an overlay; nothing: there is none of that number, or it has none.
/// @param mounts  as in /proc/self/mountinfo
/// @param device  its number there, such as "0:39"
/// Source: proc(5), and the kernel's filesystems/overlayfs.rst
[[nodiscard]] std::optional<std::filesystem::path> upper_layer(std::string_view mounts, std::string_view device);

}  // namespace earshot::host
