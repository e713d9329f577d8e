#include "firmware/boards/linux/can/can_port.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "tests/firmware/boards/linux/can/bus_rig.hpp"

namespace earshot::board {
namespace {

using host::Role;
using messages::Order;

// Unique number 1, maker 2044, instance 0, function 150 of class 40, marine industry, can claim any address; by hand.
constexpr n2k::Name kOwnName = 0xC050'9600'FF80'0001;
constexpr n2k::Name kStronger = 0x0000'0000'0000'0001;
constexpr n2k::Name kWeaker = 0xFFFF'FFFF'FFFF'FFFF;

runtime::Outputs searching() {
  runtime::Outputs outputs;
  outputs.setpoint = messages::Setpoint{.heading = Radians{0.5}, .speed = MetersPerSecond{2.0}, .depth = Meters{300.0}, .waypoint = {}};
  outputs.health.state = messages::MissionState::kSearch;
  outputs.health.steps_taken = 7;
  return outputs;
}

messages::CommandAcknowledgement acknowledgement(std::uint8_t port, std::uint32_t number, Order order,
                                                 messages::CommandOutcome outcome = messages::CommandOutcome::kObeyed) {
  return {.time = {}, .port = port, .issuer = 4711, .number = number, .order = order, .outcome = outcome};
}

/// Of a START that is obeyed, in STANDBY.
runtime::Outputs started(std::uint32_t number) {
  runtime::Outputs outputs;
  EXPECT_EQ(outputs.acknowledgements.push_back(acknowledgement(1, number, Order::kStart)), Status::kOk);
  return outputs;
}

class CanPortTest : public BusRig {
 protected:
  std::uint64_t publish(const runtime::Outputs& outputs) { return port_->publish(clock_.time, outputs); }
  /// The frames of a vehicle in the middle of its area; the pressure is left out without a depth.
  void send_fix(std::optional<double> depth_m = 0.0) {
    n2k::NavigationFrames frames;
    const messages::Navigation fix{.time = {},
                                   .position = {.north = Meters{12'000}, .east = Meters{13'000}},
                                   .depth = Meters{depth_m.value_or(0.0)},
                                   .heading = Radians{1.0},
                                   .speed = MetersPerSecond{1.5}};
    ASSERT_EQ(n2k::compose_navigation(fix, plane(), kCommander, frames), Status::kOk);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (i != 2 || depth_m) send(frames[i]);  // the pressure is the third
    }
  }
  void send_pressure(double pascal) {
    n2k::Frame frame;
    ASSERT_EQ(n2k::MessageWriter(n2k::kPressurePgn).set("Instance", 0).set("Source", 1).set("Pressure", pascal).frame(kCommander, frame),
              Status::kOk);
    send(frame);
  }
  void send_snr(double snr_db, std::uint8_t address = kCommander) {
    n2k::Frame frame;
    ASSERT_EQ(n2k::compose_snr({.snr = Decibels{snr_db}, .too_faint = false, .band_level = {}}, address, frame), Status::kOk);
    send(frame);
  }
  std::vector<double> depths() const {
    std::vector<double> all;
    for (const messages::Navigation& fix : taken_.all<messages::Navigation>()) all.push_back(fix.depth.value);
    return all;
  }
};

TEST_F(CanPortTest, SendsNothingButItsClaimUntilAQuarterOfASecondHasPassedWithoutObjection) {
  open();
  port_->serve();
  const std::vector<Heard> claim = heard();
  ASSERT_EQ(claim.size(), 1U);
  EXPECT_EQ(claim[0].identifier, (n2k::Identifier{.pgn = 60928, .priority = 6, .source = kOwn, .destination = n2k::kBroadcast}));
  EXPECT_EQ(claim[0].bytes, (std::vector<std::uint8_t>{0x01, 0x00, 0x80, 0xFF, 0x00, 0x96, 0x50, 0xC0})) << std::hex << kOwnName;
  host_.passed = Duration::milliseconds(249);
  EXPECT_FALSE(port_->settle());
  EXPECT_EQ(publish(searching()), 0U);
  EXPECT_TRUE(heard().empty());
  EXPECT_EQ(port_->report().unsent, 2U) << "a set-point and the health";
  host_.passed = Duration::milliseconds(250);
  EXPECT_TRUE(port_->settle());
  EXPECT_EQ(publish(searching()), 1U);
  const std::vector<Heard> setpoint = heard(n2k::kHeadingControlPgn);
  ASSERT_EQ(setpoint.size(), 1U);
  EXPECT_EQ(setpoint[0].identifier.source, kOwn);
}

TEST_F(CanPortTest, GivesItsAddressToADeviceWithMoreRightsAndSendsFromTheNextOnceThatIsItsOwn) {
  open_settled();
  claim(kStronger, kOwn);
  collect();
  port_->serve();
  EXPECT_EQ(heard(n2k::kAddressClaimPgn).at(0).identifier.source, kOwn + 1);
  EXPECT_EQ(publish(searching()), 0U);
  EXPECT_TRUE(heard(n2k::kHeadingControlPgn).empty());
  serve_for(Duration::milliseconds(300));
  EXPECT_EQ(publish(searching()), 1U);
  EXPECT_EQ(heard(n2k::kHeadingControlPgn).at(0).identifier.source, kOwn + 1);
}

TEST_F(CanPortTest, KeepsItsAddressAgainstADeviceWithFewerRights) {
  open_settled();
  claim(kWeaker, kOwn);
  serve_for(Duration::milliseconds(100));
  const std::vector<Heard> defence = heard(n2k::kAddressClaimPgn);
  ASSERT_EQ(defence.size(), 1U);
  EXPECT_EQ(defence[0].identifier.source, kOwn);
  EXPECT_EQ(publish(searching()), 1U);
}

TEST_F(CanPortTest, BeatsOnceAMinuteOfTheHostHoweverFarTheMissionClockHasGone) {
  open_settled();
  for (int second = 0; second < 120; ++second) {
    clock_.time = clock_.time + Duration::seconds(20);
    serve_for(Duration::seconds(1));
  }
  EXPECT_EQ(heard(n2k::kHeartbeatPgn).size(), 2U);
}

TEST_F(CanPortTest, SaysWhatItSendsAndReadsAsItsRolesHaveIt) {
  settings_.roles = {Role::kSnr, Role::kAutopilot};
  open_settled();
  request(n2k::kPgnListPgn);
  serve_for(Duration::milliseconds(200));
  const std::vector<Heard> lists = heard(n2k::kPgnListPgn);
  ASSERT_EQ(lists.size(), 2U);
  const auto pgns_of = [](const Heard& list) {
    std::vector<unsigned> pgns;
    for (std::size_t i = 1; i + 2 < list.bytes.size(); i += 3)
      pgns.push_back(list.bytes[i] | static_cast<unsigned>(list.bytes[i + 1]) << 8U | static_cast<unsigned>(list.bytes[i + 2]) << 16U);
    return pgns;
  };
  EXPECT_EQ(pgns_of(lists[0]), (std::vector{59392U, 59904U, 60928U, 126464U, 126208U, 126993U, 126996U, 126998U, 65290U, 127237U}));
  EXPECT_EQ(pgns_of(lists[1]), (std::vector{59904U, 60928U, 65240U, 60416U, 60160U, 126208U, 65291U, 65294U}));
}

TEST_F(CanPortTest, RefusesToItsAskerWhatItDoesNotSend) {
  open_settled();
  request(n2k::kWindPgn, kOwn);
  serve_for(Duration::milliseconds(100));
  const std::vector<Heard> refusal = heard(n2k::kAcknowledgementPgn);
  ASSERT_EQ(refusal.size(), 1U);
  EXPECT_EQ(refusal[0].identifier.destination, kCommander);
  EXPECT_EQ(refusal[0].bytes, (std::vector<std::uint8_t>{1, 0xFF, 0xFF, 0xFF, 0xFF, 0x02, 0xFD, 0x01})) << "NAK of 130306";
}

TEST_F(CanPortTest, BringsFixesSnrAndOrdersWithTheirDates) {
  open_settled();
  send_fix(100.0);
  send_snr(12.5);
  order(Order::kStart, 3);
  collect();
  const std::vector<messages::Navigation> fixes = taken_.all<messages::Navigation>();
  ASSERT_EQ(fixes.size(), 1U);
  EXPECT_NEAR(fixes[0].position.north.value, 12'000, 0.02) << "1e-7 degree is 11 mm";
  EXPECT_NEAR(fixes[0].depth.value, 100.0, 1e-4) << "0.1 Pa";
  EXPECT_NEAR(fixes[0].speed.value, 1.5, 1e-9);
  const std::vector<messages::SnrMeasurement> measurements = taken_.all<messages::SnrMeasurement>();
  ASSERT_EQ(measurements.size(), 1U);
  EXPECT_EQ(measurements[0].snr, Decibels{12.5});
  EXPECT_GE(measurements[0].time, fixes[0].time) << "both arrived by the kernel's clock, which SetClock takes as it is";
  const std::vector<messages::OperatorCommand> orders = taken_.all<messages::OperatorCommand>();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0],
            (messages::OperatorCommand{
                .time = clock_.time, .expiry = clock_.time + Duration::seconds(10), .issuer = 4711, .number = 3, .order = Order::kStart}));
  EXPECT_EQ(port_->report().received, 3U);
  EXPECT_EQ(port_->report().malformed, 0U);
}

