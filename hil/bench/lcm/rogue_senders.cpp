#include "hil/bench/lcm/rogue_senders.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/order_reader.hpp"

namespace earshot::hil {
namespace {

constexpr std::uint32_t kStrangersNumber = 0xBAD;
constexpr messages::Order kNoOrder{99};
/// Shorter than the ten seconds for which the rules about a second sender wait, and the pause longer than a jump is remembered.
constexpr double kSends_s = 6.0;
constexpr double kPausesEach_s = 10.0;
constexpr std::string_view kStrangeChannel = "SOMEBODY_ELSES_CAMERA";

template <class Message>
void send_on(std::string_view channel, const Message& message, LcmMessages& sent) {
  const wire::Encoded encoded(message);
  sent.push_back({.channel = std::string(channel), .data = {encoded.bytes().begin(), encoded.bytes().end()}});
}

messages::OperatorCommand order(messages::Order order, Time given, Time expires, std::uint32_t number) {
  return {.time = given, .expiry = expires, .issuer = kStrangersNumber, .number = number, .order = order};
}

}  // namespace

void RogueSenders::step(Time now, LcmMessages& sent) {
  const double passed_s = (now - std::exchange(last_, now).value_or(now)).to_seconds();
  for (const TimedFault& fault : faults_) {
    if (fault.traits().hits == FaultTarget::kBus && fault.acts_at(now)) send(fault, now, passed_s, sent);
  }
}

void RogueSenders::send(const TimedFault& fault, Time now, double passed_s, LcmMessages& sent) {
  const Time given{now.us - Duration::seconds(20).us};  // long ago
  switch (fault.fault) {
    case Fault::kFlood:
      for (std::uint64_t left = due(fault.amount * passed_s); left > 0; --left)
        sent.push_back({.channel = std::string(kStrangeChannel), .data = std::vector<std::uint8_t>(64, 0x55)});
      break;
    case Fault::kNavigationFlood:
      for (std::uint64_t left = due(fault.amount * passed_s); left > 0; --left) {
        messages::Navigation nonsense;
        nonsense.time = now;
        const auto any = [this] { return std::bit_cast<double>(std::uint64_t{random_.next()} << 32U | random_.next()); };
        for (double* const number : {&nonsense.position.north.value, &nonsense.position.east.value, &nonsense.depth.value,
                                     &nonsense.heading.value, &nonsense.speed.value})
          *number = any();
        send_on(wire::kNavStateChannel, nonsense, sent);
      }
      break;
    case Fault::kSecondNavigation:
      send_on(wire::kNavStateChannel,
              messages::Navigation{.time = now,
                                   .position = vehicle_.position + fault.vector(),
                                   .depth = vehicle_.depth,
                                   .heading = vehicle_.heading,
                                   .speed = vehicle_.speed},
              sent);
      break;
    case Fault::kWalkingNavigation:
    case Fault::kPausingNavigation: {
      const double seconds = (now - fault.from).to_seconds();
      if (fault.fault == Fault::kPausingNavigation && std::fmod(seconds, kPausesEach_s) >= kSends_s) break;
      const NorthEast walked{fault.vector().north * seconds, fault.vector().east * seconds};
      send_on(wire::kNavStateChannel,
              messages::Navigation{.time = now,
                                   .position = vehicle_.position + walked,
                                   .depth = vehicle_.depth,
                                   .heading = vehicle_.heading,
                                   .speed = vehicle_.speed},
              sent);
      break;
    }
    case Fault::kStrangersOrder:
      send_on(wire::kOperatorCommandChannel, order(messages::Order::kComplete, given, given + Duration::seconds(1), ++orders_), sent);
      break;
    case Fault::kUnknownOrder:
      send_on(wire::kOperatorCommandChannel, order(kNoOrder, now, now, ++orders_), sent);
      break;
    case Fault::kCutAbort:
      send_on(wire::kOperatorCommandChannel, order(messages::Order::kAbort, now, now, ++orders_), sent);
      sent.back().data.resize(wire::kOrderHeadBytes);
      break;
    case Fault::kRecordedOrder: {
      messages::OperatorCommand recorded = order(messages::Order::kPause, now, now, ++orders_);
      recorded.mark = key_.old_mark_of(recorded);
      send_on(wire::kOperatorCommandChannel, recorded, sent);
      break;
    }
    default:
      throw NoMaker(fault.fault, "of who is on an LCM bus");
  }
}

std::uint64_t RogueSenders::due(double new_messages) {
  owed_ += new_messages;
  const auto whole = static_cast<std::uint64_t>(owed_);
  owed_ -= static_cast<double>(whole);
  return whole;
}

}  // namespace earshot::hil
