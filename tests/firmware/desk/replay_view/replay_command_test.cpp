// GIVEN a journal, WHEN earshot replay is asked about it, THEN it says whether the core gives it again, and what another would have
// decided.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/firmware/boards/linux/replay/random_mission.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_mission.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::replay_view {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// Ten seconds of a search that begins 12 km north, 12 km east with a START in the second.
std::vector<board::Happening> script() {
  std::vector<board::Happening> happenings;
  for (int second = 1; second <= 10; ++second) {
    const Time now = Time{1'795'000'000'000'000} + Duration::seconds(second);
    const auto add = [&](const auto& value) { happenings.push_back({.time = now, .port = 1, .input = value}); };
    add(messages::Navigation{
        .time = now, .position = at(12'000, 12'000), .depth = Meters{300}, .heading = Radians{0}, .speed = MetersPerSecond{0}});
    add(messages::SnrMeasurement{.time = now, .snr = Decibels{12}});
    if (second == 2) add(runtime::command_of(messages::Order::kStart, now));
    happenings.push_back({.time = now});
  }
  return happenings;
}

class ReplayCommand : public ::testing::Test {
 protected:
  ReplayCommand() {
    board::Vessel vessel(board::walking_mission(kSeed), journal_);
    vessel.live_through(script());
    vessel.end(vessel.standing());
    policy::FrozenPolicy north = board::walk();
    north.draw = policy::ActionDraw::kArgmax;  // of logits that are all the same: the first action, north
    support::write_bytes(folder_ / "north.policy", support::signed_bytes(north));
    north.step_length = Meters{900};
    support::write_bytes(folder_ / "short.policy", support::signed_bytes(north));
  }

  int replay(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), journal_.string());
    support::Process process(fs::path(EARSHOT_BIN_DIR) / "earshot-replay", arguments,
                             {.folder = folder_, .output = folder_ / "said.txt", .errors = folder_ / "errors.txt"});
    const int status = process.wait(30s);
    output_ = support::read_text(folder_ / "said.txt");
    errors_ = support::read_text(folder_ / "errors.txt");
    return status;
  }
  /// What it said, without the breaks that keep a line within a terminal.
  [[nodiscard]] std::string unwrapped() const {
    std::string text = output_;
    for (std::size_t at = text.find("\n  "); at != std::string::npos; at = text.find("\n  ", at)) text.replace(at, 3, " ");
    return text;
  }
  [[nodiscard]] std::string file(const char* name) const { return (folder_ / name).string(); }
  void write_mission(const char* name, const std::string& more) const {
    std::string text = support::mission_of_the_walk(support::read_text(EARSHOT_SOURCE_DIR "/firmware/boards/linux/missions/search.toml"));
    text.insert(text.find("file = \"walk.policy\""), "public_key_file = \"walk.pub\"\n");
    std::ofstream(file(name)) << text << more;
  }

  static constexpr std::uint64_t kSeed = 1;  ///< whose first draw is not north
  const support::TemporaryFolder folder_;
  const fs::path journal_ = folder_ / "journal.lcmlog";
  std::string output_;
  std::string errors_;
};

TEST_F(ReplayCommand, SaysThatAWholeJournalIsTheSame) {
  EXPECT_EQ(replay({}), 0) << errors_;
  // Ten fixes, ten SNRs, the START, and the port's own first report.
  EXPECT_TRUE(support::has_line(output_, {journal_.string(), "22 inputs", "10 turns", "1 decision", "10.0 s"})) << output_;
  EXPECT_TRUE(support::tells(support::last_line(output_), {"every output", "the same"})) << output_;
  EXPECT_EQ(errors_, "");
}

TEST_F(ReplayCommand, SaysThatTheEndIsMissing) {
  fs::resize_file(journal_, fs::file_size(journal_) - 94);  // the closing record: 28 + 19 + 47
  EXPECT_EQ(replay({"--quiet"}), 1);
  EXPECT_EQ(output_, "");
  EXPECT_TRUE(support::lines_tell(errors_, {{journal_.string(), "journal's", "end", "missing", "program", "killed", "lost"}}));
}

