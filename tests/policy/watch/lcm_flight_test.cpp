// GIVEN a vehicle on LCM, WHEN it is watched, THEN its flight is what it says there, and the next flight is another.

#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "policy/watch/lcm_flight.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/private_network.hpp"

namespace earshot::watch {
namespace {

using namespace std::chrono_literals;
constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

class VehicleOnLcm {
 public:
  void send(std::string_view channel, const auto& message) {
    ASSERT_EQ(endpoint_.publish(channel, wire::Encoded(message, Time{}).bytes()), Status::kOk);
  }
  void send_health(messages::MissionState state, messages::EndReason reason) {
    messages::Health health;
    health.state = state;
    health.end_reason = reason;
    send(wire::kHealthChannel, health);
  }

 private:
  host::LcmEndpoint endpoint_{host::parse_lcm_url(kUrl), {}};
};

Change next_change(LcmFlight& flight) {
  Change change = flight.take();
  for (int i = 0; i < 500 && change == Change::kNone; ++i, change = flight.take()) flight.wait(20ms);
  return change;
}

TEST(LcmFlight, IsWhatTheVehiclePublishes) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  LcmFlight flight(kUrl);
  VehicleOnLcm vehicle;
  EXPECT_EQ(flight.take(), Change::kNone);
  const auto now = std::chrono::system_clock::now().time_since_epoch();  // an older fix counts as none
  vehicle.send(wire::kNavStateChannel, journal::known_fix({std::chrono::duration_cast<std::chrono::microseconds>(now).count()}));
  vehicle.send_health(messages::MissionState::kSearch, messages::EndReason::kNone);
  while (flight.flight().whole()["strips"]["time_s"].empty()) ASSERT_EQ(next_change(flight), Change::kMore);
  const auto whole = flight.flight().whole();
  EXPECT_EQ(whole["name"], kUrl);
  EXPECT_EQ(whole["strips"]["north_m"], nlohmann::ordered_json::array({1000}));
  EXPECT_EQ(whole["strips"]["depth_m"], nlohmann::ordered_json::array({299.5}));
  EXPECT_EQ(whole["is_over"], false);
  vehicle.send_health(messages::MissionState::kDone, messages::EndReason::kCompleted);
  EXPECT_EQ(next_change(flight), Change::kMore);
  EXPECT_EQ(flight.flight().whole()["is_over"], true);
  vehicle.send_health(messages::MissionState::kStandby, messages::EndReason::kNone);
  EXPECT_EQ(next_change(flight), Change::kOther);
  EXPECT_EQ(flight.flight().whole()["strips"]["time_s"].size(), 1U);
}

TEST(LcmFlight, HasAnAddressOfLcm) {
  EXPECT_THROW(LcmFlight("tcp://here"), host::BadInput);
}

}  // namespace
}  // namespace earshot::watch
