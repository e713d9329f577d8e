// pe.*: processor seconds of the parabolic-equation solver, set-up and fit of the propagator included; tests/bench/peers/pyram_cases.py is
// the peer. usage: bench_pe_solver FIGURE (benchmarks.toml)
#include <cmath>
#include <complex>
#include <ctime>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/pe/solver.hpp"
#include "sim/sonar/radial.hpp"
#include "sim/sonar/sonar_field.hpp"
#include "tests/bench/short_form.hpp"
#include "tests/reference/transmission_loss.hpp"
#include "tests/sim/pe/short_section.hpp"

namespace {

using namespace earshot;

constexpr double kRange = 25'000.0;
constexpr int kSectionRuns = 100;  // as tests/bench/python_field.py: some milliseconds each, and a machine has other work

ocean::Section papers_ocean() {
  return pe::tests::section_of({.floor = {{0.0, 3000.0}},
                                .water = {{0.0, ocean::MunkProfile{MetersPerSecond{1500.0}, Meters{1300.0}, Meters{1300.0}, 0.00737}}},
                                .sediment = {{0.0, {{0.0, 1505.0, 1.5, 0.5}}}}});
}

ocean::Section upslope() {
  ocean::Section section = papers_ocean();
  section.sea_floor = pe::tests::sea_floor({{0.0, 3000.0}, {5'000.0, 3000.0}, {25'000.0, 1000.0}, {35'000.0, 1000.0}});
  section.sediment = {{.range = Meters{}, .layers = pe::tests::layers_between({{0.0, 1600.0, 1.8, 0.5}})}};
  return section;
}

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// In short of one.
template <class Work>
double best_of(int runs, const Work& work) {
  double best = 1e9;
  for (int i = 0; i < bench::full_or_short(runs, 1); ++i) {
    const double start = processor_seconds();
    work();
    best = std::min(best, processor_seconds() - start);
  }
  return best;
}

/// As for pyRAM.
template <class Work>
double best_of_three(const Work& work) {
  return best_of(3, work);
}

pe::Field run(const ocean::Section& section, const pe::Options& options, double source_depth_m, double range_m,
              const std::vector<double>& receiver_depth_m = {300.0}) {
  const double frequency_hz = bench::is_wrong_on_purpose() ? 22.0 : 20.0;
  return pe::solve(section, {Hertz{frequency_hz}, Meters{source_depth_m}}, options, receiver_depth_m, Meters{range_m});
}

void require_mean_error(const pe::Field& field, const std::string& name, int column, int to_m, double limit_db) {
  const auto truth = reference::load(name, column);
  reference::TransmissionLoss loss;
  for (Eigen::Index row = 0; row < field.pressure.rows(); ++row)
    loss[static_cast<int>(std::lround(static_cast<double>(row + 1) * field.range_step.value))] =
        -20.0 * std::log10(std::abs(field.pressure(row, 0)));
  const double mean = reference::compare(loss, truth, 1'000, to_m, reference::DeepMinimum(truth, 1500)).mean_db;
  std::cerr << name << ": mean error " << mean << " dB\n";
  if (!(mean <= limit_db)) throw std::runtime_error(name + ": less accurate than the peer");
}

/// What tests/bench/python_field.py is given, without Python: every 10 m of depth, loss to 1/256 dB, pressure.
void compute_section() {
  sonar::RadialPlan plan{
      .source_depth = Meters{30.0}, .depth_m = {}, .range_step = Meters{50.0}, .ranges = 500, .band = {Hertz{20.0}, Hertz{20.0}}};
  for (int i = 1; i <= 300; ++i) plan.depth_m.push_back(10.0 * i);
  const std::size_t values = plan.ranges * plan.depth_m.size();
  std::vector<float> loss_db(values);
  std::vector<float> sea_floor_m(plan.ranges);
  std::vector<std::complex<double>> pressure(values);
  (void)sonar::compute_radial(papers_ocean(), "the paper's ocean", plan,
                              {.transmission_loss_db = loss_db, .sea_floor_depth_m = sea_floor_m, .pressure = pressure});
  loss_db = sonar::rounded_loss_db(std::move(loss_db));
  if (!std::isfinite(loss_db.back())) throw std::runtime_error("the section has no loss at its end");
}

double measure(const std::string& figure) {
  // The absorber is each solver's own: here some ten matched elements, in pyRAM 20 wavelengths of growing loss.
  const pe::Options same_grid{.depth_step = Meters{1.0}, .range_step = Meters{50.0}, .terms = 8, .output_step = Meters{50.0}};
  if (figure.starts_with("same_grid")) require_mean_error(run(papers_ocean(), same_grid, 30.0, kRange), "munk_20hz", 0, 25'000, 0.1);
  if (figure == "same_grid.single") return best_of_three([&] { (void)run(papers_ocean(), same_grid, 30.0, kRange); });
  if (figure == "same_grid.batch") {
    return best_of_three([&] {
             for (int radial = 0; radial < 8; ++radial) (void)run(papers_ocean(), same_grid, 30.0 + 10.0 * radial, kRange);
           }) /
           8.0;
  }
  if (figure == "equal_accuracy.munk_20hz") {
    const pe::Options automatic{.output_step = Meters{50.0}};
    require_mean_error(run(papers_ocean(), automatic, 30.0, kRange), "munk_20hz", 0, 25'000, 0.05);
    return best_of_three([&] { (void)run(papers_ocean(), automatic, 30.0, kRange); });
  }
  if (figure == "section.munk_20hz") {
    std::vector<double> depth_m;
    for (int i = 1; i <= 300; ++i) depth_m.push_back(10.0 * i);
    const double pressure_alone_s =
        best_of(kSectionRuns, [&] { (void)run(papers_ocean(), {.output_step = Meters{50.0}}, 30.0, kRange, depth_m); });
    std::cerr << "the march alone, pressure and no loss: " << pressure_alone_s << " s\n";
    return best_of(kSectionRuns, compute_section);
  }
  if (figure == "equal_accuracy.range_dependent") {
    const pe::Options automatic{.output_step = Meters{50.0}, .accuracy = Decibels{0.3}};
    require_mean_error(run(upslope(), automatic, 30.0, 35'000.0), "upslope_deep", 1, 35'000, 0.78);
    return best_of_three([&] { (void)run(upslope(), automatic, 30.0, 35'000.0); });
  }
  throw std::runtime_error("no such figure: " + figure);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::cout << "{\"value\": " << measure(argc > 1 ? argv[1] : "") << "}\n";
  } catch (const std::exception& e) {
    std::cerr << "bench_pe_solver: " << e.what() << '\n';
    return 1;
  }
  return 0;
}
