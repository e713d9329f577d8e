#include "hil/nodes/hydrophone.hpp"

#include <gtest/gtest.h>

#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

constexpr Time kSettled{1'000'000};

/// 20 dB less a decibel for each kilometre.
Decibels straight(Meters range) {
  return Decibels{20.0 - range.value / 1000.0};
}

TEST(Hydrophone, SaysTheSnrAtItsRangeOnceASecond) {
  const HydrophoneFault fault;
  vehicle::State vehicle;
  vehicle.position = {Meters{3000}, Meters{4000}};
  const auto hydrophone = make_hydrophone(vehicle, {.position = {}, .snr = straight}, fault, 1);
  (void)run(*hydrophone, Time{}, kSettled);
  const Frames frames = of_group(n2k::kSnrPgn, run(*hydrophone, kSettled, kSettled + Duration::seconds(10)));
  ASSERT_EQ(frames.size(), 10U);
  // 65291 = 0xFF0B at priority 5 from 0x28: maker and industry 0x9FFC; 15.00 dB = 1500 = 0x005DC in 18 bits, not too faint: 0 in two, level
  // unknown: 0xFFFF in 16, no SID: 0xFF in 8; four reserved bits.
  EXPECT_EQ(frames[0], (n2k::Frame{0x14FF0B28, 8, {0xFC, 0x9F, 0xDC, 0x05, 0xF0, 0xFF, 0xFF, 0xFF}}));
}

TEST(Hydrophone, HearsTheVehicleComeNearer) {
  const HydrophoneFault fault;
  vehicle::State vehicle;
  vehicle.position = {Meters{5000}, Meters{0}};
  const auto hydrophone = make_hydrophone(vehicle, {.position = {}, .snr = straight}, fault, 1);
  (void)run(*hydrophone, Time{}, kSettled);
  vehicle.position = {Meters{4000}, Meters{0}};
  const Frames frames = of_group(n2k::kSnrPgn, run(*hydrophone, kSettled, kSettled + Duration::seconds(1)));
  ASSERT_EQ(frames.size(), 1U);
  // 16.00 dB = 1600 = 0x0640.
  EXPECT_EQ(frames[0].data[2], 0x40);
  EXPECT_EQ(frames[0].data[3], 0x06);
}

TEST(Hydrophone, SaysThatItIsDeafAndNoSnrAsLongAsItIs) {
  HydrophoneFault fault;
  const vehicle::State vehicle;
  const auto hydrophone = make_hydrophone(vehicle, {.position = {}, .snr = straight}, fault, 1);
  (void)run(*hydrophone, Time{}, kSettled);
  fault.is_deaf = true;
  const Frames deaf = of_group(n2k::kSnrPgn, run(*hydrophone, kSettled, kSettled + Duration::seconds(2)));
  ASSERT_EQ(deaf.size(), 2U);
  EXPECT_TRUE(n2k::read_deaf(deaf[0].bytes()).value());
  EXPECT_FALSE(n2k::read_snr(deaf[0].bytes()).ok());
  fault.is_deaf = false;
  const Time later = kSettled + Duration::seconds(2);
  const Frames healed = of_group(n2k::kSnrPgn, run(*hydrophone, later, later + Duration::seconds(1)));
  ASSERT_EQ(healed.size(), 1U);
  EXPECT_EQ(n2k::read_snr(healed[0].bytes()).value().snr.value, 20.0);
}

TEST(Hydrophone, TellsAnSnrThatIsWrongByItsGain) {
  const HydrophoneFault fault{.is_deaf = false, .gain_error = Decibels{-12.5}};
  const vehicle::State vehicle;
  const auto hydrophone = make_hydrophone(vehicle, {.position = {}, .snr = straight}, fault, 1);
  (void)run(*hydrophone, Time{}, kSettled);
  const Frames frames = of_group(n2k::kSnrPgn, run(*hydrophone, kSettled, kSettled + Duration::seconds(1)));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(n2k::read_snr(frames[0].bytes()).value().snr.value, 7.5);
}

TEST(Hydrophone, IsSilentWhereItsModelHasNoNumber) {
  const HydrophoneFault fault;
  const vehicle::State vehicle;
  const auto hydrophone = make_hydrophone(vehicle, {.position = {}, .snr = [](Meters) { return Decibels{1e9}; }}, fault, 1);
  EXPECT_TRUE(of_group(n2k::kSnrPgn, run(*hydrophone, Time{}, kSettled)).empty());
  EXPECT_GT(hydrophone->unsent(), 0U);
}

}  // namespace
}  // namespace earshot::hil
