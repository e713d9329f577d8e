#include "hil/bus/decode/dump.hpp"

#include <algorithm>
#include <ostream>

#include "firmware/wire/n2k/fast_packet.hpp"

namespace earshot::hil {

void Dump::record(const LogEntry& entry) {
  if (entry.frame) recording_->add(entry);
  if (entry.message) record_message(entry);
}

void Dump::record_message(const LogEntry& entry) {
  const n2k::Identifier& identifier = entry.message->identifier;
  const std::vector<std::uint8_t>& bytes = entry.message->bytes;
  n2k::FastPacketFrames frames;
  if (bytes.size() > n2k::Frame().data.size() || is_fast(identifier.pgn)) {
    std::uint8_t& sequence = sequences_[{identifier.pgn, identifier.source}];
    if (n2k::compose_fast_packet(identifier, sequence++, bytes, frames) != Status::kOk) ++unrecorded_;
  } else if (const auto can_identifier = n2k::compose(identifier); can_identifier.ok()) {
    n2k::Frame frame{.identifier = can_identifier.value(), .size = static_cast<std::uint8_t>(bytes.size())};
    std::ranges::copy(bytes, frame.data.begin());
    (void)frames.push_back(frame);
  }
  for (const n2k::Frame& frame : frames) recording_->add({.time = entry.time, .interface = entry.interface, .frame = frame});
}

bool Dump::take(const LogEntry& entry) {
  Heard heard;
  const Decoder::Taken taken = decoder_.accept(entry, heard);
  if (taken == Decoder::Taken::kTooManyInterfaces) return false;
  if (recording_ != nullptr) record(entry);
  if (taken != Decoder::Taken::kMessage) return true;
  const bool is_of_group = shown_.pgns.empty() || shown_.pgns.contains(heard.identifier.pgn);
  if (!is_of_group || (shown_.source && *shown_.source != heard.identifier.source)) return true;
  printer_.print(out_, heard);
  ++printed_;
  return true;
}

}  // namespace earshot::hil
