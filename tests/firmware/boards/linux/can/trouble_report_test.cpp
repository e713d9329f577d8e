#include "firmware/boards/linux/can/trouble_report.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace earshot::board {
namespace {

using enum BusTrouble;
using Told = std::vector<std::pair<BusTrouble, bool>>;

class TakenTroubles final : public InputSink {
 public:
  void take(std::uint8_t /*port*/, const Value& /*value*/) override {}
  void report_trouble(std::uint8_t port, BusTrouble trouble, bool is_there) override {
    EXPECT_EQ(port, 2);
    told.emplace_back(trouble, is_there);
  }
  Told told;
};

/// Of a port without roles, so that nothing is missing on its bus.
class TroubleReportTest : public testing::Test {
 protected:
  TroubleReportTest() { signs_.has_address = true; }

  /// What is told once a second has passed.
  Told check(bool is_up = true) {
    now_.host = now_.host + Duration::seconds(1);
    now_.mission = now_.mission + Duration::seconds(1);
    report_.check(is_up, signs_, now_, sink_);
    return std::exchange(sink_.told, {});
  }

  TroubleReport report_{2, {}, Duration::seconds(3)};
  BusSigns signs_;
  TroubleWatch::Now now_{.host = Time{7'000'000}, .mission = Time{1'795'000'000'000'000}};
  TakenTroubles sink_;
};

TEST_F(TroubleReportTest, TellsOfATroubleWhenItBeginsAndWhenItIsOverAndKeepsItInMind) {
  EXPECT_EQ(check(), Told{});
  signs_.controller = n2k::ControllerState::kErrorPassive;
  EXPECT_EQ(check(), (Told{{kErrorPassive, true}}));
  EXPECT_EQ(check(), Told{}) << "it was told";
  signs_.controller = n2k::ControllerState::kErrorActive;
  EXPECT_EQ(check(), (Told{{kErrorPassive, false}}));
  EXPECT_TRUE(report_.met()[static_cast<std::size_t>(kErrorPassive)]);
  EXPECT_EQ(report_.met().count(), 1U);
}

TEST_F(TroubleReportTest, SaysNothingOfAMissingInterfaceButThatTheControllerHasLeftTheBus) {
  EXPECT_EQ(check(), Told{});
  signs_.own_name_claims = 1;
  EXPECT_EQ(check(false), Told{});
  signs_.own_name_claims = 0;
  signs_.controller = n2k::ControllerState::kBusOff;
  EXPECT_EQ(check(false), (Told{{kBusOff, true}}));
}

TEST_F(TroubleReportTest, CountsNoFramesThatWereLostWhileTheLinkWasDown) {
  EXPECT_EQ(check(), Told{});
  EXPECT_EQ(check(false), Told{});
  signs_.frames_lost = 100;
  EXPECT_EQ(check(), Told{}) << "that was the link's trouble";
  signs_.frames_lost = 101;
  EXPECT_EQ(check(), (Told{{kFramesLost, true}}));
}

}  // namespace
}  // namespace earshot::board
