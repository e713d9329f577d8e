// earshot evaluate --tables: the oceans that policies and ocean_search think possible.
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "policy/tables/make_tables.hpp"
#include "policy/tables/signed_tables.hpp"
#include "tests/policy/apps/programs.hpp"
#include "tests/support/text/tells.hpp"

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

TEST_F(TablesForEvaluate, MustHaveAName) {
  for (const std::string option : {"--tables", "--world"}) {
    const int status =
        start(EARSHOT_BIN_DIR "/earshot-evaluate", {"--policies", "ocean_search", "--episodes", "1", option, ""}).wait(kPatience);
    EXPECT_EQ(status, 2);
    EXPECT_NE(content(folder / "err").find(option + ": must name a file"), std::string::npos) << content(folder / "err");
  }
}

TEST_F(TablesForEvaluate, MustHaveANameInEveryOtherProgramThatTakesThem) {
  const std::vector<std::vector<std::string>> calls{{"earshot-explain", "map", "a.policy", "-o", "a.png"},
                                                    {"earshot-explain", "decision", "out", "--step", "0"},
                                                    {"earshot-train", "run.toml", "-o", "a.checkpoint"},
                                                    {"earshot-replay", "journal.lcmlog"}};
  for (const std::vector<std::string>& call : calls) {
    std::vector<std::string> words(call.begin() + 1, call.end());
    words.insert(words.end(), {"--tables", ""});
    EXPECT_EQ(start(EARSHOT_BIN_DIR "/" + call.front(), words).wait(kPatience), 2) << call.front();
    EXPECT_NE(content(folder / "err").find("--tables: must name a file"), std::string::npos) << content(folder / "err");
  }
}

TEST_F(TablesForEvaluate, StandInTheFiguresOfEveryWorldWithWhoSignedThem) {
  const std::string good = given("good.tables", {});
  ASSERT_EQ(run("evaluate --policies oracle --episodes 1 --json a.json" + good), 0) << content(folder / "err");
  EXPECT_EQ(content(folder / "err"), "");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  const auto tables = json["worlds"][0]["ocean_tables"];
  EXPECT_EQ(tables["file"], "good.tables");
  EXPECT_EQ(tables["tables"], 3);
  ASSERT_EQ(start("/usr/bin/sha256sum", {"good.tables"}).wait(kPatience), 0);  // coreutils'
  EXPECT_EQ(tables["sha256"].get<std::string>() + "  good.tables\n", content(folder / "out"));
  EXPECT_EQ(tables["signed_by"].get<std::string>().size(), 64U);
  EXPECT_EQ(json["worlds"][0]["vehicle_depth_m"], 300.0);
  EXPECT_EQ(json["warnings"], nlohmann::json::array());
}

TEST_F(TablesForEvaluate, ThatAreNotSignedAreWarnedOfOnceAndInTheFigures) {
  std::string bytes = (given("good.tables", {}), content(folder / "good.tables"));
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  std::ofstream(folder / "unsigned.tables", std::ios::binary) << bytes;
  const std::string worlds = " --world " + kSource + "/policy/worlds/rock.toml " + kSource + "/policy/worlds/noisy_4db.toml";
  ASSERT_EQ(run("evaluate --policies oracle --episodes 1 --json a.json --tables unsigned.tables" + worlds), 0) << content(folder / "err");
  const std::string warning = "unsigned.tables: is not signed with the key that it names: a vehicle refuses it";
  EXPECT_EQ(content(folder / "err"), "earshot evaluate: warning: " + warning + "\n");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["warnings"], nlohmann::json::array({warning}));
  EXPECT_TRUE(json["worlds"][1]["ocean_tables"]["signed_by"].is_null());
}

