// GIVEN a journal, WHEN earshot journal is asked about it, THEN it tells or writes what is there, and never passes over what is not.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "firmware/core/big_endian.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::journal {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

const fs::path kProgram = fs::path(EARSHOT_BIN_DIR) / "earshot-journal";

class JournalView : public ::testing::Test {
 protected:
  JournalView() { write_known_journal(journal_); }

  int view(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), journal_.string());
    support::Process process(kProgram, arguments, {.folder = folder_, .output = folder_ / "said.txt", .errors = folder_ / "errors.txt"});
    const int status = process.wait(30s);
    output_ = support::read_text(folder_ / "said.txt");
    errors_ = support::read_text(folder_ / "errors.txt");
    return status;
  }
  [[nodiscard]] std::string file(const char* name) const { return (folder_ / name).string(); }
  /// One bit of the journal's byte, counted from its end.
  void flip_bit_before_end(std::streamoff bytes) const {
    std::fstream bits(journal_, std::ios::binary | std::ios::in | std::ios::out);
    bits.seekg(-bytes, std::ios::end);
    const int byte = bits.get();
    bits.seekp(-bytes, std::ios::end);
    bits.put(static_cast<char>(byte ^ 1));
  }

  const support::TemporaryFolder folder_;
  const fs::path journal_ = folder_ / "journal.lcmlog";
  std::string output_;
  std::string errors_;
};

/// Of its first record, by which a safety record names it.
std::uint32_t mark_of(const fs::path& journal) {
  host::JournalReader reader(journal);
  host::JournalRecord first;
  EXPECT_TRUE(reader.next(first));
  return host::checksum_of_record(first.number, first.time, first.channel, first.data);
}

/// As a flight leaves it whose computer stopped in mid-search.
void leave_safety_record(const fs::path& folder, std::uint32_t journal_crc32) {
  host::SafetyCopies copies({{.file = folder / "journal.safety"}});
  copies.prepare(std::vector<std::uint8_t>{1});
  host::SafetyRecord record;
  record.utc = {1'795'000'000'000'000};
  record.journal_crc32 = journal_crc32;
  record.state = messages::MissionState::kSearch;
  record.is_engaged = true;
  record.max_depth = Meters{350};
  ASSERT_TRUE(copies.write(record, 10s));
}
const std::string kRecord =
    "safety record, 2026-11-18 11:06:40 UTC: SEARCH, set-points leave; depth at most 350 m. earshotd --resume goes on, or brings the "
    "vehicle up\n";

TEST_F(JournalView, EndsWithWhatTheSafetyRecordOfItsFlightSays) {
  leave_safety_record(folder_, mark_of(journal_));
  EXPECT_EQ(view({}), 0);
  EXPECT_TRUE(output_.ends_with("no record was lost\n" + kRecord)) << output_;
  EXPECT_EQ(view({"--csv", file("turns.csv")}), 0);
  EXPECT_EQ(output_.find("safety record"), std::string::npos) << output_;
}

TEST_F(JournalView, TellsTheSafetyRecordThatIsLeftOfAFlightWhoseJournalIsGone) {
  leave_safety_record(folder_, mark_of(journal_));
  fs::remove(journal_);
  EXPECT_EQ(view({}), 1);
  EXPECT_EQ(output_, kRecord);
  EXPECT_TRUE(support::lines_tell(errors_, {{journal_.string(), "no", "file", "safety", "beside"}}));
}

TEST_F(JournalView, PrintsTheTimelineOfAWholeJournal) {
  EXPECT_EQ(view({}), 0);
  EXPECT_EQ(std::ranges::count(output_, '\n'), 13);
  EXPECT_TRUE(output_.starts_with("2026-11-22 15:04:00 UTC       0.0 s  mission begins: ")) << output_;
  EXPECT_TRUE(support::has_line(
      output_, {"2026-11-22 15:04:04 UTC", "4.0 s", "ABORT", messages::to_string(messages::EndReason::kSafetyRule), "after 1 step"}))
      << output_;
  EXPECT_EQ(errors_, "");
}

TEST_F(JournalView, TakesAFolderForTheNewestJournalInItAndNamesItWhereThereAreOthers) {
  support::Process process(kProgram, {folder_.path().string()}, {.folder = folder_, .output = folder_ / "said", .errors = folder_ / "err"});
  EXPECT_EQ(process.wait(30s), 0);
  EXPECT_EQ(std::ranges::count(support::read_text(folder_ / "said"), '\n'), 13);
  EXPECT_EQ(support::read_text(folder_ / "err"), "");
  fs::copy_file(journal_, folder_ / "journal-2.lcmlog");
  fs::resize_file(journal_, fs::file_size(journal_) - 94);  // the older one lacks its end, and is not read
  support::Process other(kProgram, {folder_.path().string()}, {.folder = folder_, .output = folder_ / "said", .errors = folder_ / "err"});
  EXPECT_EQ(other.wait(30s), 0);
  EXPECT_TRUE(
      support::lines_tell(support::read_text(folder_ / "err"),
                          {{"earshot", "journal", "reads", (folder_ / "journal-2.lcmlog").string(), "newest", "2", "journals", "folder"}}));
}

TEST_F(JournalView, SaysNothingButWhatIsWrongWhenItIsToBeQuiet) {
  fs::resize_file(journal_, fs::file_size(journal_) - 94);  // the closing record: 28 + 19 + 47
  EXPECT_EQ(view({"--quiet"}), 1);
  EXPECT_EQ(output_, "");
  EXPECT_EQ(errors_.find(journal_.string() + ": the journal's end is missing"), 0U) << errors_;
}

TEST_F(JournalView, ReadsOnBehindDamageAndSaysWhereItIs) {
  flip_bit_before_end(94 + 20);  // in the last health record
  EXPECT_EQ(view({"--csv", file("t.csv")}), 1);
  EXPECT_NE(errors_.find(": damaged: "), std::string::npos) << errors_;
  EXPECT_TRUE(support::has_line(errors_, {"1", "record", "missing", "number 16", "damaged"})) << errors_;
  EXPECT_EQ(output_, file("t.csv") + ": 3 turns\n");
  EXPECT_EQ(view({}), 1);
  EXPECT_NE(output_.find("1 record is missing"), std::string::npos) << output_;
  EXPECT_NE(output_.find("end: the mission was over"), std::string::npos) << output_;
}

TEST_F(JournalView, RefusesWhatIsNoJournal) {
  std::ofstream(journal_) << "notes of mine, which are long enough to hold the header of a record";
  EXPECT_EQ(view({"--csv", file("t.csv")}), 2);
  EXPECT_EQ(errors_, journal_.string() + ": not a journal: no record in it\n");
  EXPECT_FALSE(fs::exists(file("t.csv")));
  fs::remove(journal_);
  EXPECT_EQ(view({}), 2);
  EXPECT_EQ(errors_, journal_.string() + ": no such file\n");
}

TEST_F(JournalView, WritesAllThreeFilesInOneGoAndReplacesItsOwnKind) {
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(view({"--csv", file("t.csv"), "--jsonl", file("r.jsonl"), "--mcap", file("m.mcap")}), 0) << errors_;
    EXPECT_EQ(output_, file("t.csv") + ": 4 turns\n" + file("r.jsonl") + ": 18 records\n" + file("m.mcap") + ": 32 messages\n");
  }
}

