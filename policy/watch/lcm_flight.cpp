#include "policy/watch/lcm_flight.hpp"

#include <poll.h>

#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/reading/decode_record.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::watch {
namespace {

constexpr std::chrono::seconds kBetweenRefreshes{1};

std::vector<std::string_view> channels() {
  using namespace wire;
  return {kNavStateChannel,        kSnrEstimateChannel,      kBearingChannel,     kOperatorCommandChannel, kVehicleStatusChannel,
          kAutopilotStatusChannel, kHydrophoneStatusChannel, kSetpointChannel,    kDecisionChannel,        kHealthChannel,
          kAcknowledgementChannel, kChallengeChannel,        kSafetyEventChannel, kDetectionChannel};
}

host::LcmUrl parsed(const std::string& url) try { return host::parse_lcm_url(url); } catch (const std::invalid_argument& e) {
  throw host::BadInput("--lcm-url " + url + ": " + e.what());
}

Time utc_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return {std::chrono::duration_cast<std::chrono::microseconds>(now).count()};
}

}  // namespace

LcmFlight::LcmFlight(const std::string& url) : url_(url), endpoint_(parsed(url), channels(), nullptr, host::IfMissing::kKeepTrying) {
  begin();
}

void LcmFlight::begin() {
  flight_ = std::make_unique<report::GrowingFlight>(report::FlightSurroundings{.name = url_, .journal = {}, .files = {}, .recording = {}});
  next_number_ = 0;
  flight_->take(journal::BusLog{});
}

Change LcmFlight::take() {
  const auto now = std::chrono::steady_clock::now();
  if (now >= next_refresh_) {
    endpoint_.refresh_interfaces();
    next_refresh_ = now + kBetweenRefreshes;
  }
  Change change = Change::kNone;
  wire::Lc02Message message;
  // One at a time, so that none is pushed out by those that came after it.
  while (endpoint_.collect(1) > 0)
    while (endpoint_.take(message) == Status::kOk) change = std::max(change, take(message));
  return change;
}

Change LcmFlight::take(const wire::Lc02Message& message) {
  const std::string channel = journal::journalled_channel(message.channel);
  const Time time = utc_now();
  journal::Content content = journal::decode_record(channel, time, message.data);
  const auto* const health = std::get_if<messages::Health>(&content);
  const bool is_another = health != nullptr && health->end_reason == messages::EndReason::kNone && flight_->is_over();
  if (is_another) begin();
  add(journal::Record{
      .number = next_number_++, .time = time, .channel = channel, .size_bytes = message.data.size(), .content = std::move(content)});
  return is_another ? Change::kOther : Change::kMore;
}

void LcmFlight::wait(std::chrono::milliseconds most) {
  pollfd arrives{endpoint_.file_descriptor(), POLLIN, 0};
  (void)::poll(&arrives, 1, static_cast<int>(most.count()));
}

}  // namespace earshot::watch
