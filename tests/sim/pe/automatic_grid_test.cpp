// The automatic grid against a much finer one, in every ocean of oceans.hpp.
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

#include "tests/sim/pe/accuracy.hpp"

namespace earshot::pe {
namespace {

using tests::Ocean;

std::vector<Ocean> all_oceans() {
  std::vector<Ocean> oceans = tests::reference_oceans();
  for (Ocean& ocean : tests::further_oceans()) oceans.push_back(std::move(ocean));
  return oceans;
}

std::string test_name(const testing::TestParamInfo<Ocean>& info) {
  std::string name;
  for (const char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  return name;
}

class AutomaticGrid : public testing::TestWithParam<Ocean> {};

TEST_P(AutomaticGrid, IsOffByAtMostTwiceThePredictedError) {
  const Decibels accuracy{0.02};
  const GridChoice choice = tests::automatic_grid(GetParam(), accuracy);
  const bool uniform = GetParam().section.floor.size() == 1 && GetParam().section.water.size() == 1;
  const Field finer = tests::solve_on(GetParam(), choice.depth_step.value / 1.8,             // a tenth of the error in depth,
                                      choice.range_step.value / (uniform ? 2.0 : 4.0), 16);  // a sixteenth in range
  const double error_db = tests::mean_difference_db(tests::solve_automatically(GetParam(), accuracy), finer);
  EXPECT_LT(error_db, 2.0 * choice.predicted_error_db);  // one ocean scatters about a law for all
  EXPECT_LT(error_db, 0.15);                             // of 0.8 dB that a RAM-type solver is off on such slopes
}

INSTANTIATE_TEST_SUITE_P(Oceans, AutomaticGrid, testing::ValuesIn(all_oceans()), test_name);

TEST(AutomaticGrid, CostsNoAccuracyWhenTheUserShortensTheRangeStepFarBelowIt) {
  // Every step adds the error of its rational function: in 5 m steps the deep slope once was 0.05 dB off by that alone, a flat ocean more.
  Ocean ocean = tests::reference_oceans().front();
  ocean.max_range_m = 15'000.0;
  const Field automatic = tests::solve_automatically(ocean, Decibels{0.001});
  for (const double range_step_m : {5.0, 20.0})
    EXPECT_LT(tests::mean_difference_db(
                  tests::solve_on(ocean, tests::automatic_grid(ocean, Decibels{0.001}).depth_step.value, range_step_m, 16), automatic),
              0.01)
        << range_step_m;
}

}  // namespace
}  // namespace earshot::pe
