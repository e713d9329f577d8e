#include "policy/command_line/place.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::command_line {
namespace {

NorthEast place(const std::string& text) {
  return north_east_of("--source", text);
}

std::string refusal(const std::string& text) {
  try {
    (void)place(text);
  } catch (const host::BadInput& bad) {
    return bad.what();
  }
  return "not refused";
}

TEST(Place, IsInMetresOrInTheUnitOfEachLength) {
  EXPECT_EQ(place("10000,-9500"), (NorthEast{Meters{10'000}, Meters{-9'500}}));
  EXPECT_EQ(place("10km,9500m"), (NorthEast{Meters{10'000}, Meters{9'500}}));
  EXPECT_EQ(place("1.5km,0"), (NorthEast{Meters{1'500}, Meters{0}}));
}

TEST(Place, AsksWhetherKilometresAreMeantWhereBothLengthsAreBelowAHundredAndHaveNoUnit) {
  EXPECT_TRUE(
      support::tells(refusal("10,-99.5"), {"--source", "10,-99.5", "meant", "mean 10000,-99500", "10km,-99.5km", "not", "10m,-99.5m"}));
  EXPECT_EQ(place("10m,99.5m"), (NorthEast{Meters{10}, Meters{99.5}}));
  EXPECT_EQ(place("10,100"), (NorthEast{Meters{10}, Meters{100}}));
  EXPECT_EQ(place("0,0"), NorthEast{});
}

TEST(Place, RefusesWhatIsNoTwoLengthsAndNamesTheOption) {
  for (const char* text : {"", "10000", "10000,", ",10000", "10000,10000,3", "10000,nan", "10000,inf", "10miles,10miles", "km,m"})
    EXPECT_TRUE(support::tells(refusal(text), {"--source", std::string(text), "north", "east", "10000,10000", "10km,10km"}));
}

}  // namespace
}  // namespace earshot::command_line
