#include "firmware/host/journal/words/event_words.hpp"

#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/messages/dictionary/journal_fields.hpp"

namespace earshot::journal {

const char* why_it_ended(messages::EndReason reason, AbortedBy by) {
  const bool is_stopped = reason == messages::EndReason::kOperatorAbort && by == AbortedBy::kProgram;
  return is_stopped ? "its program was stopped" : messages::to_string(reason);
}

void write_standing(host::TextInto& line, messages::MissionState state, messages::EndReason reason, std::uint32_t steps, AbortedBy by) {
  line << messages::to_string(state);
  if (reason != messages::EndReason::kNone) line << ", " << why_it_ended(reason, by);
  if (messages::counts_steps(reason)) line << ", after " << host::Counted{steps, "step"};
}

void write_state(host::TextInto& line, const messages::Health& health, std::string_view remark, AbortedBy by) {
  if (health.end_reason != messages::EndReason::kNone) return write_standing(line, health.state, health.end_reason, health.steps_taken, by);
  line << messages::to_string(health.state);
  if (!remark.empty()) line << ", " << remark;
}

void write_refused(host::TextInto& line, std::string_view sensor, std::uint64_t count) {
  line << sensor << ": " << host::Counted{count, "message"} << " refused so far, for their date, their order or what is in them";
}

void write_bearings_of_others(host::TextInto& line, std::uint64_t count) {
  line << "bearing: " << host::Counted{count, "message"} << " of a second sender not taken so far";
}

void write_detection(host::TextInto& line, const messages::SoundDetection& detection, std::string_view begin) {
  line << "heard for ";
  line.decimal(detection.duration.to_seconds(), 1) << " s from " << begin << ": level ";
  line.decimal(detection.level.value, 1) << " dB re 1 uPa, SNR ";
  line.decimal(detection.snr.value, 1) << " dB";
  if (detection.is_clipped) line << ", clipped";
}

std::string_view words_of_link(bool is_up) {
  return is_up ? "its link is up again" : "its link is down";
}

std::string_view words_of_disk(bool is_up) {
  return is_up ? "the disk takes it again" : "the disk does not take it in time";
}

std::string_view words_of(messages::ControllerState trouble, bool is_there) {
  return is_there ? messages::to_string(trouble) : messages::end_of(trouble);
}

}  // namespace earshot::journal
