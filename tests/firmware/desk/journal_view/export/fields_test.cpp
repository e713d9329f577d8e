#include "firmware/desk/journal_view/export/fields.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "firmware/host/journal/reading/decode_record.hpp"
#include "tests/firmware/desk/journal_view/export/export_rig.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"

namespace earshot::journal {
namespace {

Content input(const auto& value) {
  return messages::Input{.arrival = kBegan, .port = 2, .sequence = 0, .value = value};
}

TEST(JournalFields, HaveUnitsInTheirNamesAndSecondsForTimes) {
  EXPECT_EQ(to_line(fields_of(input(messages::SnrMeasurement{.time = Time{1'500'000}, .snr = Decibels{-3.5}, .too_faint = true}))),
            R"({"port":2,"valid_time_s":1.5,"snr_db":-3.5,"too_faint":true})");
  EXPECT_EQ(to_line(fields_of(some_setpoint())),
            R"({"heading_rad":0.5,"speed_mps":2.0,"depth_m":300.0,"waypoint_north_m":0.0,"waypoint_east_m":0.0,"release_weight":false})");
}

TEST(JournalFields, HoldABearingAndTheAxisOfItsMirrorImageIfItHasOne) {
  messages::BearingMeasurement bearing{
      .time = Time{1'500'000}, .bearing = {.direction = Radians{1.5}, .deviation = Radians{0.25}}, .sender = 7};
  EXPECT_EQ(to_line(fields_of(input(bearing))),
            R"({"port":2,"valid_time_s":1.5,"bearing_rad":1.5,"bearing_deviation_rad":0.25,"bearing_ambiguous":false,)"
            R"("bearing_axis_rad":null,"sender":7})");
  bearing.bearing.mirror_axis = Radians{0.5};
  const nlohmann::ordered_json fields = fields_of(input(bearing));
  EXPECT_EQ(fields.at("bearing_ambiguous"), true);
  EXPECT_EQ(fields.at("bearing_axis_rad"), 0.5);
}

TEST(JournalFields, SayOfADecisionWhetherItHeardABearing) {
  messages::Decision m;
  EXPECT_TRUE(fields_of(m).at("bearing_rad").is_number());
  EXPECT_EQ(to_line(fields_of(m).at("bearing_rad")), "null");
  m.bearing = messages::Bearing{.direction = Radians{1.5}, .deviation = Radians{0.1}};
  EXPECT_EQ(fields_of(m).at("bearing_rad"), 1.5);
}

TEST(JournalFields, SayNullForWhatIsNotKnown) {
  EXPECT_EQ(to_line(fields_of(input(messages::VehicleStatus{.time = Time{}, .battery_percent = 80.5}))),
            R"({"port":2,"valid_time_s":0.0,"altitude_m":null,"battery_percent":80.5,"leak":false,"ground_fault":false})");
  EXPECT_EQ(to_line(fields_of(Unreadable{})), "null");
}

TEST(JournalFields, HoldAllOfAnOrderItsAnswerAPortAndTheEnd) {
  messages::OperatorCommand command = command_to(messages::Order::kTighten);
  command.time = Time{1'000'000};
  command.expiry = Time{2'500'000};
  command.issuer = 4'294'967'295;
  command.number = 3;
  command.limits = {.max_depth = Meters{280}, .max_speed = MetersPerSecond{1.5}, .max_time_s = 600.0};
  command.is_verified = true;
  EXPECT_EQ(to_line(fields_of(input(command))),
            R"({"port":2,"given_time_s":1.0,"expiry_time_s":2.5,"issuer":4294967295,"number":3,"order":"TIGHTEN","max_depth_m":280.0,)"
            R"("max_speed_mps":1.5,"max_time_s":600.0,"verified":true})");
  messages::CommandAcknowledgement answer;
  answer.issuer = 4'294'967'295;
  answer.number = 3;
  answer.order = messages::Order::kTighten;
  answer.outcome = messages::CommandOutcome::kNotTighter;
  EXPECT_EQ(to_line(fields_of(answer)), R"({"issuer":4294967295,"number":3,"order":"TIGHTEN","outcome":"refused: not tighter"})");
  const messages::PortReport report{.port = 4, .link_up = false, .received = 1, .lost = 2, .malformed = 3, .unsent = 5};
  EXPECT_EQ(to_line(fields_of(input(report))),
            R"({"port":2,"reported_port":4,"link_up":false,"received":1,"lost":2,"malformed":3,"unsent":5})");
  EXPECT_EQ(to_line(fields_of(input(messages::UnsentSetpoints{.count = 7}))), R"({"port":2,"count":7})");
  const messages::ClosingRecord closing{.time = kBegan,
                                        .ending = messages::Ending::kStopped,
                                        .state = messages::MissionState::kAbort,
                                        .end_reason = messages::EndReason::kOperatorAbort,
                                        .steps_taken = 7,
                                        .lost = {.streams = 1, .steering = 2, .orders = 3}};
  EXPECT_EQ(to_line(fields_of(closing)),
            R"({"ending":"stopped","state":"ABORT","end_reason":"an operator aborted it","steps_taken":7,"streams_lost":1,)"
            R"("steering_lost":2,"orders_lost":3})");
}

/// The fields of a message by its .lcm file, without those that the export says in another way.
std::set<std::string> fields_in(const std::string& message, const std::set<std::string>& said_otherwise) {
  const std::string text = text_of(std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/wire/lcm" / (message + ".lcm"));
  static const std::regex kField(R"(\n  (?!const)\w+ (\w+)(\[\d+\])?;)");
  std::set<std::string> names;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), kField); at != std::sregex_iterator(); ++at) {
    if (!said_otherwise.contains((*at)[1])) names.insert((*at)[1]);
  }
  return names;
}

