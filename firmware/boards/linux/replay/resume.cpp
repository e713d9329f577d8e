#include "firmware/boards/linux/replay/resume.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <utility>

#include "firmware/boards/linux/event_log/health_words.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/journal_parts.hpp"
#include "firmware/host/journal/reading/decode_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::board {
namespace {

host::BadInput refusal(const std::filesystem::path& journal, const std::string& why) {
  return host::BadInput(journal.string() + ": the mission cannot go on from it: " + why);
}

bool is_same(const config::Mission& a, const config::Mission& b) {
  return std::ranges::equal(wire::Encoded(messages::MissionRecord{.mission = a}).bytes(),
                            wire::Encoded(messages::MissionRecord{.mission = b}).bytes());
}

/// How the journal ends.
struct Ending {
  std::uint64_t last_turn = 0;  ///< behind it, bytes from the beginning; 0: no turn was made
  bool is_in_order = false;
  std::uint64_t torn_at = std::numeric_limits<std::uint64_t>::max();  ///< bytes before what a power cut tore; none: it tore nothing
};

/// An order, a rule that acts, another process that went on: what no mission may forget; and what nobody can read, which may be one of
/// these.
bool is_urgent(const journal::Content& content) {
  if (const auto* const input = std::get_if<messages::Input>(&content))
    return std::holds_alternative<messages::OperatorCommand>(input->value);
  return std::holds_alternative<messages::CommandAcknowledgement>(content) || std::holds_alternative<messages::SafetyEvent>(content) ||
         std::holds_alternative<messages::JournalResumed>(content) || std::holds_alternative<journal::Unreadable>(content);
}

/// What stands behind the first record that is missing. A disk writes what it was not told to keep in any order: of the journal's last
/// second, which a power cut may cost, it may lack the beginning and hold the end.
class Tail {
 public:
  Tail(const Ending& before, std::uint64_t begin, Time began, std::optional<messages::Health> last)
      : before_(before), begin_(begin), began_(began), last_(std::move(last)) {}

  void note(Time time, const journal::Content& content) {
    ended_ = time;
    const auto* const health = std::get_if<messages::Health>(&content);
    const bool is_new_state = health != nullptr && !(last_ && health->state == last_->state);
    is_light_ = is_light_ && !is_new_state && !is_urgent(content);
  }

  /// No order, rule that acts or change of state would be forgotten. @return nothing: it cannot be done without
  [[nodiscard]] std::optional<Ending> without() const {
    constexpr Duration kMost{std::chrono::microseconds(host::kJournalBudget).count()};
    if (!is_light_ || ended_ - began_ > kMost || before_.last_turn == 0) return std::nullopt;
    return Ending{.last_turn = before_.last_turn, .is_in_order = false, .torn_at = begin_};
  }

 private:
  Ending before_;
  std::uint64_t begin_;
  Time began_;
  Time ended_;
  std::optional<messages::Health> last_;
  bool is_light_ = true;
};

Ending ending_of(const std::filesystem::path& journal, GoOnAfter after) {
  host::JournalReader reader(journal);
  Ending ending;
  std::optional<Tail> tail;
  std::optional<messages::Health> last;
  std::uint32_t next_number = 0;
  std::uint64_t begin = 0;
  Time time;
  for (host::JournalRecord record; reader.next(record); begin = reader.offset(), time = record.time) {
    if (record.number != next_number && !tail) tail.emplace(ending, begin, time, last);
    next_number = record.number + 1;
    const journal::Content content = journal::decode_record(record.channel, record.time, record.data);
    if (tail) tail->note(record.time, content);
    ending.is_in_order = record.channel == wire::kJournalEndChannel;
    if (record.channel != wire::kHealthChannel) continue;
    ending.last_turn = reader.offset();
    if (const auto* const health = std::get_if<messages::Health>(&content)) last = *health;
  }
  if (!tail || ending.is_in_order || after == GoOnAfter::kLastTurn) return ending;
  return tail->without().value_or(ending);
}

void require_whole(const std::filesystem::path& journal, const Playback& playback, std::uint64_t end) {
  if (playback.difference())
    throw refusal(journal, "this build does not give again what stands in record " + std::to_string(playback.difference()->record) + " (" +
                               playback.difference()->channel + ")");
  if (playback.gap())
    throw refusal(journal, "records are missing from number " + std::to_string(*playback.gap()) +
                               " on (damaged, or the disk was full): how the mission stood is not known");
  if (playback.file().offset() < end) throw refusal(journal, "it ends before its last turn");
}

}  // namespace

