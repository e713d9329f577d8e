#include "sim/apps/field_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace earshot::apps {
namespace {

std::string picture_name(const std::string& path) {
  const auto extension = std::filesystem::path(path).extension();
  return extension == ".png" || extension == ".svg" ? std::string() : path + ": a picture's name must end in .png or .svg";
}

/// CLI::Range lets NaN pass.
CLI::Validator number_between(double low, double high) {
  std::ostringstream range;
  range << low << " to " << high;
  const auto check = [low, high, allowed = range.str()](const std::string& text) {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && value >= low && value <= high ? std::string() : text + ": must be a number from " + allowed;
  };
  return {check, range.str()};
}

void describe_place(CLI::App& app, FieldArguments& a) {
  app.add_option("--max-range-km", a.max_range_km, "how far from the source")->check(number_between(0.001, 2000.0))->capture_default_str();
  app.add_option("--depth,--receiver-depth-m", a.depth_m, "receiver depths in m; default: every --depth-spacing down to the sea floor")
      ->check(number_between(0.0, 12'000.0));
  app.add_option("--depth-spacing", a.depth_spacing_m, "m between receiver depths")
      ->check(number_between(0.1, 10000.0))
      ->capture_default_str();
  app.add_option("--bearing-deg", a.bearing_deg, "of the radial, clockwise from north; matters where charts are used")
      ->check(number_between(-360.0, 360.0))
      ->capture_default_str();
  app.add_option("--output-step-m", a.output_step_m,
                 "m between ranges written; default: a sixth of a wavelength, a third with --radials, --range-step if given")
      ->check(number_between(0.01, 100000.0));
}

void describe_fan(CLI::App& app, FieldArguments& a) {
  app.add_option("--radials", a.radials, "all around the source on so many bearings, at the depths of --receiver-depth-m")
      ->check(CLI::Range(1, 100'000));
  app.add_flag("--map", a.map, "also lay SNR and probability of detection on a north-east grid; one receiver depth");
  app.add_option("--map-side-km", a.map_side_km, "side of that square; default: the largest within --max-range-km")
      ->check(number_between(0.001, 4000.0));
  app.add_option("--map-intervals", a.map_intervals, "grid steps along a side")->check(CLI::Range(1, 10'000))->capture_default_str();
  app.add_option("--detection-threshold-db", a.detection_threshold_db, "SNR needed for detection; pictures change colour there")
      ->check(number_between(-200.0, 200.0))
      ->capture_default_str();
  app.add_option("--fluctuation-db", a.fluctuation_db, "standard deviation of the SNR in dB; 0: detection is certain or impossible")
      ->check(number_between(0.0, 100.0))
      ->capture_default_str();
}

void describe_sound(CLI::App& app, FieldArguments& a) {
  app.add_option("--band-hz", a.band_hz, "average intensity over the band LOW HIGH instead of the source's one frequency")
      ->expected(2)
      ->check(number_between(1.0, 10'000.0));
  app.add_option("--frequencies", a.frequencies, "how many equal parts of the band are computed, at their middles")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
}

void describe_solver(CLI::App& app, FieldArguments& a) {
  app.add_option("--accuracy-db", a.accuracy_db, "of transmission loss, mean over ranges; chooses the solver's grid")
      ->check(number_between(0.0001, 10.0))
      ->capture_default_str();
  app.add_option("--range-step,--range-step-m", a.range_step_m, "m of one step of the solver; default: automatic")
      ->check(number_between(0.01, 10000.0));
  app.add_option("--depth-step,--depth-step-m", a.depth_step_m, "m of the solver's depth grid; default: automatic")
      ->check(number_between(0.001, 1000.0));
  app.add_option("--terms", a.terms, "poles of the propagator, 2 to 16; 0: automatic")->check(CLI::Range(0, 16))->capture_default_str();
  app.add_option("--absorber-wavelengths", a.absorber_wavelengths, "thickness of the absorbing layer below the deepest layer of the seabed")
      ->check(number_between(0.5, 100.0))
      ->capture_default_str();
  app.add_option("--starter", a.starter, "self: a point source, exact at all angles; gaussian: a beam, weaker where it is steep")
      ->check(CLI::IsMember({"self", "gaussian"}))
      ->capture_default_str();
  app.add_flag("--check", a.check, "also run with both steps of the grid halved, and print by how many dB that changes the loss");
  app.add_option("--threads", a.threads, "processors used, default all; the result does not depend on it")->check(CLI::Range(1, 4096));
}

/// Options that would be silently ignored are refused.
void exclude_from(CLI::Option& mode, CLI::App& app, const std::vector<std::string>& but) {
  for (CLI::Option* option : app.get_options()) {
    const bool allowed = std::any_of(but.begin(), but.end(), [option](const std::string& name) { return option->check_name(name); });
    if (!allowed && option != &mode) mode.excludes(option);
  }
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
  for (double depth = arguments.depth_spacing_m; depth < sea_floor.value; depth += arguments.depth_spacing_m) depths.push_back(depth);
  depths.push_back(sea_floor.value);
  return depths;
}

}  // namespace

void describe(CLI::App& app, FieldArguments& a) {
  app.description(
      "Computes how loud the source of an ocean is at every range and depth, and writes transmission loss and SNR as NetCDF (CF-1.8):\n"
      "along one bearing, all around (--radials), or for many sources of a region (--library).");
  app.footer(
      "Examples:\n"
      "  earshot field sim/ocean/environments/munk_flat.toml -o field.nc --plot field.png\n"
      "  earshot field OCEAN.toml -o fan.nc --radials 72 --receiver-depth-m 300 --map --fluctuation-db 6 --plot map.png\n"
      "  mpirun -n 4 earshot-field --library LIBRARY.toml -o library.nc     (started again after an interruption, it goes on)");
  app.add_option("ENVIRONMENT", a.environment, "TOML file that describes the ocean and the source");
  CLI::Option* library =
      app.add_option("--library", a.library, "TOML file that names an environment and many positions; instead of ENVIRONMENT");
  app.add_option("-o,--output", a.output, "NetCDF file to write")->required();
  app.add_option("--plot", a.plot, "also draw the SNR, as .png or .svg")->check(picture_name);
  describe_place(app, a);
  describe_fan(app, a);
  describe_sound(app, a);
  describe_solver(app, a);
  exclude_from(*library, app, {"--help", "--output", "--threads"});  // all else stands in its file
}

void require_consistent(const FieldArguments& a) {
  const auto refuse_unless = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument(what);
  };
  refuse_unless(a.environment.empty() != a.library.empty(), "ENVIRONMENT or --library is needed");
  refuse_unless(a.radials == 0 || !a.depth_m.empty(), "--radials needs --receiver-depth-m");
  refuse_unless(!a.map || (a.radials > 0 && a.depth_m.size() == 1), "--map needs --radials and one --receiver-depth-m");
  refuse_unless(a.map || !a.map_side_km, "--map-side-km needs --map");
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
