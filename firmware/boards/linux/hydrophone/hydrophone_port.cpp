#include "firmware/boards/linux/hydrophone/hydrophone_port.hpp"

#include <algorithm>

#include "firmware/boards/linux/hydrophone/hearing_words.hpp"

namespace earshot::board {
namespace {

/// Of each channel. A sender whose counter repeats itself hides what is missing, but not what the ring had no room for.
std::uint64_t lost_of(const SampleMeter::Reading& metered, const HydrophoneReceiver::Counters& received) {
  return std::max(metered.samples_missing, received.samples_overrun);
}

}  // namespace

HydrophonePort::HydrophonePort(std::uint8_t index, const host::PortSettings& settings,
                               const std::optional<detector::SoundSettings>& hearing, WakesFor wakes, host::IfMissing if_missing)
    : Port(index, settings.roles),
      name_(settings.name),
      address_(settings.address),
      hears_(hearing ? to_string(*hearing) : std::string()),
      processor_(hearing, wakes),
      receiver_(settings.address, processor_, if_missing) {}

void HydrophonePort::collect(Clock& clock, InputSink& sink) {
  processor_.clear();
  if (!clock.takes_sound_now()) return;
  for (HeardChain chain; processor_.take(chain);) sink.report_chain(index(), chain);
  for (messages::HydrophoneStatus status; processor_.take(status);) {
    status.time = clock.now();
    sink.take(index(), status);
  }
  for (messages::SnrMeasurement measurement; processor_.take(measurement);) {
    measurement.time = clock.time_heard(measurement.time);
    sink.take(index(), measurement);
  }
  for (messages::SoundDetection detection; processor_.take(detection);) {
    detection.begin = clock.time_heard(detection.begin);
    sink.report_detection(index(), detection);
  }
}

PortWords HydrophonePort::words() const {
  return {.label = name_ + ", hydrophone, LCM " + address_,
          .details = "on " + receiver_.interfaces() + (hears_.empty() ? "" : ": " + hears_),
          .remark = remark()};
}

messages::PortReport HydrophonePort::report() const {
  const HydrophoneReceiver::Counters received = receiver_.counters();
  const SampleMeter::Reading metered = processor_.account();
  messages::PortReport report = report_;
  report.link_up = received.link_up;
  report.received = metered.samples_heard;
  report.lost = lost_of(metered, received);
  report.malformed = received.malformed;
  return report;
}

std::string HydrophonePort::remark() const {
  const HydrophoneReceiver::Counters received = receiver_.counters();
  const SampleMeter::Reading metered = processor_.account();
  const auto count = [](std::uint64_t n, const char* what) { return std::to_string(n) + what; };
  return name_ + ": of each channel " + count(metered.samples_heard, " samples heard, ") + count(lost_of(metered, received), " lost (") +
         count(metered.missing_at_sender, " by the sender, ") + count(received.samples_overrun, " because the listener was slow); ") +
         count(metered.overflows, " clipped, ") + count(metered.gain_changes, " changes of gain, ") +
         count(metered.beginnings, " beginnings, ") + count(metered.jumps, " jumps that no ADC makes, ") +
         count(received.malformed, " malformed messages, ") + count(received.datagrams_overrun, " datagrams overrun") +
         (hears_.empty() ? std::string() : "; " + to_string(processor_.heard()));
}

}  // namespace earshot::board
