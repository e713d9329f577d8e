// Journals, read record by record, given to a runtime again, and gone on with as after a power cut.
//
// The input is a row of changes to a good journal of a mission, its policy, its ocean tables and some inputs (see spoil()), each with a
// first byte before it: when that is odd, the checksum of every record that still begins as one is mended, so that what it holds is read. A
// first byte of 0xFF cuts the file off, at the place that follows (2 bytes).

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "firmware/boards/linux/replay/playback.hpp"
#include "firmware/boards/linux/replay/resume.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/lc02.hpp"
#include "tests/fuzz/policy_flight.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"
#include "tests/support/mission_for.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/three_oceans.hpp"

namespace earshot::fuzz {
namespace {

Bytes good_journal(const std::filesystem::path& path) {
  const Bytes policy_bytes = good_policies().back();
  policy::FrozenPolicy policy;
  policy::PolicyComplaint complaint;
  require(policy::parse(policy_bytes, policy, complaint) == Status::kOk, "a good policy is none");
  const config::Mission flown = support::mission_for(policy);
  const Bytes tables_bytes = support::signed_bytes(*support::three_oceans(policy.area_size, flown.search_depth, flown.source_frequency));
  const messages::MissionRecord mission{.mission = flown, .policy_crc32 = crc32(policy_bytes), .tables_crc32 = crc32(tables_bytes)};
  {
    host::Journal journal(path, {.when_full = host::JournalOptions::WhenFull::kWait});
    const auto append = [&](Time time, std::string_view channel, std::span<const std::uint8_t> data) {
      require(journal.append(time, channel, data) == Status::kOk, "the journal does not take a record");
    };
    append(Time{}, wire::kMissionChannel, wire::Encoded(mission).bytes());
    append(Time{}, wire::kPolicyChannel, policy_bytes);
    append(Time{}, wire::kTablesChannel, tables_bytes);
    const Time now{1'000'000};
    const auto take = [&](const auto& value) {
      const wire::InputRecord record({.arrival = now, .port = 0, .sequence = 0, .value = value});
      append(now, record.channel(), record.data());
    };
    take(dated<messages::Navigation>(now));
    take(dated<messages::SnrMeasurement>(now));
    take(messages::OperatorCommand{.time = now, .expiry = now, .issuer = 1, .number = 1, .order = messages::Order::kStart});
    append(now, wire::kHealthChannel, wire::Encoded(messages::Health{}, now).bytes());
  }
  return host::read_bytes(path, host::kAnySize);
}

/// As somebody would who means harm.
void mend_checksums(std::span<std::uint8_t> journal) {
  while (journal.size() >= host::kRecordHeaderSize) {
    const std::uint64_t size = host::kRecordHeaderSize + load_big_endian(journal.subspan(20, 4)) + load_big_endian(journal.subspan(24, 4));
    if (size > journal.size()) return;
    store_big_endian(journal.subspan(4, 4), crc32(journal.subspan(host::kCheckedFrom, size - host::kCheckedFrom)));
    journal = journal.subspan(size);
  }
}

/// Every byte of the file is a record's or damage, each once.
void require_all_reported(const std::filesystem::path& path, std::uint64_t size) {
  host::JournalReader reader(path);
  host::JournalRecord record;
  std::uint64_t told = 0;
  while (reader.next(record)) {
    require(!record.channel.empty() && record.channel.size() <= wire::kMaxChannelLength, "a record has no channel");
    told += host::kRecordHeaderSize + record.channel.size() + record.data.size();
    require(reader.offset() <= size, "a record ends behind the file");
  }
  std::uint64_t end = 0;
  for (const host::JournalDamage& damage : reader.damages()) {
    require(damage.offset >= end && damage.bytes > 0, "damages overlap");
    end = damage.offset + damage.bytes;
    told += damage.bytes;
  }
  require(told == size, "bytes of the journal are neither a record's nor damage");
  require((reader.end() == host::JournalReader::End::kWhole) == (reader.offset() == size), "the end is told wrong");
}

void play(const std::filesystem::path& path) {
  try {
    board::Playback playback(path);
    while (playback.next()) {
    }
    static_cast<void>(playback.closing());
    if (playback.outputs().setpoint) require(is_finite(playback.outputs().setpoint->waypoint), "a set-point is not finite");
  } catch (const host::BadInput& refusal) {
    require_names_file(refusal.what(), path.string());
  }
}

/// @param flown  the beginning of the good journal
void go_on(const std::filesystem::path& path, const board::Flown& flown, std::uint64_t size) {
  for (const board::GoOnAfter after : {board::GoOnAfter::kLastInput, board::GoOnAfter::kLastTurn}) {
    try {
      std::optional<board::Resumption> before = board::resume(path, flown, after);
      if (!before) continue;
      require(before->runtime != nullptr && before->kept_bytes + before->cut_bytes == size, "a journal is gone on with at a wrong place");
      const runtime::Outputs outputs = before->runtime->step(before->memory.last + Duration::seconds(1));
      if (outputs.setpoint) require(is_finite(outputs.setpoint->waypoint), "a set-point is not finite");
    } catch (const host::BadInput& refusal) {
      require_names_file(refusal.what(), path.string());
    }
  }
}

}  // namespace

void judge(std::span<const std::uint8_t> bytes) {
  static const support::TemporaryFolder folder;
  static const Bytes good = good_journal(folder / "good.journal");
  static const board::Flown flown = board::Playback(folder / "good.journal").flown();
  Bytes spoilt = good;
  for (Input input(bytes); !input.is_used_up();) {
    const std::uint8_t what = input.byte();
    if (what == 0xFF) spoilt.resize(std::min<std::size_t>(input.word(), spoilt.size()));
    spoil(spoilt, input);
    if (what % 2 == 1) mend_checksums(spoilt);
  }
  const std::filesystem::path path = folder / "spoilt.journal";
  std::ofstream(path).write(reinterpret_cast<const char*>(spoilt.data()), static_cast<std::streamsize>(spoilt.size()));
  require_all_reported(path, spoilt.size());
  play(path);
  go_on(path, flown, spoilt.size());
}

}  // namespace earshot::fuzz
