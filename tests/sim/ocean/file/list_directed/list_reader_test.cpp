#include "sim/ocean/file/list_directed/list_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

namespace earshot::ocean {
namespace {

constexpr double kUntouched = -7.0;

template <std::size_t kCount>
std::array<double, kCount> numbers_of(const std::string& text) {
  std::array<double, kCount> values{};
  values.fill(kUntouched);
  ListReader("x.env", text).numbers(values, "x");
  return values;
}

std::string complaint_about(const std::string& text) {
  std::array<double, 2> values{};
  try {
    ListReader("x.env", text).numbers(values, "x");
  } catch (const host::BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(ListReader, TakesNumbersFromAsManyLinesAsItNeeds) {
  EXPECT_EQ(numbers_of<4>("1 2.5\n\n  -3e2\n.5 ! of a comment"), (std::array{1.0, 2.5, -300.0, 0.5}));
}

TEST(ListReader, KnowsFortransWaysOfWritingNumbers) {
  EXPECT_EQ(numbers_of<6>("1.5D3, +2 5. 3*0.25"), (std::array{1500.0, 2.0, 5.0, 0.25, 0.25, 0.25}));
}

TEST(ListReader, LeavesAsItWasWhatASlashOrTwoCommasLeaveOut) {
  EXPECT_EQ(numbers_of<4>("1,,3 / 4\n5"), (std::array{1.0, kUntouched, 3.0, kUntouched}));
  EXPECT_EQ(numbers_of<3>("/"), (std::array{kUntouched, kUntouched, kUntouched}));
  EXPECT_EQ(numbers_of<4>("1 2* 4"), (std::array{1.0, kUntouched, kUntouched, 4.0}));
  EXPECT_EQ(numbers_of<2>(", 2"), (std::array{kUntouched, 2.0}));
}

TEST(ListReader, CountsWhatStandsBeforeASlash) {
  std::array<double, 5> values{};
  EXPECT_EQ(ListReader("x.env", "0 80 /\n3").numbers(values, "x"), 2U);
  EXPECT_EQ(ListReader("x.env", "0 2*1 , , 5 6").numbers(values, "x"), 5U);
}

TEST(ListReader, BeginsEachReadOnALineOfItsOwn) {
  ListReader file("x.env", "50.0 60.0 of which one is read\r\n'SVW' ! options\r\nA\n7");
  EXPECT_EQ(file.number("f", host::Range::at_least(0.0)), 50.0);
  EXPECT_EQ(file.text("options"), "SVW");
  EXPECT_EQ(file.text("bottom"), "A");
  EXPECT_FALSE(file.at_end());
  EXPECT_EQ(file.count("n", 1, 9), 7U);
  EXPECT_EQ(file.line_number(), 4U);
  EXPECT_TRUE(file.at_end());
}

TEST(ListReader, UnderstandsAQuoteThatStandsTwiceInAText) {
  EXPECT_EQ(ListReader("x.env", "'it''s'").text("title"), "it's");
  EXPECT_EQ(ListReader("x.env", "\"a 'b'\"").text("title"), "a 'b'");
}

TEST(ListReader, LooksAheadHowManyNumbersALineBeginsWith) {
  EXPECT_EQ(ListReader("x.env", "\n1400, 1600 ! cLow cHigh").numbers_ahead(), 2U);
  EXPECT_EQ(ListReader("x.env", "1 / 2").numbers_ahead(), 1U);
  EXPECT_EQ(ListReader("x.env", "1 ! NSD 2").numbers_ahead(), 1U);
  EXPECT_EQ(ListReader("x.env", " \n").numbers_ahead(), 0U);
}

TEST(ListReader, NamesFileLineAndWhatIsWrong) {
  EXPECT_EQ(complaint_about("1\n\nabc"), "x.env:3: x = abc: must be a finite number");
  EXPECT_EQ(complaint_about("1 nan"), "x.env:1: x = nan: must be a finite number");
  EXPECT_EQ(complaint_about("1 1e999"), "x.env:1: x = 1e999: must be a finite number");
  EXPECT_EQ(complaint_about("1 +-2"), "x.env:1: x = +-2: must be a finite number");
  EXPECT_EQ(complaint_about("1 99999999999999999999999*0"), "x.env:1: x = 99999999999999999999999*0: must be a finite number");
  EXPECT_EQ(complaint_about("1\n"), "x.env:1: x = nothing: the file ends too early");
  EXPECT_EQ(complaint_about("1 'a"), "x.env:1: x = a: must end with a quote on its line");
}

}  // namespace
}  // namespace earshot::ocean