TEST_F(ReplayCommand, SaysThatAFileWithoutARecordIsNoJournal) {
  std::ofstream(file("notes.txt")) << "notes of mine";
  support::Process process(fs::path(EARSHOT_BIN_DIR) / "earshot-replay", {"notes.txt"},
                           {.folder = folder_, .output = folder_ / "said.txt", .errors = folder_ / "errors.txt"});
  EXPECT_EQ(process.wait(30s), 2);
  EXPECT_TRUE(support::lines_tell(support::read_text(folder_ / "errors.txt"), {{"notes.txt", "not", "journal", "no"}}));
}

TEST_F(ReplayCommand, CallsAnEndThatIsCutNoDamage) {
  const std::uintmax_t closing = fs::file_size(journal_) - 94;
  fs::resize_file(journal_, closing + 44);
  EXPECT_EQ(replay({"--quiet"}), 1);
  EXPECT_TRUE(support::lines_tell(
      errors_, {{journal_.string(), "journal", "middle", "44 bytes", std::to_string(closing), "program", "stopped", "wrote"},
                {journal_.string(), "journal's", "end", "missing", "program", "killed", "lost"}}));
}

TEST_F(ReplayCommand, SaysWhatAnotherPolicyWouldHaveDecidedAndDrawsIt) {
  EXPECT_EQ(replay({"--policy", file("north.policy"), "--map", file("m.svg"), "--json", file("r.json")}), 0) << errors_;
  EXPECT_TRUE(support::has_line(output_, {"step 0", "then", "2.0 s"})) << output_;
  std::istringstream lines(output_);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.size() <= 100 || line.find(folder_.path().string()) != std::string::npos) << line;
  EXPECT_TRUE(support::has_line(unwrapped(), {"now", "2.0 s", "000 deg", "13.000 km north", "12.000 km east"})) << output_;
  EXPECT_NE(output_.find("set-points differ from 2.0 s on: "), std::string::npos) << output_;
  EXPECT_NE(unwrapped().find("no forecast"), std::string::npos) << output_;
  EXPECT_EQ(support::read_text(file("m.svg")).find("<svg "), 0U);
  EXPECT_NE(support::read_text(file("m.svg")).find("journal.lcmlog: decided then, and now with policy north.policy"), std::string::npos);
  const std::string json = support::read_text(file("r.json"));
  EXPECT_NE(json.find("\"parting_step\": 0"), std::string::npos) << json;
  EXPECT_EQ(replay({"--json", file("r.json")}), 0) << "of its own kind: " << errors_;
  EXPECT_NE(support::read_text(file("r.json")).find("\"what_if\": null"), std::string::npos);
}

TEST_F(ReplayCommand, NamesTheRuleByWhichAnotherMissionEnds) {
  write_mission("m.toml", "\n[[rule]]\nwhen = \"vehicle_status_age_s\"\nabove = 3.0\nthen = \"abort\"\n");
  EXPECT_EQ(replay({"--mission", file("m.toml"), "--json", file("r.json")}), 0) << errors_;
  // Thirteen rules stand in a mission without a fence. Nobody tells of the vehicle from the second in which the search begins: three
  // seconds are over in the sixth.
  EXPECT_TRUE(support::has_line(unwrapped(), {"now", "ABORT", messages::to_string(messages::EndReason::kSafetyRule), "after 0 steps",
                                              "6.0 s", "rule 14", "vehicle_status_age_s", "4.0", "above 3.0", "abort"}))
      << output_;
  EXPECT_TRUE(support::has_line(output_, {"now steers there", "rule 14", "vehicle_status_age_s", "4.0", "above 3.0", "abort"})) << output_;
  EXPECT_NE(support::read_text(file("r.json")).find("\"rule\": \"rule 14, vehicle_status_age_s: 4.0, above 3.0: abort\""),
            std::string::npos);
}