TEST_F(JournalView, ReplacesNothingOfAnotherKindUnlessItIsForced) {
  std::ofstream(file("t.csv")) << "notes of mine";
  EXPECT_EQ(view({"--jsonl", file("r.jsonl"), "--csv", file("t.csv")}), 2);
  EXPECT_TRUE(support::has_line(errors_, {"t.csv", "already", "not", "--force"}));
  EXPECT_EQ(support::read_text(file("t.csv")), "notes of mine");
  EXPECT_FALSE(fs::exists(file("r.jsonl")));
  EXPECT_EQ(view({"--csv", file("t.csv"), "--force"}), 0) << errors_;
}

TEST_F(JournalView, NeverWritesOverTheJournalThatItReads) {
  const std::string before = support::read_text(journal_);
  fs::create_symlink(journal_, file("link"));
  fs::create_hard_link(journal_, file("hard"));
  std::ofstream(file("journal.part2.lcmlog")) << "a part whose beginning is damaged";
  for (const std::string& name : {journal_.string(), file("link"), file("hard"), file("journal.part2.lcmlog")}) {
    for (const char* option : {"--csv", "--jsonl", "--mcap"}) {
      EXPECT_EQ(view({option, name, "--force"}), 2) << errors_;
      EXPECT_NE(errors_.find(std::string(option) + " " + name + ": the same file"), std::string::npos) << errors_;
    }
  }
  EXPECT_EQ(support::read_text(file("journal.part2.lcmlog")), "a part whose beginning is damaged");
  EXPECT_EQ(support::read_text(journal_), before);
  EXPECT_EQ(view({"--csv", file("x"), "--jsonl", file("./x")}), 2);
  EXPECT_NE(errors_.find("--csv " + file("x") + ", --jsonl " + file("./x") + ": the same file"), std::string::npos) << errors_;
}

