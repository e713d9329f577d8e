#include <limits>
#include <span>
#include <vector>

#include "sim/apps/listen/outputs.hpp"
#include "sim/listening/levels.hpp"
#include "sim/netcdf/conventions.hpp"
#include "sim/netcdf/writer.hpp"

namespace earshot::listen {
namespace {

using netcdf::Attributes;
using netcdf::Type;
using netcdf::Writer;

void write_axis(Writer& file, const std::string& name, const std::vector<double>& values, const Attributes& attributes) {
  file.variable(name, Type::kDouble, {name}, attributes);
  file.write(name, values);
}

void write_floats(Writer& file, const std::string& name, const std::vector<std::string>& shape, const Attributes& attributes,
                  std::span<const float> values) {
  file.variable(name, Type::kFloat, shape, attributes);
  file.attribute(name, "_FillValue", std::numeric_limits<double>::quiet_NaN());
  file.compress(name);
  file.write(name, values);
}

/// What the axis of time is called. In CF a "time" counts since a date.
std::string time_axis(const listening::Levels& levels) {
  return levels.is_dated ? "time" : "elapsed_time";
}

/// The begins of the intervals, in UTC where every file tells when it began.
void write_time(Writer& file, const listening::Levels& levels) {
  Attributes attributes = {{"long_name", "begin of the interval"}, {"units", levels.is_dated ? "seconds since 1970-01-01T00:00:00Z" : "s"}};
  if (levels.is_dated) {
    attributes.emplace_back("standard_name", "time");
    attributes.emplace_back("calendar", "standard");
  } else {
    attributes.emplace_back("comment", "from the start of the file sequence: the recorder gave no date");
  }
  write_axis(file, time_axis(levels), levels.begin_s, attributes);
}

void write_bands(Writer& file, std::span<const spectrum::ThirdOctave> bands) {
  std::vector<double> centre_hz;
  std::vector<double> edges_hz;
  for (const spectrum::ThirdOctave& band : bands) {
    centre_hz.push_back(band.centre.value);
    edges_hz.insert(edges_hz.end(), {band.low.value, band.high.value});
  }
  write_axis(file, "frequency", centre_hz,
             {{"long_name", "centre of the band, a tenth of a decade wide (IEC 61260-1, base ten)"},
              {"units", "Hz"},
              {"bounds", "frequency_bounds"}});
  file.variable("frequency_bounds", Type::kDouble, {"frequency", "bound"}, {});
  file.write("frequency_bounds", edges_hz);
}

}  // namespace

void write_levels(const Result& result, const Arguments& arguments) {
  const listening::Levels levels = levels_of(*result.heard.levels, result.plan);
  const listening::Chain& chain = result.plan.chain;
  Writer file(arguments.levels);
  file.attribute("Conventions", netcdf::kConventions);
  file.attribute("title", "Third-octave levels: " + result.plan.sequence.parts().front().path.filename().string());
  file.attribute("source", "Earshot, Hann windows of about one second");
  file.attribute("history", arguments.history);
  file.attribute("calibration", chain.is_calibrated() ? chain.from : "uncalibrated: levels are dB re full scale");
  file.dimension(time_axis(levels), levels.begin_s.size());
  file.dimension("frequency", levels.bands.size());
  file.dimension("percentile", spectrum::kPercentiles.size());
  file.dimension("bound", 2);
  write_time(file, levels);
  write_bands(file, levels.bands);
  write_axis(file, "percentile", {spectrum::kPercentiles.begin(), spectrum::kPercentiles.end()},
             {{"long_name", "share of the windows whose level is no higher"}, {"units", "percent"}});
  const netcdf::LevelUnit unit = chain.is_calibrated() ? netcdf::kReOneMicropascal : netcdf::kReFullScale;
  write_floats(file, "level", {time_axis(levels), "frequency"}, netcdf::level_attributes("level of the mean power in the band", unit),
               levels.level_db);
  write_floats(file, "level_percentile", {time_axis(levels), "percentile", "frequency"},
               netcdf::level_attributes("percentiles of the levels of one second", unit), levels.level_percentile_db);
  file.commit();
}

}  // namespace earshot::listen
