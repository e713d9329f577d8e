// What a vehicle under way makes of sound: searches of the default mission for a tone, flown on what the vehicle's detector measures, held
// against the same searches flown on the modelled SNR, and the SNRs measured against those modelled.
// usage: flights MISSION ENVIRONMENT CSV PNG [SEEDS]     seeds 1 to SEEDS (default 100)

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/host/file/output_file.hpp"
#include "sim/plot/gnuplot.hpp"
#include "tests/hearing/heard_search.hpp"

namespace {

using namespace earshot;
using hearing::Measurement;

constexpr std::array kIntegrations_s{4.0, 1.0, 2.0, 8.0};  ///< the mission's own first: its policy flies on it
constexpr double kWindow_s = 30.0;                         ///< that the shipped policy hears the mean of
constexpr double kBin_db = 2.0;

/// Measured less modelled SNR of what was modelled within one bin.
struct Bin {
  std::size_t count = 0;
  std::size_t too_faint = 0;
  double sum_db = 0.0;
  double squares_db = 0.0;

  void add(double error_db) {
    ++count;
    sum_db += error_db;
    squares_db += error_db * error_db;
  }
  [[nodiscard]] double measured() const { return static_cast<double>(count - too_faint); }
  [[nodiscard]] double mean_db() const { return sum_db / measured(); }
  [[nodiscard]] double deviation_db() const { return std::sqrt(std::max(0.0, squares_db / measured() - mean_db() * mean_db())); }
  [[nodiscard]] double too_faint_share() const { return static_cast<double>(too_faint) / static_cast<double>(count); }
};

/// Bins of modelled SNR.
class Curve {
 public:
  static constexpr double kLowest_db = -20.0;
  static constexpr std::size_t kBins = 35;

  void add(double modelled_db, double measured_db, bool too_faint) {
    const double place = std::floor((modelled_db - kLowest_db) / kBin_db);
    if (!(place >= 0.0 && place < static_cast<double>(kBins))) return;
    Bin& bin = bins_[static_cast<std::size_t>(place)];
    if (too_faint) {
      ++bin.count;
      ++bin.too_faint;
    } else {
      bin.add(measured_db - modelled_db);
    }
  }
  [[nodiscard]] static double middle_db(std::size_t bin) { return kLowest_db + (static_cast<double>(bin) + 0.5) * kBin_db; }
  [[nodiscard]] const std::array<Bin, kBins>& bins() const { return bins_; }

  /// The SNR at which half of the measurements are too faint, in line between bins.
  [[nodiscard]] double floor_db() const {
    for (std::size_t i = kBins - 1; i > 0; --i) {
      if (bins_[i].count == 0 || bins_[i - 1].count == 0) continue;
      const double below = bins_[i].too_faint_share();
      const double above = bins_[i - 1].too_faint_share();
      if (below < 0.5 && above >= 0.5) return std::lerp(middle_db(i - 1), middle_db(i), (above - 0.5) / (above - below));
    }
    return std::nan("");
  }
  /// Over all of what was modelled between two SNRs.
  [[nodiscard]] double deviation_db(double low_db, double high_db) const {
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < kBins; ++i) {
      const Bin& bin = bins_[i];
      if (bin.measured() < 2.0 || middle_db(i) < low_db || middle_db(i) >= high_db) continue;
      squares += bin.measured() * bin.deviation_db() * bin.deviation_db();
      count += bin.measured();
    }
    return std::sqrt(squares / count);
  }

 private:
  std::array<Bin, kBins> bins_{};
};

/// Of one integration time: its measurements, and their means over windows in which each was measured.
struct Curves {
  Curve measurements;
  Curve windows;

  void add(const std::vector<Measurement>& measurements_of_search) {
    double begin_s = measurements_of_search.empty() ? 0.0 : measurements_of_search.front().time_s;
    double measured_db = 0.0;
    double modelled_db = 0.0;
    double count = 0.0;
    bool is_whole = true;
    for (const Measurement& measurement : measurements_of_search) {
      measurements.add(measurement.modelled_db, measurement.snr_db, measurement.too_faint);
      if (measurement.time_s >= begin_s + kWindow_s) {
        if (is_whole && count > 0.0) windows.add(modelled_db / count, measured_db / count, false);
        begin_s = measurement.time_s;
        measured_db = modelled_db = count = 0.0;
        is_whole = true;
      }
      is_whole = is_whole && !measurement.too_faint;
      measured_db += measurement.snr_db;
      modelled_db += measurement.modelled_db;
      count += 1.0;
    }
  }
};

std::string rows_of(double integration_s, const char* what, const Curve& curve) {
  std::string text;
  for (std::size_t i = 0; i < Curve::kBins; ++i) {
    const Bin& bin = curve.bins()[i];
    if (bin.count < 20) continue;
    std::array<char, 160> row{};
    (void)std::snprintf(row.data(), row.size(), "%s of %g s,%g,%zu,%.4f,", what, integration_s, Curve::middle_db(i), bin.count,
                        bin.too_faint_share());
    text += row.data();
    if (bin.measured() >= 20.0) {
      (void)std::snprintf(row.data(), row.size(), "%.3f,%.3f", bin.mean_db(), bin.deviation_db());
      text += row.data();
    } else {
      text += ",";
    }
    text += "\n";
  }
  return text;
}

