#include "firmware/host/transport/can/controller.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>

namespace earshot::host {
namespace {

using State = n2k::ControllerState;

// Identifiers and bytes as printed in the kernel's include/uapi/linux/can/error.h.
can_frame error(canid_t kind, std::uint8_t problem = 0) {
  can_frame frame{};
  frame.can_id = 0x20000000U | kind;
  frame.can_dlc = 8;
  frame.data[1] = problem;
  return frame;
}
constexpr canid_t kTimeout = 0x001;
constexpr canid_t kProblem = 0x004;
constexpr canid_t kNoAcknowledgement = 0x020;
constexpr canid_t kBusOff = 0x040;
constexpr canid_t kRestarted = 0x100;

TEST(CanController, GoesFromActiveOverPassiveToBusOffAndBack) {
  CanController controller;
  EXPECT_EQ(controller.state(), State::kErrorActive);
  controller.accept_error(error(kProblem, 0x08));  // TX_WARNING
  EXPECT_EQ(controller.state(), State::kErrorActive);
  EXPECT_TRUE(controller.is_warned());
  controller.accept_error(error(kProblem, 0x04));  // RX_WARNING, while it is warned: no other
  controller.accept_error(error(kProblem, 0x20));  // TX_PASSIVE
  EXPECT_EQ(controller.state(), State::kErrorPassive);
  controller.accept_error(error(kBusOff));
  EXPECT_TRUE(controller.is_bus_off());
  controller.accept_error(error(kBusOff));
  controller.accept_error(error(kRestarted));
  EXPECT_EQ(controller.state(), State::kErrorActive);
  EXPECT_FALSE(controller.is_warned());
  EXPECT_EQ(controller.counters().frames, 6U);
  EXPECT_EQ(controller.counters().warning, 1U);
  EXPECT_EQ(controller.counters().passive, 1U);
  EXPECT_EQ(controller.counters().bus_off, 1U) << "off the bus it cannot leave it";
  EXPECT_EQ(controller.counters().restarted, 1U);
}

TEST(CanController, IsPassiveByItsReceptionTooAndActiveWhenTheKernelSaysSo) {
  CanController controller;
  controller.accept_error(error(kProblem, 0x10));  // RX_PASSIVE
  EXPECT_EQ(controller.state(), State::kErrorPassive);
  controller.accept_error(error(kProblem, 0x04));  // RX_WARNING: fewer errors than that
  EXPECT_EQ(controller.state(), State::kErrorActive);
  EXPECT_TRUE(controller.is_warned());
  controller.accept_error(error(kProblem, 0x40));  // ACTIVE
  EXPECT_FALSE(controller.is_warned());
}

TEST(CanController, StaysPassiveWhenItsProblemIsAnother) {
  CanController controller;
  controller.accept_error(error(kProblem, 0x20));  // TX_PASSIVE
  controller.accept_error(error(kProblem, 0x01));  // RX_OVERFLOW
  controller.accept_error(error(kProblem, 0x00));  // unspecified
  EXPECT_EQ(controller.state(), State::kErrorPassive);
  EXPECT_EQ(controller.counters().restarted, 0U);
}

TEST(CanController, CountsWhatDoesNotChangeItsState) {
  CanController controller;
  controller.accept_error(error(kTimeout));
  controller.accept_error(error(kNoAcknowledgement));
  controller.accept_error(error(kProblem, 0x01));  // RX_OVERFLOW
  EXPECT_EQ(controller.state(), State::kErrorActive);
  EXPECT_EQ(controller.counters().send_timeouts, 1U);
  EXPECT_EQ(controller.counters().not_acknowledged, 1U);
  EXPECT_EQ(controller.counters().overflows, 1U);
}

TEST(CanController, ReadsNothingBehindTheEndOfAShortErrorFrame) {
  CanController controller;
  can_frame frame = error(kProblem, 0x20);
  frame.can_dlc = 1;
  controller.accept_error(frame);
  EXPECT_EQ(controller.state(), State::kErrorActive);
}

TEST(CanController, IsOnTheBusIfItHearsSomebody) {
  CanController controller;
  controller.note_bus_off();
  controller.note_reception();
  EXPECT_EQ(controller.state(), State::kErrorActive);
  controller.accept_error(error(kProblem, 0x20));
  controller.note_reception();
  EXPECT_EQ(controller.state(), State::kErrorPassive) << "who is passive hears everything";
}

}  // namespace
}  // namespace earshot::host
