#include <gtest/gtest.h>

#include "earshot/board_t.hpp"
#include "earshot/controller_trouble_t.hpp"
#include "earshot/hearing_t.hpp"
#include "earshot/hydrophone_block_t.hpp"
#include "earshot/journal_part_t.hpp"
#include "earshot/journal_resumed_t.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/wire/golden/every_message.hpp"
#include "tests/firmware/wire/golden/golden_file.hpp"

namespace earshot::wire {
namespace {

TEST(LcmGolden, EveryMessageHasTheBytesThatItAlwaysHad) {
  GoldenFile golden("lcm.txt");
  const auto add = [&golden](std::string_view name, const auto& message) { golden.add(name, Encoded(to_message(message)).bytes()); };
  for_each_sample_input(add);
  for_each_sample_output(add);
  golden.add("setpoint", Encoded(to_message(kSampleSetpoint, kSampleTime)).bytes());
  for (const bool says_all : {false, true}) {
    golden.add(says_all ? "health.all" : "health", Encoded(to_message(sample_health(says_all), kSampleTime)).bytes());
    golden.add(says_all ? "mission.all" : "mission", Encoded(to_message(sample_mission(says_all), kSampleTime)).bytes());
  }
  golden.add("journal_end", encoded(sample_closing()).bytes());
  golden.expect_as_recorded();
}

/// What is no message of the runtime: said between a computer and its microcontroller, in a journal alone, or beside the runtime.
TEST(LcmGolden, SoHasEveryOtherType) {
  GoldenFile golden("lcm_types.txt");
  golden.add("board_t", Encoded(board_t{.utime = kSampleTime.us,
                                        .event = board_t::DECIDED,
                                        .status = 2,
                                        .frames_refused = 3,
                                        .bytes_lost = 4,
                                        .turn_us = 5,
                                        .stack_bytes = 6,
                                        .stack_used_bytes = 7})
                            .bytes());
  golden.add("hearing_t", Encoded(hearing_t{.utime = kSampleTime.us,
                                            .sensitivity_db = -170.5,
                                            .fixed_gain_db = 20.5,
                                            .full_scale_volts = 2.5,
                                            .adc_bits = 24,
                                            .high_pass_corner_hz = 5.5,
                                            .band_low_hz = 15.5,
                                            .band_high_hz = 30.5,
                                            .integration_time_us = 1'000'001,
                                            .floor_window_us = 60'000'001,
                                            .noise_reference = 1,
                                            .detection_threshold_db = 10.5,
                                            .detections_needed = 2,
                                            .detections_of = 3,
                                            .longest_pause_us = 4'000'001,
                                            .expected_noise_db = 90.5,
                                            .gate_speed_mps = 3.5,
                                            .gate_thruster_rpm = 300.5,
                                            .channels = 0x81})
                              .bytes());
  golden.add(
      "controller_trouble_t",
      Encoded(controller_trouble_t{.utime = kSampleTime.us, .port = 2, .trouble = controller_trouble_t::BUS_OFF, .is_there = 1}).bytes());
  golden.add("journal_part_t", Encoded(journal_part_t{.part = 2, .first_record_crc32 = 0x01020304}).bytes());
  journal_resumed_t resumed{.utime = kSampleTime.us, .cut_bytes = 99, .build = {}};
  resumed.build[0] = '1';
  resumed.build[63] = 0xFF;
  golden.add("journal_resumed_t", Encoded(resumed).bytes());
  hydrophone_block_t block{};
  block.utime = kSampleTime.us;
  block.sequence = 11;
  block.first_sample = 12;
  block.sample_rate_hz = 1000.5;
  block.gain_db = -6.5;
  block.overflow_count = 1;
  block.channels = 2;
  block.sample_count = 4;
  block.samples = {0.5F, -0.25F, 0.125F, -1.0F};
  golden.add("hydrophone_block_t", Encoded(block).bytes());
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
