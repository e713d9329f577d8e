#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace earshot::host {

/// The largest event of a log that lcm-logger wrote, bytes with its header. Nothing: the file is no such log.
///
/// LCM's event log, in which a journal hides its checksums in the upper half of the event numbers: here they count plainly, from 0 and from
/// 0 again where the logger went on with the file. With no checksum to go by, all of the file must be such events, end to end; only the
/// last may be cut off.
/// @throws BadInput if it cannot be read or is no regular file
/// Oracle: BusLog.*, LcmLogger.*
[[nodiscard]] std::optional<std::size_t> largest_event_of_bus_log(const std::filesystem::path& path);

}  // namespace earshot::host
