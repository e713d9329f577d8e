#include "firmware/boards/linux/port/port_set.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/firmware/boards/linux/scripted_sea.hpp"

namespace earshot::board {
namespace {

/// A port that the test sets, and that tells a log what is done with it.
class SetPort final : public Port, public BusMember, public SoundListener, public DetectionSender {
 public:
  SetPort(std::uint8_t index, host::Roles roles, std::vector<std::string>& log) : Port(index, roles), log_(log) {}

  void collect(Clock& /*clock*/, InputSink& /*sink*/) override { note("collect"); }
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& /*outputs*/) override {
    note("publish");
    return sends;
  }
  void publish_detection(const messages::SoundDetection& /*detection*/) override { note("detection"); }
  void note_speed(MetersPerSecond speed) override { note("speed " + std::to_string(static_cast<int>(speed.value))); }
  void serve() override { note("serve"); }
  void tend() override { note("tend"); }
  [[nodiscard]] bool settle() override {
    note("settle");
    return --settles_after < 0;
  }
  [[nodiscard]] int file_descriptor() const override { return descriptor; }
  [[nodiscard]] std::uint64_t blocks_heard() const override { return blocks; }
  [[nodiscard]] std::size_t memory() const override { return 100U * index(); }
  [[nodiscard]] PortWords words() const override { return says; }
  [[nodiscard]] FurtherDuties further_duties() override { return {.bus_member = this, .sound_listener = this, .detection_sender = this}; }

  [[nodiscard]] messages::PortReport& set_report() { return report_; }

  std::uint64_t sends = 0;
  std::uint64_t blocks = 0;
  int settles_after = 0;
  int descriptor = -1;
  PortWords says;

 private:
  void note(const std::string& what) { log_.push_back(std::to_string(index()) + " " + what); }
  std::vector<std::string>& log_;
};

/// One that has no further duties.
class PlainPort final : public Port {
 public:
  explicit PlainPort(std::uint8_t index) : Port(index, {}) {}
  void collect(Clock& /*clock*/, InputSink& /*sink*/) override {}
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& /*outputs*/) override { return 0; }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] PortWords words() const override { return {.label = "plain"}; }
};

class TakenReports final : public InputSink {
 public:
  void take(std::uint8_t port, const Value& /*value*/) override { ports.push_back(port); }
  std::vector<std::uint8_t> ports;
};

class PortSetTest : public testing::Test {
 protected:
  SetPort& add(host::Roles roles = {}) {
    auto port = std::make_unique<SetPort>(ports_.next_index(), roles, log_);
    SetPort& added = *port;
    ports_.add(std::move(port));
    return added;
  }
  [[nodiscard]] std::vector<std::string> done() { return std::exchange(log_, {}); }

  std::vector<std::string> log_;
  PortSet ports_;
};

using Log = std::vector<std::string>;

TEST_F(PortSetTest, CountsItsPortsFromOneAndTakesNoMoreThanTheReportsHoldRoomFor) {
  EXPECT_EQ(ports_.next_index(), 1);
  for (std::size_t i = 1; i < config::kMaxPorts; ++i) EXPECT_EQ(add().index(), i);
  EXPECT_THROW(add(), std::invalid_argument);
}

TEST_F(PortSetTest, AsksEveryPortInTurn) {
  add().sends = 2;
  add().sends = 1;
  FakeHost host;
  const Script script;
  FakeClock clock(host, script);
  TakenReports sink;
  ports_.collect(clock, sink);
  EXPECT_EQ(done(), (Log{"1 collect", "2 collect"}));
  ports_.publish(Time{}, {});
  ports_.publish(Time{}, {});
  EXPECT_EQ(done(), (Log{"1 publish", "2 publish", "1 publish", "2 publish"}));
  EXPECT_EQ(ports_.setpoints_sent(), 6U);
  ports_.publish_detection({});
  ports_.note_speed(MetersPerSecond{3.0F});
  ports_.serve();
  EXPECT_EQ(done(), (Log{"1 detection", "2 detection", "1 speed 3", "2 speed 3", "1 serve", "2 serve"}));
}

TEST_F(PortSetTest, AsksForFurtherDutiesOnlyOfPortsThatHaveThem) {
  ports_.add(std::make_unique<PlainPort>(ports_.next_index()));
  add().blocks = 4;
  ports_.publish_detection({});
  ports_.note_speed(MetersPerSecond{3.0F});
  ports_.serve();
  EXPECT_EQ(done(), (Log{"2 detection", "2 speed 3", "2 serve"}));
  EXPECT_EQ(ports_.blocks_heard(), 4U);
}

