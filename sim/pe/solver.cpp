#include "sim/pe/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "sim/pe/depth_grid.hpp"
#include "sim/pe/depth_operator.hpp"
#include "sim/pe/grid_choice.hpp"
#include "sim/pe/propagator.hpp"
#include "sim/pe/sweep.hpp"
#include "sim/pe/valid_section.hpp"

namespace earshot::pe {

namespace {

using Complex = std::complex<double>;

void require(bool allowed, const std::string& what, double value, const std::string& range) {
  if (allowed) return;
  std::ostringstream text;
  text << what << " is " << value << ", allowed: " << range;
  throw std::invalid_argument(text.str());
}

bool inside(double value, double low, double high) {
  return value >= low && value <= high;
}  // false for NaN

void require_valid(const Options& options) {
  if (options.depth_step)
    require(inside(options.depth_step->value, 1e-3, 1e3), "depth step in m", options.depth_step->value, "0.001 to 1000");
  if (options.range_step)
    require(inside(options.range_step->value, 1e-2, 1e4), "range step in m", options.range_step->value, "0.01 to 10000");
  if (options.output_step)
    require(inside(options.output_step->value, 1e-2, 1e5), "output step in m", options.output_step->value, "0.01 to 100000");
  require(options.terms == 0 || inside(static_cast<double>(options.terms), 2, Sweep::kMaxTerms), "terms",
          static_cast<double>(options.terms), "2 to 16, or 0 for automatic");
  if (options.absorber_wavelengths)
    require(inside(*options.absorber_wavelengths, 0.5, 1e4), "absorber in wavelengths", *options.absorber_wavelengths, "0.5 to 10000");
  require(inside(options.accuracy.value, 1e-4, 10.0), "accuracy in dB", options.accuracy.value, "0.0001 to 10");
}

/// Range steps and the rows of the field within them: either several rows to a step or several steps to a row.
struct Stepping {
  double step_m;
  std::size_t rows_per_step;
  std::size_t steps_per_row;

