#include "hil/bench/torn_journal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/firmware/boards/linux/replay/random_mission.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

/// The channels of a journal's records, in order, and how many bytes these are.
struct Content {
  std::vector<std::string> channels;
  std::uint64_t bytes = 0;
  [[nodiscard]] auto turns() const { return std::ranges::count(channels, std::string(wire::kHealthChannel)); }
};

class TornJournalTest : public testing::Test {
 protected:
  TornJournalTest() { board::fly_random_mission(1, journal_, 30); }
  [[nodiscard]] Content content() const {
    Content found;
    host::JournalReader reader(journal_);
    for (host::JournalRecord record; reader.next(record);) found.channels.push_back(record.channel);
    found.bytes = reader.offset();
    return found;
  }
  const support::TemporaryFolder folder_;
  const std::filesystem::path journal_ = folder_ / "journal.lcmlog";
};

TEST_F(TornJournalTest, HasLostItsLastBytesInTheMiddleOfARecord) {
  const Content whole = content();
  tear_journal(journal_, 1);
  EXPECT_EQ(std::filesystem::file_size(journal_), whole.bytes - 1);
  const Content torn = content();
  EXPECT_EQ(torn.channels, std::vector(whole.channels.begin(), whole.channels.end() - 1));
}

TEST_F(TornJournalTest, KeepsItsFirstTurnHoweverMuchIsLost) {
  ASSERT_EQ(content().turns(), 30);
  tear_journal(journal_, 1'000'000'000);
  const Content torn = content();
  EXPECT_EQ(torn.turns(), 1);
  EXPECT_EQ(torn.channels.back(), wire::kHealthChannel);
  EXPECT_EQ(std::filesystem::file_size(journal_), torn.bytes);
}

}  // namespace
}  // namespace earshot::hil
