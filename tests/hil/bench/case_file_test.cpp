#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "hil/bench/case.hpp"
#include "tests/hil/seconds.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::hil {
namespace {

const std::string kWords = "given = \"a search\"\nwhen = \"nothing fails\"\nthen = \"it finds the source\"\n";
const std::filesystem::path kMissions = std::filesystem::path(EARSHOT_SOURCE_DIR) / "hil/missions";
const std::string kExpect = "[expect]\nend = \"completed\"\n";

class CaseFileTest : public testing::Test {
 protected:
  [[nodiscard]] Case load(const std::string& text) const {
    std::ofstream(path_) << text;
    return load_case(path_, kMissions / "search_over_can.toml");
  }
  /// Keys of a fault, one a line.
  [[nodiscard]] Case load_with_fault(const std::string& fault) const { return load(kWords + "[[fault]]\n" + fault + "\n" + kExpect); }
  /// What is wrong with a file, without the name of its folder.
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      (void)load(text);
    } catch (const host::BadInput& e) {
      std::string words = e.what();
      const std::string folder = folder_.path().string() + "/";
      for (std::size_t at = 0; (at = words.find(folder, at)) != std::string::npos;) words.erase(at, folder.size());
      return words;
    }
    return "it was taken";
  }
  [[nodiscard]] std::string refusal_of_fault(const std::string& fault) const {
    return refusal(kWords + "[[fault]]\n" + fault + "\n" + kExpect);
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "cases.toml";
};

TEST_F(CaseFileTest, NeedsWordsAndAnEndAndHasDefaultsForTheRest) {
  const Case c = load(kWords + kExpect);
  EXPECT_EQ(c.name, "cases");
  EXPECT_EQ(c.given, "a search");
  EXPECT_EQ(c.when, "nothing fails");
  EXPECT_EQ(c.then, "it finds the source");
  EXPECT_EQ(c.mission, kMissions / "search_over_can.toml");
  EXPECT_EQ(c.start, (NorthEast{Meters{12'500}, Meters{11'000}}));
  EXPECT_EQ(c.source, (NorthEast{Meters{12'500}, Meters{12'500}}));
  EXPECT_EQ(c.start_heading_deg, 0.0);
  EXPECT_EQ(c.at_most, Duration::seconds(3600));
  EXPECT_TRUE(c.faults.empty());
  EXPECT_EQ(c.expected.end, messages::EndReason::kCompleted);
  EXPECT_TRUE(c.expected.rules.empty());
  EXPECT_TRUE(c.expected.only_these);
  EXPECT_FALSE(c.expected.refuses_navigation.has_value());
  EXPECT_FALSE(c.expected.refuses_commands.has_value());
  EXPECT_EQ(c.defence, "");
}

TEST_F(CaseFileTest, ReadsEveryKey) {
  std::filesystem::copy_file(kMissions / "search_over_can.toml", folder_ / "m.toml");
  const Case c =
      load(kWords +
           "defence = \"a rule\"\nmission = \"m.toml\"\nstart_m = [1, 2.5]\nstart_heading_deg = 270\nsource_m = [-3, 4]\nat_most_s = 600\n"
           "[[fault]]\nkind = \"loss\"\nat_s = 100\nfor_s = 20.5\nof = \"compass\"\npgn = 127250\nshare = 0.25\n"
           "[[fault]]\nkind = \"current\"\nat_s = 0\nmps = 0.4\ntowards_deg = -90\n"
           "[expect]\nend = \"safety_rule\"\nrules = [\"leak\", \"depth_m\"]\nothers_may_fire = true\n"
           "refuses_navigation = true\nrefuses_commands = false\nloses_nothing = true\n");
  EXPECT_EQ(c.defence, "a rule");
  EXPECT_EQ(c.mission, folder_ / "m.toml");
  EXPECT_EQ(c.start, (NorthEast{Meters{1}, Meters{2.5}}));
  EXPECT_EQ(c.start_heading_deg, 270.0);
  EXPECT_NEAR(c.start_heading().value, -1.5707963267948966, 1e-15) << "half of pi to the left, within one bit";
  EXPECT_EQ(c.source, (NorthEast{Meters{-3}, Meters{4}}));
  EXPECT_EQ(c.at_most, Duration::seconds(600));
  ASSERT_EQ(c.faults.size(), 2U);
  EXPECT_EQ(c.faults[0],
            (TimedFault{
                .fault = Fault::kLoss, .from = at_s(100), .until = Time{120'500'000}, .share = 0.25, .device = "compass", .pgn = 127250}));
  EXPECT_EQ(c.faults[1], (TimedFault{.fault = Fault::kCurrent, .from = at_s(0), .amount = 0.4, .direction_deg = -90}));
  EXPECT_EQ(c.expected, (Expectation{.end = messages::EndReason::kSafetyRule,
                                     .rules = {config::Condition::kLeak, config::Condition::kDepth},
                                     .only_these = false,
                                     .refuses_navigation = true,
                                     .refuses_commands = false,
                                     .loses_nothing = true}));
}

