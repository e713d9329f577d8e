#include "hil/nodes/vehicle/track_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

constexpr Time at_ms(std::int64_t milliseconds) {
  return Time{} + Duration::milliseconds(milliseconds);
}

vehicle::State at(double north_m, double east_m, double depth_m) {
  vehicle::State state;
  state.position = {Meters{north_m}, Meters{east_m}};
  state.depth = Meters{depth_m};
  return state;
}

class TrackFileTest : public testing::Test {
 protected:
  [[nodiscard]] std::string text() const {
    std::ostringstream all;
    all << std::ifstream(path_).rdbuf();
    return all.str();
  }
  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "track.csv";
};

TEST_F(TrackFileTest, HasAPlaceForEverySecondAtSea) {
  TrackFile track(path_);
  track.note(at_ms(5'000), at_ms(100), at(1, -2.5, 300));
  track.note(at_ms(5'999), at_ms(150), at(2, 0, 300));
  track.note(at_ms(6'000), at_ms(151), at(3, 12'500.1234, 299.5));
  EXPECT_EQ(text(),
            "host_s,north_m,east_m,depth_m\n"
            "0.100000,1.000,-2.500,300.000\n"
            "0.151000,3.000,12500.123,299.500\n")
      << "each line is there at once";
  const std::vector<TrackPlace> places = read_track(path_);
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[1].host, at_ms(151));
  EXPECT_EQ(places[1].position, (NorthEast{Meters{3}, Meters{12'500.123}}));
  EXPECT_EQ(places[1].depth, Meters{299.5});
}

TEST_F(TrackFileTest, GoesOnBehindThatOfAnEarlierProcess) {
  TrackFile(path_).note(at_ms(0), at_ms(1), at(1, 1, 1));
  TrackFile(path_).note(at_ms(0), at_ms(2), at(2, 2, 2));
  EXPECT_EQ(text(), "host_s,north_m,east_m,depth_m\n0.001000,1.000,1.000,1.000\n0.002000,2.000,2.000,2.000\n");
}

TEST_F(TrackFileTest, LeavesOutALineWithoutItsEndAndWhatIsNoPlace) {
  std::ofstream(path_) << "host_s,north_m,east_m,depth_m\n1.0,2.0,3.0,4.0\n1.0,2.0,3.0\n1.0,2.0,3.0,4.0,5.0\n5.0,6.0,7.0,80";
  const std::vector<TrackPlace> places = read_track(path_);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].depth, Meters{4});
  EXPECT_TRUE(read_track(folder_ / "none.csv").empty());
}

}  // namespace
}  // namespace earshot::hil
