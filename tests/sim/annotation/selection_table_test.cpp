#include "sim/annotation/selection_table.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/text/tells.hpp"

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
  EXPECT_TRUE(support::lines_tell(refusal_of("Begin Time (s)\tEnd Time (s)\n1\t2\nabc\t2\n5\t4\n1\n-1\t2\nnan\t2\n"),
                                  {{"t.txt:3", "abc", "0 to 1000000000"},
                                   {"t.txt:4", "4", "before"},
                                   {"t.txt:5", "0 to 1000000000"},
                                   {"t.txt:6", "-1", "0 to 1000000000"},
                                   {"t.txt:7", "nan", "0 to 1000000000"}}));
}

TEST(SelectionTable, IsRefusedWhereTheFirstLineIsNoHeader) {
  const std::string refusal =
      "t.txt: is no Raven selection table, no CSV of start and end and no labels of Audacity: its first line has no column ";
  EXPECT_EQ(refusal_of(""), refusal + "\"Begin Time (s)\"");
  EXPECT_EQ(refusal_of("a song of a whale\n1\t2\n"), refusal + "\"Begin Time (s)\"");
  EXPECT_EQ(refusal_of("Begin Time (ms),End Time (ms)\n1,2\n"), refusal + "\"Begin Time (s)\"") << "no seconds";
  EXPECT_EQ(refusal_of("start,label\n1,fin\n"), refusal + "\"End Time (s)\"");
}

TEST(SelectionTable, IsReadWhateverItsLinesEndWith) {
  for (const std::string end : {"\r", "\n", "\r\n"}) {
    const SelectionTable table = selection_table_from("Begin Time (s)\tEnd Time (s)" + end + "1\t2" + end + "3\t4" + end, "t.txt");
    ASSERT_EQ(table.selections.size(), 2U);
    EXPECT_EQ(table.selections[1].end_s, 4.0);
  }
  EXPECT_EQ(refusal_of("Begin Time (s)\tEnd Time (s)\r1\t2\rx\t4\r").substr(0, 8), "t.txt:3:");
}

// As Audacity 3 exports a label, a label with frequencies and a point.
TEST(SelectionTable, IsReadFromAudacitysLabels) {
  const SelectionTable table = selection_table_from(
      "12.500000\t13.250000\tfin\n20.000000\t21.000000\tfin\n\\\t15.000000\t28.000000\n30.000000\t30.000000\t\n", "t.txt");
  ASSERT_EQ(table.selections.size(), 3U);
  EXPECT_EQ(table.selections[0].begin_s, 12.5);
  EXPECT_EQ(table.selections[0].high_hz, 0.0);
  EXPECT_EQ(table.selections[1].low_hz, 15.0);
  EXPECT_EQ(table.selections[1].high_hz, 28.0);
  EXPECT_EQ(table.selections[2].end_s, 30.0);
  EXPECT_EQ(selection_table_from("12,5\t13,25\tfin\n", "t.txt").selections[0].end_s, 13.25) << "as some countries write it";
}

TEST(SelectionTable, IsReadFromPlainCsv) {
  const SelectionTable plain = selection_table_from("start,end,label\n12.5,13.25,\"fin, far\"\n", "t.csv");
  ASSERT_EQ(plain.selections.size(), 1U);
  EXPECT_EQ(plain.selections[0].end_s, 13.25);
  EXPECT_FALSE(plain.selections[0].names_channel);
  EXPECT_EQ(selection_table_from("1,2,fin\n3,4,fin\n", "t.csv").selections.size(), 2U) << "without a first line of names";
  EXPECT_EQ(selection_table_from("Start (s);End (s);Common name\n1,5;2,5;Fin\n", "t.csv").selections[0].begin_s, 1.5);
  EXPECT_EQ(selection_table_from("start_sec,end_seconds\n1,2\n", "t.csv").selections[0].end_s, 2.0);
  const SelectionTable path =
      selection_table_from("Begin Path\tBegin Time (s)\tEnd Time (s)\tHigh Frequency (Hz)\nC:\\in\\a.wav\t1\t2\t28\n", "t.txt");
  EXPECT_EQ(path.selections[0].begin_file, "C:\\in\\a.wav");
  EXPECT_EQ(path.selections[0].high_hz, 28.0);
  const SelectionTable own =
      selection_table_from("begin_s,duration_s,begin_utc,file,file_offset_s\n70.5,1.5,,\"in/a, b.wav\",10.5\n", "t.csv");
  ASSERT_EQ(own.selections.size(), 1U);
  EXPECT_EQ(own.selections[0].end_s, 72.0);
  EXPECT_EQ(own.selections[0].begin_file, "in/a, b.wav");
  EXPECT_TRUE(own.selections[0].names_offset);
  EXPECT_TRUE(support::tells(refusal_of("start,end\n1,x\n"), {"t.txt:2", "end", "0 to 1000000000"}));
}

TEST(SelectionTable, IsReadWithBlanksAboutItsCellsPlusSignsAndTheMarksOfR) {
  const SelectionTable blanks = selection_table_from("start, end, file name\n 60, +61, \"a, b.wav\"\n", "t.csv");
  ASSERT_EQ(blanks.selections.size(), 1U);
  EXPECT_EQ(blanks.selections[0].begin_s, 60.0);
  EXPECT_EQ(blanks.selections[0].end_s, 61.0);
  EXPECT_EQ(blanks.selections[0].begin_file, "a, b.wav");
  // write.table(x, sep = "\t", row.names = FALSE)
  const SelectionTable of_r = selection_table_from("\"begin\"\t\"end\"\t\"Begin File\"\n3\t4.5\t\"a.wav\"\n", "t.txt");
  ASSERT_EQ(of_r.selections.size(), 1U);
  EXPECT_EQ(of_r.selections[0].begin_file, "a.wav");
}

TEST(SelectionTable, RefusesAHalfChannel) {
  EXPECT_TRUE(support::tells(refusal_of("begin\tend\tChannel\n1\t2\t1.5\n"), {"t.txt:2", "Channel", "1.5"}));
}

TEST(SelectionTable, KeepsSelectionsOfTheSameNumberAndTimesInTwoFiles) {
  EXPECT_EQ(selection_table_from("Selection\tBegin Time (s)\tEnd Time (s)\tBegin File\n1\t1\t2\ta.wav\n1\t1\t2\tb.wav\n", "t.txt")
                .selections.size(),
            2U);
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
