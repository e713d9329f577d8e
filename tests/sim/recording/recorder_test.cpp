#include "sim/recording/recorder.hpp"

#include <gtest/gtest.h>

#include "sim/recording/clock_text.hpp"
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

// The forms of firmware 1.0.0, 1.0.1, 1.4.0, 1.5.0 and of those that follow a GPS (AudioMoth-Firmware-Basic, AudioMoth-GPS-Sync).
TEST(RecorderNotes, TakeAnAudioMothsTimeFromEveryFormOfItsComment) {
  const auto start = [](const std::string& comment) { return start_of(notes_of_comment(comment)); };
  EXPECT_EQ(start("Recorded at 19:17:30 24/09/2019 by AudioMoth 243B1F055C4A2F01 at gain setting 2 while battery state was 3.6V"),
            "2019-09-24T19:17:30.000Z");
  EXPECT_EQ(start("Recorded at 20:00:00 12/03/2022 (UTC-4) during deployment 0123456789ABCDEF at medium gain while battery was 4.6V and "
                  "temperature was 17.7C."),
            "2022-03-13T00:00:00.000Z");
  EXPECT_EQ(start("Recorded at 20:00:00.250 12/03/2022 (UTC+5:30) by AudioMoth 24F319055FDF2902 at low gain while battery was less than "
                  "2.5V and temperature was -3.1C. Recording stopped due to switch position change."),
            "2022-03-12T14:30:00.250Z");
  EXPECT_EQ(notes_of_comment("Recorded at 20:00:00 12/03/2022 (UTC-4) during deployment 0123456789ABCDEF at low-medium gain").recorder,
            "AudioMoth");
}

TEST(RecorderNotes, TakeTheZoneThatAHeaderStates) {
  const auto start = [](const SoundTexts& texts, const char* name = "a.wav") { return start_of(notes_of(name, texts, kSixteenBits)); };
  EXPECT_EQ(start({.date = "2024-06-01T05:31:14.250+02:00"}), "2024-06-01T03:31:14.250Z");
  EXPECT_EQ(start({.date = "2024-06-01 05:31:14,5 -0930"}), "2024-06-01T15:01:14.500Z");
  EXPECT_EQ(start({.date = "2024-06-01T05:31:14 PDT"}), "not told") << "a zone that is not understood is not UTC";
  EXPECT_EQ(start({.date = "2024-06-01"}), "not told") << "a day is no time";
  EXPECT_EQ(start({.guano = "GUANO|Version:1.0\r\nMake: Wildlife\r\nTimestamp: 2021-02-05T03:59:46.125+10:00\r\n"}),
            "2021-02-04T17:59:46.125Z");
  EXPECT_EQ(start({.guano = "Timestamp:2021-02-05T03:59:46Z"}, "x_20200101_000000.wav"), "2021-02-05T03:59:46.000Z")
      << "what states a zone comes before a name without one";
  const RecorderNotes bext = notes_of("a.wav", {.origin = "2021-02-05 03:59:46"}, kSixteenBits);
  EXPECT_EQ(start_of(bext), "2021-02-05T03:59:46.000Z");
  EXPECT_EQ(bext.start_from, "its header (bext), taken as UTC");
  EXPECT_EQ(start_of(notes_of_comment("3.0 V pk, -177 dBV re 1uPa", "2024-06-01T05:31:14.5-07:00")), "2024-06-01T12:31:14.500Z");
}

TEST(RecorderNotes, TakeTheZoneThatANameStates) {
  const auto start = [](const char* name) { return start_of(notes_of(name, {}, kSixteenBits)); };
  EXPECT_EQ(start("site_20210205T035946+1000.wav"), "2021-02-04T17:59:46.000Z");
  EXPECT_EQ(start("20210205_035946-0400.wav"), "2021-02-05T07:59:46.000Z");
  EXPECT_EQ(start("20210205T035946-0330_site.flac"), "2021-02-05T07:29:46.000Z");
  EXPECT_EQ(start("20210205T035946+10.wav"), "2021-02-04T17:59:46.000Z");
  EXPECT_EQ(start("2021-02-05T03-59-46.250Z.wav"), "2021-02-05T03:59:46.250Z");
  EXPECT_EQ(start("20210205035946.wav"), "2021-02-05T03:59:46.000Z");
  EXPECT_EQ(start("20210205_035946-0017.wav"), "2021-02-05T03:59:46.000Z") << "a number of a part: no zone has 17 minutes";
  EXPECT_EQ(start("20210205_035946-0015.wav"), "2021-02-05T03:59:46.000Z") << "no zone is a quarter of an hour west of UTC";
  EXPECT_EQ(start("20210205T035946_+1000.wav"), "2021-02-04T17:59:46.000Z");
  EXPECT_EQ(start("20210205T035946_-0400.wav"), "2021-02-05T07:59:46.000Z");
  EXPECT_EQ(start("S4A04430_20210403$150100.wav"), "2021-04-03T15:01:00.000Z") << "Wildlife Acoustics, where a recording goes on";
  EXPECT_EQ(notes_of("20210205T035946+1000.wav", {}, kSixteenBits).start_from, "its name");
}

TEST(ClockText, ReadsANameByItsPattern) {
  const auto time = [](const char* format, const char* name) {
    const std::optional<ClockTime> read = time_by_format(format, name);
    return read ? to_iso(read->utc) : "none";
  };
  EXPECT_EQ(time("%y%m%d_%H%M%S", "SITE_B_210205_035946.wav"), "2021-02-05T03:59:46.000Z");
  EXPECT_EQ(time("%Y%j_%H%M%S.%f", "hydro2021036_035946.250.wav"), "2021-02-05T03:59:46.250Z");
  EXPECT_EQ(time("%d-%m-%Y %H.%M%z", "05-02-2021 03.59+1000.wav"), "2021-02-04T17:59:00.000Z");
  EXPECT_EQ(time("%y%m%d_%H%M%S", "song.wav"), "none");
  EXPECT_EQ(fault_of_format("%Y%m%d_%H"), "");
  EXPECT_NE(fault_of_format("%H%M%S"), "");
  EXPECT_NE(fault_of_format("%Y%m%d %Q %H"), "");
  EXPECT_NE(fault_of_format("%Y%m%d%H%"), "");
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
