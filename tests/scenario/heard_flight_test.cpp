// Flights that hear sound: the programs themselves, over real LCM and real DDS.

#include <sndfile.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>

#include "earshot/snr_estimate_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/scenario/flight.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot {
namespace {

const fs::path kMissions = kSource / "firmware/boards/linux/missions";

class HeardFlight : public Flight {
 protected:
  /// By the policy that ships, in the missions that ship.
  [[nodiscard]] std::unique_ptr<support::Process> hear(const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> a{"--out", folder_ / out, "--no-report"};
    a.insert(a.end(), more.begin(), more.end());
    return std::make_unique<support::Process>(kBin / "earshot-fly", a, folder_ / (out + ".txt"));
  }

  [[nodiscard]] fs::path sound_of(const char* name, double seconds, const std::function<double(double)>& at) const {
    constexpr int kRate_hz = 500;
    const fs::path path = folder_ / name;
    SF_INFO info{
        .frames = 0, .samplerate = kRate_hz, .channels = 1, .format = SF_FORMAT_WAV | SF_FORMAT_FLOAT, .sections = 0, .seekable = 0};
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    std::vector<float> samples(static_cast<std::size_t>(std::llround(seconds * kRate_hz)));
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<float>(at(static_cast<double>(i) / kRate_hz));
    EXPECT_EQ(sf_writef_float(file, samples.data(), static_cast<sf_count_t>(samples.size())), static_cast<sf_count_t>(samples.size()));
    sf_close(file);
    return path;
  }

  /// A pulse of a second every fifteen, in faint noise.
  [[nodiscard]] fs::path song() const {
    return sound_of("song.wav", 60.0, [](double t) {
      const double into_s = std::fmod(t, 15.0);
      const double swell = into_s < 1.0 ? std::sin(std::numbers::pi * into_s) : 0.0;
      return 0.3 * swell * std::sin(2.0 * std::numbers::pi * 20.0 * t) + 1e-4 * std::sin(1e4 * t * t);
    });
  }

  void expect_refused(const std::vector<std::string>& arguments, const std::string& part) const {
    const auto flight = hear("refused", arguments);
    EXPECT_EQ(flight->wait(30s), 2) << flight->output();
    EXPECT_NE(flight->output().find(part), std::string::npos) << flight->output();
    EXPECT_FALSE(fs::exists(folder_ / "refused")) << part;
  }

