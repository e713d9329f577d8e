#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/host/policy/tables_choice.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::tables {
namespace {

const std::vector<std::filesystem::path> kShipped{EARSHOT_SOURCE_DIR "/policy/tables/shipped"};
const std::string kPapersOcean = EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml";
constexpr Meters kDiagonal{35'355.34};  // of 25 km x 25 km

TEST(ShippedTables, AreSignedByTheShippedPublicKeyAndNamedForFrequencyAndDepth) {
  const host::TrustedKey trusted = host::load_public_key(EARSHOT_SOURCE_DIR "/policy/frozen/earshot.pub");
  for (const host::TablesFile& file : host::read_tables_files(kShipped)) {
    EXPECT_TRUE(host::is_signed_at_end(file.bytes, trusted.key)) << file.path;
    std::ostringstream name;
    name << file.tables->frequency.value << "hz_" << file.tables->receiver_depth.value << "m.tables";
    EXPECT_EQ(file.path.filename(), name.str());
  }
}

/// Of a mission in 25 km x 25 km. Throws where there is none.
const host::TablesFile& file_for(const std::vector<host::TablesFile>& files, double depth_m, double frequency_hz) {
  return host::tables_for(files, {.vehicle_depth = Meters{depth_m}, .frequency = Hertz{frequency_hz}, .furthest = kDiagonal}, "mission");
}

TEST(ShippedTables, CoverEveryDepthFrom27To363MetresAt20HzFrom100MetresDownWithinATwentieth) {
  const std::vector<host::TablesFile> files = host::read_tables_files(kShipped);
  for (double depth_m = 27.0; depth_m <= 363.0; depth_m += 0.25) {
    ASSERT_NO_THROW((void)file_for(files, depth_m, 20.0)) << depth_m;
    const double made_for_m = file_for(files, depth_m, 20.0).tables->receiver_depth.value;
    const double share = depth_m >= 100.0 && depth_m <= 345.0 ? 0.05 : 0.1;
    EXPECT_NEAR(made_for_m, depth_m, share * made_for_m + 1e-9) << depth_m;  // rounding at the ends
  }
}

TEST(ShippedTables, AreMadeForTheDepthsOfThePaperAndOfShallowWaterAt20And35Hz) {
  const std::vector<host::TablesFile> files = host::read_tables_files(kShipped);
  for (const char* depth : {"30", "100", "300"}) {
    EXPECT_EQ(file_for(files, std::stod(depth), 20.0).path.filename(), std::string("20hz_") + depth + "m.tables");
    EXPECT_EQ(file_for(files, std::stod(depth), 35.0).path.filename(), std::string("35hz_") + depth + "m.tables");
  }
}

TEST(ShippedTables, HoldWatersFromSixtyMetresOrTheVehiclesDepthToSixKilometres) {
  for (const host::TablesFile& file : host::read_tables_files(kShipped)) {
    const policy::OceanTables& tables = *file.tables;
    EXPECT_GT(tables.tables.size(), 90U) << file.path;
    EXPECT_GE(tables.sea_depth.least.value, 60.0) << file.path;
    EXPECT_LT(tables.sea_depth.least.value, std::max(65.0, 1.05 * tables.receiver_depth.value)) << file.path;
    EXPECT_GT(tables.sea_depth.most.value, 5'800.0) << file.path;
    EXPECT_LT(tables.source_depth.least.value, 11.0) << file.path;
    EXPECT_GT(tables.source_depth.most.value, 190.0) << file.path;
  }
}

/// The PE's curve of that environment is what the table is to say, to half a decibel.
TEST(ShippedTables, HoldThePapersOceanFirstAndAsLikelyAsAllOthers) {
  ocean::Environment papers = ocean::load_environment(kPapersOcean);
  for (const host::TablesFile& file : host::read_tables_files(kShipped)) {
    const policy::OceanTables& tables = *file.tables;
    const policy::OceanTable& first = tables.tables[0];
    EXPECT_EQ(std::string(first.name.begin(), first.name.end()), papers.name.substr(0, first.name.size())) << file.path;
    double others = 0.0;
    for (const policy::OceanTable& table : tables.tables) others += double{table.prior};
    others -= double{first.prior};
    EXPECT_NEAR(double{first.prior}, others, 1e-5) << file.path;  // floats of a hundred priors
    papers.source.frequency = tables.frequency;
    const sonar::SnrCurve heard = sonar::compute_snr_curve(papers, tables.receiver_depth, policy::reach(tables));
    for (const std::size_t range : {1U, 7U, 30U, 65U, 120U, 200U, 354U}) {
      const double snr_db = heard.at(static_cast<double>(range) * tables.range_step).value;
      const double expected_db = std::min(snr_db, double{policy::kMostTableSnr_db});  // a byte holds no more
      // A quarter by rounding; another processor's PE may round the other way.
      EXPECT_NEAR(double{first.snr_db(range)}, expected_db, 0.26) << file.path << " " << range;
    }
  }
}

}  // namespace
}  // namespace earshot::tables
