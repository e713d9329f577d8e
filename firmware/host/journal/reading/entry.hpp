#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/messages/challenge.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/journal_records.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::journal {

// What a journal holds, one entry after the other.

/// The file of the policy that flew.
struct PolicyBytes {
  std::vector<std::uint8_t> bytes;
  std::uint32_t crc32 = 0;
};

/// The file of the ocean tables that it searched by; empty for a policy that needs none.
struct TablesBytes {
  std::vector<std::uint8_t> bytes;
  std::uint32_t crc32 = 0;
};

/// A whole record that this program cannot read: of a channel it does not know, or of another version's message.
struct Unreadable {
  bool is_known_channel = false;
};

using Content = std::variant<Unreadable, messages::MissionRecord, PolicyBytes, messages::Input, messages::Setpoint, messages::Decision,
                             messages::SafetyEvent, messages::CommandAcknowledgement, messages::Health, messages::ClosingRecord,
                             messages::JournalResumed, messages::ControllerTrouble, TablesBytes, messages::SoundDetection,
                             messages::PublishedChallenge>;

struct Record {
  std::uint32_t number = 0;  ///< counts all records that the journal was given, from 0
  Time time;                 ///< of the mission's clock
  std::string channel;
  std::size_t size_bytes = 0;  ///< of its message
  Content content;
};

/// Records whose numbers are not there.
struct MissingRecords {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  bool was_damaged = false;  ///< damaged bytes stand in their place; else the disk did not take them, or
  int first_part = 0;        ///< they were in this part of the journal and in those behind it, none of which is there
  int parts = 0;             ///< so many; 0: all parts are there
};

/// Bytes of the file that are no whole record.
using DamagedBytes = host::JournalDamage;

/// A record whose number is not above the one before it: the file was not written in one piece by one program.
struct NumbersGoBack {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

/// What stands behind the last record.
struct TornEnd {
  DamagedBytes where;
  bool is_cut = false;  ///< it is the beginning of a record: the writer was stopped in it
};

/// Before the first record: this is no journal, but what somebody logged of a bus (lcm-logger).
struct BusLog {};

using Entry = std::variant<Record, MissingRecords, DamagedBytes, NumbersGoBack, BusLog>;

}  // namespace earshot::journal