TEST_F(CaseFileTest, KnowsEveryKindOfFaultWithItsAmountAndItsBounds) {
  for (const FaultTraits& traits : kFaultTraits) {
    if (traits.bus == FaultBus::kLcm) continue;                                         // lcm/lcm_cases_test.cpp
    if (traits.hits == FaultTarget::kSound || traits.fault == Fault::kNetem) continue;  // below
    const std::string speed = traits.flight == FaultFlight::kAtSea ? "speed = 20\n" : "";
    const std::string fault = "at_s = 1\nkind = \"" + std::string(traits.word) + "\"\n";
    const auto with_fault = [&](const std::string& keys) { return kWords + speed + "[[fault]]\n" + keys + "\n" + kExpect; };
    if (traits.amount.empty()) {
      EXPECT_EQ(load(with_fault(fault)).faults.at(0).fault, traits.fault);
      continue;
    }
    const std::string amount(traits.amount);
    EXPECT_NE(refusal(with_fault(fault)).find("fault 1: " + amount + " is missing"), std::string::npos) << traits.word;
    for (const double bound : {traits.lowest, traits.highest})
      EXPECT_EQ(load(with_fault(fault + amount + " = " + std::to_string(bound))).faults.at(0).amount, bound) << traits.word;
    for (const double beyond : {traits.lowest - 1.0, traits.highest + 1.0})
      EXPECT_NE(refusal(with_fault(fault + amount + " = " + std::to_string(beyond))).find("must be a finite number of at least "),
                std::string::npos)
          << traits.word;
  }
}

TEST_F(CaseFileTest, KnowsTheTroublesOfAControllerAtSeaAlone) {
  for (const Fault fault : {Fault::kErrorPassive, Fault::kBusOff}) {
    const std::string word(kFaultTraits.at(static_cast<std::size_t>(fault)).word);
    const std::string text = "[[fault]]\nat_s = 1\nkind = \"" + word + "\"\n" + kExpect;
    EXPECT_EQ(load(kWords + "speed = 20\n" + text).faults.at(0).fault, fault);
    EXPECT_NE(refusal(kWords + text).find("there is no " + word + " in lock-step"), std::string::npos);
  }
}

TEST_F(CaseFileTest, KnowsEveryEnd) {
  const auto end_of = [this](const std::string& word) { return load(kWords + "[expect]\nend = \"" + word + "\"\n").expected.end; };
  EXPECT_EQ(end_of("under_way"), messages::EndReason::kNone);
  EXPECT_EQ(end_of("completed"), messages::EndReason::kCompleted);
  EXPECT_EQ(end_of("steps_used_up"), messages::EndReason::kStepsUsedUp);
  EXPECT_EQ(end_of("operator_abort"), messages::EndReason::kOperatorAbort);
  EXPECT_EQ(end_of("navigation_stale"), messages::EndReason::kNavigationStale);
  EXPECT_EQ(end_of("snr_stale"), messages::EndReason::kSnrStale);
  EXPECT_EQ(end_of("left_operating_area"), messages::EndReason::kLeftOperatingArea);
  EXPECT_EQ(end_of("time_used_up"), messages::EndReason::kTimeUsedUp);
  EXPECT_EQ(end_of("safety_rule"), messages::EndReason::kSafetyRule);
  EXPECT_EQ(end_of("memory_fault"), messages::EndReason::kMemoryFault);
  EXPECT_EQ(end_of("found"), messages::EndReason::kFound) << "the vehicle says so itself";
  EXPECT_EQ(end_of("outage"), messages::EndReason::kOutage);
}

TEST_F(CaseFileTest, NamesEverythingThatIsWrongAtOnceWithFileLineAndKey) {
  EXPECT_TRUE(support::lines_tell(
      refusal("given = 7\nwhen = \"\"\n[expect]\nends = \"found\"\n"),
      {{"cases.toml:1", "given", "7", "at least"},
       {"cases.toml:2", "when", "at least"},
       {"cases.toml:1", "then", "missing", "text", "at least", "character"},
       {"cases.toml:3", "expect.end", "missing", "under_way", "completed", "steps_used_up", "operator_abort", "navigation_stale",
        "snr_stale", "left_operating_area", "time_used_up", "safety_rule", "memory_fault", "found", "outage"},
       {"cases.toml:4", "expect.ends", "unknown"}}));
}

