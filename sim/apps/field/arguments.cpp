#include "sim/apps/field/arguments.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/file_type.hpp"
#include "sim/plot/gnuplot.hpp"
#include "sim/sonar/model_files/shade_file.hpp"
#include "sim/sonar/model_files/tl_grid.hpp"

namespace earshot::field {
namespace {

std::string picture_name(const std::string& path) {
  return plot::is_picture_name(path) ? std::string() : path + ": a picture's name must end in .png or .svg";
}

void describe_place(program::CommandLine& line, FieldArguments& a) {
  line.option("--max-range-km", &a.max_range_km, "how far from the source; default: 25, or as far as an .env or ram.in file goes")
      .between(0.001, 2000.0);
  line.option("--source-depth-m", &a.source_depth_m, "of the source, in place of the file's").between(0.001, 12'000.0);
  line.option("--depth,--receiver-depth-m", &a.depth_m,
              "receiver depths in m; default: those of an .env or ram.in file, else every --depth-spacing down to the sea floor")
      .between(0.0, 12'000.0);
  line.option("--depth-spacing", &a.depth_spacing_m,
              "m between receiver depths; default: 10, in water of less than 1000 m a hundredth of it or less")
      .between(0.1, 10000.0);
  line.option("--bearing-deg", &a.bearing_deg, "of the radial, clockwise from north; matters where charts are used")
      .between(-360.0, 360.0)
      .shows_default();
  line.option("--output-step-m", &a.output_step_m,
              "m between ranges written; default: a sixth of a wavelength, a third with --radials, --range-step if given")
      .between(0.01, 100000.0);
}

void describe_fan(program::CommandLine& line, FieldArguments& a) {
  line.option("--radials", &a.radials, "all around the source on so many bearings, at the depths of --receiver-depth-m").from(1, 100'000);
  line.flag("--map", &a.map, "also lay SNR and probability of detection on a north-east grid; one receiver depth");
  line.option("--map-side-km", &a.map_side_km, "side of that square; default: the largest within --max-range-km").between(0.001, 4000.0);
  line.option("--map-intervals", &a.map_intervals, "grid steps along a side").from(1, 10'000).shows_default();
  line.option("--detection-threshold-db", &a.detection_threshold_db, "SNR needed for detection; pictures change colour there")
      .between(-200.0, 200.0)
      .shows_default();
  line.option("--fluctuation-db", &a.fluctuation_db, "standard deviation of the SNR in dB; 0: detection is certain or impossible")
      .between(0.0, 100.0)
      .shows_default();
}

void describe_sound(program::CommandLine& line, FieldArguments& a) {
  line.option("--band-hz", &a.band_hz, "average intensity over the band LOW HIGH instead of the source's one frequency")
      .takes(2, 2)
      .between(1.0, 10'000.0);
  line.option("--frequencies", &a.frequencies, "how many equal parts of the band are computed, at their middles")
      .from(1, 10'000)
      .shows_default();
}

void describe_solver(program::CommandLine& line, FieldArguments& a) {
  line.option("--accuracy-db", &a.accuracy_db, "of transmission loss, mean over ranges; chooses the solver's grid")
      .between(0.0001, 10.0)
      .shows_default();
  line.option("--range-step,--range-step-m", &a.range_step_m, "m of one step of the solver; default: automatic").between(0.01, 10000.0);
  line.option("--depth-step,--depth-step-m", &a.depth_step_m, "m of the solver's depth grid; default: automatic").between(0.001, 1000.0);
  line.option("--terms", &a.terms, "poles of the propagator, 2 to 16; 0: automatic").from(0, 16).shows_default();
  line.option("--absorber-wavelengths", &a.absorber_wavelengths,
              "thickness of the absorber below the deepest layer of the seabed; default: after seabed and range")
      .between(0.5, 10'000.0);
  line.option("--starter", &a.starter, "self: a point source, exact at all angles; gaussian: a beam, weaker where it is steep")
      .one_of({"self", "gaussian"})
      .shows_default();
  line.flag("--check", &a.check,
            "also run with both steps of the grid halved and a thicker absorber, and print by how many dB that changes the loss");
  line.option("--threads", &a.threads, "processors used, default all; the result does not depend on it").from(1, 4096);
}

/// Options that would be silently ignored are refused.
void refuse_beside_library(const program::CommandLine& line) {
  for (const std::string& option : line.given()) {
    if (option != "--library" && option != "--output" && option != "--threads" && option != "--force")
      throw std::invalid_argument(option + ": not with --library, whose file states all of it");
  }
}

/// `option` says something about `other`.
void bind(const program::CommandLine& line, const char* option, const char* other) {
  line.at(option).needs(line.at(other));
}

ocean::Band band_of(const FieldArguments& arguments, const ocean::Environment& environment) {
  if (arguments.band_hz.empty()) return {environment.source.frequency, environment.source.frequency};
  return {Hertz{arguments.band_hz[0]}, Hertz{arguments.band_hz[1]}, arguments.frequencies};
}

Meters max_range_of(const FieldArguments& arguments, const ocean::RadialCase& asked) {
  constexpr double kDefault_km = 25.0;
  if (arguments.max_range_km) return Meters{1000.0 * *arguments.max_range_km};
  return asked.furthest().value_or(Meters{1000.0 * kDefault_km});
}

const host::OutputKind& kind_of(OutputFormat format) {
  switch (format) {
    case OutputFormat::kShade:
      return sonar::model_files::kShadeOutput;
    case OutputFormat::kGrid:
      return sonar::model_files::kGridOutput;
    case OutputFormat::kNetcdf:
      break;
  }
  return host::kNetcdfOutput;
}

}  // namespace

void describe(program::CommandLine& line, FieldArguments& a) {
  line.footer(
      "Examples:\n"
      "  earshot field sim/ocean/environments/munk_flat.toml -o field.nc --plot field.png\n"
      "  earshot field MUNK.env -o munk.shd\n"
      "  earshot field OCEAN.toml -o fan.nc --radials 72 --receiver-depth-m 300 --map --fluctuation-db 6 --plot map.png\n"
      "  mpirun -n 4 earshot-field --library LIBRARY.toml -o library.nc     (started again after an interruption, it goes on)");
  line.option("ENVIRONMENT", &a.environment,
              "TOML file that describes the ocean and the source, or an .env file of the Acoustics Toolbox, or a ram.in file of RAM");
  line.option("--library", &a.library, "TOML file that names an environment and many positions; instead of ENVIRONMENT");
  line.option("-o,--output", &a.output,
              "NetCDF file to write; NAME.shd: a shade file of the Acoustics Toolbox; NAME.grid: a tl.grid file of RAM")
      .required();
  line.option("--shd-layout", &a.shd_layout,
              "of a shade file: ranges in double precision, or in single, as older programs and arlpy have them")
      .one_of({"double", "single"})
      .shows_default();
  line.option("--plot", &a.plot, "also draw the SNR, as .png or .svg; with --radials it draws the map, and needs --map")
      .checked(picture_name);
  line.flag("--force", &a.force, "replace a file that is there already, of whatever kind it is");
  describe_place(line, a);
  describe_fan(line, a);
  describe_sound(line, a);
  describe_solver(line, a);
  bind(line, "--map", "--radials");
  bind(line, "--map-side-km", "--map");
  bind(line, "--map-intervals", "--map");
  bind(line, "--fluctuation-db", "--radials");
  bind(line, "--frequencies", "--band-hz");
  line.at("--bearing-deg").excludes(line.at("--radials"));
  line.at("--depth-spacing").excludes(line.at("--depth"));
}

void require_consistent(const program::CommandLine& line, const FieldArguments& a) {
  const auto refuse_unless = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument(what);
  };
  if (!a.library.empty()) refuse_beside_library(line);
  refuse_unless(a.environment.empty() != a.library.empty(), "ENVIRONMENT or --library is needed");
  refuse_unless(a.radials == 0 || !a.depth_m.empty(), "--radials needs --receiver-depth-m");
  refuse_unless(!a.map || a.depth_m.size() == 1, "--map needs one --receiver-depth-m");
  refuse_unless(a.radials == 0 || a.plot.empty() || a.map, "--plot with --radials needs --map");
  refuse_unless(std::is_sorted(a.depth_m.begin(), a.depth_m.end(), std::less_equal<>{}), "--depth must increase");
  const std::vector<std::string> given = line.given();
  const OutputFormat format = format_of(a);
  refuse_unless(format == OutputFormat::kShade || std::find(given.begin(), given.end(), "--shd-layout") == given.end(),
                "--shd-layout needs --output NAME.shd");
  refuse_unless(format == OutputFormat::kNetcdf || (a.radials == 0 && a.library.empty()),
                "--output: a .shd or .grid file holds one radial");
  refuse_unless(format != OutputFormat::kShade || a.band_hz.empty(),
                "--output: a shade file (.shd) holds the pressure of one frequency, not of --band-hz");
  refuse_unless(a.band_hz.empty() || a.band_hz[0] < a.band_hz[1],
                "--band-hz: the low frequency comes first, and must be less than the high one");
}

void require_writable(const FieldArguments& arguments, const ocean::Environment& environment) {
  host::DistinctFiles read;
  if (!arguments.library.empty()) read.read("--library", arguments.library);
  read.read("ENVIRONMENT", environment.files.front());
  read.read("a file of ENVIRONMENT", environment.files);
  std::vector<host::Output> outputs{{"--output", arguments.output, kind_of(format_of(arguments))}};
  if (!arguments.plot.empty()) outputs.push_back({"--plot", arguments.plot, host::picture_kind(arguments.plot)});
  host::require_writable(std::move(read), outputs, host::replaced_by(arguments.force));
}

sonar::RadialRequest request_of(const FieldArguments& arguments, const ocean::RadialCase& asked, double default_step_wavelengths) {
  const auto metres = [](std::optional<double> value) { return value ? std::optional(Meters{*value}) : std::nullopt; };
  sonar::RadialRequest request{.max_range = max_range_of(arguments, asked),
                               .depth_m = arguments.depth_m,
                               .depth_spacing = metres(arguments.depth_spacing_m),
                               .output_step = metres(arguments.output_step_m),
                               .default_step_wavelengths = default_step_wavelengths,
                               .band = band_of(arguments, asked.environment)};
  request.options.terms = arguments.terms;
  request.options.absorber_wavelengths = arguments.absorber_wavelengths;
  request.options.starter = arguments.starter == "gaussian" ? pe::Starter::kGaussian : pe::Starter::kSelf;
  request.options.accuracy = Decibels{arguments.accuracy_db};
  request.options.range_step = metres(arguments.range_step_m);
  request.options.depth_step = metres(arguments.depth_step_m);
  return request;
}

sonar::model_files::ReceiverGrid grid_of(const FieldArguments& arguments, const ocean::RadialCase& asked) {
  sonar::model_files::ReceiverGrid grid{.depth_m = asked.receiver_depth_m, .range_m = asked.receiver_range_m};
  if (!arguments.depth_m.empty() || arguments.depth_spacing_m) grid.depth_m.clear();
  if (arguments.max_range_km || arguments.output_step_m || arguments.range_step_m) grid.range_m.clear();
  return grid;
}

OutputFormat format_of(const FieldArguments& arguments) {
  const std::string suffix = host::suffix_of(arguments.output);
  if (suffix == ".shd") return OutputFormat::kShade;
  return suffix == ".grid" ? OutputFormat::kGrid : OutputFormat::kNetcdf;
}

std::string option_of(sonar::BadRequest::What what) {
  switch (what) {
    case sonar::BadRequest::What::kDepth:
      return "--depth";
    case sonar::BadRequest::What::kOutputStep:
      return "--output-step-m";
    case sonar::BadRequest::What::kBearing:
      return "--bearing-deg";
    case sonar::BadRequest::What::kRadials:
      return "--radials";
  }
  return "";
}

sonar::Detector detector_of(const FieldArguments& arguments, const ocean::Environment& environment) {
  return {.source_level = environment.source.level,
          .noise_level = environment.noise_level,
          .detection_threshold = Decibels{arguments.detection_threshold_db},
          .fluctuation = Decibels{arguments.fluctuation_db}};
}

}  // namespace earshot::field