TEST_F(PortSetTest, FindsPortsWithoutABusSettledAtOnce) {
  ports_.add(std::make_unique<PlainPort>(ports_.next_index()));
  const auto begin = std::chrono::steady_clock::now();
  ports_.settle(std::chrono::hours(1));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(1));
}

TEST_F(PortSetTest, TendsItsLinksOnceASecondAndNotAtTheFirstCall) {
  add();
  ports_.tend();
  ports_.tend();
  EXPECT_EQ(done(), Log{});
}

TEST_F(PortSetTest, AsksEveryPortToSettleAlsoThoseThatHave) {
  add().settles_after = 1;
  add();
  ports_.settle(std::chrono::seconds(60));
  EXPECT_EQ(done(), (Log{"1 settle", "2 settle", "1 settle", "2 settle"}));
  add().settles_after = 1'000'000;
  ports_.settle(std::chrono::milliseconds(0));
  EXPECT_EQ(done(), Log{}) << "no time, no question";
}

TEST_F(PortSetTest, GivesAReportWhenItHasChangedAndOnce) {
  add();
  SetPort& second = add();
  TakenReports sink;
  second.set_report().received = 5;
  ports_.report_changes(sink);
  ports_.report_changes(sink);
  EXPECT_EQ(std::ranges::count(sink.ports, 2), 1);
  second.set_report().lost = 1;
  sink.ports.clear();
  ports_.report_changes(sink);
  EXPECT_EQ(sink.ports, (std::vector<std::uint8_t>{2}));
}

TEST_F(PortSetTest, WaitsForThePortsWhoseLinksAreUp) {
  add().descriptor = 7;
  add();
  add().descriptor = 0;
  const auto readable = ports_.readable();
  ASSERT_EQ(readable.size(), 2U);
  EXPECT_EQ(readable[0].fd, 7);
  EXPECT_EQ(readable[1].fd, 0);
  EXPECT_EQ(readable[1].events, POLLIN);
}

TEST_F(PortSetTest, NamesWhatIsThereAndWhatIsDown) {
  add().says = {.label = "vehicle, CAN can0"};
  SetPort& second = add();
  second.says = {.label = "SNR, LCM", .details = "on lo"};
  EXPECT_EQ(ports_.description(), "  port 1: vehicle, CAN can0\n  port 2: SNR, LCM on lo\n");
  EXPECT_EQ(ports_.down(), "");
  second.set_report().link_up = false;
  EXPECT_EQ(ports_.down(), "  port 2: SNR, LCM on lo\n");
  const auto links = ports_.links();
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links[0].label, "port 1, vehicle, CAN can0");
  EXPECT_TRUE(links[0].is_up);
  EXPECT_EQ(links[1].port, 2);
  EXPECT_EQ(links[1].label, "port 2, SNR, LCM");
  EXPECT_FALSE(links[1].is_up);
  const auto held = ports_.memory();
  ASSERT_EQ(held.size(), 2U);
  EXPECT_EQ(held[1].port, "2, SNR, LCM on lo");
  EXPECT_EQ(held[1].bytes, 200U);
}

TEST_F(PortSetTest, LeavesOutPortsThatSayNothing) {
  add();
  add().says = {.remark = "3 messages were lost", .strangers = "2 SNRs were ignored"};
  EXPECT_EQ(ports_.remarks(), Log{"3 messages were lost"});
  EXPECT_EQ(ports_.strangers(), Log{"2 SNRs were ignored"});
}

TEST_F(PortSetTest, SumsReportsOfMessagesAndBlocksOfSoundApart) {
  SetPort& vehicle = add();
  vehicle.set_report() = {.port = 1, .link_up = true, .received = 10, .lost = 2, .malformed = 3, .unsent = 4};
  SetPort& operators = add();
  operators.set_report() = {.port = 2, .link_up = false, .received = 100, .lost = 20, .malformed = 30, .unsent = 40};
  SetPort& hydrophone = add({host::Role::kHydrophone});
  hydrophone.set_report() = {.port = 3, .link_up = false, .received = 48'000, .lost = 1, .malformed = 1, .unsent = 1};
  hydrophone.blocks = 48;
  const messages::PortReport sum = ports_.sum();
  EXPECT_EQ(sum.received, 110U);
  EXPECT_EQ(sum.lost, 22U);
  EXPECT_EQ(sum.malformed, 33U);
  EXPECT_EQ(sum.unsent, 44U);
  EXPECT_FALSE(sum.link_up);
  EXPECT_EQ(ports_.blocks_heard(), 48U);
}

}  // namespace
}  // namespace earshot::board
