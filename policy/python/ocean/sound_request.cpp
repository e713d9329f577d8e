#include "policy/python/ocean/sound_request.hpp"

#include <array>
#include <string_view>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/toml/range.hpp"
#include "sim/ocean/with_source.hpp"

namespace earshot::python {
namespace {

using host::BadInput;
using host::Range;

std::optional<Meters> checked_metres(const char* name, std::optional<double> value, const Range& allowed) {
  return value ? std::optional(Meters{checked(name, *value, allowed)}) : std::nullopt;
}

ocean::Band band_of(const SoundRequest& asked) {
  if (!asked.band_hz) return {Hertz{asked.frequency_hz}, Hertz{asked.frequency_hz}};
  const Range allowed = Range::between(1.0, 10'000.0);
  const ocean::Band band{
      Hertz{checked("band", asked.band_hz->first, allowed)}, Hertz{checked("band", asked.band_hz->second, allowed)},
      static_cast<std::size_t>(checked("band_parts", static_cast<double>(asked.band_parts), Range::between(1.0, 10'000.0)))};
  if (!(band.low < band.high)) throw BadInput("band: the low frequency comes first, and must be less than the high one");
  return band;
}

std::vector<double> checked_depths(const std::vector<double>& depth_m) {
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    checked("receiver_depth", depth_m[i], Range::between(0.0, 12'000.0));
    if (i > 0 && !(depth_m[i] > depth_m[i - 1])) throw BadInput(named("receiver_depth", depth_m[i]) + "must increase");
  }
  return depth_m;
}

const char* argument_of(sonar::BadRequest::What what) {
  switch (what) {
    case sonar::BadRequest::What::kDepth:
      return "receiver_depth";
    case sonar::BadRequest::What::kOutputStep:
      return "output_step";
    case sonar::BadRequest::What::kBearing:
      return "bearing";
    case sonar::BadRequest::What::kRadials:
      return "radials";
  }
  return "";
}

/// How the solver's texts begin that are about an argument; all others are about the ocean.
constexpr std::array<std::pair<std::string_view, const char*>, 8> kArguments{{{"terms", "terms"},
                                                                              {"range step", "range_step"},
                                                                              {"depth step", "depth_step"},
                                                                              {"number of depth steps", "depth_step"},
                                                                              {"output step", "output_step"},
                                                                              {"absorber", "absorber_wavelengths"},
                                                                              {"source depth", "source_depth"},
                                                                              {"receiver depth", "receiver_depth"}}};

}  // namespace

ocean::Environment ocean_of(const ocean::Environment& ocean, const SoundRequest& asked) {
  checked("frequency", asked.frequency_hz, Range::between(1.0, 10'000.0));
  checked("source_depth", asked.source_depth_m, Range::above_up_to(0.0, 12'000.0));
  return ocean::with_source(ocean, Hertz{asked.frequency_hz}, Meters{asked.source_depth_m}, "source_depth");
}

sonar::RadialRequest request_of(const SoundRequest& asked, double default_step_wavelengths) {
  if (asked.starter != "self" && asked.starter != "gaussian")
    throw BadInput("starter = \"" + asked.starter + "\": must be \"self\" or \"gaussian\"");
  sonar::RadialRequest request{.max_range = Meters{checked("max_range", asked.max_range_m, Range::between(1.0, 2e6))},
                               .depth_m = checked_depths(asked.receiver_depth_m),
                               .depth_spacing = checked_metres("depth_spacing", asked.depth_spacing_m, Range::between(0.1, 10'000.0)),
                               .output_step = checked_metres("output_step", asked.output_step_m, Range::between(0.01, 100'000.0)),
                               .default_step_wavelengths = default_step_wavelengths,
                               .band = band_of(asked)};
  request.options.accuracy = Decibels{checked("accuracy_db", asked.accuracy_db, Range::between(0.0001, 10.0))};
  request.options.starter = asked.starter == "gaussian" ? pe::Starter::kGaussian : pe::Starter::kSelf;
  request.options.range_step = checked_metres("range_step", asked.range_step_m, Range::between(0.01, 10'000.0));
  request.options.depth_step = checked_metres("depth_step", asked.depth_step_m, Range::between(0.001, 1'000.0));
  request.options.terms = static_cast<std::size_t>(checked("terms", static_cast<double>(asked.terms), Range::between(0.0, 16.0)));
  if (asked.absorber_wavelengths)
    request.options.absorber_wavelengths = checked("absorber_wavelengths", *asked.absorber_wavelengths, Range::between(0.5, 10'000.0));
  return request;
}

BadArgument bad_argument(const sonar::BadRequest& bad) {
  const char* const name = argument_of(bad.what_is_wrong());
  return {name, bad.value(), bad.called(name)};
}

BadArgument bad_argument(const std::invalid_argument& bad) {
  const std::string_view text = bad.what();
  for (const auto& [beginning, name] : kArguments) {
    if (text.starts_with(beginning)) return {name, std::nullopt, bad.what()};
  }
  return {"environment", std::nullopt, bad.what()};
}

}  // namespace earshot::python