  struct Measurement {
    std::int64_t time_us = 0;
    long snr_ten_thousandths = 0;
    int too_faint = 0;
    friend bool operator==(const Measurement&, const Measurement&) = default;
  };
  /// What the vehicle's own journal says that its detector gave it.
  [[nodiscard]] std::vector<Measurement> journalled(const std::string& out) const {
    std::vector<Measurement> measurements;
    host::JournalReader reader(folder_ / out / "journal.lcmlog");
    for (host::JournalRecord record; reader.next(record);) {
      snr_estimate_t measurement{};
      if (!record.channel.starts_with(wire::kSnrEstimateChannel) || support::read_peer(record.data, measurement) != Status::kOk) continue;
      measurements.push_back({measurement.utime, std::lround(1e4 * measurement.snr_db), measurement.too_faint != 0 ? 1 : 0});
    }
    return measurements;
  }
  [[nodiscard]] std::vector<Measurement> written(const std::string& out) const {
    std::vector<Measurement> measurements;
    std::ifstream rows(folder_ / out / "hearing.csv");
    std::string row;
    std::getline(rows, row);
    while (std::getline(rows, row)) {
      double time_s = 0.0;
      double snr_db = 0.0;
      int too_faint = 0;
      EXPECT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%d", &time_s, &snr_db, &too_faint), 3) << row;
      measurements.push_back({std::llround(1e6 * time_s), std::lround(1e4 * snr_db), too_faint});
    }
    return measurements;
  }
};

TEST_F(HeardFlight, GivenOneSeedTwoFlightsHearTheSameAndGoTheSameWayByteForByteAndFindTheSource) {
  for (const char* out : {"first", "second"}) {
    const auto flight = hear(out, {"--hear", "synthetic", "--seed", "7"});
    ASSERT_EQ(flight->wait(240s), 0) << flight->output();
    EXPECT_NE(flight->output().find("learn the noise of the sea"), std::string::npos) << flight->output();
  }
  for (const char* file : {"track.csv", "hearing.csv", "spectrogram.csv", "journal.lcmlog"})
    EXPECT_TRUE(support::read_text(folder_ / "first" / file) == support::read_text(folder_ / "second" / file)) << file;
  const nlohmann::json s = summary("first");
  EXPECT_EQ(s.at("found"), true);
  EXPECT_EQ(s.at("hearing").at("blocks_lost"), 0);
  // The detector for a tone knows the noise after a quarter of 480 s; its filters and its first integration time come on top.
  EXPECT_GE(s.at("hearing").at("search_began_s").get<double>(), 120.0);
  EXPECT_LE(s.at("hearing").at("search_began_s").get<double>(), 140.0);
  EXPECT_GT(s.at("hearing").at("looks").get<int>(), 500);
}

TEST_F(HeardFlight, GivenItsJournalTheSnrsInItAreThoseThatTheSimulatorsFileTells) {
  const auto flight = hear("out", {"--hear", "synthetic", "--seed", "3"});
  ASSERT_EQ(flight->wait(240s), 0) << flight->output();
  const std::vector<Measurement> heard = journalled("out");
  EXPECT_GT(heard.size(), 200U);
  EXPECT_TRUE(heard == written("out"));
}

TEST_F(HeardFlight, GivenASeaThatLosesBlocksItHearsTheRestAndTheSameSeedLosesTheSame) {
  const fs::path rough = folder_ / "rough.toml";
  std::ofstream(rough) << support::read_text(kEnvironment) << "\n[conditions.sound]\nlost_blocks = 0.01\n";
  for (const char* out : {"first", "second"}) {
    const auto flight = hear(out, {"--hear", "synthetic", "--seed", "3", "--environment", rough});
    ASSERT_EQ(flight->wait(240s), 0) << flight->output();
  }
  EXPECT_GT(summary("first").at("hearing").at("blocks_lost").get<int>(), 5);
  EXPECT_TRUE(support::read_text(folder_ / "first/track.csv") == support::read_text(folder_ / "second/track.csv"));
  EXPECT_TRUE(journalled("first") == written("first"));
}

TEST_F(HeardFlight, GivenRecordedCallsTheyAreHeardAtTheModelledLevelAndTheSourceIsSearchedFor) {
  const auto flight = hear("out", {"--hear", song(), "--seed", "3"});
  ASSERT_EQ(flight->wait(240s), 0) << flight->output();
  // A pulse falls into one measurement or two that follow each other: together they hold its sound.
  std::ifstream rows(folder_ / "out/hearing.csv");
  std::string row;
  std::getline(rows, row);
  double pulse_s = -10.0;
  double pulse_power = 0.0;
  double modelled_db = 0.0;
  double sum_db = 0.0;
  int pulses = 0;
  while (std::getline(rows, row)) {
    double time_s = 0.0;
    double snr_db = 0.0;
    double now_modelled_db = 0.0;
    int too_faint = 0;
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%d,%lf", &time_s, &snr_db, &too_faint, &now_modelled_db), 4);
    if (too_faint != 0) continue;
    if (time_s - pulse_s < 1.5) {
      pulse_power += std::pow(10.0, snr_db / 10.0);
      continue;
    }
    if (modelled_db > 15.0) {
      sum_db += 10.0 * std::log10(pulse_power) - modelled_db;
      ++pulses;
    }
    pulse_s = time_s;
    pulse_power = std::pow(10.0, snr_db / 10.0);
    modelled_db = now_modelled_db;
  }
  EXPECT_GT(pulses, 100);
  // A second of the pulse and its filtered edges are a little more than the loudest second of it, a faint half of it goes unmeasured: 1 dB.
  EXPECT_NEAR(sum_db / pulses, 0.0, 1.0);
}

TEST_F(HeardFlight, GivenWhatCannotBeHeardNothingFliesAndTheMessageNamesIt) {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused({"--hear", folder_ / "none.wav"}, "none.wav");
  expect_refused({"--hear", sound_of("silence.wav", 20.0, [](double) { return 0.0; })}, "silence.wav: is silent");
  expect_refused({"--hear", sound_of("nan.wav", 20.0, [nan](double) { return nan; })},
                 "nan.wav: sample 1 of the first channel is no finite number");
  std::ofstream(folder_ / "text.wav") << "no sound";
  expect_refused({"--hear", folder_ / "text.wav"}, "text.wav");
  expect_refused({"--hear", "synthetic", "--mission", kMissions / "search.toml"}, "search.toml: port: no port has the role \"hydrophone\"");
  const fs::path no_table = folder_ / "no_table.toml";
  expect_refused({"--hear", "synthetic", "--mission", kMissions / "hear_calls.toml"},
                 "hear_calls.toml: hydrophone: learns the noise in the pauses between calls");
  const fs::path higher = fs::path(EARSHOT_SOURCE_DIR) / "policy/worlds/oceans/hz_35.toml";
  expect_refused({"--hear", "synthetic", "--environment", higher, "--mission", kMissions / "hear_tone.toml"},
                 "hear_tone.toml: hydrophone: listens from 18 to 22 Hz, and source.frequency_hz of " + higher.string() + " is 35");
  expect_refused({"--hear", "--quiet"}, "must be synthetic or name a file");
  std::string text = support::read_text(kMissions / "hear_tone.toml");
  text.erase(text.find("[hydrophone]"), text.find("[origin]") - text.find("[hydrophone]"));
  std::ofstream(no_table) << text;
  expect_refused({"--hear", "synthetic", "--mission", no_table}, "no_table.toml: hydrophone");
}

TEST_F(HeardFlight, GivenADetectorThatNeverHearsTheFlightEndsAndSaysWhatIsInTheWay) {
  const fs::path deaf = folder_ / "deaf.toml";
  std::ofstream(deaf) << support::read_text(kEnvironment) << "\n[conditions.sound]\nlost_blocks = 1.0\n";
  const auto flight = hear("out", {"--hear", "synthetic", "--environment", deaf});
  EXPECT_EQ(flight->wait(120s), 3) << flight->output();
  EXPECT_NE(flight->output().find("the vehicle's detector gave no SNR"), std::string::npos) << flight->output();
  EXPECT_FALSE(fs::exists(folder_ / "out/summary.json"));
}

}  // namespace
}  // namespace earshot
