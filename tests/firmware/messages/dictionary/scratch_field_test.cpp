// Compiled with a health that has one member more, and its one line in the list (CMakeLists.txt): whatever is made of the list has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/desk/journal_view/export/foxglove.hpp"
#include "firmware/desk/journal_view/export/turn_table.hpp"
#include "firmware/host/definitions/lcm_text.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "hil/bus/dbc.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {
namespace {

messages::Health health_with_a_scratch() {
  messages::Health health;
  health.scratch_percent = 12.5;
  return health;
}

TEST(ScratchField, GoesOverLcmAndBack) {
  const wire::Encoded encoded(health_with_a_scratch(), Time{5});
  EXPECT_EQ(encoded.bytes().size(), 372U + 8U);
  messages::Health read;
  ASSERT_EQ(wire::decode(encoded.bytes(), read), Status::kOk);
  EXPECT_EQ(read.scratch_percent, 12.5);
}

TEST(ScratchField, GoesOverCanAndBackAndStandsInTheDbc) {
  n2k::FastPacketFrames frames;
  ASSERT_EQ(n2k::compose_health(health_with_a_scratch(), Time{5}, {.source = 0x40}, frames), Status::kOk);
  n2k::FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  Status status = Status::kNotReady;
  for (const n2k::Frame& frame : frames) status = assembly.accept({.pgn = n2k::kHealthPgn, .source = 0x40}, frame, bytes);
  ASSERT_EQ(status, Status::kOk);
  EXPECT_EQ(bytes.size(), 61U + 2U);
  EXPECT_EQ(n2k::read_health(bytes).value().health.scratch_percent, 12.5);
  std::ostringstream dbc;
  hil::print_dbc(dbc);
  EXPECT_NE(dbc.str().find("\n SG_ Scratch : 488|16@1+ (0.01,0) "), std::string::npos);
}

TEST(ScratchField, StandsInTheLcmDefinition) {
  const auto all = definitions::lcm_definitions();
  const auto health = std::ranges::find(all, "health_t", &definitions::LcmDefinition::type);
  EXPECT_NE(health->text.find("\n  double scratch_percent;"), std::string::npos) << health->text;
}

TEST(ScratchField, StandsInJsonAndInTheSchemaOfAnMcapFile) {
  const nlohmann::ordered_json fields = journal::fields_of(health_with_a_scratch());
  EXPECT_EQ(fields.at("scratch_percent"), 12.5);
  EXPECT_EQ(journal::schema_of(journal::all_fields_of(health_with_a_scratch())).at("properties").at("scratch_percent").at("type"),
            "number");
}

TEST(ScratchField, HasAColumnInTheTableOfTurns) {
  const support::TemporaryFolder folder;
  journal::TurnTable table(folder / "turns.csv", std::nullopt);
  table.take(journal::Record{.time = Time{5}, .channel = "EARSHOT_HEALTH", .content = health_with_a_scratch()}, {});
  table.finish({});
  std::ifstream file(folder / "turns.csv");
  std::string header;
  std::string row;
  std::getline(file, header);
  std::getline(file, row);
  EXPECT_TRUE(header.ends_with(",scratch_percent,vehicle_status_age_s")) << header;
  EXPECT_TRUE(row.ends_with(",12.5,")) << row;
}

}  // namespace
}  // namespace earshot
