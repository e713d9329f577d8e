#include "hil/bus/candump/log_fields.hpp"

#include <gtest/gtest.h>

namespace earshot::hil {
namespace {

TEST(LogFields, TakeWordsAndFieldsOneAfterTheOther) {
  std::string_view text = "  a\tbc ";
  EXPECT_EQ(take_word(text), "a");
  EXPECT_EQ(take_word(text), "bc");
  EXPECT_EQ(take_word(text), "");
  text = "a,,b";
  EXPECT_EQ(take_field(text, ','), "a");
  EXPECT_EQ(take_field(text, ','), "");
  EXPECT_EQ(take_field(text, ','), "b");
  EXPECT_EQ(text, "");
}

TEST(LogFields, ScaleDecimalsAndRefuseWhatIsNone) {
  EXPECT_EQ(scaled("48.6", 3), 48'600);
  EXPECT_EQ(scaled("0.015991", 6), 15'991);
  EXPECT_EQ(scaled("7", 6), 7'000'000);
  EXPECT_EQ(scaled("1.23456789", 6), 1'234'567);
  for (const char* text : {"", ".5", "-1", "1e3", "1.2.3", "x", "100000000000000000000"}) EXPECT_FALSE(scaled(text, 0)) << text;
}

TEST(LogFields, ReadDatesOfTheirShape) {
  EXPECT_EQ(date_parts("2015-07-10 06:17:32", "0000-00-00 00:00:00"), (DateParts{2015, 7, 10, 6, 17, 32}));
  EXPECT_EQ(date_parts("06:17:32", "00:00:00"), (DateParts{6, 17, 32, 0, 0, 0}));
  EXPECT_FALSE(date_parts("2015-07-10T06:17:32", "0000-00-00 00:00:00"));
  EXPECT_FALSE(date_parts("2015-7-10 06:17:32", "0000-00-00 00:00:00"));
  // date -u -d @1436509052 gives 2015-07-10 06:17:32.
  EXPECT_EQ(utc_time({2015, 7, 10, 6, 17, 32}), Time{1'436'509'052'000'000});
  EXPECT_FALSE(utc_time({2015, 13, 10, 6, 17, 32}));
  EXPECT_FALSE(utc_time({2015, 7, 10, 24, 17, 32}));
}

}  // namespace
}  // namespace earshot::hil
