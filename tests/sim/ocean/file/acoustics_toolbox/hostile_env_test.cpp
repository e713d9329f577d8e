#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/sim/ocean/file/acoustics_toolbox/env_files.hpp"

namespace earshot::ocean::acoustics_toolbox {
namespace {

using tests::kBellhop;

class HostileEnv : public tests::EnvFiles {
 protected:
  /// Either refused in one line that begins with the file, or a case whose numbers are all finite.
  void expect_refused_or_sound(const std::string& text) {
    ++tried_;
    RadialCase read;
    try {
      read = load(text);
    } catch (const host::BadInput& bad) {
      ++refused_;
      const std::string complaint = bad.what();
      EXPECT_TRUE(complaint.starts_with(folder_.path().string())) << complaint;
      EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
      return;
    }
    EXPECT_TRUE(std::isfinite(read.environment.seabed.depth.value)) << text;
    EXPECT_TRUE(read.environment.source.depth < read.environment.seabed.depth) << text;
    for (const SedimentLayer& layer : read.environment.seabed.layers) {
      EXPECT_TRUE(std::isfinite(layer.sound_speed.value) && std::isfinite(layer.attenuation_db_per_wavelength)) << text;
    }
    for (const double depth_m : read.receiver_depth_m) EXPECT_TRUE(depth_m >= 0.0) << text;
  }

  std::size_t tried_ = 0;
  std::size_t refused_ = 0;
};

TEST_F(HostileEnv, IsRefusedOrReadWhereverItIsCut) {
  for (std::size_t size = 0; size < kBellhop.size(); ++size) expect_refused_or_sound(kBellhop.substr(0, size));
  EXPECT_GE(refused_, kBellhop.find("0.5 1.0 1.5"));  // what is cut before the ranges lacks something
}

TEST_F(HostileEnv, IsRefusedOrReadWhateverStandsInPlaceOfAWord) {
  const std::vector<std::string> others{"nan",
                                        "-inf",
                                        "1e999",
                                        "-1",
                                        "0",
                                        "1e18",
                                        "99999999999999999999",
                                        "'",
                                        "\"",
                                        "/",
                                        ",,,,",
                                        "*",
                                        "3*",
                                        "9999999999*1500",
                                        "''",
                                        "x",
                                        std::string("\0\1\xff", 3),
                                        "'CVWT'",
                                        "! 1"};
  const std::string blanks = " \n";
  for (std::size_t from = kBellhop.find_first_not_of(blanks); from != std::string::npos;) {
    const std::size_t to = std::min(kBellhop.find_first_of(blanks, from), kBellhop.size());
    for (const std::string& other : others) expect_refused_or_sound(std::string(kBellhop).replace(from, to - from, other));
    from = kBellhop.find_first_not_of(blanks, to);
  }
  EXPECT_GE(tried_, 800U);
  EXPECT_GE(refused_, tried_ / 3);
}

TEST_F(HostileEnv, IsRefusedWhereItAsksForMoreThanThereIsRoomFor) {
  expect_complaint(with(kBellhop, "5\n0 80 /", "2000000000\n0 80 /"), "number of receiver depths in m = 2e+09: must be");
  expect_complaint(with(kBellhop, "1\n'CVW'", "100000\n'CVW'"), "number of media = 1e+05: must be");
  write("a.ssp", "9999\n0 5\n");
  expect_complaint(with(kBellhop, "'CVW'", "'QVW'"), "a.ssp:2: ranges of the profiles in km");
}

}  // namespace
}  // namespace earshot::ocean::acoustics_toolbox
