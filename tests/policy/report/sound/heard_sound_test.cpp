#include "policy/report/sound/heard_sound.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

class HeardSoundTest : public testing::Test {
 protected:
  HeardSoundTest() {
    write("hearing.csv",
          "time_s,snr_db,too_faint,modelled_snr_db,modelled_too_faint,level_db_re_1upa,noise_db_re_1upa\n"
          "100.5,12.5,0,12,0,102.7,90\n101.5,0.1,1,3,1,90,90\n");
    write("spectrogram.csv", "time_s,5,6,7\n1,80,81,82\n3,80.5,81.5,95\n");
  }
  void write(const char* name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] std::string complaint() const {
    try {
      (void)read_heard_sound(folder_);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "";
  }

  const support::TemporaryFolder folder_;
};

TEST_F(HeardSoundTest, IsReadAsItStandsInItsFiles) {
  const HeardSound sound = read_heard_sound(folder_);
  ASSERT_TRUE(sound.is_there());
  ASSERT_EQ(sound.measurements.size(), 2U);
  EXPECT_EQ(sound.measurements[0].snr_db, 12.5);
  EXPECT_EQ(sound.measurements[0].modelled_snr_db, 12.0);
  EXPECT_FALSE(sound.measurements[0].too_faint);
  EXPECT_TRUE(sound.measurements[1].too_faint && sound.measurements[1].modelled_too_faint);
  EXPECT_EQ(sound.spectrogram.frequency_hz, (std::vector<double>{5, 6, 7}));
  EXPECT_EQ(sound.spectrogram.time_s, (std::vector<double>{1, 3}));
  EXPECT_EQ(sound.spectrogram.level_db, (std::vector<double>{80, 81, 82, 80.5, 81.5, 95}));
}

TEST_F(HeardSoundTest, NamesTheLineThatIsNoRow) {
  write("hearing.csv", "time_s,...\n1,2,0,3,0,1,1\n1,nan,0,3,0,1,1\n");
  EXPECT_NE(complaint().find("hearing.csv:3: not a row of this table"), std::string::npos) << complaint();
  write("hearing.csv", "time_s,...\n");
  for (const char* bad : {"", "time_s\n", "time_s,5\n", "time_s,5,x\n"}) {
    write("spectrogram.csv", bad);
    EXPECT_EQ(complaint().empty(), *bad == '\0') << bad;  // an empty file is a flight without a block
  }
  write("spectrogram.csv", "time_s,5,6\n1,80\n");
  EXPECT_TRUE(support::has_line(complaint(), {"spectrogram.csv:2", "not", "table"})) << complaint();
}

}  // namespace
}  // namespace earshot::report
