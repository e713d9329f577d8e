#include "hil/bus/decode/decoder.hpp"

#include <algorithm>
#include <cstdio>

#include "firmware/wire/n2k/own/ownership.hpp"
#include "hil/bus/decode/desk_messages.hpp"

namespace earshot::hil {

namespace {

using n2k::Message;

bool is_proprietary(std::uint32_t pgn) {
  const std::uint32_t format = (pgn >> 8U) & 0xFFU;
  return pgn == 61184 || pgn == 126720 || format == 0xFF || (pgn >= 130816 && pgn <= 131071);
}

/// The message of that group, of its kind where several share it; null for what the table lacks, and for what is another maker's.
const Message* message_in(std::uint32_t pgn, std::span<const std::uint8_t> bytes) {
  for (const Message& message : n2k::messages()) {
    if (message.pgn == pgn && message.framing != n2k::Framing::kTransport && (!is_proprietary(pgn) || n2k::is_ours(message, bytes)))
      return &message;
  }
  const auto found = std::ranges::find(desk_messages(), pgn, &Message::pgn);
  return found == desk_messages().end() ? nullptr : &*found;
}

std::string in_hexadecimal(n2k::Name name) {
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), "NAME 0x%016llX", static_cast<unsigned long long>(name));
  return text.data();
}

}  // namespace

bool is_fast(std::uint32_t pgn) {
  return std::ranges::any_of(n2k::messages(), [pgn](const Message& m) { return m.pgn == pgn && m.framing == n2k::Framing::kFast; });
}

Decoder::Taken Decoder::accept(const LogEntry& entry, Heard& heard) {
  auto bus = buses_.find(entry.interface);
  if (bus == buses_.end()) {
    if (buses_.size() == kMostInterfaces) return Taken::kTooManyInterfaces;
    bus = buses_.emplace(entry.interface, std::make_unique<Bus>()).first;
  }
  ++counters_.frames;
  if (!entry.frame && !entry.message) {
    ++counters_.other_frames;
    return Taken::kNothingYet;
  }
  return read(*bus->second, entry, heard);
}

Decoder::Taken Decoder::read(Bus& bus, const LogEntry& entry, Heard& heard) {
  heard = {.time = entry.time, .interface = entry.interface, .identifier = {}};
  if (entry.message) {
    heard.identifier = entry.message->identifier;
    heard.bytes = entry.message->bytes;
  } else {
    const Result<n2k::Identifier> identifier = n2k::parse_identifier(entry.frame->identifier);
    if (!identifier.ok()) return Taken::kNothingYet;
    heard.identifier = identifier.value();
    if (!put_together(bus, entry, heard)) return Taken::kNothingYet;
  }
  heard.message = message_in(heard.identifier.pgn, heard.bytes);
  if (heard.message != nullptr) heard.values = values_of(*heard.message, heard.bytes);
  remember(bus, heard);
  const std::uint8_t source = heard.identifier.source;
  heard.source_name = bus.models.at(source);
  if (const auto name = bus.devices.name_of(source); heard.source_name.empty() && name) heard.source_name = in_hexadecimal(*name);
  ++counters_.messages;
  if (heard.message == nullptr) ++counters_.unknown;
  return Taken::kMessage;
}

/// An abort of ours goes as one frame under a number whose other messages are fast packets.
bool Decoder::put_together(Bus& bus, const LogEntry& entry, Heard& heard) {
  const auto bytes = entry.frame->bytes();
  heard.bytes.assign(bytes.begin(), bytes.end());
  if (!is_fast(heard.identifier.pgn)) return true;
  auto& packets = bus.fast_packets.at(heard.identifier.source);
  if (packets == nullptr) packets = std::make_unique<FastPackets>();
  const Message* const single = message_in(heard.identifier.pgn, bytes);
  const bool is_single = single != nullptr && single->framing == n2k::Framing::kSingle;
  if (is_single && !packets->expects(heard.identifier, *entry.frame)) return true;
  const auto whole = packets->accept(heard.identifier, *entry.frame, entry.time);
  if (!whole) return false;
  heard.bytes = whole->bytes;
  if (entry.time && whole->began) heard.time = whole->began;
  return true;
}

void Decoder::remember(Bus& bus, const Heard& heard) {
  const std::uint8_t source = heard.identifier.source;
  if (heard.identifier.pgn == n2k::kAddressClaimPgn && heard.bytes.size() <= n2k::Frame().data.size()) {
    n2k::Frame frame{.size = static_cast<std::uint8_t>(heard.bytes.size())};
    std::ranges::copy(heard.bytes, frame.data.begin());
    const auto before = bus.devices.name_of(source);
    bus.devices.accept(source, frame);
    // Another device has the address now.
    if (before && bus.devices.name_of(source) != before) bus.models.at(source).clear();
  }
  if (heard.identifier.pgn != n2k::kProductPgn) return;
  for (const Value& value : heard.values) {
    if (value.name == "ModelID" && value.kind == Value::Kind::kText) bus.models.at(source) = value.text;
  }
}

DecoderCounters Decoder::counters() const {
  DecoderCounters counters = counters_;
  for (const auto& [name, bus] : buses_) {
    for (const auto& packets : bus->fast_packets) counters.incomplete += packets == nullptr ? 0 : packets->incomplete();
  }
  return counters;
}

}  // namespace earshot::hil