TEST_F(JournalView, RefusesAnOriginThatIsNone) {
  for (const char* origin : {"38.5", "38.5,x", "85,0", "0,181", "nan,0", ","}) {
    EXPECT_EQ(view({"--csv", file("t.csv"), "--origin", origin}), 2) << origin;
    EXPECT_NE(errors_.find(std::string("--origin ") + origin + ": "), std::string::npos) << errors_;
  }
  EXPECT_EQ(view({"--origin", "38.5,-20.1"}), 2);
  EXPECT_EQ(view({"--csv", file("t.csv"), "--origin", "38.5,-20.1"}), 0) << errors_;
}

/// Numbers and no checksums, as liblcm writes them (tests/firmware/host/journal/bus_log_test.cpp).
void append_logged(const fs::path& log, std::uint64_t number, Time time, std::string_view channel, std::span<const std::uint8_t> data) {
  std::array<std::uint8_t, 28> header{0xED, 0xA1, 0xDA, 0x01};
  store_big_endian(std::span(header).subspan(4, 8), number);
  store_big_endian(std::span(header).subspan(12, 8), static_cast<std::uint64_t>(time.us));
  store_big_endian(std::span(header).subspan(20, 4), channel.size());
  store_big_endian(std::span(header).subspan(24, 4), data.size());
  std::ofstream file(log, std::ios::binary | std::ios::app);
  file.write(reinterpret_cast<const char*>(header.data()), 28).write(channel.data(), static_cast<std::streamsize>(channel.size()));
  file.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
}

TEST_F(JournalView, ReadsALogOfTheBusAndSaysWhatItLacks) {
  fs::remove(journal_);
  messages::Navigation navigation{};
  navigation.time = kBegan;
  navigation.depth = Meters{300};
  const wire::Encoded fix(navigation);
  messages::Health health;
  append_logged(journal_, 0, kBegan, wire::kNavStateChannel, fix.bytes());
  append_logged(journal_, 1, after(500), "CAMERA", fix.bytes());
  append_logged(journal_, 2, after(1000), wire::kHealthChannel, wire::Encoded(health, after(1000)).bytes());
  health.state = messages::MissionState::kSearch;
  append_logged(journal_, 3, after(2000), wire::kHealthChannel, wire::Encoded(health, after(2000)).bytes());
  EXPECT_EQ(view({}), 1);
  EXPECT_NE(output_.find("2.0 s  SEARCH\n"), std::string::npos) << output_;
  EXPECT_TRUE(errors_.starts_with(journal_.string() + ": no mission record, no checksums: ")) << errors_;
  EXPECT_EQ(std::ranges::count(errors_, '\n'), 1) << errors_;
  EXPECT_EQ(view({"--csv", file("t.csv"), "--jsonl", file("r.jsonl")}), 1);
  EXPECT_NE(support::read_text(file("r.jsonl")).find("\"depth_m\":300"), std::string::npos);
  EXPECT_NE(output_.find("t.csv: 2 turns"), std::string::npos) << output_;
}

