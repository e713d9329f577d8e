#include "firmware/boards/linux/replay/resume.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/core/big_endian.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/replay/random_mission.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

/// A record without its number and its place.
struct Written {
  Time time;
  std::string channel;
  Bytes data;
  std::uint64_t end = 0;  ///< of the record in the file
  friend bool operator==(const Written& a, const Written& b) { return a.time == b.time && a.channel == b.channel && a.data == b.data; }
};

std::vector<Written> records_of(const fs::path& journal) {
  host::JournalReader reader(journal);
  std::vector<Written> records;
  for (host::JournalRecord record; reader.next(record);)
    records.push_back({.time = record.time, .channel = record.channel, .data = record.data, .end = reader.offset()});
  EXPECT_EQ(reader.end(), host::JournalReader::End::kWhole);
  return records;
}

/// What was said, but that it was gone on with.
std::vector<Written> without_resumptions(std::vector<Written> records) {
  std::erase_if(records, [](const Written& record) { return record.channel == wire::kJournalResumedChannel; });
  return records;
}

class Resuming : public testing::Test {
 protected:
  void fly_whole(std::uint64_t seed) {
    mission_ = walking_mission(seed);
    script_ = RandomScript(seed).turns(30);
    Vessel vessel(mission_, whole_);
    vessel.live_through(script_);
    vessel.end();
    records_ = records_of(whole_);
    std::ifstream file(whole_, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
  }

  /// What a process leaves that was killed when so much was in its journal.
  void leave(std::uint64_t size) const {
    support::write_bytes(cut_, Bytes(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(size)));
  }

  [[nodiscard]] std::optional<Resumption> resume_from(GoOnAfter after) const {
    return resume(cut_, {.mission = mission_, .policy_crc32 = crc32(walk_bytes()), .tables_crc32 = 0}, after);
  }

  /// Of the script, behind so many turns and, of the turn under way, what stands in a journal of so many bytes.
  [[nodiscard]] std::span<const Happening> rest(std::uint64_t turns, std::uint64_t bytes) const {
    std::size_t i = 0;
    for (std::uint64_t made = 0; i < script_.size() && made < turns; ++i) made += script_[i].is_turn() ? 1 : 0;
    std::uint64_t health = 0;
    std::uint64_t taken = 0;
    bool is_turn_begun = false;
    messages::Input input;
    for (const Written& record : records_) {
      if (record.end > bytes) break;
      const bool is_of_script = !record.channel.starts_with(wire::kPortReportChannel);
      if (health >= turns && is_of_script && wire::read_input(record.channel, record.time, record.data, 0, input) == Status::kOk) ++taken;
      is_turn_begun = !is_of_script;  // a port's report is made by the turn itself
      if (record.channel == wire::kHealthChannel) ++health;
    }
    for (; i < script_.size() && (taken > 0 || (is_turn_begun && !script_[i].is_turn())); ++i) taken -= script_[i].input ? 1 : 0;
    return std::span(script_).subspan(i);
  }

  [[nodiscard]] std::string refusal(GoOnAfter after = GoOnAfter::kLastInput) const {
    try {
      (void)resume_from(after);
    } catch (const host::BadInput& error) {
      return error.what();
    }
    return "";
  }

  const support::TemporaryFolder folder_;
  const fs::path whole_ = folder_ / "whole.lcmlog";
  const fs::path cut_ = folder_ / "journal.lcmlog";
  config::Mission mission_;
  std::vector<Happening> script_;
  std::vector<Written> records_;
  Bytes bytes_;
};

TEST_F(Resuming, AfterAKillAtEveryTurnOfManyMissionsTheRestIsTheSameByteForByte) {
  std::size_t decisions = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    fly_whole(seed);
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (records_[i].channel != wire::kHealthChannel) continue;
      const bool has_decided =
          i > 0 && std::ranges::any_of(std::span(records_).subspan(i - std::min<std::size_t>(i, 3), 3),
                                       [](const Written& written) { return written.channel == wire::kDecisionChannel; });
      // A turn that decides is rare: of the others every fifth will do.
      if (!has_decided && i % 5 != 0) continue;
      decisions += has_decided ? 1 : 0;
      leave(records_[i].end);
      std::optional<Resumption> before = resume_from(GoOnAfter::kLastTurn);
      ASSERT_TRUE(before) << seed << " " << i;
      EXPECT_EQ(before->cut_bytes, 0U);
      const auto script = rest(before->last.health.turn, 0);
      Vessel vessel(*std::move(before), cut_);
      vessel.live_through(script);
      vessel.end();
      ASSERT_TRUE(without_resumptions(records_of(cut_)) == records_) << "seed " << seed << ", killed after record " << i;
      ASSERT_TRUE(replay(cut_).is_same()) << "seed " << seed << ", killed after record " << i;
    }
  }
  EXPECT_GT(decisions, 10U);
}