TEST_F(CaseFileTest, RefusesAPlaceThatIsNone) {
  EXPECT_TRUE(support::tells(refusal("start_m = [1]\n" + kWords + kExpect), {"cases.toml:1", "start_m", "numbers", "north", "east"}));
  EXPECT_TRUE(
      support::tells(refusal("source_m = [1, 2, 3]\n" + kWords + kExpect), {"cases.toml:1", "source_m", "numbers", "north", "east"}));
  EXPECT_TRUE(support::tells(refusal("start_m = [1, 1e7]\n" + kWords + kExpect),
                             {"cases.toml:1", "start_m[1]", "10000000.0", "at least -1000000", "at most 1000000"}));
  EXPECT_TRUE(support::tells(refusal("start_m = 7\n" + kWords + kExpect), {"cases.toml:1", "start_m", "7"}));
}

TEST_F(CaseFileTest, RefusesATimeAtSeaOutOfBounds) {
  for (const std::string seconds : {"9", "1000001", "60.5"})
    EXPECT_TRUE(support::tells(refusal("at_most_s = " + seconds + "\n" + kWords + kExpect),
                               {"cases.toml:1", "at_most_s", seconds, "10 to 1000000"}));
}

TEST_F(CaseFileTest, RefusesAFaultOfNoKnownKindOrWithoutABeginning) {
  EXPECT_TRUE(support::has_line(refusal_of_fault("kind = \"lost\"\nat_s = 1"), {"cases.toml:5", "1", "kind", "lost", "loss", "delay"}));
  EXPECT_TRUE(
      support::tells(refusal_of_fault("kind = \"leak\""), {"cases.toml:4", "1", "at_s", "missing", "at least 0", "at most 1000000"}));
  EXPECT_TRUE(
      support::tells(refusal_of_fault("kind = \"leak\"\nat_s = -1"), {"cases.toml:6", "1", "at_s", "-1", "at least 0", "at most 1000000"}));
  EXPECT_TRUE(support::tells(refusal_of_fault("kind = \"leak\"\nat_s = 1\nfor_s = 0"),
                             {"cases.toml:7", "1", "for_s", "0", "at least 0.1", "at most 1000000"}));
}

TEST_F(CaseFileTest, RefusesWhichFramesWhereTheyAreNone) {
  EXPECT_TRUE(support::tells(refusal_of_fault("kind = \"loss\"\nat_s = 1\nshare = 1.5"),
                             {"cases.toml:7", "1", "share", "1.5", "at least 0", "at most 1"}));
  EXPECT_TRUE(
      support::tells(refusal_of_fault("kind = \"loss\"\nat_s = 1\npgn = 262144"), {"cases.toml:7", "1", "pgn", "262144", "0 to 262143"}));
  EXPECT_TRUE(support::tells(refusal_of_fault("kind = \"loss\"\nat_s = 1\nof = \"log\""),
                             {"cases.toml:7", "1", "of", "log", "autopilot", "compass", "speed-log", "depth-sensor", "navigation",
                              "hydrophone", "operator", "altimeter", "battery", "hull-monitor", "earshot"}));
  EXPECT_EQ(load_with_fault("kind = \"loss\"\nat_s = 1\nof = \"earshot\"").faults.at(0).device, "earshot");
}

TEST_F(CaseFileTest, RefusesKeysThatAKindOfFaultDoesNotHave) {
  EXPECT_TRUE(support::tells(refusal_of_fault("kind = \"leak\"\nat_s = 1\nshare = 0.5"), {"cases.toml:7", "1", "share", "unknown"}));
  EXPECT_EQ(refusal_of_fault("kind = \"leak\"\nat_s = 1\nof = \"compass\""), "cases.toml:7: fault 1: of: unknown key");
  EXPECT_TRUE(support::tells(refusal_of_fault("kind = \"loss\"\nat_s = 1\nseconds = 3"), {"cases.toml:7", "1", "seconds", "unknown"}));
  EXPECT_TRUE(support::tells(refusal_of_fault("kind = \"heading_error\"\nat_s = 1\ndegrees = 3\ntowards_deg = 3"),
                             {"cases.toml:8", "1", "towards_deg", "unknown"}));
  EXPECT_TRUE(support::tells(refusal_of_fault("kind = \"current\"\nat_s = 1\nmps = 1\ntowards_deg = 361"),
                             {"cases.toml:8", "1", "towards_deg", "361", "at least -360", "at most 360"}));
}

