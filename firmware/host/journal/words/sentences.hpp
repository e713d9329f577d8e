#pragma once

#include <cstdint>
#include <string>

#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/host/journal/words/event_words.hpp"
#include "firmware/messages/bearing_measurement.hpp"

namespace earshot::journal {

// The words for what a journal holds: `earshot journal`, `replay` and `report` print it with these. One entry is one line, and whatever
// another wrote into the journal is spelled out (host::printable). What the event log reports, too, has its words in event_words.hpp and
// rule_event_words.hpp.

/// "mission begins: area of 25.0 km x 25.0 km, at 300 m depth and 2.0 m/s, up to 100 steps of 1000 m in 60000 s; ..."
[[nodiscard]] std::string to_string(const messages::MissionRecord& mission);

/// "order START, number 1 of issuer 77, by port 2"; "... TIGHTEN to 280 m depth, ..."
[[nodiscard]] std::string to_string(const messages::OperatorCommand& command, std::uint8_t port);

/// "order START, number 1 of issuer 77: obeyed"
[[nodiscard]] std::string to_string(const messages::CommandAcknowledgement& acknowledgement);

/// "step 3: SNR 12.3 dB, detection; from 100 m north, 200 m east 1000 m towards 090 deg, to ..."
/// "47 deg, give or take 10 deg"; "47 deg or 313 deg, give or take 10 deg" where left and right cannot be distinguished.
[[nodiscard]] std::string to_string(const messages::Bearing& bearing);
[[nodiscard]] std::string to_string(const messages::Decision& decision);

/// "ABORT, navigation went silent, after 12 steps"
[[nodiscard]] std::string to_string(messages::MissionState state, messages::EndReason reason, std::uint32_t steps, AbortedBy by);

/// Likewise, and of one that is not over what else there is to say: "SEARCH, listening: it commands nothing"
[[nodiscard]] std::string to_string(const messages::Health& health, bool was_mismatched, AbortedBy by = AbortedBy::kOperator);

/// "2 of navigation, SNR and health, 0 set-points and decisions, 1 orders and changes of state"
[[nodiscard]] std::string to_string(const messages::LostRecords& lost);

/// "end: the mission was over; DONE, completed, the source is reached, after 37 steps; no record was lost"
[[nodiscard]] std::string to_string(const messages::ClosingRecord& closing, AbortedBy by = AbortedBy::kOperator);
[[nodiscard]] std::string to_string(const messages::JournalResumed& resumed);

/// "port 1: the CAN controller has left the bus after too many errors (bus-off)"; "port 1: the CAN controller is back on the bus"
[[nodiscard]] std::string to_string(const messages::ControllerTrouble& trouble);

[[nodiscard]] std::string to_string(const MissingRecords& missing);
[[nodiscard]] std::string to_string(const DamagedBytes& damage);
[[nodiscard]] std::string to_string(const NumbersGoBack& numbers);
[[nodiscard]] std::string to_string(const TornEnd& end);

}  // namespace earshot::journal
