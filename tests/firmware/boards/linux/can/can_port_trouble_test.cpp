#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "tests/firmware/boards/linux/can/bus_rig.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

// Unique number 1, maker 2044, instance 0, function 150 of class 40, marine industry, can claim any address; by hand.
constexpr n2k::Name kOwnName = 0xC050'9600'FF80'0001;

class CanPortTroubleTest : public BusRig {
 protected:
  /// Time passes on both clocks.
  void pass(int seconds) {
    for (int i = 0; i < seconds; ++i) {
      clock_.time = clock_.time + Duration::seconds(1);
      serve_for(Duration::seconds(1));
    }
  }
};

TEST_F(CanPortTroubleTest, TellsThatNobodyBringsAnythingAndRemarksNothingAtTheEnd) {
  open_settled();
  pass(6);
  for (const BusTrouble trouble : {BusTrouble::kNoPosition, BusTrouble::kNoHeading, BusTrouble::kNoDepth, BusTrouble::kNoSnr})
    EXPECT_TRUE(taken_.has(trouble)) << begin_of(trouble);
  EXPECT_EQ(taken_.troubles.count(), 4U);
  EXPECT_EQ(port_->words().remark, "") << "nothing was lost";
}

TEST_F(CanPortTroubleTest, TellsOfADeviceOfItsNameAndRemarksItAtTheEnd) {
  open_settled();
  claim(kOwnName, 0x77);
  pass(1);
  EXPECT_TRUE(taken_.has(BusTrouble::kSameName));
  EXPECT_TRUE(support::tells(port_->words().remark, {"CAN", "vcan0", "NAME", "back", "them", "unique_number"}));
}

TEST_F(CanPortTroubleTest, TellsThatItHasNoAddressAndCountsWhatItCouldNotSend) {
  open();
  runtime::Outputs outputs;
  outputs.setpoint.emplace();
  for (int second = 0; second < 3; ++second) {
    for (unsigned address = 0; address <= n2k::kLastAddress; ++address) claim(1 + address, static_cast<std::uint8_t>(address));
    pass(1);
    EXPECT_EQ(port_->publish(clock_.time, outputs), 0U);
  }
  EXPECT_TRUE(taken_.has(BusTrouble::kNoAddress));
  EXPECT_FALSE(taken_.has(BusTrouble::kUnsent)) << "which is why";
  EXPECT_EQ(port_->report().unsent, 6U) << "set-point and health";
  EXPECT_TRUE(support::tells(port_->words().remark, {"CAN", "vcan0", "6 messages", "not", "no", "bus"}));
}

TEST_F(CanPortTroubleTest, RemarksPositionsThatWaitedForAHeadingOnceThatWasTold) {
  open_settled();
  const auto send_position = [this] {
    n2k::NavigationFrames frames;
    ASSERT_EQ(n2k::compose_navigation({}, plane(), kCommander, frames), Status::kOk);
    send(frames[2]);
    send(frames[3]);
  };
  send_position();
  collect();
  EXPECT_EQ(port_->words().remark, "") << "the first positions are there before the first heading";
  // The bus is dated by the kernel's clock: the mission's time is what the host's clock says.
  clock_.time = HostClock().utc();
  for (int i = 0; i < 6; ++i) {
    send_position();
    serve_for(Duration::seconds(1));
    clock_.time = clock_.time + Duration::seconds(1);
  }
  EXPECT_TRUE(taken_.has(BusTrouble::kNoHeading));
  EXPECT_TRUE(support::tells(port_->words().remark, {"CAN", "vcan0", "7 positions", "no", "missing", "oldest_part_s"}));
}

}  // namespace
}  // namespace earshot::board
