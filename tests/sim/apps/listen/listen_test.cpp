#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/annotation/selection_table.hpp"
#include "sim/netcdf/reader.hpp"
#include "tests/sim/apps/listen/listen_program.hpp"
#include "tests/sim/netcdf/kept_conventions.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::tests {
namespace {

TEST_F(ListenProgram, TellsEachCallWithItsTimeAndSnr) {
  const std::string song_file = wav("song.wav", song(60, {12.0, 30.0, 48.0}));
  ASSERT_EQ(run(song_file + " --csv " + out("a.csv")), 0) << errors();
  EXPECT_EQ(errors(), "");  // no progress bar into a file
  EXPECT_NE(said().find("detections:  3"), std::string::npos) << said();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0][0], "begin_s");
  EXPECT_EQ(rows[0][4], "snr_db");
  EXPECT_NEAR(std::stod(rows[1][0]), 12.0, 0.3);  // a quarter of the integration time
  EXPECT_NEAR(std::stod(rows[3][0]), 48.0, 0.3);
  // 20.2 dB (song); over 60 s the noise's level is known to half a decibel, and one second of it adds as much again.
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(std::stod(rows[i][4]), 20.2, 1.0);
  EXPECT_EQ(rows[1][7], rows[1][0]) << "the only file begins with the sequence";
}

TEST_F(ListenProgram, HearsACallAtTheVeryBeginningAndAtTheVeryEndOnce) {
  ASSERT_EQ(run(wav("song.wav", song(60, {0.2, 30.0, 59.0})) + " --csv " + out("a.csv")), 0) << errors();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  ASSERT_EQ(rows.size(), 4U) << said();
  for (const auto& [row, begin_s] : {std::pair{1, 0.2}, {2, 30.0}, {3, 59.0}}) {
    EXPECT_NEAR(std::stod(rows[row][0]), begin_s, 0.3);
    EXPECT_NEAR(std::stod(rows[row][4]), 20.2, 1.0);
    EXPECT_GE(std::stod(rows[row][0]), 0.0);
    EXPECT_LE(std::stod(rows[row][3]), 60.0) << "nothing is heard after the end";
  }
}