TEST_F(Resuming, FromAJournalThatIsCutAtAnyByteEveryInputCountsOnceAndTheRestIsTheSame) {
  fly_whole(3);
  const std::uint64_t from = records_[records_.size() - 30].end;
  for (std::uint64_t size = from; size < bytes_.size(); size += 29) {
    leave(size);
    std::optional<Resumption> before = resume_from(GoOnAfter::kLastInput);
    ASSERT_TRUE(before) << size;
    const auto script = rest(before->last.health.turn, size);
    Vessel vessel(*std::move(before), cut_);
    vessel.live_through(script);
    vessel.end();
    ASSERT_TRUE(without_resumptions(records_of(cut_)) == records_) << "cut after " << size << " of " << bytes_.size();
    ASSERT_TRUE(replay(cut_).is_same()) << size;
  }
}

TEST_F(Resuming, InLockStepWhatCameAfterTheLastTurnIsTakenOnceMore) {
  fly_whole(3);
  const auto last_turn =
      std::find_if(records_.rbegin() + 1, records_.rend(), [](const Written& r) { return r.channel == wire::kHealthChannel; });
  const std::uint64_t turn_end = last_turn->end;
  leave(bytes_.size() - 1);
  std::optional<Resumption> before = resume_from(GoOnAfter::kLastTurn);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->kept_bytes, turn_end);
  EXPECT_EQ(before->cut_bytes, bytes_.size() - 1 - turn_end);
  EXPECT_TRUE(before->unwritten.empty());
}

TEST_F(Resuming, ManyTimesInOneMissionChangesNothing) {
  fly_whole(7);
  leave(std::ranges::find(std::span(records_).subspan(20), wire::kHealthChannel, &Written::channel)->end);
  for (int kills = 0; kills < 5; ++kills) {
    std::optional<Resumption> before = resume_from(GoOnAfter::kLastInput);
    ASSERT_TRUE(before) << kills;
    std::span<const Happening> script = rest(before->last.health.turn, 0);
    if (kills < 4) script = script.first(script.size() / 4);
    while (kills < 4 && !script.empty() && !script.back().is_turn()) script = script.first(script.size() - 1);
    Vessel vessel(*std::move(before), cut_);
    vessel.live_through(script);
    vessel.end();
  }
  EXPECT_TRUE(without_resumptions(records_of(cut_)) == records_);
}

TEST_F(Resuming, BeginsAnewAfterAMissionThatWasEndedInOrderAndBeforeTheFirstTurn) {
  fly_random_mission(1, cut_, 30, messages::ClosingRecord{});
  mission_ = walking_mission(1);
  EXPECT_FALSE(resume_from(GoOnAfter::kLastInput));
  fly_whole(1);
  leave(records_[1].end + 10);
  EXPECT_FALSE(resume_from(GoOnAfter::kLastInput)) << "mission and policy, and no turn";
  leave(0);
  EXPECT_FALSE(resume_from(GoOnAfter::kLastInput));
}

TEST_F(Resuming, RefusesAnotherMissionAndAnotherPolicy) {
  fly_whole(1);
  leave(bytes_.size());
  const std::string begin = cut_.string() + ": the mission cannot go on from it: ";
  mission_.max_steps += 1;
  EXPECT_TRUE(support::tells(refusal(), {begin, "mission", "one's", "changed"}));
  mission_.max_steps -= 1;
  EXPECT_EQ(refusal(), "");
  EXPECT_THROW((void)resume(cut_, {.mission = mission_, .policy_crc32 = 1}, GoOnAfter::kLastInput), host::BadInput);
}

