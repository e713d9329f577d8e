#include "sim/sonar/model_files/shade_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::sonar::model_files {
namespace {

/// Three ranges, two depths; k0 r is a quarter turn at 100 m.
SonarField field() {
  SonarField result{.range_m = {100.0, 200.0, 300.0},
                    .depth_m = {10.0, 50.0},
                    .source_level = {},
                    .noise_level = {},
                    .transmission_loss_db = std::vector<float>(6, 40.0F),
                    .sea_floor_depth_m = {60.0F, 60.0F, 60.0F},
                    .pressure = {{0.5, 0.25}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}, {4.0, 0.0}, {std::nan(""), std::nan("")}}};
  result.grid = pe::MarchGrid{};
  result.grid->reference_wavenumber_per_m = 0.005 * std::numbers::pi;
  return result;
}

class ShadeFile : public testing::Test {
 protected:
  void write(ShadeLayout layout, const SonarField& written = field()) {
    write_shade(folder_ / "a.shd", written, {.title = "A case", .frequency = Hertz{50.0}, .depth = Meters{36.0}}, layout);
    std::ifstream stream(folder_ / "a.shd", std::ios::binary);
    bytes_ = {std::istreambuf_iterator<char>(stream), {}};
  }
  /// The number that stands so many bytes behind the beginning of a record, the first of which is 1.
  template <class Number>
  Number at(std::size_t record, std::size_t offset = 0) const {
    Number number{};
    const std::size_t position = (record - 1) * kRecord + offset;
    EXPECT_LE(position + sizeof(number), bytes_.size());
    std::memcpy(&number, bytes_.data() + position, sizeof(number));
    return number;
  }

  static constexpr std::size_t kRecord = 164;  // 41 words: the length and the 80 letters of the title do not fit into fewer
  const support::TemporaryFolder folder_;
  std::string bytes_;
};

TEST_F(ShadeFile, HasTheRecordsOfTheAcousticsToolbox) {
  write(ShadeLayout::kDouble);
  EXPECT_EQ(bytes_.size(), 12 * kRecord);  // ten of the header, one for each depth
  EXPECT_EQ(at<std::int32_t>(1), 41);
  EXPECT_EQ(bytes_.substr(4, 15), "Earshot, A case");
  EXPECT_EQ(bytes_.substr(kRecord, 10), "rectilin  ");
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(at<std::int32_t>(3, 4 * i), 1);
  EXPECT_EQ(at<std::int32_t>(3, 20), 2);
  EXPECT_EQ(at<std::int32_t>(3, 24), 3);
  EXPECT_EQ(at<double>(3, 28), 50.0);
  EXPECT_EQ(at<double>(4), 50.0);
  EXPECT_EQ(at<float>(8), 36.0F);
  EXPECT_EQ(at<float>(9, 4), 50.0F);
  EXPECT_EQ(at<double>(10, 16), 300.0);
}

TEST_F(ShadeFile, OfOlderVersionsHasRangesInSinglePrecision) {
  write(ShadeLayout::kSingle);
  EXPECT_EQ(at<float>(3, 28), 50.0F);
  EXPECT_EQ(at<double>(4), 50.0);
  EXPECT_EQ(at<float>(9, 4), 50.0F);
  EXPECT_EQ(at<float>(10, 8), 300.0F);
}

TEST_F(ShadeFile, HoldsMinusTheConjugateOfThePressureWithItsPhase) {
  write(ShadeLayout::kDouble);
  // (0.5 + 0.25 i) i = -0.25 + 0.5 i at a quarter turn; minus its conjugate is 0.25 + 0.5 i.
  EXPECT_NEAR(at<float>(11, 0), 0.25F, 1e-7F);
  EXPECT_NEAR(at<float>(11, 4), 0.5F, 1e-7F);
  EXPECT_NEAR(at<float>(11, 8), 2.0F, 1e-6F);  // half a turn: -2, minus that
  EXPECT_NEAR(at<float>(12, 8), 3.0F, 1e-6F);
  EXPECT_TRUE(std::isnan(at<float>(12, 16)));
}

TEST_F(ShadeFile, HasLongerRecordsForMoreRanges) {
  SonarField wide = field();
  wide.range_m.resize(30, 400.0);
  wide.pressure.resize(60);
  write(ShadeLayout::kDouble, wide);
  EXPECT_EQ(at<std::int32_t>(1), 60);
  EXPECT_EQ(bytes_.size(), 12U * 240U);
}

TEST_F(ShadeFile, ReplacesOnlyWhatEarshotWrote) {
  write(ShadeLayout::kDouble);
  host::require_writable(folder_ / "a.shd", kShadeOutput, host::Replace::kOwnKind);
  std::ofstream(folder_ / "b.shd") << bytes_.replace(4, 7, "BELLHOP");
  EXPECT_THROW(host::require_writable(folder_ / "b.shd", kShadeOutput, host::Replace::kOwnKind), host::BadInput);
}

}  // namespace
}  // namespace earshot::sonar::model_files
