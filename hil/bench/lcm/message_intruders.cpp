#include "hil/bench/lcm/message_intruders.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/order_reader.hpp"

namespace earshot::hil {
namespace {

constexpr std::int32_t kStrangersNumber = 0xBAD;
constexpr std::int8_t kNoOrder = 99;
/// Shorter than the ten seconds for which the rules about a second sender wait, and the pause longer than a jump is remembered.
constexpr double kSays_s = 6.0;
constexpr double kPausesEach_s = 10.0;
constexpr std::string_view kStrangeChannel = "SOMEBODY_ELSES_CAMERA";

template <class Message>
void say_on(std::string_view channel, const Message& message, LcmMessages& said) {
  const wire::Encoded encoded(message);
  said.push_back({.channel = std::string(channel), .data = {encoded.bytes().begin(), encoded.bytes().end()}});
}

operator_command_t order(std::int8_t command, std::int64_t given, std::int64_t expires, std::int32_t number) {
  operator_command_t order{};
  order.utime = given;
  order.expiry_utime = expires;
  order.issuer = kStrangersNumber;
  order.number = number;
  order.command = command;
  order.max_depth_m = order.max_speed_mps = order.max_time_s = std::numeric_limits<double>::quiet_NaN();
  return order;
}

}  // namespace

void MessageIntruders::step(Time now, LcmMessages& said) {
  const double passed_s = (now - std::exchange(last_, now).value_or(now)).to_seconds();
  for (const TimedFault& fault : faults_) {
    if (fault.acts_at(now)) say(fault, now, passed_s, said);
  }
}

void MessageIntruders::say(const TimedFault& fault, Time now, double passed_s, LcmMessages& said) {
  constexpr std::int64_t kLongAgo_us = 20'000'000;
  switch (fault.fault) {
    case Fault::kFlood:
      for (std::uint64_t left = due(fault.amount * passed_s); left > 0; --left)
        said.push_back({.channel = std::string(kStrangeChannel), .data = std::vector<std::uint8_t>(64, 0x55)});
      break;
    case Fault::kNavigationFlood:
      for (std::uint64_t left = due(fault.amount * passed_s); left > 0; --left) {
        nav_state_t nonsense{};
        nonsense.utime = now.us;
        for (double* const number : {&nonsense.north_m, &nonsense.east_m, &nonsense.depth_m, &nonsense.heading_rad, &nonsense.speed_mps})
          *number = std::bit_cast<double>(std::uint64_t{random_.next()} << 32U | random_.next());
        say_on(wire::kNavStateChannel, nonsense, said);
      }
      break;
    case Fault::kSecondNavigation:
      say_on(wire::kNavStateChannel,
             wire::to_message(messages::Navigation{.time = now,
                                                   .position = vehicle_.position + fault.vector(),
                                                   .depth = vehicle_.depth,
                                                   .heading = vehicle_.heading,
                                                   .speed = vehicle_.speed}),
             said);
      break;
    case Fault::kWalkingNavigation:
    case Fault::kPausingNavigation: {
      const double seconds = (now - fault.from).to_seconds();
      if (fault.fault == Fault::kPausingNavigation && std::fmod(seconds, kPausesEach_s) >= kSays_s) break;
      const NorthEast walked{fault.vector().north * seconds, fault.vector().east * seconds};
      say_on(wire::kNavStateChannel,
             wire::to_message(messages::Navigation{.time = now,
                                                   .position = vehicle_.position + walked,
                                                   .depth = vehicle_.depth,
                                                   .heading = vehicle_.heading,
                                                   .speed = vehicle_.speed}),
             said);
      break;
    }
    case Fault::kStrangersOrder:
      say_on(wire::kOperatorCommandChannel,
             order(operator_command_t::COMPLETE, now.us - kLongAgo_us, now.us - kLongAgo_us + 1'000'000, ++orders_), said);
      break;
    case Fault::kUnknownOrder:
      say_on(wire::kOperatorCommandChannel, order(kNoOrder, now.us, now.us, ++orders_), said);
      break;
    case Fault::kCutAbort:
      say_on(wire::kOperatorCommandChannel, order(operator_command_t::ABORT, now.us, now.us, ++orders_), said);
      said.back().data.resize(wire::kOrderHeadBytes);
      break;
    case Fault::kRecordedOrder: {
      operator_command_t recorded = order(operator_command_t::PAUSE, now.us, now.us, ++orders_);
      const messages::CommandMark mark = key_.old_mark_of(wire::from_message(recorded));
      std::ranges::copy(mark, std::begin(recorded.mark));
      say_on(wire::kOperatorCommandChannel, recorded, said);
      break;
    }
    default:
      break;
  }
}

std::uint64_t MessageIntruders::due(double new_messages) {
  owed_ += new_messages;
  const auto whole = static_cast<std::uint64_t>(owed_);
  owed_ -= static_cast<double>(whole);
  return whole;
}

}  // namespace earshot::hil