TEST_F(CanPortTest, LeavesUnreadWhatItHasNoRoleFor) {
  settings_.roles = {Role::kAutopilot};
  open_settled();
  send_fix();
  send_snr(12.5);
  order(Order::kAbort, 3);
  collect();
  EXPECT_TRUE(taken_.values.empty());
}

TEST_F(CanPortTest, AnswersEachAskerAndNobodyElse) {
  open_settled();
  order(Order::kStart, 3);
  collect();
  runtime::Outputs outputs;
  // Another port's, of an operator who counts alike, comes first.
  ASSERT_EQ(outputs.acknowledgements.push_back(acknowledgement(2, 3, Order::kStart, messages::CommandOutcome::kTooOld)), Status::kOk);
  ASSERT_EQ(outputs.acknowledgements.push_back(acknowledgement(1, 3, Order::kStart)), Status::kOk);
  publish(outputs);
  const std::vector<Heard> answers = heard(n2k::kPeerPgn);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].identifier.destination, kCommander);
  const Result<messages::CommandAcknowledgement> read = n2k::read_acknowledgement(answers[0].bytes);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().number, 3U);
  EXPECT_EQ(read.value().outcome, messages::CommandOutcome::kObeyed);
  publish(outputs);
  EXPECT_TRUE(heard(n2k::kPeerPgn).empty()) << "nobody has asked again";
}

