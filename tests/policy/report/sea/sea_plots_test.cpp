#include "policy/report/sea/sea_plots.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

SeaFlight flight_of_a_kilometre() {
  SeaFlight flight;
  flight.threshold = Decibels{10.0};
  flight.fixes = {{.time_s = 0.0, .position = {}, .depth = Meters{300}},
                  {.time_s = 500.0, .position = {Meters{1000}, {}}, .depth = Meters{300}}};
  flight.ended_s = 500.0;
  return flight;
}

TEST(SeaPlots, AreNoneOfWhatDidNotComeIn) {
  EXPECT_EQ(sea_map_svg(SeaFlight{}, {}), "");
  EXPECT_EQ(sea_history_svg(flight_of_a_kilometre(), {}), "");
}

TEST(SeaPlots, ShowAMeasurementTooFaintToMeasureApartFromAMeasuredOne) {
  SeaFlight flight = flight_of_a_kilometre();
  EXPECT_TRUE(support::has_line(sea_map_svg(flight, {}), {"<title>", "track", "navigation</title>"}));
  flight.measurements = {{.time_s = 100.0, .snr_db = 12.0, .too_faint = false}};
  const std::string measured = sea_history_svg(flight, {});
  EXPECT_NE(measured.find("<title>SNR against time</title>"), std::string::npos);
  flight.measurements[0].too_faint = true;
  EXPECT_NE(sea_history_svg(flight, {}), measured);
}

}  // namespace
}  // namespace earshot::report
