#include "firmware/boards/linux/event_log/log_format.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

namespace earshot::board {
namespace {

constexpr Time kUtc{1'795'000'000'000'000};  // 2026-11-18 11:06:40, as date(1) says

std::string line_of(const LogEntry& entry, LogFormat format) {
  std::array<char, kLogLineBytes> line{};
  return std::string(formatted(entry, format, line));
}

std::string line_of(std::string_view said, LogFormat format) {
  std::array<char, kLogLineBytes> line{};
  return std::string(formatted(said, format, line));
}

TEST(LogFormatTest, SaysALineToAPersonToTheJournalAndToAProgram) {
  const LogEntry entry{.severity = Severity::kWarning, .event = "link", .time = kUtc, .port = 2, .message = "its link is down"};
  EXPECT_EQ(line_of(entry, LogFormat::kText), "earshotd: 2026-11-18 11:06:40 UTC: its link is down");
  EXPECT_EQ(line_of(entry, LogFormat::kJournal), "<4>2026-11-18 11:06:40 UTC: its link is down");
  EXPECT_EQ(line_of(entry, LogFormat::kJson),
            R"({"severity": "warning", "event": "link", "time": "2026-11-18T11:06:40Z", "port": 2, "message": "its link is down"})");
}

TEST(LogFormatTest, GivesASimulatorsTimeInSecondsAndLeavesOutWhatThereIsNot) {
  const LogEntry entry{.severity = Severity::kError, .event = "rule", .time = Time{4'711'900'000}, .rule = 12, .message = "x"};
  EXPECT_EQ(line_of(entry, LogFormat::kText), "earshotd: 4711 s: x");
  EXPECT_EQ(line_of(entry, LogFormat::kJson), R"({"severity": "error", "event": "rule", "time_s": 4711, "rule": 12, "message": "x"})");
  EXPECT_EQ(line_of(LogEntry{.message = "x"}, LogFormat::kJson), R"({"severity": "notice", "event": "program", "message": "x"})");
}

TEST(LogFormatTest, IsJsonWhateverAMessageHolds) {
  std::string message;
  for (int i = 0; i < 128; ++i) message += static_cast<char>(i);
  EXPECT_EQ(nlohmann::json::parse(line_of(LogEntry{.message = message}, LogFormat::kJson)).at("message"), message);
  const std::string longest = line_of(LogEntry{.message = std::string(1000, '"')}, LogFormat::kJson);
  EXPECT_LE(longest.size(), kLogLineBytes);
  EXPECT_GT(nlohmann::json::parse(longest).at("message").get<std::string>().size(), 200U);
  EXPECT_EQ(line_of(LogEntry{.message = std::string(1000, 'x')}, LogFormat::kText).size(), kLogLineBytes);
}

TEST(LogFormatTest, CutsAMessageThatIsTooLongBetweenTwoCharacters) {
  for (const std::string character : {"\u00fc", "\u20ac", "\U0001d11e"}) {  // 2, 3 and 4 bytes
    std::string message;
    while (message.size() < 2 * kLogLineBytes) message += character;
    for (std::size_t shift = 0; shift < character.size(); ++shift, message.insert(0, "x")) {
      const LogEntry entry{.message = message};
      const std::string json = line_of(entry, LogFormat::kJson);
      const std::string said = nlohmann::json::parse(json).at("message");  // which throws at half a character
      EXPECT_TRUE(message.starts_with(said));
      EXPECT_EQ((said.size() - shift) % character.size(), 0U);
      EXPECT_GT(json.size(), kLogLineBytes - 10);
      const std::string text = line_of(entry, LogFormat::kText);
      EXPECT_EQ((text.size() - std::string("earshotd: ").size() - shift) % character.size(), 0U);
      EXPECT_GT(text.size(), kLogLineBytes - 4);
    }
  }
}

TEST(LogFormatTest, TakesTheSeverityOfWhatAProgramSaysFromHowItBegins) {
  EXPECT_EQ(line_of("earshotd: journal out/journal.lcmlog", LogFormat::kText), "earshotd: journal out/journal.lcmlog");
  EXPECT_EQ(line_of("earshotd: journal out/journal.lcmlog", LogFormat::kJournal), "<5>journal out/journal.lcmlog");
  EXPECT_EQ(line_of("earshotd: warning: no key", LogFormat::kJournal), "<4>warning: no key");
  EXPECT_EQ(line_of("port 1, vehicle", LogFormat::kJson), R"({"severity": "notice", "event": "program", "message": "port 1, vehicle"})");
  EXPECT_EQ(line_of("", LogFormat::kJson), "");
}

TEST(LogFormatTest, IsTheJournalsWhereStandardErrorLeadsThereAndNowhereElse) {
  struct stat status {};
  ASSERT_EQ(::fstat(STDERR_FILENO, &status), 0);
  ::setenv("JOURNAL_STREAM", (std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino)).c_str(), 1);
  EXPECT_EQ(log_format_of_standard_error(), LogFormat::kJournal);
  ::setenv("JOURNAL_STREAM", "8:1", 1);
  EXPECT_EQ(log_format_of_standard_error(), LogFormat::kText) << "it was redirected";
  ::unsetenv("JOURNAL_STREAM");
  EXPECT_EQ(log_format_of_standard_error(), LogFormat::kText);
}

}  // namespace
}  // namespace earshot::board
