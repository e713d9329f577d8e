#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

#include "firmware/boards/linux/turn/turn_records.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "tests/bits/mission.hpp"
#include "tests/firmware/wire/golden/every_message.hpp"
#include "tests/firmware/wire/golden/frames.hpp"
#include "tests/firmware/wire/golden/golden_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::wire {
namespace {

/// Of the recorded flight of tests/bits: its journal, and what a bus carries of it.
class FlightWitness final : public bits::Witness {
 public:
  explicit FlightWitness(host::Journal& journal) : journal_(journal) {}

  void see(const messages::Input& input) override {
    const InputRecord record(input);
    append(input.arrival, record.channel(), record.data());
    if (const auto* const order = std::get_if<messages::OperatorCommand>(&input.value))
      fast("can order", [&](n2k::FastPacketFrames& frames) { return n2k::compose_command(*order, {.source = 0x41}, frames); });
    if (const auto* const snr = std::get_if<messages::SnrMeasurement>(&input.value)) {
      n2k::Frame frame;
      EXPECT_EQ(n2k::compose_snr({.snr = snr->snr, .too_faint = snr->too_faint, .band_level = {}}, 0x43, frame), Status::kOk);
      streams.add("can snr", frame.bytes());
    }
  }

  void see(Time turn, const runtime::Outputs& outputs) override {
    board::for_each_record(outputs, outputs.health.state != state_, [&](std::string_view channel, const auto& message, host::Priority) {
      append(turn, channel, Encoded(message, turn).bytes());
    });
    state_ = outputs.health.state;
    fast("can health", [&](n2k::FastPacketFrames& frames) { return n2k::compose_health(outputs.health, turn, {.source = 0x40}, frames); });
    if (outputs.decision)
      fast("can decision",
           [&](n2k::FastPacketFrames& frames) { return n2k::compose_decision(*outputs.decision, {.source = 0x40}, frames); });
    for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements)
      fast("can acknowledgement",
           [&](n2k::FastPacketFrames& frames) { return n2k::compose_acknowledgement(acknowledgement, {.source = 0x40}, frames); });
    if (!outputs.setpoint) return;
    n2k::SetpointFrames frames;
    EXPECT_EQ(n2k::compose_setpoint(*outputs.setpoint, 0x40, 0, frames), Status::kOk);
    for (const n2k::Frame& frame : frames) streams.add("can setpoint", frame.bytes());
  }

  void append(Time time, std::string_view channel, std::span<const std::uint8_t> data) {
    EXPECT_EQ(journal_.append(time, channel, data, host::Priority::kOrder), Status::kOk);
    streams.add(channel, data);
  }

  Streams streams;

 private:
  template <class Compose>
  void fast(std::string_view stream, Compose&& compose) {
    n2k::FastPacketFrames frames;
    EXPECT_EQ(compose(frames), Status::kOk) << stream;
    for (const n2k::Frame& frame : frames) streams.add(stream, frame.bytes());
  }

  host::Journal& journal_;
  messages::MissionState state_ = messages::MissionState::kStandby;
};

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(FlightGolden, ARecordedFlightHasTheJournalAndTheFramesThatItAlwaysHad) {
  const support::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "journal.lcmlog";
  host::Journal journal(path, {.when_full = host::JournalOptions::WhenFull::kWait, .existing = host::ExistingJournal::kReplace});
  FlightWitness witness(journal);
  witness.append(Time{}, kMissionChannel, Encoded(messages::MissionRecord{.mission = sample_mission(true)}).bytes());
  const auto mission = std::make_unique<bits::Mission>();
  mission->show(witness);
  ASSERT_EQ(mission->begin(bits::Track::kRecorded), Status::kOk);
  while (!mission->fly().is_end) {
  }
  journal.conclude(sample_closing());
  ASSERT_EQ(journal.close(), Status::kOk);
  const std::vector<std::uint8_t> file = bytes_of(path);

  GoldenFile golden("flight.txt");
  golden.add("journal", std::to_string(file.size()) + " bytes, CRC-32 " + std::to_string(crc32(file)));
  witness.streams.write_to(golden);
  golden.expect_as_recorded();
}

}  // namespace
}  // namespace earshot::wire