/// A mission that is under way while earshot journal follows it.
class JournalFollowed : public ::testing::Test {
 protected:
  /// Waits, for as long as it takes but not for ever, until this was said.
  [[nodiscard]] bool hears(const std::string& text) const {
    for (int i = 0; i < 600; ++i, std::this_thread::sleep_for(50ms))
      if (process_.output().find(text) != std::string::npos) return true;
    return false;
  }
  static fs::path begun(const fs::path& path, WrittenJournal& journal) {
    journal.message(kBegan, wire::kMissionChannel, known_mission());
    journal.flush();
    return path;
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal.lcmlog";
  WrittenJournal journal_{path_};
  support::Process process_{kProgram, {begun(path_, journal_).string(), "--follow"}, folder_ / "said.txt"};
};

TEST_F(JournalFollowed, SaysWhatHappensAsItIsWrittenUntilTheMissionEnds) {
  EXPECT_TRUE(hears("mission begins"));
  journal_.health(after(1000), 1, messages::MissionState::kSearch);
  journal_.flush();
  EXPECT_TRUE(hears("1.0 s  SEARCH\n")) << process_.output();
  journal_.close({.time = after(2000), .ending = messages::Ending::kStopped});
  EXPECT_EQ(process_.wait(30s), 0);
  EXPECT_NE(process_.output().find("end: the program was stopped"), std::string::npos) << process_.output();
}

TEST_F(JournalFollowed, EndsOnCtrlC) {
  EXPECT_TRUE(hears("mission begins"));
  process_.signal(SIGINT);
  EXPECT_EQ(process_.wait(30s), 130);
}

TEST_F(JournalFollowed, EndsWhenTheProgramThatWroteIsGone) {
  journal_.close();  // without a closing record, as if it had been killed
  EXPECT_EQ(process_.wait(30s), 1);
  EXPECT_NE(process_.output().find("the journal's end is missing"), std::string::npos) << process_.output();
}

/// GIVEN a folder in which a flight was made, WHEN its journal is followed, THEN it is the next flight that is told of.
class FlightFollowed : public ::testing::Test {
 protected:
  FlightFollowed() {
    WrittenJournal old(path_);
    begin(old);
    old.health(Time{1'000'000}, 1, messages::MissionState::kSearch);
    old.close({.time = Time{2'000'000}, .ending = messages::Ending::kMissionOver});
  }
  static void begin(WrittenJournal& journal) {
    journal.message(Time{}, wire::kMissionChannel, known_mission());
    journal.flush();
  }
  void follow() {
    process_ = std::make_unique<support::Process>(kProgram, std::vector<std::string>{path_.string(), "--follow", wait_}, output_);
  }
  [[nodiscard]] bool hears(const std::string& text) const {
    for (int i = 0; i < 600; ++i, std::this_thread::sleep_for(50ms))
      if (process_->output().find(text) != std::string::npos) return true;
    return false;
  }
  [[nodiscard]] fs::path unfinished(const char* name) const {
    fs::create_directories(folder_ / name);
    return folder_ / name / "journal.lcmlog";
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal.lcmlog";
  const fs::path output_ = folder_ / "said.txt";
  std::string wait_ = "--wait=60";
  std::unique_ptr<support::Process> process_;
};

TEST_F(FlightFollowed, IsTheOneThatIsUnderWayThoughOneThatWasCutOffLiesBesideIt) {
  fs::copy_file(path_, unfinished("unfinished-flight"));
  WrittenJournal flight(unfinished("unfinished-flight-2"));
  begin(flight);
  follow();
  EXPECT_TRUE(hears("mission begins"));
  flight.health(Time{5'000'000}, 1, messages::MissionState::kSearch);
  flight.flush();
  EXPECT_TRUE(hears("5.0 s  SEARCH\n")) << process_->output();
  flight.close({.time = Time{6'000'000}, .ending = messages::Ending::kMissionOver});
  fs::rename(folder_ / "unfinished-flight-2/journal.lcmlog", path_);
  fs::remove(folder_ / "unfinished-flight-2");
  EXPECT_EQ(process_->wait(30s), 0);
  EXPECT_NE(process_->output().find("6.0 s  end: the mission was over"), std::string::npos) << process_->output();
  EXPECT_EQ(process_->output().find("1.0 s  SEARCH"), std::string::npos) << process_->output();
}

TEST_F(FlightFollowed, IsFoundInItsFolderWhateverItsNumberThere) {
  WrittenJournal third(folder_ / "journal-3.lcmlog");
  begin(third);
  process_ = std::make_unique<support::Process>(kProgram, std::vector<std::string>{folder_.path().string(), "--follow", wait_}, output_);
  EXPECT_TRUE(hears("follows " + (folder_ / "journal-3.lcmlog").string())) << process_->output();
  third.health(Time{5'000'000}, 1, messages::MissionState::kSearch);
  third.flush();
  EXPECT_TRUE(hears("5.0 s  SEARCH\n")) << process_->output();
  third.close({.time = Time{6'000'000}, .ending = messages::Ending::kMissionOver});
  EXPECT_EQ(process_->wait(30s), 0) << process_->output();
}

TEST_F(FlightFollowed, IsWaitedForWhereAnOlderOneLiesOrNone) {
  for (const bool is_old_there : {true, false}) {
    if (!is_old_there) fs::remove(path_);
    follow();
    EXPECT_TRUE(hears("earshot journal: waiting for a mission that writes " + path_.string())) << process_->output();
    WrittenJournal flight(unfinished("unfinished-flight"));
    begin(flight);
    EXPECT_TRUE(hears("mission begins"));
    flight.close({.time = Time{6'000'000}, .ending = messages::Ending::kMissionOver});
    EXPECT_EQ(process_->wait(30s), 0) << process_->output();
    EXPECT_EQ(process_->output().find("1.0 s  SEARCH"), std::string::npos) << process_->output();
    fs::remove_all(folder_ / "unfinished-flight");
  }
}

TEST_F(FlightFollowed, ThatDoesNotComeIsSaidAndNotReplacedByAnOlderOne) {
  wait_ = "--wait=1";
  follow();
  EXPECT_EQ(process_->wait(30s), 2);
  EXPECT_TRUE(support::has_line(process_->output(), {path_.string(), "flight", "no", "began", "without --follow"})) << process_->output();
  fs::remove(path_);
  follow();
  EXPECT_EQ(process_->wait(30s), 2);
  EXPECT_NE(process_->output().find(path_.string() + ": no such file; no mission began there"), std::string::npos) << process_->output();
}

}  // namespace
}  // namespace earshot::journal
