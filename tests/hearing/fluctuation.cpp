// What a vehicle's detector makes of a steady source: how far a measurement lies from the true SNR, and how often it is too faint to
// measure. usage: fluctuation CSV PNG [HOURS]     hours of sound for every SNR (default 3)

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "firmware/host/file/output_file.hpp"
#include "sim/hydrophone/hydrophone.hpp"
#include "sim/plot/gnuplot.hpp"

namespace {

using namespace earshot;
using hydrophone::Calls;
using hydrophone::Song;
using hydrophone::Tone;

constexpr double kInterval_s = 15.0;
const Song kSong{.pattern = {.interval_s = kInterval_s, .song_s = 1e9, .pause_s = 0.0, .listening_s = 1.0}};
constexpr Meters kRange{15'000};
constexpr double kTravel_s = 10.0;  // at 1500 m/s

struct Measurement {
  double time_s;
  double snr_db;
  bool too_faint;
};

/// Measurements that share no sound of a tone; of a song the loudest of each pulse's second, as a window that takes the loudest hears it.
struct Sample {
  double snr_db;  ///< true
  std::size_t measurements = 0;
  std::size_t too_faint = 0;
  double mean_error_db = 0.0;
  double deviation_db = 0.0;
};

std::vector<Measurement> measurements_of(const detector::SoundSettings& listening, const Calls& calls, double snr_db, int seconds) {
  const auto sound_detector = std::make_unique<detector::SoundDetector>();
  if (sound_detector->configure(listening) != Status::kOk) std::abort();
  hydrophone::HydrophoneSettings settings;
  settings.band = {.low = listening.band.low, .high = listening.band.high};
  settings.calls = calls;
  settings.full_scale = full_scale_level(listening.calibration, {});
  hydrophone::Hydrophone ocean(settings, static_cast<std::uint64_t>(1000.0 + 10.0 * snr_db));
  hydrophone::Situation situation{.arrivals = {}, .speed = MetersPerSecond{2.0}};
  (void)situation.arrivals.push_back({.range = kRange, .level = settings.noise_level + Decibels{snr_db}});
  ocean.begin(situation);
  const bool is_tone = std::holds_alternative<Tone>(calls);
  std::vector<Measurement> measurements;
  for (int t = 1; t <= seconds; ++t) {
    if (!ocean.hear(situation, Time{} + Duration::seconds(t))) continue;
    sound_detector->hear(ocean.block(), ocean.samples());
    while (const auto e = sound_detector->next()) {
      if (e->is_measured() && (e->is_independent || !is_tone))
        measurements.push_back({(e->time - Time{}).to_seconds(), e->snr.value, e->too_faint});
    }
  }
  return measurements;
}

/// One measurement for each pulse: the loudest that shares sound with it.
std::vector<Measurement> loudest_of_pulses(const std::vector<Measurement>& measurements) {
  std::vector<Measurement> loudest;
  double pulse = -1.0;
  for (const Measurement& measurement : measurements) {
    const double since_s = measurement.time_s - kTravel_s;
    if (std::fmod(since_s, kInterval_s) > 2.0) continue;  // a measurement of a second that ends later has none of the pulse
    const double its_pulse = std::floor(since_s / kInterval_s);
    if (its_pulse != pulse) loudest.push_back(measurement);
    pulse = its_pulse;
    Measurement& so_far = loudest.back();
    if (so_far.too_faint || (!measurement.too_faint && measurement.snr_db > so_far.snr_db)) so_far = measurement;
  }
  return loudest;
}

Sample sample_of(double snr_db, const std::vector<Measurement>& measurements) {
  Sample s{.snr_db = snr_db, .measurements = measurements.size()};
  double sum = 0.0;
  double squares = 0.0;
  for (const Measurement& measurement : measurements) {
    s.too_faint += measurement.too_faint ? 1 : 0;
    if (measurement.too_faint) continue;
    sum += measurement.snr_db - snr_db;
    squares += (measurement.snr_db - snr_db) * (measurement.snr_db - snr_db);
  }
  const auto measured = static_cast<double>(s.measurements - s.too_faint);
  s.mean_error_db = sum / measured;
  s.deviation_db = std::sqrt(squares / measured - s.mean_error_db * s.mean_error_db);
  return s;
}

std::vector<Sample> samples_of(const detector::SoundSettings& listening, const Calls& calls, int seconds) {
  std::vector<Sample> samples;
  for (double snr_db = -10.0; snr_db <= 40.0; snr_db += snr_db < 16.0 ? 1.0 : 4.0) {
    std::vector<Measurement> measurements = measurements_of(listening, calls, snr_db, seconds);
    if (std::holds_alternative<Song>(calls)) measurements = loudest_of_pulses(measurements);
    samples.push_back(sample_of(snr_db, measurements));
  }
  return samples;
}

std::string rows_of(const char* name, const std::vector<Sample>& samples) {
  std::string text;
  for (const Sample& s : samples) {
    std::array<char, 200> row{};
    (void)std::snprintf(row.data(), row.size(), "%s,%g,%zu,%.4f,%.3f,%.3f\n", name, s.snr_db, s.measurements,
                        static_cast<double>(s.too_faint) / static_cast<double>(s.measurements), s.mean_error_db, s.deviation_db);
    text += row.data();
  }
  return text;
}

/// The SNR at which half of the measurements are too faint, in line between samples.
double floor_of(const std::vector<Sample>& samples) {
  const auto share = [](const Sample& s) { return static_cast<double>(s.too_faint) / static_cast<double>(s.measurements); };
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double above = share(samples[i - 1]);
    const double below = share(samples[i]);
    if (above >= 0.5 && below < 0.5) return std::lerp(samples[i - 1].snr_db, samples[i].snr_db, (above - 0.5) / (above - below));
  }
  return std::nan("");
}

/// The greatest among SNRs at which all but a tenth are measured.
double worst_of(const std::vector<Sample>& samples) {
  double worst = 0.0;
  for (const Sample& s : samples) {
    if (10 * s.too_faint < s.measurements) worst = std::max(worst, s.deviation_db);
  }
  return worst;
}

double at(const std::vector<Sample>& samples, double snr_db) {
  return std::find_if(samples.begin(), samples.end(), [snr_db](const Sample& s) { return s.snr_db == snr_db; })->deviation_db;
}

void print_figures(const char* name, const std::vector<Sample>& samples) {
  std::printf("%-34s half of the looks are too faint at %5.2f dB; fluctuation %.2f dB at most, %.2f dB at 10 dB, %.2f dB at 20 dB\n", name,
              floor_of(samples), worst_of(samples), at(samples, 10.0), at(samples, 20.0));
}

void draw_curves(const std::filesystem::path& path, const std::filesystem::path& csv) {
  const std::string data = plot::quoted(csv.string());
  const auto curve = [&data](const char* name, int column, const char* style) {
    return data + " every ::1 using 2:(strcol(1) eq '" + name + "' && ($4 < 0.9 || " + std::to_string(column) + " == 4) ? $" +
           std::to_string(column) + " : 1/0) with linespoints " + style;
  };
  plot::draw(path,
             {.title = "What a look tells of the SNR",
              .size = "900,900",
              .commands = "set datafile separator comma\nset multiplot layout 3,1\nset grid\nset xrange [-10:40]\nset key top right\n"
                          "set ylabel 'standard deviation (dB)'\nset yrange [0:1.5]\n"
                          "set title 'Measured less true SNR, of looks that were not too faint'\nplot " +
                          curve("tone", 6, "pt 7 lc rgb '#3f8fc5' title 'tone, looks of 4 s'") + ", " +
                          curve("pulses", 6, "pt 5 lc rgb '#c77d2b' title 'pulses, loudest look of each'") +
                          "\nunset title\nset ylabel 'mean (dB)'\nset yrange [-1:6]\nplot " +
                          curve("tone", 5, "pt 7 lc rgb '#3f8fc5' notitle") + ", " + curve("pulses", 5, "pt 5 lc rgb '#c77d2b' notitle") +
                          "\nset ylabel 'share too faint'\nset yrange [0:1]\nset xlabel 'true SNR (dB)'\nplot " +
                          curve("tone", 4, "pt 7 lc rgb '#3f8fc5' notitle") + ", " + curve("pulses", 4, "pt 5 lc rgb '#c77d2b' notitle") +
                          "\nunset multiplot\n"});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: fluctuation CSV PNG [HOURS]\n");
    return 2;
  }
  const int seconds = static_cast<int>(3600.0 * (argc > 3 ? std::atof(argv[3]) : 3.0));
  const std::vector<Sample> tone = samples_of(detector::continuous_tone(), Tone{}, seconds);
  const std::vector<Sample> pulses = samples_of(detector::fin_whale(), kSong, seconds);
  const std::string head = "calls,true_snr_db,looks,too_faint_share,mean_error_db,standard_deviation_db\n";
  host::write_whole(argv[1], head + rows_of("tone", tone) + rows_of("pulses", pulses));
  draw_curves(argv[2], argv[1]);
  print_figures("a tone, looks of 4 s:", tone);
  print_figures("pulses, the loudest look of each:", pulses);
}
