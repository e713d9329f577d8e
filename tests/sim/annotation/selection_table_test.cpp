#include "sim/annotation/selection_table.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::annotation {
namespace {

std::string refusal_of(const std::string& text) {
  try {
    (void)selection_table_from(text, "t.txt");
    return "taken";
  } catch (const host::BadInput& e) {
    return e.what();
  }
}

// As Raven Pro saves a table of both views of one sound, with a column of the user's own.
TEST(SelectionTable, IsReadAsRavenSavesItWithOneSelectionForBothViews) {
  const SelectionTable table = selection_table_from(
      "Selection\tView\tChannel\tBegin Time (s)\tEnd Time (s)\tLow Freq (Hz)\tHigh Freq (Hz)\tBegin File\tFile Offset (s)\tSpecies\r\n"
      "1\tWaveform 1\t1\t4.250000000\t5.500000000\t15.000\t28.000\tsong.wav\t4.2500\tfin\r\n"
      "1\tSpectrogram 1\t1\t4.250000000\t5.500000000\t15.000\t28.000\tsong.wav\t4.2500\tfin\r\n"
      "2\tSpectrogram 1\t1\t610.125000000\t611.000000000\t15.000\t28.000\tnext.wav\t10.1250\tfin\r\n",
      "t.txt");
  ASSERT_EQ(table.selections.size(), 2U);
  EXPECT_EQ(table.selections[0].begin_s, 4.25);
  EXPECT_EQ(table.selections[0].end_s, 5.5);
  EXPECT_EQ(table.selections[0].high_hz, 28.0);
  EXPECT_EQ(table.selections[1].begin_file, "next.wav");
  EXPECT_EQ(table.selections[1].file_offset_s, 10.125);
}

TEST(SelectionTable, NeedsNothingButTheTimes) {
  const SelectionTable table = selection_table_from(
      "\xEF\xBB\xBF"
      "End Time (s)\tBegin Time (s)\n2\t1\n\n4.5e0\t3\n",
      "t.txt");
  ASSERT_EQ(table.selections.size(), 2U);
  EXPECT_EQ(table.selections[1].begin_s, 3.0);
  EXPECT_EQ(table.selections[1].end_s, 4.5);
  EXPECT_TRUE(selection_table_from("Begin Time (s)\tEnd Time (s)\n", "t.txt").selections.empty());
}

TEST(SelectionTable, IsRefusedWithEveryLineThatIsWrong) {
  EXPECT_EQ(refusal_of("Begin Time (s)\tEnd Time (s)\n1\t2\nabc\t2\n5\t4\n1\n-1\t2\nnan\t2\n"),
            "t.txt:3: Begin Time (s) = abc: must be a number from 0 to 1000000000\n"
            "t.txt:4: End Time (s) = 4: lies before the begin\n"
            "t.txt:5: End Time (s) = : must be a number from 0 to 1000000000\n"
            "t.txt:6: Begin Time (s) = -1: must be a number from 0 to 1000000000\n"
            "t.txt:7: Begin Time (s) = nan: must be a number from 0 to 1000000000");
}

TEST(SelectionTable, IsRefusedWhereTheFirstLineIsNoHeader) {
  EXPECT_EQ(refusal_of(""), "t.txt: is no Raven selection table: its first line has no column \"Begin Time (s)\"");
  EXPECT_EQ(refusal_of("Begin Time (s),End Time (s)\n1,2\n"),
            "t.txt: is no Raven selection table: its first line has no column \"Begin Time (s)\"");
}

TEST(SelectionTable, IsWrittenAsRavenOpensIt) {
  EXPECT_EQ(to_text({.columns = {"SNR (dB)"},
                     .selections = {{.begin_s = 4.25,
                                     .end_s = 5.5,
                                     .low_hz = 15.0,
                                     .high_hz = 30.0,
                                     .channel = 2,
                                     .begin_file = "a\tb.wav",
                                     .file_offset_s = 0.25,
                                     .values = {"12.5"}}}}),
            "Selection\tView\tChannel\tBegin Time (s)\tEnd Time (s)\tLow Freq (Hz)\tHigh Freq (Hz)\tBegin File\tFile Offset (s)\tSNR (dB)\n"
            "1\tSpectrogram 1\t2\t4.250000\t5.500000\t15.000\t30.000\ta b.wav\t0.250000\t12.5\n");
}

}  // namespace
}  // namespace earshot::annotation