void draw_curves(const std::filesystem::path& path, const std::filesystem::path& csv) {
  constexpr std::array kColours{"#3f8fc5", "#c77d2b", "#7a9a3a", "#8e5aa8"};
  const std::string data = plot::quoted(csv.string());
  std::string deviations;
  std::string shares;
  for (std::size_t i = 0; i < kIntegrations_s.size(); ++i) {
    const std::string name = std::to_string(static_cast<int>(kIntegrations_s[i])) + " s";
    const auto curve = [&](const char* what, int column, const std::string& style) {
      return data + " every ::1 using 2:(strcol(1) eq '" + what + " of " + name + "' ? $" + std::to_string(column) +
             " : 1/0) with linespoints " + style + " lc rgb '" + kColours.at(i) + "'";
    };
    deviations += (i == 0 ? "" : ", ") + curve("look", 6, "pt 7") + " title 'looks of " + name + "'";
    if (i == 0) deviations += ", " + curve("mean of 30 s", 6, "pt 6 dt 2") + " title 'means of 30 s of looks of " + name + "'";
    shares += (i == 0 ? "" : ", ") + curve("look", 4, "pt 7") + " notitle";
  }
  plot::draw(path, {.title = "Measured less modelled SNR of a vehicle under way",
                    .size = "900,700",
                    .commands = "set datafile separator comma\nset multiplot layout 2,1\nset grid\nset xrange [-10:40]\nset key top right\n"
                                "set ylabel 'standard deviation (dB)'\nset yrange [0:2]\n"
                                "set title 'Measured less modelled SNR of a vehicle under way, of looks that were not too faint'\nplot " +
                                deviations +
                                "\nunset title\nset ylabel 'share too faint'\nset yrange [0:1]\nset xlabel 'modelled SNR (dB)'\nplot " +
                                shares + "\nunset multiplot\n"});
}

detector::SoundSettings listening_of(const detector::SoundSettings& mission, double integration_s) {
  detector::SoundSettings settings = mission;
  settings.integration_time = Duration::milliseconds(static_cast<std::int64_t>(1e3 * integration_s));
  settings.longest_pause = Duration::milliseconds(static_cast<std::int64_t>(2e3 * integration_s));
  return settings;
}

struct Total {
  int found = 0;
  double reward = 0.0;
  void add(const hearing::Search& search) {
    found += search.is_found ? 1 : 0;
    reward += search.reward;
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "usage: flights MISSION ENVIRONMENT CSV PNG [SEEDS]\n");
    return 2;
  }
  const fly::FlightPlan plan = [&] {
    fly::FlightPlan made = fly::load_flight_plan(argv[1], argv[2]);
    made.search.placement = search::SourcePlacement::kChanging;
    return made;
  }();
  const search::World world = search::assemble(plan.scenario, plan.search, plan.mission.mission.search_depth);
  const host::SignedSearch flown = host::MissionVerifier().load_search(plan.mission);
  const hearing::Rig rig{.plan = plan, .world = world, .flown = flown};
  std::vector<detector::SoundSettings> detectors;
  for (const double integration_s : kIntegrations_s) detectors.push_back(listening_of(*plan.mission.hearing, integration_s));
  const int seeds = argc > 5 ? std::atoi(argv[5]) : 100;
  std::array<Curves, kIntegrations_s.size()> curves;
  Total heard;
  Total told;
  for (int seed = 1; seed <= seeds; ++seed) {
    const hearing::Search search = hearing::fly_search(rig, detectors, static_cast<std::uint64_t>(seed));
    heard.add(search);
    told.add(hearing::fly_search(rig, {}, static_cast<std::uint64_t>(seed)));
    for (std::size_t i = 0; i < curves.size(); ++i) curves[i].add(search.measurements[i]);
  }
  std::string text = "what,modelled_snr_db,count,too_faint_share,mean_error_db,standard_deviation_db\n";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    text += rows_of(kIntegrations_s[i], "look", curves[i].measurements) + rows_of(kIntegrations_s[i], "mean of 30 s", curves[i].windows);
    std::printf(
        "looks of %g s: half are too faint at %5.2f dB; fluctuation %.2f dB from 4 to 8 dB, %.2f dB from 8 to 12 dB, %.2f dB from 12 dB "
        "on; "
        "of the mean of 30 s %.2f, %.2f, %.2f dB\n",
        kIntegrations_s[i], curves[i].measurements.floor_db(), curves[i].measurements.deviation_db(4, 8),
        curves[i].measurements.deviation_db(8, 12), curves[i].measurements.deviation_db(12, 100), curves[i].windows.deviation_db(4, 8),
        curves[i].windows.deviation_db(8, 12), curves[i].windows.deviation_db(12, 100));
  }
  host::write_whole(argv[3], text);
  draw_curves(argv[4], argv[3]);
  std::printf("by sound:          %d of %d found, mean reward %.2f\nby modelled SNR:   %d of %d found, mean reward %.2f\n", heard.found,
              seeds, heard.reward / seeds, told.found, seeds, told.reward / seeds);
}