TEST_F(CanPortTest, AnswersTwoDevicesThatGiveOneOrderEachAtItsOwnAddress) {
  open_settled();
  order(Order::kAbort, 3);
  n2k::Frame abort;
  ASSERT_EQ(n2k::compose_abort(4711, 3, {.source = 0x66, .destination = kOwn}, abort), Status::kOk);
  send(abort);
  collect();
  runtime::Outputs outputs;
  for (const auto outcome : {messages::CommandOutcome::kObeyed, messages::CommandOutcome::kRepeated})
    ASSERT_EQ(outputs.acknowledgements.push_back(acknowledgement(1, 3, Order::kAbort, outcome)), Status::kOk);
  publish(outputs);
  const std::vector<Heard> answers = heard(n2k::kPeerPgn);
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].identifier.destination, kCommander);
  EXPECT_EQ(answers[1].identifier.destination, 0x66);
  EXPECT_EQ(n2k::read_acknowledgement(answers[1].bytes).value().outcome, messages::CommandOutcome::kRepeated);
}

TEST_F(CanPortTest, TakesAnAbortToAllThoughItHasNoAddressYet) {
  open();
  n2k::Frame abort;
  ASSERT_EQ(n2k::compose_abort(1, 2, {.source = kCommander, .destination = n2k::kBroadcast}, abort), Status::kOk);
  send(abort);
  order(Order::kStart, 5);  // to an address that is not ours yet
  collect();
  const std::vector<messages::OperatorCommand> orders = taken_.all<messages::OperatorCommand>();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].order, Order::kAbort);
}