TEST_F(ReplayCommand, RefusesAPolicyOfAnotherMissionInOneLine) {
  EXPECT_EQ(replay({"--policy", file("short.policy")}), 2);
  EXPECT_TRUE(support::lines_tell(errors_, {{journal_.string(), "search.step_length_m", "1000", "900", file("short.policy"), "trained"}}));
  EXPECT_EQ(output_, "");
}

TEST_F(ReplayCommand, RefusesAStepThatIsNotDecidedAndAMapOfNothingOrOfAnotherKindThanItsNameSays) {
  EXPECT_EQ(replay({"--from", "1"}), 2);
  EXPECT_TRUE(support::lines_tell(errors_, {{"--from", "1", "no", "1", "step 0"}}));
  EXPECT_EQ(replay({"--map", file("m.svg")}), 2);
  EXPECT_EQ(errors_, "--map: only with --policy, --tables or --mission\n");
  EXPECT_EQ(replay({"--policy", file("north.policy"), "--map", file("m.png")}), 2);
  EXPECT_TRUE(support::has_line(errors_, {"--map", "SVG", "picture", ".svg"})) << errors_;
  EXPECT_FALSE(fs::exists(file("m.png")));
}

TEST_F(ReplayCommand, ReplacesNothingOfAnotherKindAndNeverTheJournal) {
  std::ofstream(file("r.json")) << "notes of mine";
  EXPECT_EQ(replay({"--json", file("r.json")}), 2);
  EXPECT_EQ(support::read_text(file("r.json")), "notes of mine");
  EXPECT_EQ(replay({"--json", file("r.json"), "--force"}), 0) << errors_;
  const std::string before = support::read_text(journal_);
  fs::create_hard_link(journal_, file("hard.json"));
  for (const std::string& name : {journal_.string(), file("hard.json")}) {
    EXPECT_EQ(replay({"--json", name, "--force"}), 2);
    EXPECT_TRUE(support::lines_tell(errors_, {{"JOURNAL", journal_.string(), "--json", name, "same file", "replace"}}));
  }
  EXPECT_EQ(replay({"--policy", file("north.policy"), "--json", file("north.policy"), "--force"}), 2);
  EXPECT_EQ(replay({"--policy", file("north.policy"), "--json", file("a.svg"), "--map", file("a.svg"), "--force"}), 2);
  EXPECT_EQ(support::read_text(journal_), before);
  std::ofstream(file("journal.part2.lcmlog")) << "a part whose beginning is damaged";
  EXPECT_EQ(replay({"--json", file("journal.part2.lcmlog"), "--force"}), 2);
  EXPECT_EQ(support::read_text(file("journal.part2.lcmlog")), "a part whose beginning is damaged");
}

TEST_F(ReplayCommand, ReplacesNothingThatTheQuestionIsOf) {
  write_mission("m.toml", "\n[authority]\nkey_file = \"m.key\"\n");
  std::ofstream(file("m.key")) << "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f\n";
  fs::permissions(file("m.key"), fs::perms::owner_read | fs::perms::owner_write);
  std::ofstream(file("x.tables")) << "judged by its name before it is read";
  const std::vector<std::vector<std::string>> refused{
      {"--mission", file("m.toml"), file("m.toml"), "--mission " + file("m.toml")},
      {"--mission", file("m.toml"), file("m.key"), "the command key of --mission " + file("m.key")},
      {"--tables", file("x.tables"), file("x.tables"), "--tables " + file("x.tables")}};
  for (const std::vector<std::string>& each : refused) {
    const std::string before = support::read_text(each[2]);
    EXPECT_EQ(replay({each[0], each[1], "--json", each[2], "--force"}), 2);
    EXPECT_TRUE(support::lines_tell(errors_, {{each[3], "--json", each[2], "same file", "replace"}}));
    EXPECT_EQ(support::read_text(each[2]), before);
  }
}

}  // namespace
}  // namespace earshot::replay_view
