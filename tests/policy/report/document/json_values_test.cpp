#include "policy/report/document/json_values.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace earshot::report {
namespace {

TEST(Rounded, HasAsManyDecimalsAsAreKnownAndAWholeNumberNone) {
  EXPECT_EQ(rounded(12.346, 2).dump(), "12.35");
  EXPECT_EQ(rounded(-0.04, 1).dump(), "0");
  EXPECT_EQ(rounded(299.98, 1).dump(), "300");
  EXPECT_EQ(rounded(1e17, 1).dump(), "1e+17") << "beyond what 64 bits hold it stays a double";
}

TEST(Rounded, IsNullOfWhatIsNoNumber) {
  EXPECT_EQ(rounded(std::numeric_limits<double>::quiet_NaN(), 1).dump(), "null");
  EXPECT_EQ(rounded(std::numeric_limits<double>::infinity(), 1).dump(), "null");
}

TEST(CompassValue, IsClockwiseFromNorthAndNeverAFullTurn) {
  EXPECT_EQ(compass_value(Radians{1.5707963267948966}).dump(), "90");
  EXPECT_EQ(compass_value(Radians{-0.7853981633974483}).dump(), "315");
  EXPECT_EQ(rounded_compass(359.94).dump(), "359.9");
  EXPECT_EQ(rounded_compass(359.96).dump(), "0");
}

TEST(PlaceValue, IsToTheDecimetre) {
  EXPECT_EQ(place_value({Meters{12.345}, Meters{-3.0}}).dump(), R"({"north_m":12.3,"east_m":-3})");
}

// The vectors of RFC 4648, section 10, and the two last digits.
TEST(Base64, IsThatOfItsStandard) {
  constexpr std::pair<std::string_view, std::string_view> kVectors[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [text, encoded] : kVectors) EXPECT_EQ(base64(std::vector<std::uint8_t>(text.begin(), text.end())), encoded);
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xFF, 0xEF, 0xBE}), "/+++");
}

}  // namespace
}  // namespace earshot::report
