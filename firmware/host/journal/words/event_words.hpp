#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/host/text/text_line.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/journal_records.hpp"
#include "firmware/messages/sound_detection.hpp"

namespace earshot::journal {

// The words for what the event log reports while a vehicle is at sea and its journal afterwards; rules that act have theirs in
// rule_event_words.hpp. They are written into memory of the caller's: nothing here allocates.

/// Whose order an ABORT was that no rule gave: a program that is stopped gives one, too.
enum class AbortedBy : std::uint8_t { kOperator, kProgram };

/// "navigation went silent"; "its program was stopped"
[[nodiscard]] const char* why_it_ended(messages::EndReason reason, AbortedBy by);

/// "ABORT, navigation went silent, after 12 steps"; "SEARCH, after 3 steps"
void write_standing(host::TextInto& line, messages::MissionState state, messages::EndReason reason, std::uint32_t steps, AbortedBy by);

/// Likewise, and of a mission that is not over its state and what else there is to say: "SEARCH, listening: it commands nothing"
/// @param remark  messages::remark_on(), or another; may be empty
void write_state(host::TextInto& line, const messages::Health& health, std::string_view remark, AbortedBy by);

/// "SNR: 31 messages refused so far, for their date, their order or what is in them"
void write_refused(host::TextInto& line, std::string_view sensor, std::uint64_t count);
/// "bearing: 7 messages of a second sender not taken so far"
void write_bearings_of_others(host::TextInto& line, std::uint64_t count);

/// "heard for 2.5 s from 2026-11-29 12:00:00 UTC: level 101.5 dB re 1 uPa, SNR 12.5 dB, clipped"
/// @param begin  when it began, as text
void write_detection(host::TextInto& line, const messages::SoundDetection& detection, std::string_view begin);

/// "its link is down"; "its link is up again"
[[nodiscard]] std::string_view words_of_link(bool is_up);
/// Likewise, of the journal: "the disk does not take it in time"; "the disk takes it again"
[[nodiscard]] std::string_view words_of_disk(bool is_up);

/// "the CAN controller has left the bus after too many errors (bus-off)"; "the CAN controller is back on the bus"
[[nodiscard]] std::string_view words_of(messages::ControllerState trouble, bool is_there);

}  // namespace earshot::journal
