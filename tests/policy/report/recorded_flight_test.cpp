#include "policy/report/recorded_flight.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "firmware/host/toml/table_reader.hpp"
#include "tests/policy/explain/flown_policy.hpp"
#include "tests/policy/report/flight_folder.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

constexpr NorthEast kCorner{Meters{-3'000.0}, Meters{750.0}};

class RecordedFlightTest : public testing::Test {
 protected:
  RecordedFlightTest() { write_flight(folder_, *policy_, explain::flown(*policy_, 5, kCorner), kCorner); }

  /// What open_recording says when it refuses.
  [[nodiscard]] static std::string refusal(const fs::path& recording, const RecordingOptions& options = {}) {
    try {
      (void)open_recording(recording, options);
    } catch (const host::BadInput& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "more than one line";
      return e.what();
    }
    return "not refused";
  }
  static void expect_output(const std::string& said, std::initializer_list<const char*> parts) {
    for (const char* part : parts) EXPECT_NE(said.find(part), std::string::npos) << part << " is not in: " << said;
  }
  [[nodiscard]] fs::path journal() const { return folder_ / "journal.lcmlog"; }

  support::TemporaryFolder folder_;
  std::unique_ptr<policy::FrozenPolicy> policy_ = explain::belief_policy(1);
};

TEST_F(RecordedFlightTest, HoldsEveryDecisionAgainstThePolicyBesideTheJournal) {
  const RecordedFlight flight = open_recording(folder_, {});
  EXPECT_EQ(flight.journal.decisions.size(), 5U);
  EXPECT_EQ(flight.policy_path, folder_ / "journal.policy");
  EXPECT_EQ(flight.south_west, kCorner);
  EXPECT_FALSE(flight.observer);
}

TEST_F(RecordedFlightTest, MakesABeliefThatTookBearingsAgainBitForBit) {
  const messages::Bearing bearing{.direction = Radians{1.0}, .deviation = Radians{0.2}, .mirror_axis = Radians{0.25}};
  write_flight(folder_ / "with", *policy_, explain::flown(*policy_, 5, kCorner, bearing), kCorner);
  const RecordedFlight flight = open_recording(folder_ / "with", {});  // which refuses what its belief does not give
  ASSERT_EQ(flight.journal.decisions.size(), 5U);
  EXPECT_EQ(flight.journal.decisions[3].bearing, bearing);
  EXPECT_NE(flight.journal.decisions[3].observation, explain::flown(*policy_, 5, kCorner)[3].observation) << "it does not go by them";
}

TEST_F(RecordedFlightTest, OpensTheFolderOfAFlightAtSeaByTheCornerOfItsMission) {
  fs::remove(folder_ / "summary.json");
  fs::remove(journal());
  SeaJournal sea(journal(), kCorner);
  for (const explain::RecordedDecision& decision : explain::flown(*policy_, 5, kCorner)) sea.decision(decision.time_s(), decision);
  sea.end(messages::Ending::kStopped);
  const RecordedFlight flight = open_recording(folder_, {});
  EXPECT_EQ(flight.journal.decisions.size(), 5U);
  EXPECT_EQ(flight.south_west, kCorner);
}

TEST_F(RecordedFlightTest, OpensAJournalAloneOnceItKnowsTheCorner) {
  expect_output(refusal(journal()), {"step 0", "--south-west"});
  EXPECT_EQ(open_recording(journal(), {.south_west = kCorner}).journal.decisions.size(), 5U);
}

TEST_F(RecordedFlightTest, RefusesAnotherPolicyThanTheOneThatFlew) {
  const fs::path other = folder_ / "other.policy";
  support::write_bytes(other, support::signed_bytes(*explain::belief_policy(2)));
  expect_output(refusal(folder_, {.policy = other}), {"step 0", "another policy", "other.policy", "other logits"});
  support::write_bytes(other, support::signed_bytes(*explain::place_policy(1)));
  expect_output(refusal(folder_, {.policy = other}), {"another policy", "other.policy", "this one sees 2"});
  fs::remove(folder_ / "journal.policy");
  expect_output(refusal(folder_), {"journal.policy", "--policy"});
}

TEST_F(RecordedFlightTest, HasTheTablesBesideTheJournalOrThoseThatAreSaid) {
  const RecordedFlight flight = open_recording(folder_, {});
  ASSERT_EQ(flight.tables->tables.size(), 1U);
  EXPECT_EQ(flight.tables->tables[0].snr_half_db, explain::falling_ocean().tables[0].snr_half_db);
  fs::rename(folder_ / "journal.tables", folder_ / "elsewhere.tables");
  EXPECT_EQ(open_recording(folder_, {.tables = folder_ / "elsewhere.tables"}).tables->tables[0].snr_half_db,
            flight.tables->tables[0].snr_half_db);
}

TEST_F(RecordedFlightTest, NamesTheOptionWhereTheTablesAreMissing) {
  fs::remove(folder_ / "journal.tables");
  expect_output(refusal(folder_), {"journal.lcmlog", "no tables beside it (journal.tables)", "--tables FILE"});
  expect_output(refusal(folder_, {.tables = folder_ / "none.tables"}), {"none.tables", "no such file"});
}

TEST_F(RecordedFlightTest, RefusesOtherTablesThanThoseThatFlew) {
  auto louder = std::make_unique<policy::OceanTables>(explain::falling_ocean());
  for (std::int8_t& half_db : louder->tables[0].snr_half_db) half_db = static_cast<std::int8_t>(half_db + 2);
  support::write_bytes(folder_ / "louder.tables", support::signed_bytes(*louder));
  expect_output(refusal(folder_, {.tables = folder_ / "louder.tables"}), {"step 0", "other ocean tables"});
}

TEST_F(RecordedFlightTest, RefusesTablesThatAreNoneOrDamaged) {
  std::ofstream(folder_ / "journal.tables") << std::string(1'000, 'x');
  expect_output(refusal(folder_), {"journal.tables", "not a .tables file"});
  std::vector<std::uint8_t> bytes = support::signed_bytes(explain::falling_ocean());
  bytes[200] ^= 1U;
  support::write_bytes(folder_ / "journal.tables", bytes);
  expect_output(refusal(folder_), {"journal.tables", "is damaged: its CRC-32 is wrong"});
}

TEST_F(RecordedFlightTest, OfAPolicyWithoutANetworkIsHeldAgainstItsAdvice) {
  const auto advice = explain::advice_policy();
  std::vector<explain::RecordedDecision> taken = explain::flown(*advice, 5, kCorner);
  write_flight(folder_, *advice, taken, kCorner);
  EXPECT_EQ(open_recording(folder_, {}).journal.decisions.size(), 5U);
  taken[2].logits[1] += 0.25F;
  write_flight(folder_, *advice, taken, kCorner);
  expect_output(refusal(folder_), {"step 2", "other logits"});
}

TEST_F(RecordedFlightTest, RefusesAGapInTheDecisions) {
  std::vector<explain::RecordedDecision> taken = explain::flown(*policy_, 5, kCorner);
  taken.erase(taken.begin() + 2);
  write_journal(journal(), taken);
  expect_output(refusal(folder_), {"journal.lcmlog", "step 2", "missing"});
}

TEST_F(RecordedFlightTest, SaysWhereAJournalCutShortEndsAndKeepsWhatIsWhole) {
  fs::resize_file(journal(), fs::file_size(journal()) - (28 + 19 + 47) - 10);  // the closing record and a piece of the last decision
  const RecordedFlight flight = open_recording(folder_, {});
  EXPECT_EQ(flight.journal.decisions.size(), 4U);
  EXPECT_EQ(index_of_step(flight, 3), 3U);
  try {
    (void)index_of_step(flight, 4);
    FAIL() << "step 4 is cut off";
  } catch (const host::BadInput& e) {
    expect_output(e.what(), {"--step 4", "step 3", "cut short"});
  }
}

TEST_F(RecordedFlightTest, RefusesAStepBeyondTheFlight) {
  const RecordedFlight flight = open_recording(folder_, {});
  EXPECT_EQ(index_of_step(flight, 4), 4U);
  try {
    (void)index_of_step(flight, 5);
    FAIL() << "there is no step 5";
  } catch (const host::BadInput& e) {
    expect_output(e.what(), {"--step 5", "ends with the decision of step 4"});
    EXPECT_EQ(std::string(e.what()).find("cut"), std::string::npos);
  }
}

TEST_F(RecordedFlightTest, RefusesWhatIsNoJournal) {
  std::ofstream(journal()) << "time,snr\n0,1\n";
  expect_output(refusal(folder_), {"journal.lcmlog", "not a journal"});
  std::ofstream(journal(), std::ios::trunc).flush();
  expect_output(refusal(folder_), {"journal.lcmlog", "no decision"});
  fs::remove(journal());
  expect_output(refusal(folder_), {"journal.lcmlog"});
}

TEST_F(RecordedFlightTest, NamesWhatASummaryDoesNotSay) {
  const auto whole = nlohmann::json::parse(std::ifstream(folder_ / "summary.json"));
  for (const char* key : {"area", "source", "found"}) {
    auto without = whole;
    without.erase(key);
    std::ofstream(folder_ / "summary.json") << without;
    expect_output(refusal(folder_), {"summary.json", key});
  }
  std::ofstream(folder_ / "summary.json") << whole;
  std::ofstream(folder_ / "snr.csv") << "range_m,snr_db\n";
  expect_output(refusal(folder_), {"snr.csv", "0 rows", "at least 2"});
}

TEST_F(RecordedFlightTest, RefusesAnSnrCurveWhoseRangesDoNotRiseFromZeroByOneStepOrWhoseNumbersAreNone) {
  const auto refused = [this](const char* rows) {
    std::ofstream(folder_ / "snr.csv") << "range_m,snr_db\n" << rows;
    return refusal(folder_);
  };
  expect_output(refused("0,30\n0,29\n"), {"snr.csv:3", "same step"});
  expect_output(refused("0,30\n-100,29\n"), {"snr.csv:3", "same step"});
  expect_output(refused("100,30\n200,29\n"), {"snr.csv:2", "must be 0"});
  expect_output(refused("0,30\n100,29\n300,28\n"), {"snr.csv:4", "same step"});
  expect_output(refused("0,30\nnan,29\n"), {"snr.csv:3", "finite"});
  expect_output(refused("0,30\n100,nan\n"), {"snr.csv:3", "finite"});
  expect_output(refused("0,30\n100,1e300\n"), {"snr.csv:3", "finite"});  // no float
  expect_output(refused("0,30\n100.001,29\n200,28\n"), {"not refused"});
}

TEST_F(RecordedFlightTest, GivesAPolicyWithoutABeliefAnObserversOfTheOceanThatWasFlown) {
  const auto policy = explain::place_policy(1);
  fs::remove(folder_ / "journal.tables");
  write_flight(folder_, *policy, explain::flown(*policy, 5, kCorner), kCorner);
  const RecordedFlight flight = open_recording(folder_, {});
  ASSERT_TRUE(flight.observer);
  EXPECT_FALSE(flight.circumstances(explain::Baseline::kCentre).belief_is_the_policys);
  // Five measurements of 1 dB a kilometre find the range to the source, though not the side of the track on which it lies.
  const explain::DecisionAccount last = explain::account_of(flight.circumstances(explain::Baseline::kCentre), flight.journal.decisions);
  EXPECT_LT(last.place.smallest_area_km2(0.5), 150.0) << "of 625";
  expect_output(refusal(journal(), {.south_west = kCorner}), {"journal.policy", "no belief", "summary.json"});
}

}  // namespace
}  // namespace earshot::report
