#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/host/journal/reading/decode_record.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/firmware/wire/golden/golden_file.hpp"

namespace earshot::journal {
namespace {

using wire::GoldenFile;

/// "NAME: CHANNEL HEX" of tests/reference/messages.
struct RecordedLine {
  std::string name;
  std::string channel;
  std::vector<std::uint8_t> data;
};

std::vector<std::uint8_t> bytes_in(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::vector<RecordedLine> recorded(const std::string& file) {
  std::vector<RecordedLine> lines;
  std::ifstream stream(std::filesystem::path(EARSHOT_SOURCE_DIR) / "tests/reference/messages" / file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with('#') || colon == std::string::npos) continue;
    const std::string rest = line.substr(colon + 2);
    const std::size_t blank = rest.find(' ');
    const bool has_channel = blank != std::string::npos;
    lines.push_back({.name = line.substr(0, colon),
                     .channel = has_channel ? rest.substr(0, blank) : "",
                     .data = bytes_in(has_channel ? rest.substr(blank + 1) : rest)});
  }
  return lines;
}

/// Of lcm.txt, which names no channels.
std::string channel_of(const std::string& name) {
  const std::string kind = name.substr(0, name.find('.'));
  if (kind == "decision") return std::string(wire::kDecisionChannel);
  if (kind == "acknowledgement") return std::string(wire::kAcknowledgementChannel);
  if (kind == "safety_event") return std::string(wire::kSafetyEventChannel);
  if (kind == "setpoint") return std::string(wire::kJournalledSetpointChannel);
  if (kind == "health") return std::string(wire::kHealthChannel);
  if (kind == "mission") return std::string(wire::kMissionChannel);
  if (kind == "journal_end") return std::string(wire::kJournalEndChannel);
  if (kind == "journal_resumed_t") return std::string(wire::kJournalResumedChannel);
  return kind == "controller_trouble_t" ? std::string(wire::kControllerTroubleChannel) : "";
}

/// Every record's fields, read from the bytes that were recorded.
TEST(JournalFields, AreOfEveryRecordWhatTheyAlwaysWere) {
  GoldenFile golden("fields.txt");
  for (const RecordedLine& line : recorded("input_records.txt"))
    golden.add(line.name, to_line(fields_of(decode_record(line.channel, Time{5}, line.data))));
  for (const char* file : {"lcm.txt", "lcm_types.txt"}) {
    for (const RecordedLine& line : recorded(file)) {
      const std::string channel = channel_of(line.name);
      if (!channel.empty()) golden.add(line.name, to_line(fields_of(decode_record(channel, Time{5}, line.data))));
    }
  }
  golden.expect_as_recorded();
}

}  // namespace
}  // namespace earshot::journal