TEST_F(Resuming, RefusesAJournalThatLacksARecordBeforeItsEnd) {
  fly_whole(1);
  Bytes damaged = bytes_;
  damaged[records_[10].end + 9] ^= 1U;  // in the record behind it, number 11
  support::write_bytes(cut_, damaged);
  EXPECT_TRUE(support::has_line(refusal(), {"missing", "number 11", "damaged", "mission", "not"})) << refusal();
}

TEST_F(Resuming, GoesOnBeforeARecordThatAPowerCutToreOutOfTheLastSecondUnlessAnOrderARuleOrAChangeOfStateStandsBehindIt) {
  std::size_t resumed = 0;
  std::size_t refused = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    fly_whole(seed);
    // Of a health record the byte of the state is 30: it follows fingerprint, date and turn (8 each), decisions (4), authority
    // and pause (1 each).
    const auto state_before = [&](std::size_t i) {
      while (records_[--i].channel != wire::kHealthChannel) {
      }
      return records_[i].data[30];
    };
    bool is_light = true;
    for (std::size_t i = records_.size() - 1; i-- > records_.size() - 12;) {
      const Written& behind = records_[i + 1];
      is_light = is_light && !behind.channel.starts_with("EARSHOT_OPERATOR_COMMAND") &&
                 behind.channel != "EARSHOT_COMMAND_ACKNOWLEDGEMENT" && behind.channel != "EARSHOT_SAFETY_EVENT";
      bool is_state_kept = true;
      for (std::size_t k = i + 1; k < records_.size(); ++k)
        is_state_kept = is_state_kept && (records_[k].channel != wire::kHealthChannel || records_[k].data[30] == state_before(i));
      Bytes torn = bytes_;
      std::fill(torn.begin() + static_cast<std::ptrdiff_t>(records_[i - 1].end),
                torn.begin() + static_cast<std::ptrdiff_t>(records_[i].end), std::uint8_t{0});
      support::write_bytes(cut_, torn);
      const bool is_of_last_second = records_.back().time - records_[i - 1].time <= Duration::seconds(1);
      if (!is_light || !is_state_kept || !is_of_last_second) {
        EXPECT_NE(refusal().find("records are missing from number " + std::to_string(i) + " on"), std::string::npos)
            << "seed " << seed << ", record " << i << refusal();
        ++refused;
        continue;
      }
      const std::optional<Resumption> found = resume_from(GoOnAfter::kLastInput);
      leave(records_[i - 1].end);
      const std::optional<Resumption> cut = resume_from(GoOnAfter::kLastInput);
      ASSERT_TRUE(found && cut) << "seed " << seed << ", record " << i;
      EXPECT_EQ(found->kept_bytes, records_[i - 1].end);
      EXPECT_EQ(found->cut_bytes, bytes_.size() - records_[i - 1].end);
      EXPECT_EQ(found->next_number, i);
      EXPECT_EQ(found->last.health.turn, cut->last.health.turn);
      EXPECT_EQ(found->memory.inputs, cut->memory.inputs);
      EXPECT_EQ(found->unwritten.size(), cut->unwritten.size());
      ++resumed;
    }
  }
  EXPECT_GT(resumed, 40U);
  EXPECT_GT(refused, 40U);
}

TEST_F(Resuming, RefusesAJournalWhoseOutputsThisBuildDoesNotGiveAgain) {
  fly_whole(1);
  const fs::path forged = cut_;
  {
    host::Journal journal(forged, {.existing = host::ExistingJournal::kReplace});
    host::JournalReader reader(whole_);
    for (host::JournalRecord record; reader.next(record);) {
      if (record.channel == wire::kHealthChannel) record.data[20] ^= 1U;
      ASSERT_EQ(journal.append(record.time, record.channel, record.data), Status::kOk);
    }
  }
  EXPECT_TRUE(support::has_line(refusal(), {"build", "not", "again", "stands"})) << refusal();
}