  [[nodiscard]] double row_m() const { return step_m * static_cast<double>(steps_per_row) / static_cast<double>(rows_per_step); }
};

std::size_t whole_ratio(double larger_m, double smaller_m) {
  const double ratio = std::round(larger_m / smaller_m);
  require(std::abs(larger_m / smaller_m - ratio) < 1e-6 * ratio, "range step over output step, or its inverse,", larger_m / smaller_m,
          "a whole number");
  return static_cast<std::size_t>(ratio);
}

Stepping choose_stepping(const Options& options, const GridChoice& choice, double wavelength_m) {
  if (options.range_step) {
    const double step = options.range_step->value;
    const double row = options.output_step.value_or(*options.range_step).value;
    return row >= step ? Stepping{step, 1, whole_ratio(row, step)} : Stepping{step, whole_ratio(step, row), 1};
  }
  const double row = options.output_step ? options.output_step->value : wavelength_m / 6.0;
  const double longest = choice.range_step.value;
  const auto rows_per_step = static_cast<std::size_t>(longest / row);
  if (rows_per_step >= 1) return {row * static_cast<double>(rows_per_step), rows_per_step, 1};
  const auto steps_per_row = static_cast<std::size_t>(std::ceil(row / longest));
  return {row / static_cast<double>(steps_per_row), 1, steps_per_row};
}

/// Highest eigenvalue of Numerov's second difference is 6 / h^2: the most evanescent wave the grid holds.
Spectrum spectrum_of(const ocean::Section& section, const DepthGrid& grid, Hertz frequency) {
  const double phase = grid.reference_wavenumber_per_m * grid.step_m;
  const double slowest = 2.0 * std::numbers::pi * frequency.value / grid.reference_wavenumber_per_m;
  const double ratio = slowest / sound_speed_bounds(section).highest_mps;
  constexpr double kLeastAngle = 15.0 / 180.0 * std::numbers::pi;  // to the horizontal, of what is to be most accurate
  return {.lowest = -1.0 - 6.0 / (phase * phase),
          .trapped = std::min(ratio * ratio - 1.0, -std::sin(kLeastAngle) * std::sin(kLeastAngle)),
          .highest = 0.0};
}

/// Of the step, and of the rows that lie in it.
Propagator propagator_of(const ocean::Section& section, const DepthGrid& grid, Hertz frequency, const Stepping& stepping,
                         std::size_t terms) {
  std::vector<double> offset;
  for (std::size_t i = 1; i <= stepping.rows_per_step; ++i)
    offset.push_back(stepping.step_m * static_cast<double>(i) / static_cast<double>(stepping.rows_per_step));
  return make_propagator(grid.reference_wavenumber_per_m, stepping.step_m, offset, spectrum_of(section, grid, frequency), terms);
}

/// What terms and steps that were asked for may do over a march, in dB. Each step adds its error to the sound that stays in the water, so
/// the errors of all steps together are about the mean error in TL: on munk_flat 0.7 to 2.4 times it, for 2 to 8 terms, steps of 5 m to
/// 5 km and 0.7 to 95 dB. Steep and evanescent waves carry less of the sound and may grow by more: growth of 9 dB over the march, the most
/// that automatic grids reach for an accuracy of 1 dB in the tests' oceans, does no harm; 33 dB (16 terms at 1 km) spoils the mean by 1 dB
/// and single ranges by 7, 240 dB (at 2 km) the mean by 25.
constexpr double kMostError_db = 3.0;
constexpr double kMostGrowth_db = 30.0;

/// The automatic choice, rounded down to whole rows, and half of it, which sonar::check_grid asks for: its errors are within the accuracy.
bool is_automatic(const GridChoice& choice, std::size_t terms, double step_m) {
  return terms >= choice.terms && inside(step_m, 0.25 * choice.range_step.value, (1.0 + 1e-9) * choice.range_step.value);
}

void require_serves(const Propagator& propagator, std::size_t terms, double step_m, Meters max_range) {
  const double decibels = 20.0 / std::numbers::ln10;  // in a relative error of one
  const double steps = max_range.value / step_m;
  const double error_db = decibels * propagator.largest_error * steps;
  const double growth_db = decibels * std::log(propagator.largest_modulus) * steps;
  if (error_db <= kMostError_db && growth_db <= kMostGrowth_db) return;
  std::ostringstream text;
  text << "terms = " << terms << " cannot carry sound over a range step of " << step_m << " m: in " << max_range.value
       << " m it would be off by some " << error_db << " dB (allowed: " << kMostError_db << ") or, where steep, grow by " << growth_db
       << " dB (allowed: " << kMostGrowth_db << "); take more terms or a shorter range step, or leave both to be chosen";
  throw std::invalid_argument(text.str());
}

/// @param predicted_error_db  NaN where nothing is known
void require_predictable(double predicted_error_db, Decibels accuracy) {
  const std::optional<std::string> doubt = doubt_of(predicted_error_db, accuracy);
  if (doubt && predicted_error_db > kWorstError.value)
    throw std::invalid_argument(*doubt + ": smooth it, or choose the range step yourself");
}

/// One march: the field at every receiver within a step from the solutions of that step.
class March {
 public:
  March(const ocean::Section& section, const PointSource& source, const DepthGrid& grid, const Stepping& stepping,
        const Propagator& propagator, Starter starter, std::span<const double> receiver_depth_m)
      : stepping_(stepping),
        varies_(section.sea_floor.size() > 1 || section.water.size() > 1 || section.sediment.size() > 1),
        operator_(section, source.frequency, grid),
        sweep_(grid.intervals, propagator.step.pole.size()),
        depth_m_(receiver_depth_m),
        taps_(receiver_depth_m.size()),
        y_(static_cast<Eigen::Index>(propagator.step.pole.size()), static_cast<Eigen::Index>(receiver_depth_m.size())) {
    sweep_.set_rational(propagator.step);
    read_off_.resize(static_cast<Eigen::Index>(propagator.pressure_residue.size()), y_.rows());
    for (Eigen::Index row = 0; row < read_off_.rows(); ++row) {
      for (Eigen::Index j = 0; j < read_off_.cols(); ++j)
        read_off_(row, j) = propagator.pressure_residue[static_cast<std::size_t>(row)][static_cast<std::size_t>(j)] /
                            propagator.step.residue[static_cast<std::size_t>(j)];
    }
    rows_.resize(read_off_.rows(), y_.cols());

    operator_.move_to(0.5 * stepping.step_m);
    sweep_.take(operator_, {1, grid.intervals - 1}, meeting_row());
    const double speed_mps = ocean::sound_speed(section, Meters{}, source.depth).value;
    const std::vector<Complex> u =
        make_starter(starter, operator_,
                     {.depth_m = source.depth.value, .wavenumber_per_m = 2.0 * std::numbers::pi * source.frequency.value / speed_mps});
    for (std::size_t node = 0; node < u.size(); ++node) sweep_.set_field(node, u[node]);
    place_taps(true);
  }

  void step() {
    if (steps_ > 0 && varies_) enter_next_medium();
    sweep_.apply();
    ++steps_;
  }

  /// Rows of the field that lie in the step just made, from `first_row` on.
  void read(Field& field, Eigen::Index first_row) {
    const auto terms = static_cast<std::size_t>(y_.rows());
    for (std::size_t i = 0; i < taps_.size(); ++i) sweep_.solutions_at(taps_[i], {y_.col(static_cast<Eigen::Index>(i)).data(), terms});
    rows_.noalias() = read_off_ * y_;
    const double k0 = operator_.grid().reference_wavenumber_per_m;
    for (Eigen::Index row = 0; row < rows_.rows() && first_row + row < field.pressure.rows(); ++row) {
      const double range = static_cast<double>(first_row + row + 1) * field.range_step.value;
      const Complex spreading = std::polar(std::sqrt(2.0 * std::numbers::pi / (k0 * range)), 0.25 * std::numbers::pi);
      field.pressure.row(first_row + row) = spreading * rows_.row(row).array();
    }
  }

