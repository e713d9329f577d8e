#include "firmware/boards/linux/event_log/event_log.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "firmware/detector/bearing_window.hpp"
#include "firmware/host/journal/words/event_words.hpp"
#include "firmware/host/journal/words/rule_event_words.hpp"
#include "firmware/host/text/text_line.hpp"
#include "firmware/messages/dictionary/health_words.hpp"

namespace earshot::board {
namespace {

using host::Counted;
using host::TextInto;
using host::TextLine;

/// "hears 15.0 to 30.0 Hz of 8 channels at 96000.0 Hz: full scale 180.0, the ADC's own noise 8.4 dB re 1 uPa; SNR measurements lag by 0.24
/// s"
void write_chain(TextInto& line, const HeardChain& chain) {
  if (chain.heard == HeardChain::Heard::kImpossibleChain) {
    line << "hears nothing: " << detector::to_string(chain.fault);
    return;
  }
  if (chain.heard == HeardChain::Heard::kRateTooLow) {
    line << "hears nothing: a sample rate of ";
    line.decimal(chain.sample_rate.value, 1) << " Hz is too low for a band up to ";
    line.decimal(chain.band.high.value, 1) << " Hz";
    return;
  }
  line << "hears ";
  line.decimal(chain.band.low.value, 1) << " to ";
  line.decimal(chain.band.high.value, 1) << " Hz of " << Counted{chain.channels, "channel"} << " at ";
  line.decimal(chain.sample_rate.value, 1) << " Hz: full scale ";
  line.decimal(chain.full_scale_level.value, 1) << ", the ADC's own noise ";
  line.decimal(chain.adc_noise_level.value, 1) << " dB re 1 uPa; SNR measurements lag by ";
  line.decimal(chain.delay_s, 2) << " s";
}

/// What else there is to say about a state that has not ended.
std::string_view remark_or_mismatch(const messages::Health& health, bool is_mismatched) {
  const std::string_view remark = messages::remark_on(health, is_mismatched);
  const bool is_open = remark.empty() && health.end_reason == messages::EndReason::kNone;
  return is_open && is_mismatched ? messages::kIsMismatched : remark;
}

/// Of lines of which several may come at once: how far their time may run ahead.
constexpr Duration kMostAhead{(EventLog::kLinkLinesAtOnce - 1) * EventLog::kBetweenLinkLines.us};

}  // namespace

EventLog::EventLog(const PortSet& ports, LineWriter& writer, LogFormat format) : writer_(writer), format_(format) {
  for (const PortSet::Link& link : ports.links())
    links_.at(link.port) = {.label = link.label, .is_up = link.is_up, .changes = 0, .due = {}};
}

void EventLog::write(const LogEntry& entry) {
  std::array<char, kLogLineBytes> line{};
  writer_.append(formatted(entry, format_, line));
}

void EventLog::log(Time now, const messages::Health& health) {
  for (const messages::PortReport& report : health.ports) report_link(now, report);
  for (std::size_t port = 0; port < sounds_.size(); ++port) {
    report_chain(now, port);
    report_troubles(now, port);
    report_orders(now, port);
  }
  for (RuleState& rule : rules_) report_rule(now, rule);
  report_state(now, health);
  report_refused(now, "navigation", health.counters.navigation_refused, navigation_);
  report_refused(now, "SNR", health.counters.snr_refused, snr_);
  report_refused(now, "bearing", health.counters.bearings_refused, bearing_);
  report_others(now, health.counters.bearings_of_others);
}

void EventLog::log(Time now, std::uint8_t port, const messages::SoundDetection& detection) {
  Sound& sound = sounds_.at(port);
  ++sound.detections;
  if (now < sound.detection_due) return;
  TextLine line;
  std::array<char, 32> date{};
  journal::write_detection(line, detection, written(detection.begin, date));
  if (sound.detections > 1) line << "; " << sound.detections << " detections since it was last reported";
  write({.severity = Severity::kInfo, .event = "heard", .time = now, .port = port, .message = line.text()});
  sound.detections = 0;
  sound.detection_due = now + kBetweenDetectionLines;
}

void EventLog::log(const messages::SafetyEvent& event) {
  RuleState& rule = rules_.at(event.rule);
  rule.last = event;
  ++rule.changes;
  report_rule(event.time, rule);
}

/// A line that came too soon after the last of its rule is made up for when one is due: what was told last is what is.
void EventLog::report_rule(Time now, RuleState& rule) {
  const messages::SafetyEvent& event = rule.last;
  const bool ends_mission = event.begins && event.response >= config::Response::kAbort && event.response > rule.ended_by;
  if (rule.changes == 0 || (now < rule.due && !ends_mission)) return;
  TextLine line;
  journal::write_rule(line, event);
  if (rule.changes > 1) line << "; it changed " << rule.changes << " times since it was last reported";
  if (ends_mission) rule.ended_by = event.response;
  write({.severity = ends_mission ? Severity::kError : Severity::kWarning,
         .event = "rule",
         .time = now,
         .rule = static_cast<std::uint8_t>(event.rule + 1),
         .message = line.text()});
  rule.changes = 0;
  rule.due = now + kBetweenLinkLines;
}

void EventLog::log(Time now, const config::Mission& mission) {
  const Limits limits{.max_depth = mission.max_depth,
                      .search_depth = mission.search_depth,
                      .search_speed = mission.search_speed,
                      .max_time = mission.max_time};
  if (!limits_) limits_ = limits;
  if (limits == *limits_ || now < limits_due_) return;
  limits_ = limits;
  limits_due_ = now + kBetweenLinkLines;
  TextLine line;
  line << "TIGHTEN obeyed: the search is at ";
  line.decimal(limits.search_depth.value, 1) << " m and ";
  line.decimal(limits.search_speed.value, 2) << " m/s, never below ";
  line.decimal(limits.max_depth.value, 1) << " m, and ends after ";
  line.decimal(limits.max_time.to_seconds(), 0) << " s";
  write({.severity = Severity::kNotice, .event = "limits", .time = now, .message = line.text()});
}

void EventLog::report_durable(Time now, bool is_durable) {
  if (is_durable == is_durable_ || now < durable_due_) return;
  is_durable_ = is_durable;
  durable_due_ = now + kBetweenLinkLines;
  write({.severity = is_durable ? Severity::kNotice : Severity::kError,
         .event = "safety_record",
         .time = now,
         .message = is_durable
                        ? "safety record: a disk has it again"
                        : "safety record: no disk has taken it for 0.1 s (full, read-only, slow): orders are obeyed, but a power cut "
                          "may undo them"});
}

void EventLog::log(std::uint8_t port, const HeardChain& chain) {
  sounds_.at(port).chain = chain;
}

void EventLog::log(std::uint8_t port, BusTrouble trouble, bool is_there) {
  troubles_.at(port).at(static_cast<std::size_t>(trouble)).is_there = is_there;
}

void EventLog::report_troubles(Time now, std::size_t port) {
  for (std::size_t i = 0; i < kBusTroubleCount; ++i) {
    Trouble& trouble = troubles_.at(port).at(i);
    if (trouble.is_there == trouble.is_reported || now < trouble.due) continue;
    trouble.is_reported = trouble.is_there;
    const std::string_view words = trouble.is_there ? begin_of(static_cast<BusTrouble>(i)) : end_of(static_cast<BusTrouble>(i));
    if (words.empty()) continue;
    TextLine line;
    line << links_.at(port).label << ": " << words;
    if (const std::string_view hint = hint_of(static_cast<BusTrouble>(i)); trouble.is_there && !hint.empty()) line << ": " << hint;
    write({.severity = trouble.is_there ? Severity::kWarning : Severity::kNotice,
           .event = "bus",
           .time = now,
           .port = static_cast<std::uint8_t>(port),
           .message = line.text()});
    trouble.due = now + kBetweenLinkLines;
  }
}

void EventLog::log(std::uint8_t port, OrderTrouble trouble) {
  ++bad_orders_.at(port).at(static_cast<std::size_t>(trouble)).count;
}

void EventLog::report_orders(Time now, std::size_t port) {
  for (std::size_t i = 0; i < kOrderTroubleCount; ++i) {
    BadOrders& bad = bad_orders_.at(port).at(i);
    if (bad.count == 0 || now < bad.due) continue;
    TextLine line;
    line << links_.at(port).label << ": " << to_string(static_cast<OrderTrouble>(i));
    if (bad.count > 1) line << "; " << bad.count << " such since it was last reported";
    write({.severity = Severity::kWarning, .event = "order", .time = now, .port = static_cast<std::uint8_t>(port), .message = line.text()});
    bad = {.count = 0, .due = now + kBetweenLinkLines};
  }
}

void EventLog::report_chain(Time now, std::size_t port) {
  Sound& sound = sounds_.at(port);
  if (!sound.chain || now < sound.chain_due) return;
  TextLine line;
  line << links_.at(port).label << ": ";
  write_chain(line, *sound.chain);
  write({.severity = sound.chain->heard == HeardChain::Heard::kWell ? Severity::kInfo : Severity::kError,
         .event = "hydrophone",
         .time = now,
         .port = static_cast<std::uint8_t>(port),
         .message = line.text()});
  sound.chain.reset();
  sound.chain_due = now + kBetweenLinkLines;
}

void EventLog::report_state(Time now, const messages::Health& health) {
  const bool has_begun = state_ != health.state && health.state == messages::MissionState::kSearch;
  is_mismatched_ = (is_mismatched_ && !has_begun) || health.mismatch_bits >= messages::kMismatchThreshold_bits;
  const std::string_view remark = remark_or_mismatch(health, is_mismatched_);
  if (state_ == health.state && (remark_ == remark || remark_due_ - now > kMostAhead)) return;
  if (state_ != health.state) {
    for (Refused* refused : {&navigation_, &snr_, &bearing_, &others_bearing_}) refused->is_reported_in_state = false;
  } else {
    remark_due_ = std::max(remark_due_, now) + kBetweenLinkLines;
  }
  state_ = health.state;
  remark_ = remark;
  TextLine line;
  journal::write_state(line, health, remark, is_stopping_ ? journal::AbortedBy::kProgram : journal::AbortedBy::kOperator);
  const bool is_aborted = health.state == messages::MissionState::kAbort;
  write({.severity = is_aborted ? Severity::kError : Severity::kNotice, .event = "state", .time = now, .message = line.text()});
}

/// Of two ports that bring the same, the slower one's messages are refused for their order as long as the flight lasts: no more lines then.
void EventLog::report_refused(Time now, std::string_view sensor, std::uint64_t count, Refused& refused) {
  if (count == refused.reported || refused.is_reported_in_state) return;
  refused = {.reported = count, .is_reported_in_state = true};
  TextLine line;
  journal::write_refused(line, sensor, count);
  line << "; check their sender's clock (of CAN messages, which bear no date: at two ports that bring the same)";
  write({.severity = Severity::kWarning, .event = "refused", .time = now, .message = line.text()});
}

void EventLog::report_others(Time now, std::uint64_t count) {
  if (count == others_bearing_.reported || others_bearing_.is_reported_in_state) return;
  others_bearing_ = {.reported = count, .is_reported_in_state = true};
  TextLine line;
  journal::write_bearings_of_others(line, count);
  line << ": the first that was heard is listened to, until it is silent for "
       << static_cast<std::uint64_t>(detector::kBearingHandover.to_seconds()) << " s";
  write({.severity = Severity::kWarning, .event = "refused", .time = now, .message = line.text()});
}

/// Of the journal's own limit on such reports there are few.
void EventLog::report_journal_link(Time now, const messages::PortReport& report) {
  if (report.link_up == is_journal_up_) return;
  is_journal_up_ = report.link_up;
  TextLine line;
  line << "journal: " << journal::words_of_disk(is_journal_up_);
  if (is_journal_up_) {
    line << "; " << report.lost << " records are lost";
  } else {
    line << " (full, read-only, broken, slow, or in memory alone): the flight goes on; once the buffer is full only orders, changes of "
            "state and some set-points are kept";
  }
  write({.severity = is_journal_up_ ? Severity::kNotice : Severity::kError, .event = "journal", .time = now, .message = line.text()});
}

void EventLog::report_link(Time now, const messages::PortReport& report) {
  if (report.port == kOwnPort) return report_journal_link(now, report);
  Link& link = links_.at(report.port);
  if (report.link_up != link.is_up) ++link.changes;
  link.is_up = report.link_up;
  if (link.changes == 0 || link.due - now > kMostAhead) return;
  TextLine line;
  line << link.label << ": " << journal::words_of_link(link.is_up) << (link.is_up ? "" : "; tried again once a second");
  if (link.changes > 1) line << "; it changed " << link.changes << " times since it was last reported";
  write({.severity = link.is_up ? Severity::kNotice : Severity::kWarning,
         .event = "link",
         .time = now,
         .port = report.port,
         .message = line.text()});
  link.changes = 0;
  link.due = std::max(link.due, now) + kBetweenLinkLines;
}

}  // namespace earshot::board
