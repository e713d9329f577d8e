#include "firmware/host/safety_record/words/record_words.hpp"

#include <system_error>

#include "firmware/core/time.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/safety_record/record_file.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/utc.hpp"
#include "firmware/messages/dictionary/health_words.hpp"

namespace earshot::host {
namespace {

std::string standing(const SafetyRecord& record) {
  std::string text = messages::to_string(record.state);
  if (record.end_reason == messages::EndReason::kOperatorAbort)
    text += ", an operator aborted it, or the program as it was stopped";  // both are the same order
  else if (record.end_reason != messages::EndReason::kNone)
    text += std::string(", ") + messages::to_string(record.end_reason);
  if (record.is_paused) text += ", paused";
  text += record.is_engaged ? ", set-points leave" : ", no set-points leave";
  if (record.is_released) text += ", the drop weight was asked to be released";
  return text;
}

std::string what_follows(const SafetyRecord& record) {
  if (record.is_closed) return "It was stopped in order, and nothing is under way";
  if (!is_under_way(record)) return "Nothing is under way";
  if (record.state != messages::MissionState::kSearch) return "The vehicle was not known to be up: earshotd --resume brings it up";
  return "earshotd --resume goes on, or brings the vehicle up";
}

}  // namespace

std::string to_string(const SafetyRecord& record) {
  const std::string depth = "; depth at most " + host::significant(record.max_depth.value, 6) + " m";
  const std::string starts = record.starts == 0 ? "" : "; " + host::counted(record.starts, "start");
  return "safety record, " + (host::is_dated(record.utc) ? journal::utc(record.utc) : "at no date") + ": " + standing(record) + depth +
         starts + ". " + what_follows(record);
}

std::optional<std::string> safety_record_beside(const std::filesystem::path& journal) {
  const std::filesystem::path folder = journal.parent_path();
  RecordFile file(folder / "journal.safety");
  const std::optional<SafetyRecord> record = file.open() ? file.newest() : std::nullopt;
  if (!record) return std::nullopt;
  const std::optional<std::filesystem::path> owner = journal_marked(folder / kFirstJournal, record->journal_crc32);
  std::error_code error;
  if (owner && !std::filesystem::equivalent(*owner, journal, error)) return std::nullopt;
  return to_string(*record);
}

}  // namespace earshot::host
