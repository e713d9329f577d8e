#include "hil/bus/candump/recording.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

using enum OlderRecording;
constexpr const char* kLine = "(1436509052.249713) can0 09F8017F#50C3B81347D82BC6\n";  // 51 bytes

const LogEntry kEntry{.time = Time{1'436'509'052'249'713},
                      .interface = "can0",
                      .frame = n2k::Frame{.identifier = 0x09F8017F, .size = 8, .data = {0x50, 0xC3, 0xB8, 0x13, 0x47, 0xD8, 0x2B, 0xC6}}};

class RecordingFile : public testing::Test {
 protected:
  [[nodiscard]] std::string content() const { return support::read_text(path_); }
  void write(const std::string& text) const { std::ofstream(path_) << text; }

  support::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "sea.log";
};

TEST_F(RecordingFile, HoldsALineForEachFrameOnceFlushed) {
  Recording recording(path_, kIsKept);
  recording.add(kEntry);
  recording.add(kEntry);
  recording.flush();
  EXPECT_EQ(content(), std::string(kLine) + kLine);
  EXPECT_EQ(recording.frames(), 2U);
}

TEST_F(RecordingFile, KeepsAnOlderRecordingUnlessToldToReplaceIt) {
  write(kLine);
  EXPECT_THROW(Recording(path_, kIsKept), host::BadInput);
  EXPECT_EQ(content(), kLine);
  Recording(path_, kIsReplaced).flush();
  EXPECT_EQ(content(), "");
}

TEST_F(RecordingFile, KeepsAFileOfAnotherKindUnlessToldToReplaceIt) {
  write("my thesis");
  EXPECT_THROW(Recording(path_, kIsKept), host::BadInput);
  EXPECT_EQ(content(), "my thesis");
  Recording(path_, kIsReplaced).flush();
  EXPECT_EQ(content(), "");
}

TEST_F(RecordingFile, RefusesWhatIsNoRegularFileEvenIfItMayReplace) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THROW(Recording(path_, kIsReplaced), host::BadInput);
  EXPECT_THROW(Recording(folder_, kIsReplaced), host::BadInput);
}

TEST_F(RecordingFile, IsNotReplacedWhileAnotherRecordsIntoIt) {
  Recording first(path_, kIsKept);
  first.add(kEntry);
  first.flush();
  EXPECT_THROW(Recording(path_, kIsReplaced), host::BadInput);
  EXPECT_EQ(content(), kLine);
}

TEST_F(RecordingFile, EndsWithAWholeLineOnAFullDisk) {
  Recording recording(path_, kIsKept);
  recording.add(kEntry);
  recording.flush();
  recording.add(kEntry);
  recording.add(kEntry);
  {
    const support::FileSizeLimit full(120);  // two lines and 18 bytes
    EXPECT_THROW(recording.flush(), host::BadInput);
  }
  EXPECT_EQ(content(), std::string(kLine) + kLine);
  EXPECT_EQ(recording.frames(), 2U);
}

}  // namespace
}  // namespace earshot::hil
