#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::n2k {

/// What 126208 is, by its first byte.
enum class GroupFunction : std::uint8_t {
  kRequest = 0,  ///< "send this group, so often"
  kCommand = 1,  ///< "set these of its fields"
  kAcknowledge = 2,
  kReadFields = 3,
  kReadFieldsReply = 4,
  kWriteFields = 5,
  kWriteFieldsReply = 6,
};

/// What one device asks another to do with a group.
struct GroupDemand {
  GroupFunction function = GroupFunction::kRequest;
  std::uint32_t pgn = 0;  ///< the group
};

/// The demand in a frame of 126208: it stands in the first of the fast packet's frames, so that nobody has to put the packet together who
/// does not look at its parameters. Nothing: another frame, or one that demands nothing (acknowledgements and replies).
[[nodiscard]] std::optional<GroupDemand> read_group_demand(const Frame& frame);

/// "No" to a demand, without a word on its parameters: one frame. A group that this device neither sends nor reads is "not supported"; of
/// one that it knows, what was demanded is. kOutOfRange: addresses or the group's number do not compose.
/// Source: NMEA 2000 as documented by canboat (Apache-2.0).   Oracle: Node tests by hand; the peer test
struct GroupRefusal {
  GroupDemand demand;
  bool is_known = false;  ///< whether this device sends or reads the group
  std::uint8_t asker = 0;
};
[[nodiscard]] Status compose_group_refusal(const GroupRefusal& refusal, std::uint8_t source, std::uint8_t sequence, Frame& frame);

}  // namespace earshot::n2k
