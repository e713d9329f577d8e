// The accuracy of the parabolic-equation solver in the oceans of tests/sim/pe/oceans.hpp, as a table in Markdown: the automatic grid's
// predicted error beside its measured one, and the orders of convergence in depth and range step.   usage: bench_pe_accuracy [ACCURACY_DB]
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>

#include "sim/pe/depth_grid.hpp"
#include "tests/sim/pe/accuracy.hpp"

namespace {

using namespace earshot;
using namespace earshot::pe;
using tests::Ocean;

double order_of(double coarse_error, double fine_error) {
  return std::log2(coarse_error / fine_error);
}

double distance(const Field& a, const Field& b) {
  return (a.pressure - b.pressure).abs().mean();
}

/// From steps of 1/10 and 1/20 of a wavelength, against 1/60.
double order_in_depth(const Ocean& ocean, double wavelength_m) {
  const auto at = [&](double points) { return tests::solve_on(ocean, wavelength_m / points, 0.5 * wavelength_m, 16); };
  const Field fine = at(60.0);
  return order_of(distance(at(10.0), fine), distance(at(20.0), fine));
}

/// From steps of 1 and 1/2 wavelength, against 1/8.
double order_in_range(const Ocean& ocean, double wavelength_m) {
  const auto at = [&](double share) { return tests::solve_on(ocean, wavelength_m / 20.0, share * wavelength_m, 16); };
  const Field fine = at(0.125);
  return order_of(distance(at(1.0), fine), distance(at(0.5), fine));
}

bool is_uniform(const Ocean& ocean) {
  return ocean.section.floor.size() == 1 && ocean.section.water.size() == 1;
}

void print_row(const Ocean& ocean, Decibels accuracy) {
  const GridChoice choice = tests::automatic_grid(ocean, accuracy);
  const double finer_range_step_m = choice.range_step.value / (is_uniform(ocean) ? 2.0 : 8.0);
  const double measured_db = tests::mean_difference_db(tests::solve_automatically(ocean, accuracy),
                                                       tests::solve_on(ocean, choice.depth_step.value / 2.5, finer_range_step_m, 16));
  const double wavelength_m = sound_speed_bounds(tests::section_of(ocean.section)).lowest_mps / ocean.frequency_hz;
  std::cout << "| " << ocean.name << " | " << std::fixed << std::setprecision(2) << choice.depth_step.value << " | " << std::setprecision(1)
            << choice.range_step.value << " | " << choice.terms << " | " << std::setprecision(4) << choice.predicted_error_db << " | "
            << measured_db << " | " << std::setprecision(1) << order_in_depth(ocean, wavelength_m) << " | ";
  if (is_uniform(ocean)) {
    std::cout << "-";
  } else {
    std::cout << order_in_range(ocean, wavelength_m);
  }
  std::cout << " |" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  const Decibels accuracy{argc > 1 ? std::atof(argv[1]) : 0.02};
  std::cout << "| ocean | dz, m | dr, m | terms | predicted, dB | measured, dB | order in dz | order in dr "
               "|\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& oceans : {tests::reference_oceans(), tests::further_oceans()})
    for (const Ocean& ocean : oceans) print_row(ocean, accuracy);
  return 0;
}
