#include "hil/bench/at_sea/bus_reader.hpp"

#include <cstddef>
#include <span>
#include <utility>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::hil {
namespace {

constexpr std::size_t kTracedFrames = 400'000;  ///< of a flight of two hours at sea

}  // namespace

void BusReader::hear(Time now) {
  for (n2k::Frame frame; socket_.receive(frame) == Status::kOk;) take(frame, now);
}

void BusReader::take(const n2k::Frame& frame, Time now) {
  const Result<n2k::Identifier> parsed = n2k::parse_identifier(frame.identifier);
  std::span<const std::uint8_t> bytes;
  if (parsed.ok() && parsed.value().pgn == n2k::kHealthPgn && assembly_.accept(parsed.value(), frame, bytes) == Status::kOk) {
    if (const auto report = n2k::read_health(bytes); report.ok()) {
      earshot_ = parsed.value().source;
      health_ = report.value().health;
    }
  }
  const bool is_earshots = parsed.ok() && parsed.value().source == earshot_;
  ++(is_earshots ? of_earshot_ : of_vehicle_);
  if (trace_.size() == kTracedFrames) trace_.pop_front();
  trace_.push_back({.time = now, .from_earshot = is_earshots, .frame = frame});
}

void BusReader::report(BenchFlight& flight) {
  flight.sent = of_vehicle_;
  flight.received = of_earshot_;
  flight.lost = socket_.counters().lost_by_kernel;
  flight.trace = std::move(trace_);
}

}  // namespace earshot::hil
