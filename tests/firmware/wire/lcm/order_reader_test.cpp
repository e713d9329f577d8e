#include "firmware/wire/lcm/order_reader.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "earshot/health_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "earshot/vehicle_status_t.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::wire {
namespace {

using messages::OperatorCommand;
using messages::Order;
using Bytes = std::vector<std::uint8_t>;

// By hand from operator_command_t.lcm: fingerprint 8, dates 8 and 8, issuer 4, number 4, order 1, limits 24, mark 16, verified 1.
constexpr std::size_t kWholeBytes = 74;

OperatorCommand order(Order order) {
  return {.time = Time{1'795'000'000'000'000},
          .expiry = Time{1'795'000'600'000'000},
          .issuer = 0xFEDC'BA98,
          .number = 7,
          .order = order,
          .mark = {1, 2}};
}
using support::bytes_of;
Bytes as_sent(Order of) {
  return bytes_of(support::as_peer<operator_command_t>(order(of)));
}

TEST(OrderReader, ReadsAWholeOrderWithAllItsFields) {
  const Bytes bytes = as_sent(Order::kStart);
  ASSERT_EQ(bytes.size(), kWholeBytes);
  const ReadOrder read = read_order(bytes);
  EXPECT_EQ(read.form, OrderForm::kWhole);
  EXPECT_EQ(read.command, order(Order::kStart));
}

TEST(OrderReader, FindsAnAbortWhoseMarkIsMissingAsPythonsLcmGenLeavesIt) {
  // lcm-gen writes mark[:16] of what the field holds, which is "" until it is set, and does not complain: 16 bytes are missing.
  Bytes bytes = as_sent(Order::kAbort);
  bytes.erase(bytes.begin() + 57, bytes.begin() + 73);
  const ReadOrder read = read_order(bytes);
  EXPECT_EQ(read.form, OrderForm::kAbort);
  EXPECT_EQ(read.command.order, Order::kAbort);
  EXPECT_EQ(read.command.issuer, 0xFEDC'BA98U);
  EXPECT_EQ(read.command.number, 7U);
}

TEST(OrderReader, FindsAnAbortOfAnyLengthFromItsHeadOn) {
  Bytes bytes = as_sent(Order::kAbort);
  for (std::size_t size = 0; size <= 2 * kWholeBytes; ++size) {
    bytes.resize(size <= kWholeBytes ? kWholeBytes : size, 0xA5);
    const ReadOrder read = read_order(std::span(bytes).first(size));
    const OrderForm expected = size == kWholeBytes ? OrderForm::kWhole : (size < 33 ? OrderForm::kUnreadable : OrderForm::kAbort);
    EXPECT_EQ(read.form, expected) << size;
  }
}

TEST(OrderReader, FindsAnAbortUnderAnotherFingerprint) {
  Bytes bytes = as_sent(Order::kAbort);
  bytes[3] ^= 0x40U;
  EXPECT_EQ(read_order(bytes).form, OrderForm::kAbort);
  bytes.resize(33);
  EXPECT_EQ(read_order(bytes).form, OrderForm::kAbort);
  bytes.resize(32);
  EXPECT_EQ(read_order(bytes).form, OrderForm::kUnreadable);
}

TEST(OrderReader, FindsNoAbortUnderAnotherFingerprintWhoseDatesAreNone) {
  for (const std::size_t date : {8U, 16U}) {
    Bytes bytes = as_sent(Order::kAbort);
    bytes[0] ^= 1U;
    bytes[date + 1] = 0x20;  // 2^53 us and something: after the year 2255
    EXPECT_EQ(read_order(bytes).form, OrderForm::kUnreadable) << date;
    bytes[date + 1] = 0x1F;
    EXPECT_EQ(read_order(bytes).form, OrderForm::kAbort) << date;
    bytes[0] ^= 1U;
    bytes[date + 1] = 0x20;
    EXPECT_EQ(read_order(bytes).form, OrderForm::kWhole) << "an ABORT of this type is obeyed whatever its date";
  }
}

TEST(OrderReader, ObeysNothingElseByHalf) {
  for (const Order half : {Order::kStart, Order::kComplete, Order::kListen, Order::kPause, Order::kResume, Order::kTighten}) {
    Bytes bytes = as_sent(half);
    bytes.pop_back();
    const ReadOrder read = read_order(bytes);
    EXPECT_EQ(read.form, OrderForm::kUnreadable);
    EXPECT_EQ(read.command.order, half) << "its sender is to hear which";
    EXPECT_EQ(read.command.issuer, 0xFEDC'BA98U);
    EXPECT_EQ(read.command.number, 7U);
    EXPECT_EQ(read.command.mark, messages::CommandMark{});
  }
}

TEST(OrderReader, TellsNobodysIssuerOfWhatHasNoHead) {
  EXPECT_EQ(read_order({}).command.issuer, 0U);
  Bytes bytes = as_sent(Order::kStart);
  bytes[0] ^= 1U;
  bytes[32] = 0;  // no order that there is
  EXPECT_EQ(read_order(bytes).command.issuer, 0U);
  EXPECT_EQ(read_order(bytes).form, OrderForm::kUnreadable);
}

TEST(OrderReader, TakesNoOtherMessageForAnAbort) {
  nav_state_t fix{};
  fix.utime = 1'795'000'000'000'000;
  fix.north_m = 12'500;
  snr_estimate_t snr{};
  snr.utime = fix.utime;
  vehicle_status_t status{};
  status.utime = fix.utime;
  status.altitude_m = 30;
  health_t health{};
  health.utime = fix.utime;
  for (const Bytes& bytes : {support::bytes_of(fix), support::bytes_of(snr), support::bytes_of(status), support::bytes_of(health),
                             Bytes(74, 0x03), Bytes(74, 0xFF), Bytes(74, 0)})
    EXPECT_EQ(read_order(bytes).form, OrderForm::kUnreadable);
}

}  // namespace
}  // namespace earshot::wire