TEST_F(CaseFileTest, RefusesRulesThatNoMissionCanHaveAndAnswersThatAreNone) {
  EXPECT_NE(refusal(kWords + kExpect + "rules = [\"leaks\"]\n").find("cases.toml:6: expect.rules"), std::string::npos);
  EXPECT_TRUE(support::tells(refusal(kWords + kExpect + "others_may_fire = 1\n"),
                             {"cases.toml:6", "expect.others_may_fire", "1", "true", "false"}));
  EXPECT_TRUE(support::tells(refusal(kWords + kExpect + "refuses_commands = \"yes\"\n"),
                             {"cases.toml:6", "expect.refuses_commands", "yes", "true", "false"}));
}

TEST_F(CaseFileTest, RefusesAMissionThatIsNotThere) {
  EXPECT_TRUE(
      support::tells(refusal("mission = \"none.toml\"\n" + kWords + kExpect), {"cases.toml:1", "mission", "none.toml", "no none.toml"}));
}

TEST_F(CaseFileTest, RefusesARuleThatItsMissionDoesNotHave) {
  EXPECT_TRUE(support::tells(refusal(kWords + kExpect + "rules = [\"leak\", \"turn_rate_deg_per_s\", \"snr_age_s\"]\n"),
                             {"cases.toml:6", "expect.rules", "no", "turn_rate_deg_per_s"}));
}

TEST_F(CaseFileTest, RefusesAFaultThatBeginsWhenTheFlightIsOver) {
  const std::string fault = "[[fault]]\nkind = \"leak\"\nat_s = ";
  EXPECT_TRUE(support::tells(refusal("at_most_s = 60\n" + kWords + fault + "60\n" + kExpect),
                             {"cases.toml:7", "1", "at_s", "60", "then", "at_most_s"}));
  EXPECT_EQ(load("at_most_s = 60\n" + kWords + fault + "59\n" + kExpect).faults.size(), 1U);
}

TEST_F(CaseFileTest, RefusesACaseThatExpectsNothing) {
  EXPECT_TRUE(support::tells(refusal(kWords), {"cases.toml:1", "expect", "missing"}));
}

TEST_F(CaseFileTest, LoadsAFoldersCasesByNameAndNothingElse) {
  for (const std::string name : {"b.toml", "a.toml", "c.toml"}) std::ofstream(folder_ / name) << kWords + kExpect;
  std::ofstream(folder_ / "README.md") << "no case";
  const std::vector<Case> cases = load_cases(folder_, kMissions / "search_over_can.toml");
  ASSERT_EQ(cases.size(), 3U);
  EXPECT_EQ(cases[0].name, "a");
  EXPECT_EQ(cases[1].name, "b");
  EXPECT_EQ(cases[2].name, "c");
}

TEST(ShippedCases, AreAtLeastFortyAndEachCanBeRead) {
  EXPECT_GE(load_cases(std::filesystem::path(EARSHOT_SOURCE_DIR) / "hil/cases", kMissions / "search_over_can.toml").size(), 40U);
}

TEST_F(CaseFileTest, WithASpeedIsFlownAsAtSeaWhereSignalsHitEitherProgram) {
  const std::string kSea = kWords + "speed = 20\n";
  EXPECT_EQ(load(kWords + kExpect).speed, std::nullopt);
  const Case c = load(kSea + "[[fault]]\nkind = \"kill\"\nat_s = 80\nfor_s = 20\n" +
                      "[[fault]]\nkind = \"pause\"\nof = \"vehicle\"\nat_s = 80\nfor_s = 40\n" + kExpect);
  EXPECT_EQ(c.speed, 20.0);
  EXPECT_EQ(c.faults.at(0), (TimedFault{.fault = Fault::kKill, .from = at_s(80), .until = at_s(100), .device = "earshotd"}));
  EXPECT_EQ(c.faults.at(1), (TimedFault{.fault = Fault::kPause, .from = at_s(80), .until = at_s(120), .device = "vehicle"}));
}

