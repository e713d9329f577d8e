#include "firmware/boards/linux/replay/beginning.hpp"

#include <string_view>

#include "firmware/core/crc32.hpp"
#include "firmware/host/journal/reading/decode_record.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/tables/tables_format.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::board {
namespace {

/// Reads the record that comes next into `record`.
void require_record(host::JournalReader& reader, const std::filesystem::path& journal, const char* which, std::string_view channel,
                    const char* what, host::JournalRecord& record) {
  const std::uint32_t number = channel == wire::kPolicyChannel ? 1 : 2;
  if (!reader.next(record) || record.number != number || record.channel != channel)
    throw not_replayable(journal, std::string("its ") + which + " record is no " + what);
}

template <class Parsed>
std::unique_ptr<Parsed> parsed(const host::JournalRecord& record, const std::filesystem::path& journal, const char* what,
                               std::uint32_t crc32_of_mission) {
  if (crc32(record.data) != crc32_of_mission) throw not_replayable(journal, std::string("its ") + what + " is not what its mission names");
  auto value = std::make_unique<Parsed>();
  policy::PolicyComplaint complaint;
  if (!record.data.empty() && policy::parse(record.data, *value, complaint) != Status::kOk)
    throw not_replayable(journal, std::string("its ") + what + " " + std::string(to_string(complaint.fault)));
  return value;
}

}  // namespace

host::BadInput not_replayable(const std::filesystem::path& journal, const std::string& why) {
  return host::BadInput(journal.string() + ": cannot be replayed: " + why);
}

Beginning read_beginning(host::JournalReader& reader, const std::filesystem::path& journal) {
  host::JournalRecord record;
  if (!reader.next(record)) throw host::BadInput(journal.string() + ": not a journal: no record in it");
  const journal::Content first = journal::decode_record(record.channel, record.time, record.data);
  const auto* const mission = std::get_if<messages::MissionRecord>(&first);
  if (record.number != 0 || mission == nullptr) throw not_replayable(journal, "its first record is no mission");
  Beginning beginning{.time = record.time,
                      .flown = {.mission = mission->mission, .policy_crc32 = mission->policy_crc32, .tables_crc32 = mission->tables_crc32},
                      .policy = nullptr,
                      .tables = nullptr};
  require_record(reader, journal, "second", wire::kPolicyChannel, "policy", record);
  beginning.policy = parsed<policy::FrozenPolicy>(record, journal, "policy", beginning.flown.policy_crc32);
  require_record(reader, journal, "third", wire::kTablesChannel, "tables file", record);
  beginning.tables = parsed<policy::OceanTables>(record, journal, "tables file", beginning.flown.tables_crc32);
  return beginning;
}

}  // namespace earshot::board