TEST_F(TablesForEvaluate, ThatShipAndAreOfNoWorldsDepthAreWarnedOfInTheFiguresToo) {
  const std::string worlds = " --world " + kSource + "/policy/worlds/rock.toml " + kSource + "/policy/worlds/water_60m.toml";
  ASSERT_EQ(run("evaluate --policies oracle --episodes 1 --json a.json --vehicle-depth-m 10" + worlds), 0) << content(folder / "err");
  const auto json = nlohmann::json::parse(content(folder / "a.json"));
  EXPECT_EQ(json["worlds"][0]["ocean_tables"], "own ocean");
  EXPECT_EQ(json["worlds"][0]["vehicle_depth_m"], 10.0);
  ASSERT_EQ(json["warnings"].size(), 2U) << json["warnings"];
  const std::string warning = json["warnings"][0];
  EXPECT_TRUE(support::tells(warning, {"rock", "no tables", "20 Hz", "10 m", "own ocean"})) << warning;
  EXPECT_NE(content(folder / "err").find("earshot evaluate: warning: " + warning + "\n"), std::string::npos) << content(folder / "err");
  ASSERT_EQ(run("evaluate --policies oracle --episodes 1 --json b.json" + worlds), 0) << content(folder / "err");
  const auto own = nlohmann::json::parse(content(folder / "b.json"));
  EXPECT_EQ(own["worlds"][0]["vehicle_depth_m"], 300.0);
  EXPECT_EQ(own["worlds"][1]["vehicle_depth_m"], 30.0);
  EXPECT_TRUE(own["worlds"][1]["ocean_tables"]["file"].get<std::string>().ends_with("/20hz_30m.tables"));
  EXPECT_EQ(own["warnings"], nlohmann::json::array());
}

TEST_F(TablesForEvaluate, AndAllElseThatIsReadAreReplacedByNoOutput) {
  given("a.tables", {});
  fs::create_directory(folder / "several");
  fs::copy_file(folder / "a.tables", folder / "several/b.tables");
  fs::copy_file(kFixedSource, folder / "p.policy");
  write_ocean_with_section(folder / "e.toml", folder / "section.csv");
  std::ofstream(folder / "w.toml") << "name = \"own\"\nwhat = \"b\"\nseed = 1\nenvironment = \"e.toml\"\n";
  const std::string brief = "evaluate --force --episodes 1 ";
  for (const std::string output : {"--csv", "--json", "--paths", "--page"}) {
    const std::string and_policy = ", " + output + " p.policy: the same file";
    refuses(brief + "p.policy " + output + " p.policy", {"POLICY p.policy" + and_policy});
    refuses(brief + "--policies oracle,p.policy --source fixed " + output + " p.policy", {"POLICY p.policy" + and_policy});
    refuses(brief + "--policies oracle --tables a.tables " + output + " a.tables", {"--tables a.tables, " + output + " a.tables"});
    refuses(brief + "--policies oracle --tables several " + output + " several/b.tables", {"--tables several/b.tables, "});
    refuses(brief + "--policies oracle --world w.toml " + output + " w.toml", {"--world w.toml, " + output + " w.toml"});
    refuses(brief + "--policies oracle --world w.toml " + output + " e.toml", {"environment of a world", "e.toml: the same file"});
    refuses(brief + "--policies oracle --environment e.toml " + output + " e.toml", {"--environment e.toml, " + output + " e.toml"});
    refuses(brief + "--policies oracle --environment e.toml " + output + " section.csv", {"a file of the environment section.csv, "});
    refuses(brief + "--policies oracle --world w.toml " + output + " section.csv", {"environment of a world section.csv, "});
  }
  EXPECT_EQ(content(folder / "p.policy"), content(kFixedSource));
}

TEST_F(TablesForEvaluate, ChangeNothingForOthers) {
  const std::string good = given("good.tables", {});
  EXPECT_EQ(results_of("--policies oracle,bayes_least_regret" + good), results_of("--policies oracle,bayes_least_regret"));
}

}  // namespace
}  // namespace earshot::policy_programs
