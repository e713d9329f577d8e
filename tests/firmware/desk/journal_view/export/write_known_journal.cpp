// Writes the journal that mcap_export_test.py knows. usage: write_known_journal FILE [TURNS]: with so many turns more before its end

#include <string>

#include "tests/firmware/host/journal/known_journal.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  using namespace earshot::journal;
  if (argc < 3) {
    write_known_journal(argv[1]);
    return 0;
  }
  WrittenJournal journal(argv[1]);
  for (int turn = 1; turn <= std::stoi(argv[2]); ++turn) journal.health(after(turn), turn, messages::MissionState::kSearch);
  journal.close();
  return 0;
}
