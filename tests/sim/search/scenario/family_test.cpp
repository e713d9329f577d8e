#include "sim/search/scenario/family.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "sim/ocean/file/environment_file.hpp"
#include "tests/sim/search/scenario/scenario_rig.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::search {
namespace {

using Environments = std::vector<ocean::Environment>;

const ocean::MunkProfile& munk_of(const ocean::Environment& environment) {
  return std::get<ocean::MunkProfile>(environment.water);
}

/// What somebody writes below [family].
class FamilyTable : public testing::Test {
 protected:
  Family read(const std::string& keys) {
    std::ofstream(folder_ / "family.toml") << "[family]\n" << keys;
    const host::TomlFile file(folder_ / "family.toml");
    host::TableReader root = file.root();
    const Family family = read_family(root.table("family"));
    file.finish();
    return family;
  }
  std::string complaint(const std::string& keys) {
    try {
      (void)read(keys);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "";
  }
  bool is_refused(const std::string& keys) { return !complaint(keys).empty(); }

  const support::TemporaryFolder folder_;
};

TEST_F(FamilyTable, TakesTheLeastAndTheMostOfEachKeyAndNothingBeyond) {
  EXPECT_EQ(read("members = 1\n").seed, 1U) << "unless it says otherwise";
  EXPECT_EQ(read("members = 1000\nseed = 0\n").seed, 0U);
  EXPECT_EQ(read("members = 1000\n").members, 1000U);
  EXPECT_TRUE(is_refused("members = 0\n"));
  EXPECT_TRUE(is_refused("members = 1001\n"));
  EXPECT_TRUE(is_refused("members = 1\nseed = -1\n"));
  struct Limits {
    std::string key, within, below, above;
  };
  for (const Limits& limits : std::vector<Limits>{{"sea_floor_depth_m", "[0.5, 12000]", "[0, 10]", "[10, 12001]"},
                                                  {"axis_depth_m", "[0.5, 12000]", "[0, 10]", "[10, 12001]"},
                                                  {"perturbation", "[0, 0.1]", "[-0.01, 0.1]", "[0, 0.1005]"},
                                                  {"sediment_sound_speed_mps", "[1000, 8000]", "[999, 1500]", "[1500, 8001]"},
                                                  {"noise_level_db_re_1upa", "[-100, 300]", "[-101, 0]", "[0, 301]"}}) {
    EXPECT_FALSE(is_refused("members = 1\n" + limits.key + " = " + limits.within + "\n")) << limits.key;
    EXPECT_TRUE(is_refused("members = 1\n" + limits.key + " = " + limits.below + "\n")) << limits.key;
    EXPECT_TRUE(is_refused("members = 1\n" + limits.key + " = " + limits.above + "\n")) << limits.key;
  }
  EXPECT_TRUE(is_refused("members = 1\nperturbation = [0.01]\n"));
  EXPECT_TRUE(is_refused("members = 1\nperturbation = [0.01, 0.02, 0.03]\n"));
  EXPECT_FALSE(is_refused("members = 1\nperturbation = [0.01, 0.01]\n")) << "one number may be all there is";
}

TEST_F(FamilyTable, SaysOneThingOfBoundsThatAreNone) {
  const std::string place = (folder_ / "family.toml").string() + ":3: family.perturbation";
  const std::string turned = complaint("members = 1\nperturbation = [0.02, 0.01]\n");
  EXPECT_TRUE(turned.starts_with(place) && turned.ends_with(": must be [lowest, highest]")) << turned;
  const std::string word = complaint("members = 1\nperturbation = [\"low\", 0.01]\n");
  EXPECT_TRUE(word.starts_with(place)) << word;
  EXPECT_EQ(word.find("[lowest, highest]"), std::string::npos) << word;
}

TEST_F(FamilyTable, HasItsBoundsReadInTheirOrder) {
  const Family family = read(R"(members = 7
seed = 12
sea_floor_depth_m = [2000, 4000]
axis_depth_m = [800, 1200]
perturbation = [0.005, 0.01]
sediment_sound_speed_mps = [1450, 1650]
noise_level_db_re_1upa = [80, 95]
)");
  EXPECT_EQ(family.members, 7U);
  EXPECT_EQ(family.seed, 12U);
  const auto is = [](const std::optional<Bounds>& bounds, double lowest, double highest) {
    return bounds && bounds->lowest == lowest && bounds->highest == highest;
  };
  EXPECT_TRUE(is(family.sea_floor_depth_m, 2000, 4000));
  EXPECT_TRUE(is(family.axis_depth_m, 800, 1200));
  EXPECT_TRUE(is(family.perturbation, 0.005, 0.01));
  EXPECT_TRUE(is(family.sediment_sound_speed_mps, 1450, 1650));
  EXPECT_TRUE(is(family.noise_level_db_re_1upa, 80, 95));
}

TEST(Family, IsTheOceanItselfAgainAndAgainWhereNothingHasBounds) {
  const Environments members = draw_family(papers_ocean(), {.members = 3, .seed = 1});
  ASSERT_EQ(members.size(), 3U);
  for (const ocean::Environment& member : members) {
    EXPECT_EQ(member.seabed.depth, Meters{3000.0});
    EXPECT_EQ(munk_of(member).axis_depth, Meters{1300.0});
    EXPECT_EQ(munk_of(member).scale, Meters{1300.0});
    EXPECT_EQ(munk_of(member).perturbation, 0.00737);
    EXPECT_EQ(member.seabed.layers.back().sound_speed, MetersPerSecond{1505.0});
    EXPECT_EQ(member.noise_level, Decibels{90.0});
  }
}

/// Whether 200 drawn numbers fill [lowest, highest] and stay in it. Of so many uniform numbers one lies in each twentieth at an end but
/// for a chance of 2 * 0.95^200 = 7e-5; the seed is fixed.
bool fill(const Environments& members, double lowest, double highest, const std::function<double(const ocean::Environment&)>& number) {
  std::vector<double> drawn;
  for (const ocean::Environment& member : members) drawn.push_back(number(member));
  const auto [least, most] = std::ranges::minmax(drawn);
  const double end = (highest - lowest) / 20.0;
  return least >= lowest && least < lowest + end && most <= highest && most > highest - end;
}

TEST(Family, HasEachNumberUniformBetweenItsOwnBounds) {
  const Environments members = draw_family(papers_ocean(), {.members = 200,
                                                            .seed = 3,
                                                            .sea_floor_depth_m = Bounds{2000, 4000},
                                                            .axis_depth_m = Bounds{800, 1600},
                                                            .perturbation = Bounds{0.005, 0.01},
                                                            .sediment_sound_speed_mps = Bounds{1450, 1650},
                                                            .noise_level_db_re_1upa = Bounds{80, 95}});
  EXPECT_TRUE(fill(members, 2000, 4000, [](const ocean::Environment& e) { return e.seabed.depth.value; }));
  EXPECT_TRUE(fill(members, 800, 1600, [](const ocean::Environment& e) { return munk_of(e).axis_depth.value; }));
  EXPECT_TRUE(fill(members, 0.005, 0.01, [](const ocean::Environment& e) { return munk_of(e).perturbation; }));
  EXPECT_TRUE(fill(members, 1450, 1650, [](const ocean::Environment& e) { return e.seabed.layers.back().sound_speed.value; }));
  EXPECT_TRUE(fill(members, 80, 95, [](const ocean::Environment& e) { return e.noise_level.value; }));
}

TEST(Family, KeepsTheRatioOfAProfilesScaleToItsAxis) {
  ocean::Environment own = papers_ocean();
  std::get<ocean::MunkProfile>(own.water).scale = Meters{650.0};  // half its axis' depth
  for (const ocean::Environment& member : draw_family(own, {.members = 20, .seed = 1, .axis_depth_m = Bounds{800, 1600}})) {
    EXPECT_NEAR(munk_of(member).scale.value, 0.5 * munk_of(member).axis_depth.value, 1e-9);  // doubles near 1000
  }
}

TEST(Family, DrawsWhatItDrewWhenAnotherNumberHasBoundsToo) {
  const Family one{.members = 5, .seed = 1, .noise_level_db_re_1upa = Bounds{80, 95}};
  Family two = one;
  two.sea_floor_depth_m = Bounds{2000, 4000};
  const Environments before = draw_family(papers_ocean(), one);
  const Environments after = draw_family(papers_ocean(), two);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(before[i].noise_level, after[i].noise_level) << i;
}

}  // namespace
}  // namespace earshot::search