TEST_F(CanPortTest, TakesTheSnrOfOneHydrophoneAtATimeAndOfTheOneWhoseNameIsGivenAlone) {
  open_settled();
  send_snr(1.0, 0x10);
  send_snr(2.0, 0x11);
  collect();
  ASSERT_EQ(taken_.all<messages::SnrMeasurement>().size(), 1U);
  EXPECT_EQ(taken_.all<messages::SnrMeasurement>()[0].snr, Decibels{1.0});
  taken_.values.clear();
  settings_.n2k.snr_source.name = kWeaker;
  open_settled();
  claim(kWeaker, 0x11);
  send_snr(1.0, 0x10);
  send_snr(2.0, 0x11);
  collect();
  ASSERT_EQ(taken_.all<messages::SnrMeasurement>().size(), 1U);
  EXPECT_EQ(taken_.all<messages::SnrMeasurement>()[0].snr, Decibels{2.0});
}

TEST_F(CanPortTest, CountsNothingAsMalformedThatMissesOnlyItsComplement) {
  open_settled();
  n2k::Frame magnetic;
  ASSERT_EQ(n2k::MessageWriter(n2k::kHeadingPgn).set("Heading", 1.0).set("Reference", 1).frame(kCommander, magnetic), Status::kOk);
  send(magnetic);
  collect();
  EXPECT_EQ(port_->report().malformed, 0U) << "magnetic, before anybody has said the variation";
  n2k::Frame reserved = magnetic;
  reserved.data[1] = 0xFE;
  reserved.data[2] = 0xFF;
  send(reserved);
  collect();
  EXPECT_EQ(port_->report().malformed, 1U);
}

TEST_F(CanPortTest, KnowsTheNamesThatItHeardWhileItWaitedForItsOwnAddress) {
  settings_.n2k.snr_source.name = kWeaker;
  open();
  claim(kWeaker, 0x11);
  for (int i = 0; i < 5 && !port_->settle(); ++i) host_.passed = host_.passed + Duration::milliseconds(100);
  ASSERT_TRUE(port_->settle());
  send_snr(2.0, 0x11);
  collect();
  EXPECT_EQ(taken_.all<messages::SnrMeasurement>().size(), 1U);
}

TEST_F(CanPortTest, TellsItsStateOnceASecondAndAtOnceWhenItIsNewsAndEveryDecision) {
  open_settled();
  runtime::Outputs outputs = searching();
  ASSERT_EQ(outputs.health.ports.push_back({.port = 1, .received = 5}), Status::kOk);
  ASSERT_EQ(outputs.health.ports.push_back({.port = 2, .received = 6}), Status::kOk);
  publish(outputs);
  EXPECT_EQ(n2k::read_health(heard(n2k::kHealthPgn).at(0).bytes).value().health.steps_taken, 7U);
  for (int i = 0; i < 8; ++i) {
    clock_.time = clock_.time + Duration::milliseconds(100);
    publish(outputs);
  }
  EXPECT_TRUE(heard(n2k::kHealthPgn).empty());
  ++outputs.health.steps_taken;
  outputs.decision.emplace();
  publish(outputs);
  const std::vector<Heard> published = heard();
  const auto count = [&](std::uint32_t pgn) {
    return std::ranges::count_if(published, [pgn](const Heard& message) { return message.identifier.pgn == pgn; });
  };
  EXPECT_EQ(count(n2k::kHealthPgn), 1);
  EXPECT_EQ(count(n2k::kPortHealthPgn), 2);
  EXPECT_EQ(count(n2k::kDecisionPgn), 1);
  outputs.decision.reset();
  clock_.time = clock_.time + Duration::seconds(1);
  publish(outputs);
  EXPECT_EQ(heard(n2k::kHealthPgn).size(), 1U);
}

