#include <random>

#include "tests/sim/apps/field/field_program.hpp"
#include "tests/sim/sonar/hilly_ocean.hpp"

namespace earshot::tests {
namespace {

/// An ocean over a chart of a NetCDF-4 file: 6 x 6 nodes about 47.5 degrees north, 8 west.
class DamagedChart : public FieldProgram {
 protected:
  DamagedChart() {
    std::string text = read(write_hilly_ocean(folder_));
    const auto replace = [&text](const std::string& what, const std::string& by) { text.replace(text.find(what), what.size(), by); };
    replace("latitude_deg = 0.0", "latitude_deg = 47.5");
    replace("longitude_deg = 0.0", "longitude_deg = -8.0");
    replace("layout = \"grid_csv\"\nfile = \"chart.csv\"", "layout = \"gebco\"\nfile = \"chart.nc\"\nreach_km = 60.0");
    std::ofstream(folder_ / "gebco.toml") << text;
  }

  int run_over(const std::string& chart) {
    std::ofstream(folder_ / "chart.nc", std::ios::binary) << chart;
    return run((folder_ / "gebco.toml").string() + " -o " + output() + " --max-range-km 1 --output-step-m 500 --depth 500");
  }

  const std::string whole_ = read(std::string(EARSHOT_SOURCE_DIR) + "/tests/sim/netcdf/reference/strings.nc");
};

/// As in NetcdfReader.SurvivesDamageOfAllKinds, each in a process of its own: a process that has met other files has another heap, and
/// damage that crashes one may leave the other alone.
std::string damaged(std::string bytes, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (std::uint32_t left = 1 + random() % 8; left > 0; --left) {
    const std::size_t at = random() % bytes.size();
    bytes[at] = static_cast<char>(random() & 0xFFU);
  }
  return bytes;
}

TEST_F(DamagedChart, NeverEndsTheProgramButByARefusalThatNamesTheFile) {
  ASSERT_EQ(run_over(whole_), 0) << errors();
  std::vector<std::uint32_t> seeds{16, 65, 103, 423, 472, 520};  // the library crashes in a process that has read nothing before
  for (std::uint32_t seed = 1000; seeds.size() < 100; ++seed) seeds.push_back(seed);
  int crashes = 0;
  int refusals = 0;
  for (const std::uint32_t seed : seeds) {
    std::filesystem::remove(output());
    const int status = run_over(damaged(whole_, seed));
    if (status == 0) continue;  // not every byte carries meaning
    ++refusals;
    EXPECT_EQ(status, 2) << seed;
    EXPECT_EQ(errors().find("earshot field: " + (folder_ / "chart.nc").string() + ": "), 0U) << seed << ": " << errors();
    if (errors().find("is damaged: reading it ended with ") != std::string::npos) ++crashes;
    EXPECT_TRUE(nothing_written()) << seed;
  }
  EXPECT_GT(refusals, 40);
  EXPECT_GT(crashes, 0) << "none of the files crashes the library: does this test still meet what it is for?";
}

}  // namespace
}  // namespace earshot::tests
