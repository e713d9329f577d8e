#include "firmware/config/mission.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/not_finite.hpp"

namespace earshot::config {
namespace {

using tests::kInfinity;
using tests::kNan;

Mission good_mission() {
  return {.operating_area = {.south_west = {}, .north_east = {.north = Meters{25000}, .east = Meters{20000}}},
          .edge_margin = Meters{500},
          .search_depth = Meters{300},
          .max_depth = Meters{300},
          .search_speed = MetersPerSecond{2},
          .step_length = Meters{1000},
          .max_steps = 100,
          .max_time = Duration::seconds(60000),
          .navigation_timeout = Duration::seconds(5),
          .snr_timeout = Duration::seconds(60),
          .detection_threshold = Decibels{10},
          .action_seed = 1};
}

template <class Change>
Status checked_with(Change change) {
  Mission mission = good_mission();
  change(mission);
  return check(mission);
}

TEST(MissionCheck, AcceptsThePapersMission) {
  EXPECT_EQ(check(good_mission()), Status::kOk);
}

TEST(MissionCheck, RefusesEveryNumberThatIsNotFinite) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(checked_with([bad](Mission& m) { m.operating_area.south_west.north = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.operating_area.south_west.east = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.operating_area.north_east.north = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.operating_area.north_east.east = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.edge_margin = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.search_depth = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.max_depth = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.search_speed = MetersPerSecond{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.step_length = Meters{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.detection_threshold = Decibels{bad}; }), Status::kOutOfRange);
    EXPECT_EQ(checked_with([bad](Mission& m) { m.source_frequency = Hertz{bad}; }), Status::kOutOfRange);
  }
}

TEST(MissionCheck, AcceptsWhateverIsPositiveHoweverLittle) {
  EXPECT_EQ(checked_with([](Mission& m) { m.search_depth = Meters{0.5}; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.search_speed = MetersPerSecond{0.5}; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.step_length = Meters{0.5}; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.source_frequency = Hertz{0.5}; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.max_steps = 1; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.max_time = Duration{1}; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.navigation_timeout = Duration{1}; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.snr_timeout = Duration{1}; }), Status::kOk);
}

TEST(MissionCheck, RefusesWhatMustBePositiveAndIsNot) {
  EXPECT_EQ(checked_with([](Mission& m) { m.edge_margin = Meters{-1}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.search_depth = Meters{0}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.search_speed = MetersPerSecond{0}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.step_length = Meters{0}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.source_frequency = Hertz{0}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.max_steps = 0; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.max_time = Duration{0}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.navigation_timeout = Duration{-1}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.snr_timeout = Duration{0}; }), Status::kOutOfRange);
}

TEST(MissionCheck, RefusesAWindowThatCannotBeListenedOver) {
  const auto listening = [](Listening what, std::int64_t length_us) {
    return checked_with([=](Mission& m) { m.listening = {.listening = what, .length = {length_us}}; });
  };
  EXPECT_EQ(listening(Listening::kLoudest, 1'000'000), Status::kOk);
  EXPECT_EQ(listening(Listening::kMean, 120'000'000), Status::kOk);
  EXPECT_EQ(listening(Listening::kNewest, 1'000'000), Status::kOutOfRange);
  EXPECT_EQ(listening(Listening::kLoudest, 0), Status::kOutOfRange);
  EXPECT_EQ(listening(Listening::kLoudest, -1'000'000), Status::kOutOfRange);
  EXPECT_EQ(listening(Listening::kLoudest, 1'500'000), Status::kOutOfRange);
  EXPECT_EQ(listening(Listening::kMean, 121'000'000), Status::kOutOfRange);
  EXPECT_EQ(listening(Listening{3}, 1'000'000), Status::kOutOfRange);
}

TEST(MissionCheck, AllowsTheVehicleRightUpToTheEdge) {
  EXPECT_EQ(checked_with([](Mission& m) { m.edge_margin = Meters{0}; }), Status::kOk);
}

TEST(MissionCheck, RefusesASearchDeeperThanTheDepthLimit) {
  EXPECT_EQ(checked_with([](Mission& m) { m.search_depth = Meters{300.5}; }), Status::kOutOfRange);
}

TEST(MissionCheck, MeasuresTheAreaFromCornerToCornerWhereverItLies) {
  const auto area_at = [](double north, double east) {
    return checked_with([=](Mission& m) {
      m.operating_area = {.south_west = {.north = Meters{north}, .east = Meters{east}},
                          .north_east = {.north = Meters{north + 3'000}, .east = Meters{east + 3'000}}};
    });
  };
  EXPECT_EQ(area_at(50'000, 70'000), Status::kOk);
  EXPECT_EQ(area_at(-50'000, -70'000), Status::kOk);
  const auto too_small = [](Mission& m) {
    m.operating_area = {.south_west = {.north = Meters{50'000}, .east = Meters{0}},
                        .north_east = {.north = Meters{52'999}, .east = Meters{9'000}}};
  };
  EXPECT_EQ(checked_with(too_small), Status::kOutOfRange);
}

TEST(Mission, TakesAHundredStepsForAFinWhaleAndDrawsFromSeedOneWhereNothingElseIsSaid) {
  EXPECT_EQ(Mission{}.source_frequency, Hertz{20});  // of the paper's source
  EXPECT_EQ(Mission{}.max_steps, 100U);              // the paper's N
  EXPECT_EQ(Mission{}.action_seed, 1U);
  EXPECT_EQ(Mission{}.listening, (ListeningWindow{.listening = Listening::kNewest, .length = {}}));
}

TEST(MissionCheck, RefusesAnAreaWithoutTwoStepsOfRoomBetweenItsMargins) {
  EXPECT_EQ(checked_with([](Mission& m) { m.operating_area.north_east.east = Meters{3000}; }), Status::kOk);
  EXPECT_EQ(checked_with([](Mission& m) { m.operating_area.north_east.east = Meters{2999}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.operating_area.north_east.north = Meters{2999}; }), Status::kOutOfRange);
  EXPECT_EQ(checked_with([](Mission& m) { m.operating_area.north_east.north = Meters{-25000}; }), Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::config
