#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "firmware/detector/hydrophone/settings_fields.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/hydrophone_block.hpp"
#include "tests/firmware/wire/golden/every_message.hpp"
#include "tests/firmware/wire/golden/golden_file.hpp"

namespace earshot::wire {
namespace {

TEST(LcmGolden, EveryMessageHasTheBytesThatItAlwaysHad) {
  GoldenFile golden("lcm.txt");
  const auto add = [&golden](std::string_view name, const auto& message) { golden.add(name, Encoded(message).bytes()); };
  for_each_sample_input(add);
  for_each_sample_output(add);
  golden.add("setpoint", Encoded(kSampleSetpoint, kSampleTime).bytes());
  for (const bool has_all_fields : {false, true}) {
    golden.add(has_all_fields ? "health.all" : "health", Encoded(sample_health(has_all_fields), kSampleTime).bytes());
    golden.add(has_all_fields ? "mission.all" : "mission",
               Encoded(messages::MissionRecord{.mission = sample_mission(has_all_fields)}, kSampleTime).bytes());
  }
  golden.add("journal_end", Encoded(sample_closing()).bytes());
  golden.expect_as_recorded();
}

/// What is no message of the runtime: said between a computer and its microcontroller, in a journal alone, or beside the runtime.
TEST(LcmGolden, SoHasEveryOtherType) {
  GoldenFile golden("lcm_types.txt");
  golden.add("board_t", Encoded(messages::BoardReport{.time = kSampleTime,
                                                      .event = messages::BoardEvent::kDecided,
                                                      .status = Status::kMalformed,
                                                      .frames_refused = 3,
                                                      .bytes_lost = 4,
                                                      .turn_us = 5,
                                                      .stack_bytes = 6,
                                                      .stack_used_bytes = 7})
                            .bytes());
  golden.add("hearing_t", Encoded(detector::SoundSettings{.calibration = {.sensitivity = Decibels{-170.5},
                                                                          .fixed_gain = Decibels{20.5},
                                                                          .full_scale_volts = 2.5,
                                                                          .adc_bits = 24,
                                                                          .high_pass_corner = Hertz{5.5}},
                                                          .band = {.low = Hertz{15.5}, .high = Hertz{30.5}},
                                                          .integration_time = Duration{1'000'001},
                                                          .floor_window = Duration{60'000'001},
                                                          .noise_reference = detector::NoiseReference::kFlanks,
                                                          .detection_threshold = Decibels{10.5},
                                                          .m_of_n = {.m = 2, .n = 3},
                                                          .longest_pause = Duration{4'000'001},
                                                          .expected_noise = Decibels{90.5},
                                                          .gate = {.speed = MetersPerSecond{3.5}, .thruster_rpm = 300.5},
                                                          .channels = 0x81},
                                  kSampleTime)
                              .bytes());
  golden.add(
      "controller_trouble_t",
      Encoded(messages::ControllerTrouble{.time = kSampleTime, .port = 2, .trouble = messages::ControllerState::kBusOff, .is_there = true})
          .bytes());
  golden.add("journal_part_t", Encoded(messages::JournalPart{.part = 2, .first_record_crc32 = 0x01020304}).bytes());
  messages::JournalResumed resumed{.time = kSampleTime, .cut_bytes = 99};
  resumed.build[0] = '1';
  resumed.build[63] = 0xFF;
  golden.add("journal_resumed_t", Encoded(resumed).bytes());
  constexpr std::array kSamples{0.5F, -0.25F, 0.125F, -1.0F};
  std::vector<std::uint8_t> block(hydrophone_block_bytes(kSamples.size()));
  write_hydrophone_block({.time = kSampleTime,
                          .sequence = 11,
                          .first_sample = 12,
                          .sample_rate = Hertz{1000.5},
                          .gain = Decibels{-6.5},
                          .samples_per_channel = 2,
                          .overflow_count = 1,
                          .channels = 2},
                         kSamples, block);
  golden.add("hydrophone_block_t", block);
  golden.expect_as_recorded();
}

TEST(LcmGolden, JournalRecordsOfInputsStandOnTheChannelsOfTheirPorts) {
  GoldenFile golden("input_records.txt");
  for_each_sample_input([&golden](std::string_view name, const auto& value) {
    const InputRecord record({.arrival = kSampleTime, .port = 4, .sequence = 5, .value = value});
    golden.add(name, std::string(record.channel()) + " " + hex(record.data()));
  });
  golden.expect_as_recorded();
}

}  // namespace
}  // namespace earshot::wire
