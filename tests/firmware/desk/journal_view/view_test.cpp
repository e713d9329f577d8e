// GIVEN a journal, WHEN earshot journal is asked about it, THEN it tells or writes what is there, and never passes over what is not.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/core/big_endian.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/firmware/desk/journal_view/journal_program.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::journal {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

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

TEST_F(JournalView, WritesSeveralFilesInOneGoAndReplacesItsOwnKind) {
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
  std::ofstream(file("summary.json")) << R"({"origin":{"latitude_deg":38.5,"longitude_deg":-20.1}})";
  std::ofstream(file("journal.part2.lcmlog")) << "a part whose beginning is damaged";
  for (const std::string& name : {journal_.string(), file("link"), file("hard"), file("journal.part2.lcmlog")}) {
    for (const char* option : {"--csv", "--jsonl", "--mcap", "--geojson", "--gpx", "--kml"}) {
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
  EXPECT_EQ(view({"--jsonl", file("r.jsonl"), "--origin", "38.5,-20.1"}), 2);
  EXPECT_EQ(view({"--csv", file("t.csv"), "--origin", "38.5,-20.1"}), 0) << errors_;
}

TEST_F(JournalView, WritesMapsAboutTheOriginAndReplacesItsOwnKind) {
  const std::vector<std::string> maps{"--geojson", file("f.geojson"), "--gpx",    file("f.gpx"),
                                      "--kml",     file("f.kml"),     "--origin", "38.5,-20.1"};
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(view(maps), 0) << errors_;
    const std::string what = ": 1 decision, a track of 1 place\n";
    EXPECT_EQ(output_, file("f.geojson") + what + file("f.gpx") + what + file("f.kml") + what);
  }
  for (const std::string other : {"{\"type\":\"FeatureCollection\",\"features\":[]}", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gpx >",
                                  "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml >"}) {
    const char* const option = other.starts_with("{") ? "--geojson" : other.ends_with("<gpx >") ? "--gpx" : "--kml";
    std::ofstream(file("other")) << other;
    EXPECT_EQ(view({option, file("other"), "--origin", "38.5,-20.1"}), 2);
    EXPECT_TRUE(support::has_line(errors_, {"other", "already", "--force"})) << errors_;
    EXPECT_EQ(support::read_text(file("other")), other);
  }
}

TEST_F(JournalView, WritesNoMapWithoutAnOriginAndNamesTheOptionThatStatesIt) {
  for (const char* option : {"--geojson", "--gpx", "--kml"}) {
    EXPECT_EQ(view({"--csv", file("t.csv"), option, file("f")}), 2);
    EXPECT_TRUE(support::has_line(errors_, {option, file("f"), "origin", "--origin"})) << errors_;
    EXPECT_FALSE(fs::exists(file("t.csv")) || fs::exists(file("f")));
  }
}

TEST_F(JournalView, TakesTheOriginOfASimulatedFlightFromItsSummaryUnlessItIsStated) {
  const auto columns = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--csv", file("t.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(view(arguments), 0) << errors_;
    return support::read_text(file("t.csv"));
  };
  // As in TurnTable.SaysLatitudeAndLongitudeWhereTheOriginIsKnown.
  const std::string known = ",2000.000,0.0090437,10.0179663,299.500,";
  std::ofstream(file("summary.json")) << R"({"found":true,"origin":{"latitude_deg":0.0,"longitude_deg":10}})";
  EXPECT_NE(columns({}).find(known), std::string::npos);
  EXPECT_NE(columns({"--origin", "0,20"}).find(",20.0179663,"), std::string::npos);
  EXPECT_EQ(view({"--kml", file("f.kml")}), 0) << errors_;
  for (const char* summary :
       {"", "[", "[]", "{}", R"({"origin":null})", R"({"origin":{"latitude_deg":0.0}})",
        R"({"origin":{"latitude_deg":"0","longitude_deg":10}})", R"({"origin":{"latitude_deg":85,"longitude_deg":10}})"}) {
    std::ofstream(file("summary.json")) << summary;
    EXPECT_NE(columns({}).find(",2000.000,,,299.500,"), std::string::npos) << summary;
    EXPECT_EQ(view({"--kml", file("f.kml")}), 2) << summary;
  }
}

// GIVEN a folder of a simulated flight in which another journal lies, WHEN a map is made of that, THEN the flight's origin is not its.
TEST_F(JournalView, TakesNoOriginOfAnotherJournalsFlight) {
  std::ofstream(file("summary.json")) << R"({"origin":{"latitude_deg":0.0,"longitude_deg":10}})";
  fs::copy_file(journal_, folder_ / "journal-2.lcmlog");
  support::Process process(kProgram, {file("journal-2.lcmlog"), "--kml", file("f.kml")},
                           {.folder = folder_, .output = folder_ / "said", .errors = folder_ / "err"});
  EXPECT_EQ(process.wait(30s), 2);
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

}  // namespace
}  // namespace earshot::journal
