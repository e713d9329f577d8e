#include "sim/recording/recorder.hpp"

#include <gtest/gtest.h>

#include "sim/recording/utc.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::recording {
namespace {

constexpr SoundFormat kSixteenBits{.sample_rate = Hertz{48'000}, .channels = 1, .bits = 16, .is_float = false};

RecorderNotes notes_of_comment(const std::string& comment, const std::string& date = {}) {
  return notes_of("a.wav", {.artist = {}, .album = {}, .comment = comment, .date = date, .software = {}}, kSixteenBits);
}

std::string start_of(const RecorderNotes& notes) {
  return notes.start ? to_iso(*notes.start) : "not told";
}

// The comments as the firmware's versions 1.0, 1.2 and 1.4 write them (AudioMoth-Firmware-Basic, setHeaderComment).
TEST(RecorderNotes, TakeAnAudioMothsTimeAndGainFromItsComment) {
  const RecorderNotes notes = notes_of_comment(
      "Recorded at 19:17:30 24/09/2019 (UTC) by AudioMoth 243B1F055C4A2F01 at gain setting 2 while battery state was 3.6V.");
  EXPECT_EQ(notes.recorder, "AudioMoth");
  EXPECT_EQ(start_of(notes), "2019-09-24T19:17:30.000Z");
  EXPECT_EQ(notes.gain, "gain setting 2");
  EXPECT_FALSE(notes.sensitivity) << "it tells none";
  EXPECT_EQ(notes_of_comment("Recorded at 08:00:00 01/06/2021 (UTC) by AudioMoth 24F31901603710F6 at medium gain while battery was 4.2V "
                             "and temperature was 14.3C.")
                .gain,
            "medium gain");
}

TEST(RecorderNotes, BringAnAudioMothsTimeZoneToUtc) {
  const auto start = [](const std::string& zone) {
    return start_of(notes_of_comment("Recorded at 19:17:30 24/09/2019 (UTC" + zone + ") by AudioMoth 0"));
  };
  EXPECT_EQ(start("+2"), "2019-09-24T17:17:30.000Z");
  EXPECT_EQ(start("-3"), "2019-09-24T22:17:30.000Z");
  EXPECT_EQ(start("+5:30"), "2019-09-24T13:47:30.000Z");
  EXPECT_EQ(start("-3:30"), "2019-09-24T22:47:30.000Z");
  EXPECT_EQ(start("+x"), "not told");
}

TEST(RecorderNotes, TakeNoDayThatNoCalendarHas) {
  EXPECT_EQ(start_of(notes_of_comment("Recorded at 19:17:30 31/02/2019 (UTC) by AudioMoth 0")), "not told");
  EXPECT_EQ(start_of(notes_of_comment("Recorded at 24:00:00 24/09/2019 (UTC) by AudioMoth 0")), "not told");
}

// ICMT and ICRD of the recording RBW_6661_20240601_053114.wav that MHKiT-Python ships, as its test_io.py prints their parts.
TEST(RecorderNotes, TakeAnIcListensChainFromItsComment) {
  const SoundFormat twenty_four_bits{.sample_rate = Hertz{512'000}, .channels = 1, .bits = 24, .is_float = false};
  const RecorderNotes notes = notes_of("a.wav",
                                       {.artist = "icListen HF #6661",
                                        .album = {},
                                        .comment = "3.000000 V pk, -177 dBV re 1uPa, 24.0 % RH, 8.6 deg C, Acc(-980,-18,141), "
                                                   "Mag(3603,3223,-598), 8388608 = Max Count, 2589798400000 = Seq #",
                                        .date = "2024-06-01T05:31:14+00",
                                        .software = "icListen HF R40.0"},
                                       twenty_four_bits);
  EXPECT_EQ(notes.recorder, "icListen");
  EXPECT_EQ(notes.sensitivity, Decibels{-177.0});
  EXPECT_EQ(notes.full_scale_volts, 3.0);
  EXPECT_EQ(start_of(notes), "2024-06-01T05:31:14.000Z");
}

TEST(RecorderNotes, KnowThatAnIcListensVoltsAreThoseOfItsMaximumCount) {
  // A gain of two before 24 bits become 16: 3 V are 65 536 counts, full scale at 32 768 is 1.5 V.
  EXPECT_EQ(notes_of_comment("3.000000 V pk, -177 dBV re 1uPa, 65536 = Max Count, 1 = Seq #").full_scale_volts, 1.5);
}

TEST(RecorderNotes, TakeNothingFromAnIcListensChainThatNoHydrophoneHas) {
  EXPECT_FALSE(notes_of_comment("3.000000 V pk, 177 dBV re 1uPa, 32768 = Max Count").sensitivity);
  EXPECT_FALSE(notes_of_comment("-3.000000 V pk, -177 dBV re 1uPa, 32768 = Max Count").full_scale_volts);
  EXPECT_FALSE(notes_of_comment("nan V pk, -177 dBV re 1uPa").full_scale_volts);
}

TEST(RecorderNotes, TakeASoundTrapsTimeFromItsName) {
  const RecorderNotes notes = notes_of("deployments/5100.200912231533.wav", {}, kSixteenBits);
  EXPECT_EQ(notes.recorder, "SoundTrap");
  EXPECT_EQ(start_of(notes), "2020-09-12T23:15:33.000Z");
  EXPECT_EQ(notes.start_from, "its name, taken as UTC");
}

TEST(RecorderNotes, PreferTheUtcOfASoundTrapsLog) {
  const support::TemporaryFolder folder;
  tests::write(folder / "5100.200912231533.log.xml",
               R"(<?xml version="1.0"?><ST><EVENT><AUDIO Gain="High"/></EVENT>
<PROC_EVENT ID="0"><WavFileHandler SamplingStartTimeLocal="2020-09-12T23:15:33" /></PROC_EVENT>
<PROC_EVENT ID="0"><WavFileHandler SamplingStartTimeUTC="2020-09-12T11:15:33" /></PROC_EVENT>
<PROC_EVENT ID="0"><WavFileHandler SamplingStartTimeSubS="250000 us" /></PROC_EVENT></ST>)");
  const RecorderNotes notes = notes_of(folder / "5100.200912231533.wav", {}, kSixteenBits);
  EXPECT_EQ(start_of(notes), "2020-09-12T11:15:33.250Z");
  EXPECT_EQ(notes.start_from, "5100.200912231533.log.xml");
  EXPECT_EQ(notes.gain, "gain High");
}

TEST(RecorderNotes, FindADateInAnyName) {
  EXPECT_EQ(start_of(notes_of("RBW_6661_20240601_053114.wav", {}, kSixteenBits)), "2024-06-01T05:31:14.000Z");
  EXPECT_EQ(start_of(notes_of("buoy-20200229T120000Z.flac", {}, kSixteenBits)), "2020-02-29T12:00:00.000Z");
  EXPECT_EQ(start_of(notes_of("20210229_120000.wav", {}, kSixteenBits)), "not told") << "no leap year";
  EXPECT_EQ(start_of(notes_of("song.wav", {}, kSixteenBits)), "not told");
}

}  // namespace
}  // namespace earshot::recording