TEST_F(ListenProgram, HearsACallInAShortClip) {
  const std::vector<float> samples = song(20, {10.0});
  ASSERT_EQ(run(wav("clip.wav", {samples.begin() + 7750, samples.begin() + 13'250}) + " --csv " + out("a.csv")), 0) << errors();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  ASSERT_EQ(rows.size(), 2U) << said();
  EXPECT_NEAR(std::stod(rows[1][0]), 2.25, 0.3);
  EXPECT_NEAR(std::stod(rows[1][4]), 20.2, 2.0) << "of noise that is known from a few seconds";
}

TEST_F(ListenProgram, TakesNoSwitchingOnForACall) {
  for (const double volts : {0.96, 1.2}) {
    std::vector<float> samples = song(60, {30.0});
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] += static_cast<float>(volts * std::exp(-static_cast<double>(i) / 300.0));
    ASSERT_EQ(run(wav("on.wav", samples) + " --csv " + out("a.csv")), 0) << errors();
    const auto rows = rows_of(content_of(out("a.csv")), ',');
    ASSERT_EQ(rows.size(), 2U) << said();
    EXPECT_NEAR(std::stod(rows[1][0]), 30.0, 0.3);
  }
}

TEST_F(ListenProgram, SaysThatLevelsAreUncalibratedAndTellsThemReFullScale) {
  ASSERT_EQ(run(wav("song.wav", song(60, {12.0})) + " --csv " + out("a.csv")), 0);
  EXPECT_TRUE(support::has_line(said(), {"uncalibrated", "levels", "scale"})) << said();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  EXPECT_EQ(rows[0][5], "level_db_re_full_scale");
  EXPECT_NEAR(std::stod(rows[1][5]), -29.03, 0.3);  // 10 lg(0.05^2 / 2) and 0.04 dB of noise; the window may miss a little of the call
}

TEST_F(ListenProgram, BringsLevelsToPressureByACalibration) {
  const std::string song_file = wav("song.wav", song(60, {12.0}));
  // 20 lg 2 - (-170) - 20 = 156.02 dB re 1 uPa for a sample of 1.0.
  write(folder_ / "chain.toml", "sensitivity_db_re_1v_per_upa = -170.0\ngain_db = 20.0\nfull_scale_v = 2.0\n");
  for (const std::string& option :
       {std::string(" --calibration ") + (folder_ / "chain.toml").string(), std::string(" --full-scale-db 156.0206")}) {
    ASSERT_EQ(run(song_file + option + " --csv " + out("a.csv")), 0) << errors();
    const auto rows = rows_of(content_of(out("a.csv")), ',');
    EXPECT_EQ(rows[0][5], "level_db_re_1upa");
    EXPECT_NEAR(std::stod(rows[1][5]), 156.02 - 29.03, 0.3);
  }
}

TEST_F(ListenProgram, TakesAnIcListensCalibrationAndTimeFromItsHeader) {
  const std::string info = info_chunk({{"ICRD", "2024-06-01T05:31:14"}, {"ICMT", "2.000000 V pk, -170 dBV re 1uPa, 32768 = Max Count"}});
  write(folder_ / "a.wav", WavBytes{.sample_rate = 1000, .before_format = info, .samples = sixteen_bits(song(60, {12.0}))}.bytes());
  ASSERT_EQ(run((folder_ / "a.wav").string() + " --csv " + out("a.csv")), 0) << errors();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  EXPECT_NEAR(std::stod(rows[1][5]), 176.02 - 29.03, 0.3);  // 20 lg 2 + 170
  EXPECT_EQ(rows[1][2].substr(0, 18), "2024-06-01T05:31:2");
  EXPECT_NE(said().find("from the icListen's header"), std::string::npos) << said();
}

TEST_F(ListenProgram, RefusesAChainThatNoHydrophoneHas) {
  const std::string song_file = wav("song.wav", song(20, {}));
  write(folder_ / "chain.toml", "sensitivity_db_re_1v_per_upa = 170.0\nfull_scale_v = 2.0\ngains_db = 3\n");
  expect_refused(song_file + " --calibration " + (folder_ / "chain.toml").string(), "sensitivity_db_re_1v_per_upa = 170.0");
  EXPECT_NE(errors().find("gains_db: unknown key"), std::string::npos) << errors();
  write(folder_ / "chain.toml", "full_scale_level_db_re_1upa = 170.0\nhigh_pass_corner_hz = 20.0\n");
  expect_refused(song_file + " --calibration " + (folder_ / "chain.toml").string(), "cannot be listened to");
}

TEST_F(ListenProgram, HearsAFloatingPointFileThatGoesBeyondFullScaleWithTheSameSnr) {
  std::vector<float> samples = song(60, {12.0, 30.0});
  for (float& sample : samples) sample *= 40'000.0F;
  write(folder_ / "a.wav", WavBytes{.sample_rate = 1000, .bits = 32, .format = 3, .samples = float_samples(samples)}.bytes());
  ASSERT_EQ(run((folder_ / "a.wav").string() + " --csv " + out("a.csv")), 0) << errors();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_NEAR(std::stod(rows[1][4]), 20.2, 1.0);
  EXPECT_NEAR(std::stod(rows[1][5]), -29.03 + 92.04, 0.3);  // 20 lg 40 000
  EXPECT_EQ(rows[1][8], "good") << "nothing is clipped";
}

TEST_F(ListenProgram, WritesATableThatRavenOpensOverTheSequence) {
  const std::string first = wav("a_20200912_000000.wav", song(60, {12.0}));
  const std::string second = wav("b_20200912_000200.wav", song(60, {20.0}));
  ASSERT_EQ(run(second + " " + first + " --raven " + out("a.txt") + " --csv " + out("a.csv")), 0) << errors();
  EXPECT_TRUE(support::has_line(errors(), {"b_20200912_000200.wav", "60 s", "after", "a_20200912_000000.wav"})) << errors();
  const annotation::SelectionTable table = annotation::read_selection_table(out("a.txt"));
  ASSERT_EQ(table.selections.size(), 2U);
  EXPECT_NEAR(table.selections[1].begin_s, 80.0, 0.3);  // 60 s of sound before it
  EXPECT_EQ(table.selections[1].begin_file, "b_20200912_000200.wav");
  EXPECT_NEAR(table.selections[1].file_offset_s, 20.0, 0.3);
  EXPECT_EQ(rows_of(content_of(out("a.csv")), ',')[2][2].substr(0, 17), "2020-09-12T00:02:") << "the clock runs through the gap";
}

TEST_F(ListenProgram, ScoresItselfAgainstASelectionTable) {
  const std::string song_file = wav("song.wav", song(60, {12.0, 30.0, 48.0}));
  write(folder_ / "truth.txt", "Begin Time (s)\tEnd Time (s)\n12\t13\n30\t31\n40\t41\n");
  ASSERT_EQ(run(song_file + " --score " + (folder_ / "truth.txt").string() + " --json " + out("a.json") + " --roc " + out("roc.svg")), 0)
      << errors();
  EXPECT_TRUE(support::has_line(said(), {"2", "3 selections", "found", "1 detections", "without", "2.0 s"})) << said();
  const auto json = nlohmann::json::parse(content_of(out("a.json")));
  EXPECT_EQ(json["score"]["hits"], 2);
  EXPECT_EQ(json["score"]["false_alarms"], 1);
  ASSERT_EQ(json["curve"].size(), 25U);
  EXPECT_EQ(json["curve"][10]["threshold_db"], 10.0);
  EXPECT_EQ(json["curve"][10]["hits"], 2) << "the point of the threshold is what was printed";
  EXPECT_EQ(json["curve"][24]["detections"], 0) << "20 dB are less than 24";
  EXPECT_NE(content_of(out("roc.svg")).find("<svg"), std::string::npos);
}

TEST_F(ListenProgram, RefusesATruthOfOtherFiles) {
  write(folder_ / "truth.txt", "Begin Time (s)\tEnd Time (s)\n120\t121\n");
  expect_refused(wav("song.wav", song(20, {})) + " --score " + (folder_ / "truth.txt").string(),
                 "begins at 120 s, the recording ends at 20 s");
  write(folder_ / "truth.txt", "Begin Time (s)\tEnd Time (s)\n");
  expect_refused((folder_ / "song.wav").string() + " --score " + (folder_ / "truth.txt").string() + " --roc " + out("roc.png"),
                 "holds no selection");
}

TEST_F(ListenProgram, DrawsAPictureAndWritesLevels) {
  const std::string song_file = wav("song.wav", song(60, {12.0, 30.0}));
  ASSERT_EQ(run(song_file + " --spectrogram " + out("a.png") + " --levels " + out("a.nc") + " --levels-interval-s 20"), 0) << errors();
  EXPECT_EQ(content_of(out("a.png")).substr(1, 3), "PNG");
  expect_kept_conventions(out("a.nc"));
  const netcdf::Reader file(out("a.nc"));
  EXPECT_EQ(file.read("elapsed_time"), (std::vector<double>{0.0, 20.0, 40.0}));
  EXPECT_EQ(file.text_attribute("level", "level_unit"), "dB re full scale");
  EXPECT_EQ(file.text_attribute("level", "units"), "0.1 lg(re 1)");
  const std::vector<double> frequency = file.read("frequency");
  const std::vector<double> level = file.read("level");
  const auto at_250_hz = static_cast<std::size_t>(std::ranges::find_if(frequency, [](double f) { return f > 240.0; }) - frequency.begin());
  // White noise: 0.0004 over 500 Hz, and this band 57.7 Hz wide (251.19 Hz times 0.23077 - see IEC 61260-1): -43.4 dB.
  EXPECT_NEAR(level[2 * frequency.size() + at_250_hz], -43.4, 0.3);
}

TEST_F(ListenProgram, DatesLevelsAndSaysWhatTheyAreRelativeTo) {
  const std::string song_file = wav("song_20200912_000200.wav", song(60, {12.0, 30.0}));
  ASSERT_EQ(run(song_file + " --time-format %Y%m%d_%H%M%S --full-scale-db 176 --levels " + out("a.nc") + " --levels-interval-s 20"), 0)
      << errors();
  expect_kept_conventions(out("a.nc"));
  const netcdf::Reader file(out("a.nc"));
  // date --utc -d "2020-09-12 00:02:00" +%s
  EXPECT_EQ(file.read("time"), (std::vector<double>{1'599'868'920.0, 1'599'868'940.0, 1'599'868'960.0}));
  EXPECT_EQ(file.text_attribute("level", "level_unit"), "dB re 1 uPa");
  EXPECT_EQ(file.text_attribute("level_percentile", "units"), "0.1 lg(re 1 uPa2)");
}

TEST_F(ListenProgram, NeverReplacesTheRecordingNotEvenWhenForced) {
  const std::string song_file = wav("song.wav", song(20, {}));
  const std::string before = content_of(song_file);
  EXPECT_EQ(run(song_file + " --csv " + song_file), 2);
  EXPECT_EQ(run(song_file + " --force --csv " + song_file), 2);
  std::filesystem::create_symlink(song_file, folder_ / "link.csv");
  EXPECT_EQ(run(song_file + " --force --csv " + (folder_ / "link.csv").string()), 2);
  std::filesystem::create_hard_link(song_file, folder_ / "hard.csv");
  EXPECT_EQ(run(song_file + " --force --csv " + (folder_ / "hard.csv").string()), 2);
  EXPECT_NE(errors().find("FILE " + song_file + ", --csv " + (folder_ / "hard.csv").string() + ": the same file"), std::string::npos);
  EXPECT_EQ(content_of(song_file), before);
}

TEST_F(ListenProgram, NeverReplacesAnythingElseThatItReads) {
  const std::string song_file = wav("song.200912231533.wav", song(20, {12.0}));
  const auto file = [this](const char* name) { return (folder_ / name).string(); };
  write(file("truth.csv"), "start,end,label\n12,13,call\n");
  write(file("chain.toml"), "full_scale_level_db_re_1upa = 176.0\n");
  write(file("song.200912231533.log.xml"), "<ST/>\n");
  const std::string all = song_file + " --force --score " + file("truth.csv") + " --calibration " + file("chain.toml");
  for (const char* name : {"truth.csv", "chain.toml", "song.200912231533.log.xml"}) {
    const std::string before = content_of(file(name));
    for (const char* option : {" --csv ", " --raven ", " --json ", " --levels "}) {
      EXPECT_EQ(run(all + option + file(name)), 2) << option << name;
      EXPECT_TRUE(support::has_line(errors(), {std::string(name), "same file", "replace"})) << errors();
    }
    EXPECT_EQ(content_of(file(name)), before);
  }
  EXPECT_EQ(run(all + " --csv " + out("a.csv")), 0) << errors();
}

TEST_F(ListenProgram, LeavesAFileThatIsNoneOfItsOwnUnlessForced) {
  const std::string song_file = wav("song.wav", song(20, {}));
  write(out("notes.csv"), "my own notes\n");
  EXPECT_EQ(run(song_file + " --csv " + out("notes.csv")), 2);
  EXPECT_TRUE(support::has_line(errors(), {"already", "not", "CSV", "table", "detections"})) << errors();
  EXPECT_EQ(content_of(out("notes.csv")), "my own notes\n");
  EXPECT_EQ(run(song_file + " --force --csv " + out("notes.csv")), 0) << errors();
  EXPECT_EQ(run(song_file + " --csv " + out("notes.csv")), 0) << errors();
  EXPECT_EQ(run(song_file + " --csv " + out("a.txt") + " --raven " + out("a.txt")), 2) << "one file for two outputs";
}

}  // namespace
}  // namespace earshot::tests