bool was_ended_in_order(const std::filesystem::path& journal) {
  return ending_of(journal, GoOnAfter::kLastTurn).is_in_order;
}

std::optional<Resumption> resume(const std::filesystem::path& journal, const Flown& flown, GoOnAfter after) {
  const Ending ending = ending_of(journal, after);
  if (ending.is_in_order || ending.last_turn == 0) return std::nullopt;
  Playback playback(journal);
  if (!is_same(playback.flown().mission, flown.mission))
    throw refusal(journal, "it is of another mission, or this one's file was changed since");
  if (playback.flown().policy_crc32 != flown.policy_crc32) throw refusal(journal, "it was flown with another policy");
  if (playback.flown().tables_crc32 != flown.tables_crc32) throw refusal(journal, "it was flown with other ocean tables");
  const std::uint64_t end = after == GoOnAfter::kLastInput ? ending.torn_at : ending.last_turn;
  while (playback.file().offset() < end && playback.next()) {
  }
  require_whole(journal, playback, ending.last_turn);
  const std::uint64_t kept = playback.file().offset();
  return Resumption{.runtime = playback.release(),
                    .memory = playback.memory(),
                    .last = playback.outputs(),
                    .next_number = playback.next_number(),
                    .kept_bytes = kept,
                    .cut_bytes = playback.file().file_size() - kept,
                    .unwritten = playback.unwritten()};
}

std::optional<Unfinished> find_unfinished(const std::filesystem::path& wanted, const Flown& flown, GoOnAfter after,
                                          std::optional<std::uint32_t> marked) {
  const std::optional<std::filesystem::path> found = marked ? host::journal_marked(wanted, *marked) : host::newest_journal(wanted);
  if (marked && !found) throw refusal(wanted, "no journal in its folder is the one that the safety record names");
  if (!found) return std::nullopt;
  (void)host::JournalReader(*found);  // refuses what is no regular file, before it is opened for writing
  if (std::filesystem::is_symlink(*found)) throw refusal(*found, "it is a link, and later parts would be written beside that");
  if (const std::optional<std::filesystem::path> misplaced = host::JournalParts(*found).misplaced())
    throw refusal(*found, misplaced->filename().string() + " is a part of it that bears another part's name");
  host::JournalFile file(*found, host::ExistingJournal::kGoOn);
  std::optional<Resumption> before = resume(*found, flown, after);
  if (!before) return std::nullopt;
  file.cut(before->kept_bytes);
  file.count_among(wanted);
  return Unfinished{.file = std::move(file), .before = *std::move(before)};
}

Duration hold_of(const config::Mission& mission, const std::optional<detector::SoundSettings>& hearing) {
  const Duration timeout = std::max(mission.navigation_timeout, mission.snr_timeout);
  return hearing ? timeout + hearing->floor_window : timeout;
}

std::string to_string(const Resumption& before, Time now) {
  std::string text = to_string(before.last.health) + ", " + std::to_string(before.last.health.turn) + " turns; " +
                     std::to_string(before.cut_bytes) + " bytes behind them were cut off";
  if (now > before.memory.last) text += "; " + std::to_string((now - before.memory.last).us / 1'000'000) + " s have passed";
  return text;
}

}  // namespace earshot::board
