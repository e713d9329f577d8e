#include "tests/endurance/fast_sea.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace earshot::endurance {
namespace {

using messages::Order;

constexpr Duration kHour = Duration::seconds(3600);
constexpr Duration kHourBefore = Duration::seconds(-3600);
/// An order is sent again until it is acknowledged, but not for longer.
constexpr Duration kRepeats = Duration::seconds(25);
/// Periods between two of each.
constexpr std::uint64_t kBadMeasurements = 7;
constexpr std::uint64_t kRepeatedOrders = 5;
constexpr std::uint64_t kBadOrders = 601;
constexpr std::uint64_t kLinkDown = 20'011;
constexpr std::uint64_t kPeriodsDown = 2;  ///< less than navigation may be silent for
constexpr std::uint64_t kStrangers = 20;   ///< issuers of bad orders: more than the runtime remembers

/// Far above and below 2^32 at the end, so that whoever counts in 32 bits is found out.
constexpr std::uint64_t kNearlyTwoToThe32 = 4'294'967'296 - 100'000;

/// The nearer to the middle of the area the louder; nothing is heard from its corners.
Decibels snr_at(NorthEast place, NorthEast source) {
  return Decibels{30.0 - range_between(place, source).value / 400.0};
}

}  // namespace

board::Clock::Wake FastClock::wait(const Awaited& awaited) {
  const Time heard = awaited.next_turn + kHeard;
  const bool is_heard = clock_.now() >= heard;
  const Time until = is_heard ? awaited.next_turn : heard;
  host_.advance(until - clock_.now());
  return is_heard ? Wake::kTurn : Wake::kPorts;
}

FastSea::FastSea(std::uint8_t index, const Voyage& voyage, NorthEast place, Time began, std::atomic<bool>& stop)
    : Port(index, {}),
      voyage_(voyage),
      began_(began),
      next_(began + voyage.period + FastClock::kHeard),
      next_order_(began + voyage.start),
      stop_(stop) {
  fix_.position = place;
  report_.received = kNearlyTwoToThe32;
}

template <class Value>
void FastSea::send(board::InputSink& sink, const Value& value) {
  sink.take(index(), value);
  ++report_.received;
  ++sent_.inputs;
}

void FastSea::collect(board::Clock& clock, board::InputSink& sink) {
  const Time now = clock.now();
  if (now < next_) return;
  next_ = next_ + voyage_.period;
  ++turn_;
  sail();
  if (now - began_ >= voyage_.end) stop_ = true;
  report_.link_up = turn_ % kLinkDown >= kPeriodsDown;
  if (!report_.link_up) {
    report_.lost += 2;
    return;
  }
  fix_.time = now;
  send(sink, fix_);
  const Decibels snr = snr_at(fix_.position, {Meters{5000}, Meters{18'000}});
  send(sink, messages::SnrMeasurement{.time = now, .snr = snr, .too_faint = snr < Decibels{0}});
  if (turn_ % kBadMeasurements == 0) send_bad(sink, now);
  send_orders(sink, now);
}

void FastSea::send_bad(board::InputSink& sink, Time now) {
  messages::Navigation fix = fix_;
  messages::SnrMeasurement snr{.time = now, .snr = Decibels{3}};
  switch (turn_ / kBadMeasurements % 6) {
    case 0:
      fix.position.north = Meters{std::numeric_limits<double>::quiet_NaN()};
      break;
    case 1:
      fix.time = now + kHourBefore;
      break;
    case 2:
      fix.time = now + kHour;
      break;
    case 3:
      snr.snr = Decibels{std::numeric_limits<double>::infinity()};
      break;
    case 4:
      snr.time = now + kHourBefore;
      break;
    default:
      snr.time = now + kHour;
  }
  const bool is_fix = turn_ / kBadMeasurements % 6 < 3;
  ++(is_fix ? sent_.refused.navigation_refused : sent_.refused.snr_refused);
  is_fix ? send(sink, fix) : send(sink, snr);
}

void FastSea::order(board::InputSink& sink, Time now, Order order) {
  if (order != Order::kAbort && order == last_order_.order) ++sent_.refused.commands_refused;
  last_order_ = {.time = now, .expiry = now + kHour, .issuer = 1, .number = last_order_.number + 1, .order = order};
  send(sink, last_order_);
  ++sent_.commands;
}

void FastSea::send_orders(board::InputSink& sink, Time now) {
  if (now >= next_order_) {
    const Duration at = now - began_;
    order(sink, now, at >= voyage_.abort ? Order::kAbort : (at >= voyage_.complete ? Order::kComplete : Order::kStart));
    next_order_ = next_order_ + voyage_.between_orders;
  } else if (turn_ % kRepeatedOrders == 0 && last_order_.number > 0 && now - last_order_.time <= kRepeats) {
    send(sink, last_order_);
    ++sent_.commands;
  }
  if (turn_ % kBadOrders == 0) send_bad_order(sink, now);
}

void FastSea::send_bad_order(board::InputSink& sink, Time now) {
  messages::OperatorCommand bad{.time = now,
                                .expiry = now + kHour,
                                .issuer = 1000 + static_cast<std::uint32_t>(bad_orders_ % kStrangers),
                                .number = static_cast<std::uint32_t>(++bad_orders_),
                                .order = Order::kStart};
  const bool is_standby = now - began_ <= voyage_.start + voyage_.period;  // a good START would be obeyed
  switch (bad_orders_ % 4) {
    case 0:
      bad.time = now + kHourBefore;
      break;
    case 1:
      bad.expiry = now + Duration::seconds(-1);
      break;
    case 2:
      bad.order = static_cast<Order>(77);
      break;
    default:
      if (is_standby) bad.time = now + kHour;
  }
  send(sink, bad);
  ++sent_.refused.commands_refused;
  ++sent_.commands;
}

void FastSea::sail() {
  const double sailed_m = fix_.speed.value * static_cast<double>(voyage_.period.us) * 1e-6;
  fix_.position.north += Meters{sailed_m * std::cos(fix_.heading.value)};
  fix_.position.east += Meters{sailed_m * std::sin(fix_.heading.value)};
}

std::uint64_t FastSea::publish(Time /*now*/, const runtime::Outputs& outputs) {
  if (!outputs.setpoint) return 0;
  fix_.heading = outputs.setpoint->heading;
  fix_.speed = outputs.setpoint->speed;
  fix_.depth = outputs.setpoint->depth;
  return 1;
}

}  // namespace earshot::endurance
