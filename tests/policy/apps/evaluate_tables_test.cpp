// earshot evaluate --tables: the oceans that policies and ocean_search think possible.
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "policy/tables/make_tables.hpp"
#include "tests/policy/apps/programs.hpp"

namespace earshot::policy_programs {
namespace {

/// Of a paper's search: how deep the vehicle is, what it listens for, how far the tables reach, and how many there are.
struct Listening {
  Meters vehicle_depth{300.0};
  Hertz frequency{20.0};
  std::size_t range_count = 355;
  std::size_t count = 3;
};

class TablesForEvaluate : public Programs {
 protected:
  /// Writes tables of made-up oceans that fall by so many dB over their ranges. @return the option with which they are searched
  std::string given(const std::string& name, const Listening& listening) {
    const tables::CurvePlan plan{
        .vehicle_depth = listening.vehicle_depth, .range_step = Meters{100.0}, .range_count = listening.range_count, .bearings = 1};
    std::vector<tables::OceanCurve> curves;
    for (std::size_t k = 0; k < listening.count; ++k) {
      std::vector<double> snr_db;
      for (std::size_t i = 0; i < listening.range_count; ++i)
        snr_db.push_back(40.0 - (20.0 + static_cast<double>(k)) * static_cast<double>(i) / static_cast<double>(listening.range_count));
      curves.push_back({"ocean", " " + std::to_string(k), 1.0, Meters{3'000.0}, Meters{30.0}, snr_db});
    }
    const std::vector<std::uint8_t> bytes =
        tables::sign(*tables::make_tables(curves, curves, plan, listening.frequency, {{"made", "up"}}), host::make_key());
    const std::string text(bytes.begin(), bytes.end());
    std::ofstream(folder / name, std::ios::binary) << text;
    return " --tables " + name;
  }

  std::string results_of(const std::string& words) {
    EXPECT_EQ(run("evaluate --episodes 3 --force --json a.json " + words), 0) << content(folder / "err");
    return nlohmann::json::parse(content(folder / "a.json"))["results"].dump();
  }

  static inline const std::string kSearch = "evaluate --policies ocean_search --episodes 1";
};

TEST_F(TablesForEvaluate, AreRefusedWhereTheyAreNone) {
  std::ofstream(folder / "text.tables") << "mine\n";
  std::string bytes = (given("good.tables", {}), content(folder / "good.tables"));
  std::ofstream(folder / "cut.tables", std::ios::binary) << bytes.substr(0, 300);
  bytes[400] = static_cast<char>(bytes[400] ^ 1);
  std::ofstream(folder / "damaged.tables", std::ios::binary) << bytes;
  refuses(kSearch + " --tables none.tables", {"none.tables", "no such file"});
  refuses(kSearch + " --tables text.tables", {"text.tables"});
  refuses(kSearch + " --tables cut.tables", {"cut.tables: is cut short"});
  refuses(kSearch + " --tables damaged.tables", {"damaged.tables: is damaged: its CRC-32 is wrong"});
  refuses(kSearch + " --tables " + kFixedSource, {kFixedSource, "is not a .tables file"});
}

TEST_F(TablesForEvaluate, AreRefusedWhereNoneAreOfWhatIsListenedTo) {
  const std::vector<std::string> said{"--tables: world munk_flat is listened to at 20 Hz, 300 m deep, 35355",
                                      "none of the tables are of that, but "};
  const std::string deeper = given("deeper.tables", {.vehicle_depth = Meters{334.0}});
  const std::string higher = given("higher.tables", {.frequency = Hertz{21.1}});
  const std::string nearer = given("nearer.tables", {.range_count = 354});
  refuses(kSearch + deeper, {said[0], said[1]});
  refuses(kSearch + higher, {said[0], said[1]});
  refuses(kSearch + nearer, {said[0], said[1]});
  refuses(kSearch + deeper + higher + nearer, {said[0], said[1]});
}

TEST_F(TablesForEvaluate, MayBeAsManyAsAVehicleHolds) {
  EXPECT_EQ(run(kSearch + given("full.tables", {.count = config::kMaxOceanTables})), 0) << content(folder / "err");
}

TEST_F(TablesForEvaluate, AreThoseOfTheWorldsDepthAndFrequencyWhereSeveralAreGiven) {
  const std::string deeper = given("deeper.tables", {.vehicle_depth = Meters{600.0}});
  const std::string good = given("good.tables", {.vehicle_depth = Meters{320.0}});
  const std::string over_rock = "--policies ocean_search --world " + kSource + "/policy/worlds/rock.toml";
  EXPECT_EQ(results_of(over_rock + deeper + good), results_of(over_rock + good));
  EXPECT_NE(results_of(over_rock + good), results_of(over_rock));
}

TEST_F(TablesForEvaluate, AreWhatAPolicyWithABeliefSearchesBy) {
  const std::string good = given("good.tables", {});
  EXPECT_NE(results_of("--policies shipped" + good), results_of("--policies shipped"));
}

TEST_F(TablesForEvaluate, ChangeNothingForOthers) {
  const std::string good = given("good.tables", {});
  EXPECT_EQ(results_of("--policies oracle,bayes_least_regret" + good), results_of("--policies oracle,bayes_least_regret"));
}

}  // namespace
}  // namespace earshot::policy_programs
