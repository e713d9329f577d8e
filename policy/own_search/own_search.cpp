#include "policy/own_search/own_search.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/host/file/bad_input.hpp"
#include "policy/own_search/template_text.hpp"

namespace earshot::own_search {
namespace {

constexpr double kShippedSide_m = 25'000.0;

/// Ships and wind together, dB re 1 uPa^2/Hz.
double wenz_db(double frequency_hz) {
  const double khz = frequency_hz / 1e3;
  constexpr double kShipping = 0.5;
  constexpr double kWind_mps = 5.0;
  const double ships = 40.0 + 20.0 * (kShipping - 0.5) + 26.0 * std::log10(khz) - 60.0 * std::log10(khz + 0.03);
  const double wind = 50.0 + 7.5 * std::sqrt(kWind_mps) + 20.0 * std::log10(khz) - 40.0 * std::log10(khz + 0.4);
  return 10.0 * std::log10(std::pow(10.0, 0.1 * ships) + std::pow(10.0, 0.1 * wind));
}

}  // namespace

double noise_db(const OwnSearch& search) {
  constexpr double kPapers_db = 90.0;
  constexpr double kPapers_hz = 20.0;
  if (search.noise_db) return *search.noise_db;
  return std::round(kPapers_db + wenz_db(search.frequency_hz) - wenz_db(kPapers_hz));
}

bool is_of_shipped_size(const OwnSearch& search) {
  return search.area_north_m == kShippedSide_m && search.area_east_m == kShippedSide_m;
}

double furthest_m(const OwnSearch& search) {
  return std::hypot(search.area_north_m, search.area_east_m);
}

double max_depth_m(const OwnSearch& search) {
  const double a_third_deeper = std::ceil(search.depth_m * 4.0 / 3.0);
  return std::max(search.depth_m, std::min(a_third_deeper, std::floor(search.sea_floor_m - 1.0)));
}

double max_time_s(const OwnSearch& search, double step_length_m, double max_steps) {
  return std::ceil(1.2 * max_steps * step_length_m / search.speed_mps);
}

void require_consistent(const OwnSearch& search) {
  if (search.hears && (search.frequency_hz < kHeard_hz.lowest || search.frequency_hz > kHeard_hz.highest))
    throw host::BadInput("--hear: --frequency-hz " + toml_number(search.frequency_hz) + ": a hydrophone's detector is for " +
                         toml_number(kHeard_hz.lowest) + " to " + toml_number(kHeard_hz.highest) + " Hz");
  if (search.depth_m < search.sea_floor_m) return;
  throw host::BadInput("--depth-m " + toml_number(search.depth_m) + ": must be less than --sea-floor-m (" +
                       toml_number(search.sea_floor_m) + "), the depth of the sea floor");
}

}  // namespace earshot::own_search
