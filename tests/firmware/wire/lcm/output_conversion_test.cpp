#include "firmware/wire/lcm/output_conversion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::wire {
namespace {

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  const Encoded encoded(message);
  return {encoded.bytes().begin(), encoded.bytes().end()};
}

messages::Decision decision() {
  messages::Decision d{.step = 12,
                       .time = {34},
                       .position = {Meters{1.5}, Meters{-2.5}},
                       .snr = Decibels{11.25},
                       .too_faint = true,
                       .detected = true,
                       .action = 7,
                       .sweeping = true,
                       .overridden = true,
                       .waypoint = {Meters{3.5}, Meters{4.5}},
                       .observation_size = 62,
                       .action_count = 8,
                       .belief = std::nullopt};
  for (std::size_t i = 0; i < d.observation.size(); ++i) d.observation[i] = 0.25F * static_cast<float>(i);
  for (std::size_t i = 0; i < d.logits.size(); ++i) d.logits[i] = -0.5F * static_cast<float>(i);
  return d;
}

TEST(OutputConversion, GivesADecisionsMessageAgainByteForByte) {
  messages::Decision d = decision();
  const auto again = [](const messages::Decision& said) { return bytes_of(to_message(from_message(to_message(said)))); };
  EXPECT_EQ(again(d), bytes_of(to_message(d)));
  d.bearing = messages::Bearing{.direction = Radians{1.0}, .deviation = Radians{0.2}, .mirror_axis = Radians{2.0}};
  d.belief = messages::BeliefSummary{.likeliest = {Meters{1}, Meters{2}},
                                     .mean = {Meters{3}, Meters{4}},
                                     .spread = Meters{5},
                                     .likeliest_share = 0.5F,
                                     .effective_cells = 6.0F,
                                     .surprise_bits = 7.0F};
  d.found = messages::FoundDeclaration{
      .probability = 0.75F, .snr = d.snr, .least_snr = Decibels{9}, .likeliest = {Meters{10}, Meters{11}}, .closest_approach = Meters{8}};
  EXPECT_EQ(again(d), bytes_of(to_message(d)));
}

messages::Health health() {
  messages::Health h{.turn = 1,
                     .decisions = 2,
                     .authority = messages::Authority::kCommand,
                     .is_paused = true,
                     .state = messages::MissionState::kSearch,
                     .end_reason = messages::EndReason::kFound,
                     .steps_taken = 3,
                     .surprise_bits = 4.5F,
                     .is_sweeping = true,
                     .is_found = true,
                     .response = config::Response::kHold,
                     .counters = {.navigation_refused = 5,
                                  .snr_refused = 6,
                                  .status_refused = 7,
                                  .commands_refused = 8,
                                  .setpoints_limited = 9,
                                  .bearings_refused = 10,
                                  .bearings_of_others = 11},
                     .ports = {}};
  for (std::uint8_t port = 0; port < config::kMaxPorts; ++port)
    static_cast<void>(
        h.ports.push_back({.port = port, .link_up = port % 2 == 0, .received = 12, .lost = 13, .malformed = 14, .unsent = 15}));
  return h;
}

TEST(OutputConversion, GivesAHealthsMessageAgainByteForByte) {
  const health_t message = to_message(health(), Time{99});
  EXPECT_EQ(bytes_of(to_message(from_message(message), Time{99})), bytes_of(message));
}

TEST(OutputConversion, CutsACountOfPortsThatNoHealthCanHave) {
  health_t message = to_message(health(), Time{99});
  message.port_count = 100;
  EXPECT_EQ(from_message(message).ports.size(), config::kMaxPorts);
  message.port_count = -1;
  EXPECT_TRUE(from_message(message).ports.empty());
}

TEST(OutputConversion, GivesAnAcknowledgementAgainWithItsPort) {
  const messages::CommandAcknowledgement said{.time = {1},
                                              .port = 3,
                                              .issuer = 4,
                                              .number = 5,
                                              .order = messages::Order::kPause,
                                              .outcome = messages::CommandOutcome::kNotVerified};
  EXPECT_EQ(from_message(to_message(said), 3), said);
}

}  // namespace
}  // namespace earshot::wire