TEST(JournalFields, HoldEveryFieldOfADecisionAndOfHealth) {
  // The time stands beside them, a count is the length of its array, and a bearing that is not there is null.
  const std::set<std::string> of_decision = fields_in("decision_t", {"utime", "observation_size", "action_count", "has_bearing"});
  const std::set<std::string> of_health = fields_in("health_t", {"utime", "port_count"});
  EXPECT_EQ(of_decision.size(), 30U) << "of 34";
  EXPECT_EQ(of_health.size(), 19U) << "of 21";
  for (const std::string& name : of_decision) EXPECT_TRUE(fields_of(messages::Decision{}).contains(name)) << name;
  for (const std::string& name : of_health) EXPECT_TRUE(fields_of(messages::Health{}).contains(name)) << name;
}

/// What stays away in a record that lacks it.
TEST(JournalFields, OfARecordThatLacksNothingHoldEveryKeyAndAnElementOfEachList) {
  const nlohmann::ordered_json mission = all_fields_of(messages::MissionRecord{});
  for (const char* key : {"rules", "fence_inside", "fence_save", "fence_halt", "no_surface_zones"})
    EXPECT_GE(mission.at(key).size(), 1U) << key;
  EXPECT_TRUE(mission.at("rules").at(0).at("limit").is_number_float());
  EXPECT_TRUE(mission.at("no_surface_zones").at(0).at(0).at("north_m").is_number_float());
  const nlohmann::ordered_json decision = all_fields_of(messages::Decision{});
  EXPECT_EQ(decision.at("observation").size(), 1U);
  EXPECT_EQ(decision.at("logits").size(), 1U);
  EXPECT_TRUE(decision.at("found_probability").is_number());
  EXPECT_EQ(decision.size(), fields_of(messages::Decision{}).size());
  EXPECT_EQ(all_fields_of(input(known_fix(kBegan))).size(), fields_of(input(known_fix(kBegan))).size());
}