TEST_F(CanPortTest, SaysNothingOfItsStateWithoutThatRole) {
  settings_.roles = {Role::kNavigation, Role::kAutopilot};
  open_settled();
  EXPECT_EQ(publish(searching()), 1U);
  EXPECT_TRUE(heard(n2k::kHealthPgn).empty());
  EXPECT_EQ(port_->report().unsent, 0U);
}

TEST_F(CanPortTest, TakesThePressureAtItsStartForThatAtTheSurfaceOnce) {
  settings_.n2k.zero_pressure_at_surface = true;
  open_settled();
  send_pressure(5000.0);
  send_fix({});
  collect();
  ASSERT_EQ(depths().size(), 1U);
  EXPECT_NEAR(depths()[0], 0.4974, 1e-3) << "5000 Pa / (1025 kg/m3 x 9.80665 m/s2)";
  port_->publish(taken_.all<messages::Navigation>().back().time, {});
  send_fix({});
  collect();
  EXPECT_NEAR(depths().at(1), 0.4974, 1e-3) << "before the START";
  // Dated by the kernel's clock, which is not the one that this test sets.
  port_->publish(taken_.all<messages::Navigation>().back().time, started(3));
  taken_.values.clear();
  send_fix(10.0);
  collect();
  ASSERT_EQ(depths().size(), 1U);
  EXPECT_NEAR(depths()[0], 9.5026, 1e-3);
  send_pressure(3000.0);
  collect();
  port_->publish(taken_.all<messages::Navigation>().back().time, started(4));
  send_fix(10.0);
  collect();
  EXPECT_NEAR(depths()[1], 9.5026, 1e-3) << "once";
}

TEST_F(CanPortTest, ZeroesNoPressureThatIsNotTheSurfaces) {
  settings_.n2k.zero_pressure_at_surface = true;
  open_settled();
  send_fix(100.0);
  collect();
  port_->publish(taken_.all<messages::Navigation>().back().time, started(3));
  send_fix(100.0);
  collect();
  EXPECT_NEAR(depths().at(1), 100.0, 1e-4);
}

TEST_F(CanPortTest, HasNoFixByAnAbsolutePressureBeforeItsStart) {
  settings_.n2k.zero_pressure_at_surface = true;
  settings_.n2k.navigation.sensors.pressure_kind = n2k::PressureKind::kAbsolute;
  open_settled();
  send_pressure(101'325.0);
  send_fix({});
  send_snr(1.0);  // its date says what time it is on the bus
  collect();
  EXPECT_TRUE(depths().empty());
  port_->publish(taken_.all<messages::SnrMeasurement>().back().time, started(3));
  send_pressure(201'845.2);
  send_fix({});
  collect();
  // 100 520.2 Pa / (1025 kg/m3 x 9.80665 m/s2) = 10.0003 m
  ASSERT_EQ(depths().size(), 1U);
  EXPECT_NEAR(depths()[0], 10.0003, 1e-3);
}

TEST_F(CanPortTest, CountsItsOwnMemory) {
  open();
  EXPECT_EQ(port_->memory(), sizeof(CanPort));
  EXPECT_GT(port_->memory(), 10'000U) << "fast packets in the making alone: 8 of 223 bytes for sensors and orders each, 256 NAMEs";
}

}  // namespace
}  // namespace earshot::board