TEST_F(CaseFileTest, SaysOfFaultsAtSeaWhichFileIsGoneAndWhichOrderIsGiven) {
  const auto subject = [this](const std::string& keys) {
    return load(kWords + "speed = 20\n[[fault]]\nat_s = 1\n" + keys + "\n" + kExpect).faults.at(0).device;
  };
  EXPECT_EQ(subject("kind = \"file_gone\""), "policy");
  EXPECT_EQ(subject("kind = \"file_gone\"\nof = \"mission\""), "mission");
  EXPECT_EQ(subject("kind = \"order\""), "abort");
  EXPECT_EQ(subject("kind = \"order\"\nof = \"pause\""), "pause");
  EXPECT_TRUE(support::tells(refusal(kWords + "speed = 20\n[[fault]]\nat_s = 1\nkind = \"order\"\nof = \"start\"\n" + kExpect),
                             {"cases.toml:8", "1", "of", "start", "abort", "pause"}));
  EXPECT_NE(refusal_of_fault("kind = \"file_gone\"\nat_s = 1").find("there is no file_gone in lock-step"), std::string::npos);
}

TEST_F(CaseFileTest, MayExpectFramesRefusedAndNoFlightAtAll) {
  EXPECT_FALSE(load(kWords + kExpect).expected.refuses_frames);
  EXPECT_FALSE(load(kWords + kExpect).expected.refuses_to_fly);
  const Case c = load(kWords + "speed = 20\n" + kExpect + "refuses_frames = true\nrefuses_to_fly = true\n");
  EXPECT_TRUE(c.expected.refuses_frames);
  EXPECT_TRUE(c.expected.refuses_to_fly);
  EXPECT_NE(refusal(kWords + kExpect + "refuses_to_fly = true\n").find("only in a case with a speed"), std::string::npos);
}

TEST_F(CaseFileTest, HasOnlyFaultsThatThereAreInItsKindOfFlight) {
  EXPECT_TRUE(support::tells(refusal(kWords + "speed = 20\n[[fault]]\nkind = \"loss\"\nat_s = 1\n" + kExpect),
                             {"cases.toml:6", "1", "kind", "loss", "no"}));
  EXPECT_NE(refusal_of_fault("kind = \"pause\"\nof = \"vehicle\"\nat_s = 1\nfor_s = 2").find("fault 1: of"), std::string::npos);
  EXPECT_NE(refusal_of_fault("kind = \"slow_disk\"\nat_s = 1").find("there is no slow_disk in lock-step"), std::string::npos);
  EXPECT_NE(refusal(kWords + "speed = 0\n" + kExpect).find("speed"), std::string::npos);
}

TEST(CasesOfTheBench, FlyAVehicleThatHearsForItselfOverCanWithItsSamplesOverLcm) {
  const Case c = load_case(std::filesystem::path(EARSHOT_SOURCE_DIR) / "hil/cases/sea_sound_open.toml", kMissions / "search_over_can.toml");
  EXPECT_EQ(c.bus, host::PortKind::kCan);
  EXPECT_EQ(c.sound_port, 2);
  EXPECT_EQ(load_case(std::filesystem::path(EARSHOT_SOURCE_DIR) / "hil/cases/calm.toml", kMissions / "search_over_can.toml").sound_port, 0);
}

TEST_F(CaseFileTest, ReadsWhatNetemIsToDoAndRefusesWhatAShellWouldTakeForItsOwn) {
  const std::string netem = kWords + "speed = 20\n[[fault]]\nkind = \"netem\"\nat_s = 1\nhow = ";
  EXPECT_EQ(load(netem + "\"delay 50ms 20ms loss 5%\"\n" + kExpect).faults.front().how, "delay 50ms 20ms loss 5%");
  EXPECT_NE(refusal(netem + "\"loss 5%; reboot\"\n" + kExpect).find("must be words of tc-netem(8)"), std::string::npos)
      << refusal(netem + "\"loss 5%; reboot\"\n" + kExpect);
}

TEST_F(CaseFileTest, RefusesAFaultOfSamplesWhereNoneAreTaken) {
  const std::string text = kWords + "speed = 20\n[[fault]]\nkind = \"sound_open\"\nat_s = 1\n" + kExpect;
  EXPECT_NE(refusal(text).find("must have a port of the role"), std::string::npos) << refusal(text);
}

TEST(ShippedCases, SayWhatTheyTestWhereNoRuleHasToFire) {
  for (const Case& c : load_cases(std::filesystem::path(EARSHOT_SOURCE_DIR) / "hil/cases", kMissions / "search_over_can.toml"))
    EXPECT_TRUE(!c.expected.rules.empty() || !c.defence.empty()) << c.name;
}

}  // namespace
}  // namespace earshot::hil
