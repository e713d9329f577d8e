// earshot-replay: a journal given to the vehicle's core again, also with another policy or mission.

#include <string>

#include "firmware/desk/replay_view/replay_command.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/program/run.hpp"

int main(int argc, char** argv) {
  using namespace earshot;
  program::CommandLine line(
      "earshot replay",
      "earshot replay JOURNAL gives a flight's inputs to the vehicle's core again and compares every output with the journal, byte for\n"
      "byte. With --policy, --tables or --mission it prints besides what another would have decided on the same inputs, and where the "
      "decisions part;\n"
      "behind that the inputs are those of the vehicle that followed the journal, so that it is no forecast.\n"
      "Exit status: 0 the journal is whole and every output the same, 1 an output differs or the journal is not whole, which standard\n"
      "error reports (where another policy or mission parts from it changes nothing in that), 2 bad input,\n"
      "3 standard output is gone.");
  replay_view::ReplayCommand command;
  bool force = false;
  line.option("JOURNAL", &command.journal, "journal of a flight (.lcmlog), or its folder: the newest there").required();
  line.option("--policy", &command.policy, "what would this policy have decided? (.policy; its signature is not looked at)");
  line.option("--tables", &command.tables,
              "what would have been decided by these ocean tables? (.tables; their signature is not looked at)")
      .names("a file");
  line.option("--mission", &command.mission,
              "what would have been decided on this mission? (TOML; with the journal's policy, unless --policy, and the journal's seed)");
  line.option("--from", &command.from_step, "compare, and list, from this step on; what stands before it is given to the core alone");
  line.option("--map", &command.map,
              "with --policy, --tables or --mission: draw the track and both decisions of every step into this SVG file")
      .checked([](const std::string& file) {
        return file.ends_with(".svg") ? "" : "the map is an SVG picture: name a file that ends with .svg";
      });
  line.option("--json", &command.json, "write what was found into this JSON file");
  line.flag("--force", &force, "replace a file that is there already, of whatever kind it is");
  line.footer(
      "Examples:\n"
      "  earshot replay out/journal.lcmlog\n"
      "  earshot replay out/journal.lcmlog --policy other.policy --map parting.svg\n"
      "  earshot replay out/journal.lcmlog --mission other.toml --from 10 --json parting.json");
  return program::run(line, argc, argv, [&] {
    command.replace = host::replaced_by(force);
    command.journal = host::newest_journal_in(command.journal);
    return replay_view::replay(command);
  });
}