 private:
  void enter_next_medium() {
    const double middle = (static_cast<double>(steps_) + 0.5) * stepping_.step_m;
    const RowRange changed = operator_.rows_changed_by(middle);
    if (changed.empty()) return;
    const double floor_before = operator_.floor_depth_m();
    operator_.move_to(middle);
    sweep_.take(operator_, changed, meeting_row());
    if (operator_.floor_depth_m() != floor_before) place_taps(false);
  }

  /// Where the elimination from the surface and the one from below meet: at the sea floor if that is what moves.
  [[nodiscard]] std::size_t meeting_row() const {
    const DepthGrid& grid = operator_.grid();
    return varies_ ? static_cast<std::size_t>(operator_.floor_depth_m() / grid.step_m) : grid.intervals / 2;
  }

  /// Receivers within reach of the sea floor, or below it, must not be interpolated across it and the layers that follow it.
  void place_taps(bool all) {
    const double floor = operator_.floor_depth_m();
    const double reach = static_cast<double>(DepthTap::kNodes) * operator_.grid().step_m;
    for (std::size_t i = 0; i < taps_.size(); ++i) {
      const bool near = depth_m_[i] > std::min(floor, tap_floor_m_) - reach;
      if (all || near) taps_[i] = tap_at(operator_.grid(), depth_m_[i], operator_.interfaces());
    }
    tap_floor_m_ = floor;
  }

  Stepping stepping_;
  bool varies_;
  DepthOperator operator_;
  Sweep sweep_;
  std::span<const double> depth_m_;
  std::vector<DepthTap> taps_;
  double tap_floor_m_ = 0.0;
  std::size_t steps_ = 0;
  Eigen::MatrixXcd read_off_;                                                     // [n_offset x n_term]
  Eigen::MatrixXcd y_;                                                            // [n_term x n_depth]
  Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows_;  // [n_offset x n_depth]
};

}  // namespace

Field solve(const ocean::Section& section, const PointSource& source, const Options& options, std::span<const double> receiver_depth_m,
            Meters max_range, const Progress& progress) {
  require_valid(options);
  require(inside(source.frequency.value, 0.1, 1e5), "frequency in Hz", source.frequency.value, "0.1 to 100000");
  require(inside(max_range.value, 1e-2, 2e7), "range in m", max_range.value, "0.01 to 20000000");
  require_valid(section, source.depth);

  const GridChoice choice = choose_grid(section, source.frequency, max_range, options.accuracy);
  const DepthGrid grid = make_depth_grid(section, source.frequency, options.depth_step.value_or(choice.depth_step),
                                         choose_absorber(section, source.frequency, max_range, options.absorber_wavelengths));
  require(grid.intervals >= 8 && grid.intervals <= 10'000'000, "number of depth steps", static_cast<double>(grid.intervals),
          "8 to 10000000: choose another depth step");
  for (const double depth : receiver_depth_m) {
    std::ostringstream allowed;
    allowed << "from 0 to " << grid.deepest_medium_m << ", the sea floor or the end of the layers below it";
    require(inside(depth, 0.0, grid.deepest_medium_m), "receiver depth in m", depth, allowed.str());
  }

  const Stepping stepping = choose_stepping(options, choice, 2.0 * std::numbers::pi / grid.reference_wavenumber_per_m);
  const std::size_t terms = options.terms == 0 ? choice.terms : options.terms;
  const Propagator propagator = propagator_of(section, grid, source.frequency, stepping, terms);
  const bool is_chosen_here = is_automatic(choice, terms, stepping.step_m);
  if (!is_chosen_here) require_serves(propagator, terms, stepping.step_m, max_range);
  const double predicted_error_db =
      is_chosen_here && !options.depth_step ? choice.predicted_error_db : std::numeric_limits<double>::quiet_NaN();
  require_predictable(predicted_error_db, options.accuracy);
  March march(section, source, grid, stepping, propagator, options.starter, receiver_depth_m);
  Field field{.range_step = Meters{stepping.row_m()},
              .depth_m = {receiver_depth_m.begin(), receiver_depth_m.end()},
              .pressure = {},
              .grid = {.depth_step = Meters{grid.step_m},
                       .range_step = Meters{stepping.step_m},
                       .terms = terms,
                       .predicted_error_db = predicted_error_db,
                       .reference_wavenumber_per_m = grid.reference_wavenumber_per_m}};
  const double rows = std::max(1.0, std::floor(max_range.value / stepping.row_m() + 1e-9));
  field.pressure.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(receiver_depth_m.size()));

  constexpr std::size_t kWorkPerReport = 1'000'000;  // poles x depths: some hundredths of a second
  const std::size_t work_per_step = terms * grid.intervals;
  std::size_t unreported = 0;
  Eigen::Index row = 0;
  for (std::size_t step = 1; row < field.pressure.rows(); ++step) {
    march.step();
    if (step % stepping.steps_per_row == 0) {
      march.read(field, row);
      row += static_cast<Eigen::Index>(stepping.rows_per_step);
    }
    unreported += work_per_step;
    if (progress && unreported >= kWorkPerReport) {
      unreported = 0;
      progress(std::min(1.0, static_cast<double>(row) / rows));
    }
  }
  if (progress) progress(1.0);
  return field;
}

}  // namespace earshot::pe
