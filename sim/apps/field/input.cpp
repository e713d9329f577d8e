#include <cstddef>
#include <filesystem>
#include <ostream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/apps/field/modes.hpp"
#include "sim/ocean/file/radial_case_file.hpp"
#include "sim/ocean/with_source.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::field {
namespace {

ocean::RadialCase case_in(const std::filesystem::path& path) {
  if (ocean::is_radial_case_name(path)) return ocean::load_radial_case(path);
  return {.environment = search::load_scenario(path).environment};
}

void require_one_source(const std::filesystem::path& path, const ocean::RadialCase& read) {
  const std::size_t count = read.source_depth_m.size();
  if (count > 1)
    throw host::BadInput(path.string() + ": has " + host::counted(count, "source depth") + ", from " +
                         host::shortest(read.source_depth_m.front()) + " to " + host::shortest(read.source_depth_m.back()) +
                         " m: a field has one; choose it with --source-depth-m");
}

}  // namespace

ocean::Environment environment_in(const std::filesystem::path& path) {
  ocean::RadialCase read = case_in(path);
  require_one_source(path, read);
  return read.environment;
}

ocean::RadialCase case_of(const FieldArguments& arguments) {
  ocean::RadialCase asked = case_in(arguments.environment);
  if (!arguments.source_depth_m) {
    require_one_source(arguments.environment, asked);
    return asked;
  }
  asked.environment =
      ocean::with_source(asked.environment, asked.environment.source.frequency, Meters{*arguments.source_depth_m}, "--source-depth-m");
  return asked;
}

void print_level_note(const FieldArguments& arguments) {
  if (ocean::is_radial_case_name(arguments.environment) && format_of(arguments) == OutputFormat::kNetcdf)
    program::print() << "levels:  " << arguments.environment
                     << " names none: SNR is minus the loss, pictures want --detection-threshold-db -70 or so\n";
}

}  // namespace earshot::field