TEST_F(Resuming, FindsTheNewestJournalAndCutsItToWhatIsKept) {
  fly_whole(1);
  leave(bytes_.size());
  const fs::path newer = folder_ / "journal-2.lcmlog";
  Bytes torn = bytes_;
  torn.resize(torn.size() + 100, 0x55);
  support::write_bytes(newer, torn);
  const Flown flown{.mission = mission_, .policy_crc32 = crc32(walk_bytes()), .tables_crc32 = 0};
  std::optional<Unfinished> found = find_unfinished(cut_, flown, GoOnAfter::kLastInput);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->file.path(), newer);
  EXPECT_EQ(fs::file_size(newer), bytes_.size());
  EXPECT_TRUE(
      support::has_line(to_string(found->before, records_.back().time + Duration::seconds(7)), {"100 bytes", "behind", "cut", "7 s"}));
  found->file.keep_to({.part_bytes = 0, .budget_bytes = 1});
  EXPECT_FALSE(fs::exists(cut_)) << "the older one shares its budget";
}

TEST_F(Resuming, FromTheJournalThatTheSafetyRecordNamesWhateverOthersLieBesideIt) {
  fly_whole(1);
  leave(bytes_.size());
  const auto mark = static_cast<std::uint32_t>(load_big_endian(std::span<const std::uint8_t>(bytes_).subspan(4, 4)));
  const Flown flown{.mission = mission_, .policy_crc32 = crc32(walk_bytes()), .tables_crc32 = 0};
  const fs::path elsewhere = folder_ / "journal-9.lcmlog";  // flown elsewhere, and newer by its name
  fly_random_mission(2, elsewhere, 30);
  std::optional<Unfinished> found = find_unfinished(cut_, flown, GoOnAfter::kLastInput, mark);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->file.path(), cut_);
  found.reset();
  fs::remove(cut_);
  EXPECT_THROW((void)find_unfinished(cut_, flown, GoOnAfter::kLastInput, mark), host::BadInput);
  fs::rename(elsewhere, cut_);
  EXPECT_THROW((void)find_unfinished(cut_, flown, GoOnAfter::kLastInput, mark), host::BadInput);
}

TEST_F(Resuming, TellsAJournalThatWasEndedInOrder) {
  fly_random_mission(1, cut_, 30, messages::ClosingRecord{});
  EXPECT_TRUE(was_ended_in_order(cut_));
  fly_whole(1);
  leave(bytes_.size());
  EXPECT_FALSE(was_ended_in_order(cut_));
}

TEST_F(Resuming, RefusesALinkToAJournal) {
  fly_whole(1);
  fs::create_symlink(whole_, cut_);
  const Flown flown{.mission = mission_, .policy_crc32 = crc32(walk_bytes()), .tables_crc32 = 0};
  const auto find = [&] { return find_unfinished(cut_, flown, GoOnAfter::kLastInput); };
  EXPECT_THROW((void)find(), host::BadInput);
  fs::remove(cut_);
  leave(bytes_.size());
  EXPECT_TRUE(find());
}

TEST_F(Resuming, RefusesAJournalOneOfWhosePartsBearsAnothersName) {
  fly_whole(1);
  leave(bytes_.size());
  const auto first_record_crc32 = static_cast<std::uint32_t>(load_big_endian(std::span<const std::uint8_t>(bytes_).subspan(4, 4)));
  const wire::Encoded beginning(messages::JournalPart{.part = 2, .first_record_crc32 = first_record_crc32});
  const host::LoneRecord record(0, Time{}, wire::kJournalPartChannel, beginning.bytes());
  support::write_bytes(folder_ / "journal.part3.lcmlog", Bytes(record.bytes().begin(), record.bytes().end()));
  const Flown flown{.mission = mission_, .policy_crc32 = crc32(walk_bytes()), .tables_crc32 = 0};
  const auto find = [&] { return find_unfinished(cut_, flown, GoOnAfter::kLastInput); };
  EXPECT_THROW((void)find(), host::BadInput);
  fs::rename(folder_ / "journal.part3.lcmlog", folder_ / "journal.part2.lcmlog");
  EXPECT_TRUE(find());
}

TEST_F(Resuming, FindsNothingInAnEmptyFolder) {
  EXPECT_FALSE(find_unfinished(cut_, {}, GoOnAfter::kLastInput));
}

}  // namespace
}  // namespace earshot::board
