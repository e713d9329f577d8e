#include "sim/listening/truth.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::listening {
namespace {

constexpr detector::Band kBand{.low = Hertz{15}, .high = Hertz{30}};
const std::string kHead = "Begin File\tBegin Time (s)\tEnd Time (s)";

/// Two files of ten seconds with a minute between them.
class TruthOfTwoFiles : public testing::Test {
 protected:
  TruthOfTwoFiles() : sequence_({file("a_20200912_000000.wav"), file("b_20200912_000100.wav")}) {}

  std::filesystem::path file(const std::string& name) {
    tests::write(folder_ / name, tests::WavBytes{.sample_rate = 100, .samples = std::string(2000, '\1')}.bytes());
    return folder_ / name;
  }

  [[nodiscard]] Truth of(const std::string& text, std::size_t channel = 1) const {
    return truth_of(annotation::selection_table_from(text, "t.txt"), "t.txt", {.sequence = sequence_, .channel = channel, .band = kBand});
  }

  [[nodiscard]] std::string begins(const std::string& text) const {
    std::string all;
    try {
      for (const annotation::Interval& interval : of(text).intervals) all += std::to_string(static_cast<int>(interval.begin_s)) + " ";
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return all;
  }

  support::TemporaryFolder folder_;
  recording::Sequence sequence_;
};

TEST_F(TruthOfTwoFiles, CountsTimesFromTheBeginOfTheFileThatALineNames) {
  EXPECT_EQ(begins(kHead + "\na_20200912_000000.wav\t2\t3\nb_20200912_000100.wav\t4\t5\n"), "2 14 ");
  EXPECT_EQ(begins(kHead + "\nfolder\\b_20200912_000100.flac\t4\t5\n"), "14 ") << "of another folder, in another format";
}

TEST_F(TruthOfTwoFiles, CountsTimesThroughTheSequenceWhereTheyLieInTheNamedFilesSo) {
  EXPECT_EQ(begins(kHead + "\na_20200912_000000.wav\t2\t3\nb_20200912_000100.wav\t14\t15\n"), "2 14 ");
  EXPECT_EQ(begins("Begin Time (s)\tEnd Time (s)\n2\t3\n14\t15\n"), "2 14 ");
}

TEST_F(TruthOfTwoFiles, PrefersTheOffsetInTheFile) {
  // The table was made over more files than are listened to.
  EXPECT_EQ(begins(kHead + "\tFile Offset (s)\nb_20200912_000100.wav\t204\t205.5\t4\nz.wav\t304\t305\t4\n"), "14 ");
  EXPECT_DOUBLE_EQ(of(kHead + "\tFile Offset (s)\nb_20200912_000100.wav\t204\t205.5\t4\n").intervals[0].end_s, 15.5);
}

TEST_F(TruthOfTwoFiles, RefusesATableOfOtherFiles) {
  EXPECT_TRUE(support::tells(begins(kHead + "\nz.wav\t2\t3\n"), {"t.txt", "none", "z.wav"}));
  EXPECT_TRUE(support::tells(begins("Begin Time (s)\tEnd Time (s)\n24\t25\n"), {"t.txt", "24 s", "20 s"}));
  EXPECT_TRUE(support::tells(begins(kHead + "\nb_20200912_000100.wav\t99\t100\n"), {"t.txt", "neither", "nor", "whole"}));
}

TEST_F(TruthOfTwoFiles, DoesNotCountAndTellsWhatIsNotListenedTo) {
  const Truth channel = of("Channel\tBegin Time (s)\tEnd Time (s)\n2\t2\t3\n1\t4\t5\n");
  EXPECT_EQ(channel.intervals.size(), 1U);
  ASSERT_EQ(channel.remarks.size(), 1U);
  EXPECT_TRUE(support::tells(channel.remarks[0], {"t.txt", "1", "not counted", "1"}));
  EXPECT_EQ(of("Channel\tBegin Time (s)\tEnd Time (s)\n2\t2\t3\n1\t4\t5\n", 2).intervals[0].begin_s, 2.0);
  const Truth band =
      of("Low Freq (Hz)\tHigh Freq (Hz)\tBegin Time (s)\tEnd Time (s)\n2000\t8000\t2\t3\n1\t15\t4\t5\n31\t40\t6\t7\n0\t0\t8\t9\n");
  ASSERT_EQ(band.intervals.size(), 2U);
  EXPECT_EQ(band.intervals[0].begin_s, 4.0);
  EXPECT_EQ(band.intervals[1].begin_s, 8.0) << "of no frequency";
  EXPECT_TRUE(support::tells(band.remarks[0], {"t.txt", "2", "not counted", "outside"}));
}

TEST_F(TruthOfTwoFiles, IsRefusedWhereNothingOfTheTableIsListenedTo) {
  EXPECT_TRUE(
      support::tells(begins("Channel\tLow Freq (Hz)\tHigh Freq (Hz)\tBegin Time (s)\tEnd Time (s)\n2\t15\t30\t2\t3\n1\t2000\t8000\t2\t3\n"),
                     {"t.txt", "no score", "none", "to", "1", "1", "1", "outside"}));
  EXPECT_EQ(begins("Begin Time (s)\tEnd Time (s)\n"), "") << "a table that says of a recording that nothing is in it";
}

TEST_F(TruthOfTwoFiles, RefusesTimesThatFitInBothWaysAndDiffer) {
  file("c_20200912_000200.wav");
  tests::write(folder_ / "c_20200912_000200.wav", tests::WavBytes{.sample_rate = 100, .samples = std::string(8000, '\1')}.bytes());
  const recording::Sequence longer({folder_ / "a_20200912_000000.wav", folder_ / "c_20200912_000200.wav"});
  const annotation::SelectionTable table = annotation::selection_table_from(kHead + "\nc_20200912_000200.wav\t12\t13\n", "t.txt");
  EXPECT_THROW((void)truth_of(table, "t.txt", {.sequence = longer, .channel = 1, .band = kBand}), host::BadInput);
}

}  // namespace
}  // namespace earshot::listening