TEST(JournalFields, TellWhatALogOfABusHasBesidesAJournal) {
  const messages::SoundDetection sound{
      .begin = Time{1'500'000}, .duration = Duration{250'000}, .level = Decibels{101.5}, .snr = Decibels{12.5}};
  EXPECT_STREQ(topic_of(sound), "detection");
  const nlohmann::ordered_json fields = fields_of(sound);
  EXPECT_EQ(fields.at("snr_db"), 12.5);
  EXPECT_EQ(fields.at("duration_s"), 0.25);
  messages::PublishedChallenge published;
  published.challenge.vehicle = {'a', 'u', 'v'};
  EXPECT_STREQ(topic_of(published), "challenge");
  EXPECT_EQ(fields_of(published).at("vehicle").get<std::string>().substr(0, 8), "61757600") << "ASCII in hexadecimal digits";
  EXPECT_EQ(fields_of(published).at("nonce").get<std::string>().size(), 32U);
}

TEST(JournalFields, StateTheMismatchWhetherItSweepsAndWhatItDeclares) {
  messages::Health health;
  health.mismatch_bits = 13.5F;
  health.is_sweeping = true;
  nlohmann::ordered_json fields = fields_of(health);
  EXPECT_EQ(fields.at("surprise_bits"), 13.5);
  EXPECT_EQ(fields.at("sweeping"), true);
  EXPECT_EQ(fields.at("found"), false);
  messages::Decision decision;
  fields = fields_of(decision);
  EXPECT_EQ(to_line(fields.at("surprise_bits")), "null") << "it holds no belief";
  EXPECT_EQ(to_line(fields.at("found_probability")), "null") << "it declares nothing";
  decision.sweeping = true;
  decision.belief.emplace().mismatch_bits = 6.25F;
  decision.found = {.probability = 0.75F, .snr = {}, .least_snr = Decibels{14.5}, .likeliest = {}, .closest_approach = Meters{640.0}};
  fields = fields_of(decision);
  EXPECT_EQ(fields.at("surprise_bits"), 6.25);
  EXPECT_EQ(fields.at("sweeping"), true);
  EXPECT_EQ(fields.at("found"), true);
  EXPECT_EQ(fields.at("found_probability"), 0.75);
  EXPECT_EQ(fields.at("found_least_snr_db"), 14.5);
  EXPECT_EQ(fields.at("closest_approach_m"), 640.0);
}

TEST(JournalFields, SayStatesAndOrdersInWords) {
  messages::Health health;
  health.state = messages::MissionState::kAbort;
  health.authority = messages::Authority::kCommand;
  health.response = config::Response::kAbort;
  health.end_reason = messages::EndReason::kNavigationStale;
  const nlohmann::ordered_json fields = fields_of(health);
  EXPECT_EQ(fields.at("state"), "ABORT");
  EXPECT_EQ(fields.at("authority"), "COMMAND");
  EXPECT_EQ(fields.at("response"), "abort");
  EXPECT_EQ(fields.at("end_reason"), "navigation went silent");
  EXPECT_EQ(fields_of(input(command_to(messages::Order::kPause))).at("order"), "PAUSE");
}

TEST(JournalFields, HoldAsMuchOfAnArrayAsItsCountSaysAndNoMoreThanThereIs) {
  messages::Decision decision;
  decision.observation_size = 2;
  decision.observation[1] = 0.5F;
  decision.action_count = 255;  // -1 on the bus
  const nlohmann::ordered_json fields = fields_of(decision);
  EXPECT_EQ(to_line(fields.at("observation")), "[0.0,0.5]");
  EXPECT_TRUE(fields.at("logits").empty());
  EXPECT_TRUE(fields.at("likeliest_north_m").is_number());  // NaN, which is written as null
}

TEST(JournalFields, SayNumbersForWordsThatThisProgramDoesNotKnow) {
  messages::Health health;
  health.authority = messages::Authority{255};
  health.response = config::Response{7};
  EXPECT_EQ(fields_of(health).at("authority"), "255");
  EXPECT_EQ(fields_of(health).at("response"), "7");
  EXPECT_EQ(fields_of(event_of(static_cast<config::Condition>(100), config::Response::kWarn)).at("condition"), "100");
}

TEST(JournalFields, KeepBytesOfABuildThatAreNoTextOutOfTheJson) {
  messages::MissionRecord mission = known_mission();
  mission.build[0] = 0xFF;
  EXPECT_NE(to_line(fields_of(mission)).find("\"build\":\"\xEF\xBF\xBD.1.0 abc\""), std::string::npos);  // U+FFFD
}

TEST(JournalFields, HoldAFenceItsZonesAndItsRules) {
  messages::MissionRecord mission = known_mission();
  mission.mission.safety.fence.emplace();
  ASSERT_EQ(mission.mission.safety.fence->save.push_back(at(5, 6)), Status::kOk);
  const config::Rule rule{
      .condition = config::Condition::kDepth, .limit = 350, .persistence = Duration::seconds(2), .response = config::Response::kAbort};
  ASSERT_EQ(mission.mission.safety.rules.push_back(rule), Status::kOk);
  const nlohmann::ordered_json fields = fields_of(mission);
  EXPECT_EQ(to_line(fields.at("fence_save")), R"([{"north_m":5.0,"east_m":6.0}])");
  EXPECT_EQ(to_line(fields.at("rules")),
            R"([{"condition":"depth_m","limit":350.0,"persistence_s":2.0,"response":"abort","latched":false}])");
  EXPECT_EQ(fields.at("policy_crc32"), "55bc801d");
}

TEST(JournalTopic, NamesEachKindOfRecord) {
  EXPECT_STREQ(topic_of(input(messages::Navigation{})), "navigation");
  EXPECT_STREQ(topic_of(input(messages::HydrophoneStatus{})), "hydrophone_status");
  EXPECT_STREQ(topic_of(input(messages::BearingMeasurement{})), "bearing");
  EXPECT_STREQ(topic_of(input(messages::UnsentSetpoints{})), "unsent_setpoints");
  EXPECT_STREQ(topic_of(messages::Health{}), "health");
  EXPECT_STREQ(topic_of(messages::ClosingRecord{}), "journal_end");
  EXPECT_STREQ(topic_of(Unreadable{}), "unknown");
}

TEST(JournalFields, SayWhereAnotherProcessGoesOnAndTheTroublesOfACanController) {
  messages::JournalResumed resumed{.time = Time{5}, .cut_bytes = 17};
  resumed.build = {'0', '.', '1'};
  EXPECT_STREQ(topic_of(resumed), "journal_resumed");
  EXPECT_EQ(fields_of(resumed).dump(), R"({"cut_bytes":17,"build":"0.1"})");
  const messages::ControllerTrouble trouble{.time = Time{5}, .port = 1, .trouble = messages::ControllerState::kBusOff, .is_there = true};
  EXPECT_STREQ(topic_of(trouble), "controller_trouble");
  EXPECT_EQ(fields_of(trouble).dump(), R"({"port":1,"trouble":"bus off","is_there":true})");
}

}  // namespace
}  // namespace earshot::journal
