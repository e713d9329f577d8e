// Computes the reference oceans and some others on the automatic grid, to compare one kind of machine with another.
// usage: pe_fields write FILE     (binary, little-endian)
//        pe_fields compare FILE   (status 1 when a field differs by more than the tolerance)
#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "tests/sim/pe/accuracy.hpp"

namespace {

using namespace earshot;
using namespace earshot::pe;

/// Of the root-mean-square pressure. Compilers order additions and fuse products differently, and the fit of the propagator enlarges that
/// to 4e-11 between g++ 12 on x86-64 and on aarch64.
constexpr double kTolerance = 1e-9;

std::vector<tests::Ocean> oceans() {
  std::vector<tests::Ocean> all = tests::reference_oceans();
  std::vector<tests::Ocean> chosen(all.begin(), all.begin() + 4);
  for (tests::Ocean& ocean : tests::further_oceans())
    if (ocean.name == "front" || ocean.name == "slow clay" || ocean.name == "layers with gradients, upslope") chosen.push_back(ocean);
  return chosen;
}

Field solve_short(tests::Ocean ocean) {
  ocean.max_range_m = std::min(ocean.max_range_m, 10'000.0);  // an emulator is some ten times slower
  return tests::solve_automatically(ocean, Decibels{0.05});
}

std::streamsize bytes_of(const Field& field) {
  return field.pressure.size() * static_cast<std::streamsize>(sizeof(std::complex<double>));
}

int write(const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  for (const tests::Ocean& ocean : oceans()) {
    const Field field = solve_short(ocean);
    file.write(reinterpret_cast<const char*>(field.pressure.data()), bytes_of(field));
  }
  return file.flush() ? 0 : 2;
}

int compare(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  bool alike = true;
  for (const tests::Ocean& ocean : oceans()) {
    const Field here = solve_short(ocean);
    Field there = here;
    if (!file.read(reinterpret_cast<char*>(there.pressure.data()), bytes_of(there))) {
      std::cerr << path << ": too short, " << ocean.name << " is missing\n";
      return 2;
    }
    const double scale = std::sqrt(here.pressure.abs2().mean());
    const double difference = (here.pressure - there.pressure).abs().maxCoeff() / scale;
    alike = alike && difference <= kTolerance;
    std::cout << ocean.name << ": largest difference " << difference << " of the root-mean-square pressure\n";
  }
  return alike ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 2 && arguments[0] == "write") return write(arguments[1]);
  if (arguments.size() == 2 && arguments[0] == "compare") return compare(arguments[1]);
  std::cerr << "usage: pe_fields write FILE | compare FILE\n";
  return 2;
}
