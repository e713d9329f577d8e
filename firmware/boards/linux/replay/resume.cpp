#include "firmware/boards/linux/replay/resume.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "firmware/boards/linux/news/health_words.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"

namespace earshot::board {
namespace {

host::BadInput refusal(const std::filesystem::path& journal, const std::string& why) {
  return host::BadInput(journal.string() + ": the mission cannot go on from it: " + why +
                        "; without --resume a new one begins, in STANDBY");
}

bool is_same(const config::Mission& a, const config::Mission& b) {
  return std::ranges::equal(wire::Encoded(wire::to_message(a, Time{})).bytes(), wire::Encoded(wire::to_message(b, Time{})).bytes());
}

/// How the journal ends.
struct Ending {
  std::uint64_t last_turn = 0;  ///< behind it, bytes from the beginning; 0: no turn was made
  bool is_in_order = false;
};

Ending ending_of(const std::filesystem::path& journal) {
  host::JournalReader reader(journal);
  Ending ending;
  for (host::JournalRecord record; reader.next(record);) {
    if (record.channel == wire::kHealthChannel) ending.last_turn = reader.offset();
    ending.is_in_order = record.channel == wire::kJournalEndChannel;
  }
  return ending;
}

void require_whole(const std::filesystem::path& journal, const Playback& playback, std::uint64_t end) {
  if (playback.difference())
    throw refusal(journal, "this build does not say again what stands in record " + std::to_string(playback.difference()->record) + " (" +
                               playback.difference()->channel + ")");
  if (playback.gap())
    throw refusal(journal, "records are missing from number " + std::to_string(*playback.gap()) +
                               " on (damaged, or the disk was full): how the mission stood cannot be told");
  if (playback.file().offset() < end) throw refusal(journal, "it ends before its last turn");
}

}  // namespace

std::optional<Resumption> resume(const std::filesystem::path& journal, const Playback::Beginning& flown, GoOnAfter after) {
  const Ending ending = ending_of(journal);
  if (ending.is_in_order || ending.last_turn == 0) return std::nullopt;
  Playback playback(journal);
  if (!is_same(playback.beginning().mission, flown.mission))
    throw refusal(journal, "it is of another mission, or this one's file was changed since");
  if (playback.beginning().policy_crc32 != flown.policy_crc32) throw refusal(journal, "it was flown with another policy");
  const bool to_the_end = after == GoOnAfter::kLastInput;
  while ((to_the_end || playback.file().offset() < ending.last_turn) && playback.next()) {
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

std::optional<Unfinished> find_unfinished(const std::filesystem::path& wanted, const Playback::Beginning& flown, GoOnAfter after,
                                          Time now) {
  const std::optional<std::filesystem::path> newest = host::newest_journal(wanted);
  if (!newest) return std::nullopt;
  (void)host::JournalReader(*newest);  // refuses what is no regular file, before it is opened for writing
  host::JournalFile file(*newest, host::ExistingJournal::kGoOn);
  std::optional<Resumption> before = resume(*newest, flown, after);
  if (!before) return std::nullopt;
  if (after == GoOnAfter::kLastInput && now < before->memory.last)
    throw refusal(*newest, "this computer's clock is " + std::to_string((before->memory.last - now).us / 1'000'000 + 1) +
                               " s behind its last record");
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
