#include "firmware/wire/n2k/node/group_function.hpp"

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"

namespace earshot::n2k {

namespace {

constexpr unsigned kFrameNumber = 0x1F;   ///< the bits of byte 0 that hold it
constexpr std::uint8_t kLeastDemand = 6;  ///< bytes: of a command without parameters

std::int64_t error_of(const GroupRefusal& refusal) {
  const GroupFunction function = refusal.demand.function;
  if (function == GroupFunction::kReadFields || function == GroupFunction::kWriteFields)
    return table::raw_of(table::kGroupError, "Read or Write not supported");
  return refusal.is_known ? table::raw_of(table::kGroupError, "Not supported") : table::raw_of(table::kGroupError, "PGN not supported");
}

}  // namespace

std::optional<GroupDemand> read_group_demand(const Frame& frame) {
  const bool is_first = frame.size == 8 && (frame.data[0] & kFrameNumber) == 0 && frame.data[1] >= kLeastDemand;
  if (!is_first) return std::nullopt;
  constexpr Signal kGroup = table::field(table::kGroupAcknowledgement, "PGN");  // in the same place in every group function
  const Result<std::int64_t> pgn = decode_raw(kGroup, frame.bytes().subspan(2));
  if (!pgn.ok()) return std::nullopt;
  const GroupDemand demand{.function = GroupFunction{frame.data[2]}, .pgn = static_cast<std::uint32_t>(pgn.value())};
  switch (demand.function) {
    case GroupFunction::kRequest:
    case GroupFunction::kCommand:
    case GroupFunction::kReadFields:
    case GroupFunction::kWriteFields:
      return demand;
    case GroupFunction::kAcknowledge:
    case GroupFunction::kReadFieldsReply:
    case GroupFunction::kWriteFieldsReply:
      break;
  }
  return std::nullopt;
}

Status compose_group_refusal(const GroupRefusal& refusal, std::uint8_t source, std::uint8_t sequence, Frame& frame) {
  MessageWriter writer(table::kGroupAcknowledgement);
  writer.set_raw("FunctionCode", static_cast<std::int64_t>(GroupFunction::kAcknowledge))
      .set_raw("PGN", refusal.demand.pgn)
      .set_raw("PGNErrorCode", error_of(refusal))
      .set_raw("IntervalOrPriorityErrorCode", table::raw_of(table::kGroupError, "Acknowledge"))
      .set_raw("NumberOfParameters", 0);
  FastPacketFrames frames;
  if (writer.status() != Status::kOk) return writer.status();
  const Status status = compose_fast_packet(writer.identifier(source, refusal.asker), sequence, writer.bytes(), frames);
  if (status == Status::kOk) frame = frames[0];
  return status;
}

}  // namespace earshot::n2k
