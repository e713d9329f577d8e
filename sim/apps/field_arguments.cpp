#include "sim/apps/field_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "sim/sonar/fan.hpp"
#include "sim/sonar/gnuplot.hpp"

namespace earshot::apps {
namespace {

std::string picture_name(const std::string& path) {
  return sonar::is_picture_name(path) ? std::string() : path + ": a picture's name must end in .png or .svg";
}

/// CLI11's own lets NaN through.
CLI::Validator between(double lowest, double highest) {
  std::ostringstream range;
  range << lowest << " to " << highest;
  const std::string words = range.str();
  return {[=](std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && value >= lowest && value <= highest;
            return good ? std::string() : text + ": must be a number from " + words;
          },
          words};
}

void describe_place(CLI::App& app, FieldArguments& a) {
  app.add_option("--max-range-km", a.max_range_km, "how far from the source")->check(between(0.001, 2000.0))->capture_default_str();
  app.add_option("--depth,--receiver-depth-m", a.depth_m, "receiver depths in m; default: every --depth-spacing down to the sea floor")
      ->check(between(0.0, 12'000.0));
  app.add_option("--depth-spacing", a.depth_spacing_m, "m between receiver depths")->check(between(0.1, 10000.0))->capture_default_str();
  app.add_option("--bearing-deg", a.bearing_deg, "of the radial, clockwise from north; matters where charts are used")
      ->check(between(-360.0, 360.0))
      ->capture_default_str();
  app.add_option("--output-step-m", a.output_step_m,
                 "m between ranges written; default: a sixth of a wavelength, a third with --radials, --range-step if given")
      ->check(between(0.01, 100000.0));
}

void describe_fan(CLI::App& app, FieldArguments& a) {
  app.add_option("--radials", a.radials, "all around the source on so many bearings, at the depths of --receiver-depth-m")
      ->check(between(1, 100'000));
  app.add_flag("--map", a.map, "also lay SNR and probability of detection on a north-east grid; one receiver depth");
  app.add_option("--map-side-km", a.map_side_km, "side of that square; default: the largest within --max-range-km")
      ->check(between(0.001, 4000.0));
  app.add_option("--map-intervals", a.map_intervals, "grid steps along a side")->check(between(1, 10'000))->capture_default_str();
  app.add_option("--detection-threshold-db", a.detection_threshold_db, "SNR needed for detection; pictures change colour there")
      ->check(between(-200.0, 200.0))
      ->capture_default_str();
  app.add_option("--fluctuation-db", a.fluctuation_db, "standard deviation of the SNR in dB; 0: detection is certain or impossible")
      ->check(between(0.0, 100.0))
      ->capture_default_str();
}

void describe_sound(CLI::App& app, FieldArguments& a) {
  app.add_option("--band-hz", a.band_hz, "average intensity over the band LOW HIGH instead of the source's one frequency")
      ->expected(2)
      ->check(between(1.0, 10'000.0));
  app.add_option("--frequencies", a.frequencies, "how many equal parts of the band are computed, at their middles")
      ->check(between(1, 10'000))
      ->capture_default_str();
}

void describe_solver(CLI::App& app, FieldArguments& a) {
  app.add_option("--accuracy-db", a.accuracy_db, "of transmission loss, mean over ranges; chooses the solver's grid")
      ->check(between(0.0001, 10.0))
      ->capture_default_str();
  app.add_option("--range-step,--range-step-m", a.range_step_m, "m of one step of the solver; default: automatic")
      ->check(between(0.01, 10000.0));
  app.add_option("--depth-step,--depth-step-m", a.depth_step_m, "m of the solver's depth grid; default: automatic")
      ->check(between(0.001, 1000.0));
  app.add_option("--terms", a.terms, "poles of the propagator, 2 to 16; 0: automatic")->check(between(0, 16))->capture_default_str();
  app.add_option("--absorber-wavelengths", a.absorber_wavelengths, "thickness of the absorbing layer below the deepest layer of the seabed")
      ->check(between(0.5, 100.0))
      ->capture_default_str();
  app.add_option("--starter", a.starter, "self: a point source, exact at all angles; gaussian: a beam, weaker where it is steep")
      ->check(CLI::IsMember({"self", "gaussian"}))
      ->capture_default_str();
  app.add_flag("--check", a.check, "also run with both steps of the grid halved, and print by how many dB that changes the loss");
  app.add_option("--threads", a.threads, "processors used, default all; the result does not depend on it")->check(between(1, 4096));
}

/// Options that would be silently ignored are refused.
void refuse_beside_library(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const bool allowed = name == "--library" || name == "--output" || name == "--threads" || option->count() == 0;
    if (!allowed) throw std::invalid_argument(name + ": not with --library, whose file says all of it");
  }
}

/// `option` says something about `other`.
void bind(CLI::App& app, const char* option, const char* other) {
  app.get_option(option)->needs(app.get_option(other));
}

sonar::Band band_of(const FieldArguments& arguments, const ocean::Environment& environment) {
  if (arguments.band_hz.empty()) return {environment.source.frequency, environment.source.frequency};
  return {Hertz{arguments.band_hz[0]}, Hertz{arguments.band_hz[1]}, arguments.frequencies};
}

std::vector<double> receiver_depths(const FieldArguments& arguments, Meters sea_floor) {
  std::vector<double> depths = arguments.depth_m;
  for (const double depth : depths) {
    if (depth <= sea_floor.value) continue;
    std::ostringstream text;
    text << "--depth = " << depth << ": must be from 0 m to the sea floor, at its deepest " << sea_floor.value << " m";
    throw std::invalid_argument(text.str());
  }
  if (!depths.empty()) return depths;
  // Multiples, less one that falls on the sea floor but for rounding: a sum of tenths of a metre would miss it by a nanometre.
  const double spacings = std::max(1.0, std::ceil(sea_floor.value / arguments.depth_spacing_m - 1e-6));
  for (std::size_t i = 1; i < static_cast<std::size_t>(spacings); ++i) depths.push_back(static_cast<double>(i) * arguments.depth_spacing_m);
  depths.push_back(sea_floor.value);
  return depths;
}

}  // namespace

void describe(CLI::App& app, FieldArguments& a) {
  app.name("earshot field");
  app.description(
      "Computes how loud the source of an ocean is at every range and depth, and writes transmission loss and SNR as NetCDF (CF-1.8):\n"
      "along one bearing, all around (--radials), or for many sources of a region (--library).");
  app.footer(
      "Examples:\n"
      "  earshot field sim/ocean/environments/munk_flat.toml -o field.nc --plot field.png\n"
      "  earshot field OCEAN.toml -o fan.nc --radials 72 --receiver-depth-m 300 --map --fluctuation-db 6 --plot map.png\n"
      "  mpirun -n 4 earshot-field --library LIBRARY.toml -o library.nc     (started again after an interruption, it goes on)");
  app.add_option("ENVIRONMENT", a.environment, "TOML file that describes the ocean and the source");
  app.add_option("--library", a.library, "TOML file that names an environment and many positions; instead of ENVIRONMENT");
  app.add_option("-o,--output", a.output, "NetCDF file to write")->required();
  app.add_option("--plot", a.plot, "also draw the SNR, as .png or .svg")->check(picture_name);
  describe_place(app, a);
  describe_fan(app, a);
  describe_sound(app, a);
  describe_solver(app, a);
  bind(app, "--map", "--radials");
  bind(app, "--map-side-km", "--map");
  bind(app, "--map-intervals", "--map");
  bind(app, "--fluctuation-db", "--radials");
  bind(app, "--frequencies", "--band-hz");
  app.get_option("--bearing-deg")->excludes(app.get_option("--radials"));
  app.get_option("--depth-spacing")->excludes(app.get_option("--depth"));
}

void require_consistent(const CLI::App& app, const FieldArguments& a) {
  const auto refuse_unless = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument(what);
  };
  if (!a.library.empty()) refuse_beside_library(app);
  refuse_unless(a.environment.empty() != a.library.empty(), "ENVIRONMENT or --library is needed");
  refuse_unless(a.radials == 0 || !a.depth_m.empty(), "--radials needs --receiver-depth-m");
  refuse_unless(!a.map || a.depth_m.size() == 1, "--map needs one --receiver-depth-m");
  refuse_unless(a.radials == 0 || a.plot.empty() || a.map, "--plot with --radials needs --map");
  refuse_unless(std::is_sorted(a.depth_m.begin(), a.depth_m.end(), std::less_equal<>{}), "--depth must increase");
  refuse_unless(a.band_hz.empty() || a.band_hz[0] < a.band_hz[1],
                "--band-hz: the low frequency comes first, and must be less than the high one");
}

void require_writable_folder(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder)) throw std::runtime_error(file + ": cannot be written: there is no folder " + folder.string());
}

sonar::RadialPlan plan_radial(const FieldArguments& arguments, const ocean::Environment& environment, double default_step_wavelengths,
                              Meters deepest_sea_floor) {
  sonar::RadialPlan plan{.source_depth = environment.source.depth,
                         .depth_m = receiver_depths(arguments, deepest_sea_floor),
                         .range_step = {},
                         .ranges = 1,
                         .band = band_of(arguments, environment)};
  constexpr double kSoundSpeed_mps = 1500.0;
  const double automatic_m = default_step_wavelengths * kSoundSpeed_mps / plan.band.high.value;
  plan.range_step = Meters{arguments.output_step_m.value_or(arguments.range_step_m.value_or(automatic_m))};
  plan.ranges = std::max<std::size_t>(1, static_cast<std::size_t>(1000.0 * arguments.max_range_km / plan.range_step.value + 1e-9));
  const double values = static_cast<double>(std::max<std::size_t>(1, arguments.radials)) * static_cast<double>(plan.ranges) *
                        static_cast<double>(plan.depth_m.size());
  if (values > sonar::kMostFanValues) {
    std::ostringstream text;
    text << "--output-step-m = " << plan.range_step.value << ": radials x ranges x depths are " << values << " values, must not exceed "
         << sonar::kMostFanValues << "; take a longer step, fewer depths or a shorter range";
    throw std::invalid_argument(text.str());
  }
  plan.options.terms = arguments.terms;
  plan.options.absorber_wavelengths = arguments.absorber_wavelengths;
  plan.options.starter = arguments.starter == "gaussian" ? pe::Starter::kGaussian : pe::Starter::kSelf;
  plan.options.accuracy = Decibels{arguments.accuracy_db};
  if (arguments.range_step_m) plan.options.range_step = Meters{*arguments.range_step_m};
  if (arguments.depth_step_m) plan.options.depth_step = Meters{*arguments.depth_step_m};
  return plan;
}

sonar::Detector detector_of(const FieldArguments& arguments, const ocean::Environment& environment) {
  return {.source_level = environment.source.level,
          .noise_level = environment.noise_level,
          .detection_threshold = Decibels{arguments.detection_threshold_db},
          .fluctuation = Decibels{arguments.fluctuation_db}};
}

}  // namespace earshot::apps
