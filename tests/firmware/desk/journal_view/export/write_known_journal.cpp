// Writes the journal that mcap_export_test.py knows.
// usage: write_known_journal FILE [TURNS [TABLES]]: so many turns alone, and before them a record of ocean tables that holds this text

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tests/firmware/host/journal/known_journal.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  using namespace earshot::journal;
  if (argc < 3) {
    write_known_journal(argv[1]);
    return 0;
  }
  WrittenJournal journal(argv[1]);
  if (argc > 3) {
    const std::string_view tables = argv[3];
    journal.bytes(after(0), wire::kTablesChannel, std::vector<std::uint8_t>(tables.begin(), tables.end()));
  }
  for (int turn = 1; turn <= std::stoi(argv[2]); ++turn) journal.health(after(turn), turn, messages::MissionState::kSearch);
  journal.close();
  return 0;
}
