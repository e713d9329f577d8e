#include <CLI/CLI.hpp>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config_file/table_reader.hpp"
#include "sim/apps/progress_bar.hpp"
#include "sim/ocean/environment_file.hpp"
#include "sim/sonar/field_file.hpp"
#include "sim/sonar/field_plot.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace {

using earshot::Decibels;
using earshot::Meters;

struct Arguments {
  std::string environment;
  std::string output;
  std::string plot;
  double max_range_km = 25.0;
  std::vector<double> depth_m;
  double depth_spacing_m = 10.0;
  std::optional<double> range_step_m;
  std::optional<double> depth_step_m;
  std::size_t terms = 0;
  double detection_threshold_db = 10.0;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Computes how loud the source of an ocean is at every range and depth, and writes transmission loss and SNR as NetCDF (CF-1.8).");
  app.footer("Example: earshot field sim/ocean/environments/munk_flat.toml -o field.nc --plot field.png");
  app.add_option("ENVIRONMENT", arguments.environment, "TOML file that describes the ocean and the source")->required();
  app.add_option("-o,--output", arguments.output, "NetCDF file to write")->required();
  app.add_option("--max-range-km", arguments.max_range_km, "how far from the source")
      ->check(CLI::Range(0.001, 2000.0))
      ->capture_default_str();
  app.add_option("--depth", arguments.depth_m, "receiver depths in m; default: every --depth-spacing down to the sea floor");
  app.add_option("--depth-spacing", arguments.depth_spacing_m, "m between receiver depths")
      ->check(CLI::Range(0.1, 10000.0))
      ->capture_default_str();
  app.add_option("--range-step", arguments.range_step_m, "m of one step of the solver, and between ranges written; default: automatic")
      ->check(CLI::Range(0.01, 10000.0));
  app.add_option("--depth-step", arguments.depth_step_m, "m of the solver's depth grid; default: automatic")
      ->check(CLI::Range(0.001, 1000.0));
  app.add_option("--terms", arguments.terms, "poles of the propagator, 2 to 16; 0: automatic")
      ->check(CLI::Range(0, 16))
      ->capture_default_str();
  app.add_option("--plot", arguments.plot, "also draw the SNR, as .png or .svg")->check([](const std::string& path) {
    const auto extension = std::filesystem::path(path).extension();
    return extension == ".png" || extension == ".svg" ? std::string() : path + ": a picture's name must end in .png or .svg";
  });
  app.add_option("--detection-threshold-db", arguments.detection_threshold_db, "SNR at which the plot turns from cold to warm colours")
      ->capture_default_str();
}

std::vector<double> receiver_depths(const Arguments& arguments, Meters sea_floor) {
  if (!arguments.depth_m.empty()) return arguments.depth_m;
  std::vector<double> depths;
  for (double depth = arguments.depth_spacing_m; depth < sea_floor.value; depth += arguments.depth_spacing_m) depths.push_back(depth);
  depths.push_back(sea_floor.value);
  return depths;
}

std::string command_line(int argc, char** argv) {
  std::string line = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

/// Refused before the work, not after it.
void require_writable_folder(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder)) throw std::runtime_error(file + ": cannot be written: there is no folder " + folder.string());
}

void run(const Arguments& arguments, const std::string& history) {
  const auto environment = earshot::ocean::load_environment(arguments.environment);
  require_writable_folder(arguments.output);
  if (!arguments.plot.empty()) require_writable_folder(arguments.plot);

  earshot::pe::Options options{.depth_step = {}, .range_step = {}, .terms = arguments.terms};
  if (arguments.range_step_m) options.range_step = Meters{*arguments.range_step_m};
  if (arguments.depth_step_m) options.depth_step = Meters{*arguments.depth_step_m};

  earshot::apps::ProgressBar bar("field");
  const auto field =
      earshot::sonar::compute_sonar_field(environment, options, receiver_depths(arguments, environment.seabed.depth),
                                          Meters{1000.0 * arguments.max_range_km}, [&bar](double fraction) { bar.update(fraction); });
  earshot::sonar::write_field(arguments.output, field, environment, history);
  if (!arguments.plot.empty()) {
    earshot::sonar::plot_field(arguments.plot, field, environment.name, Decibels{arguments.detection_threshold_db});
  }
  std::cout << "ocean:   " << environment.name << ", source of " << environment.source.frequency.value << " Hz at "
            << environment.source.depth.value << " m\n"
            << "field:   " << field.range_m.size() << " ranges to " << field.range_m.back() / 1000.0 << " km, " << field.depth_m.size()
            << " depths from " << field.depth_m.front() << " to " << field.depth_m.back() << " m\n"
            << "written: " << arguments.output << (arguments.plot.empty() ? "" : ", " + arguments.plot) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  try {
    run(arguments, command_line(argc, argv));
  } catch (const std::exception& e) {
    std::cerr << "earshot field: " << e.what() << '\n';
    return 2;
  }
  return 0;
}
