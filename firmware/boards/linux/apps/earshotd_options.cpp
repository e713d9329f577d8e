#include "firmware/boards/linux/apps/earshotd_options.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/memory/heap_trap.hpp"
#include "firmware/host/trust/vehicle_file.hpp"

namespace earshot::board {
namespace {

void require_check_possible(const Options& o) {
  if (o.chart && !o.check) throw host::BadInput("--chart: only with --check");
  if (o.check && o.simulation) throw host::BadInput("--check: not with --simulation; it is the checklist before a dive");
}

void require_resuming_possible(const Options& o) {
  if (o.resume && o.replace) throw host::BadInput("--resume: not with --replace, which throws the journal away");
  if (o.resume && o.hear) throw host::BadInput("--resume: not with --hear: what a detector has learnt of the noise is in no journal");
  if (o.resume && o.board) throw host::BadInput("--resume: not with --board, which begins its mission anew");
  if (o.resume && o.check) throw host::BadInput("--resume: not with --check, which flies nothing");
}

void require_copies_possible(const Options& o) {
  if (!o.safety_copies.empty() && o.simulation) throw host::BadInput("--safety-copy: not with --simulation, which keeps no safety record");
}

void require_budget_possible(const Options& o) {
  if (o.journal_part_mb && o.journal_budget_mb && *o.journal_budget_mb < 2 * *o.journal_part_mb)
    throw host::BadInput("--journal-budget-mb: " + std::to_string(*o.journal_budget_mb) + " is less than two parts of " +
                         std::to_string(*o.journal_part_mb) + " (--journal-part-mb)");
}

void require_hearing_possible(const Options& o) {
  if (o.snr_from_bus && (!o.simulation || o.hear)) throw host::BadInput("--snr-from-bus: only with --simulation, and not with --hear");
  if (o.hear && !o.simulation) throw host::BadInput("--hear: only with --simulation; at sea the mission's hydrophone is heard in any case");
}

void require_rehearsal_possible(const Options& o) {
  if (o.speed_since && o.simulation) throw host::BadInput("--speed-since: not with --simulation, whose clock is the simulator's");
}

void require_proof_possible(const Options& o) {
  if (!o.prove_no_alloc) return;
  if (o.simulation) throw host::BadInput("--prove-no-alloc: not with --simulation, whose middleware allocates as it likes");
  if (!host::kHeapTrapCounts) throw host::BadInput("--prove-no-alloc: this build has a sanitizer's heap, which cannot be counted");
}

}  // namespace

void declare(program::CommandLine& line, Options& o) {
  line.option("MISSION", &o.mission, "mission file (TOML)").required();
  line.option("--out", &o.out, "folder for journal.lcmlog, made if it is missing")
      .checked([](const std::string& folder) { return folder.empty() ? "names no folder; . is the one that you are in" : ""; })
      .shows_default();
  line.flag("--replace", &o.replace,
            "replace a journal that is there already; without it: refuse to start in simulation, write journal-2.lcmlog and so on at sea");
  line.flag(
      "--resume", &o.resume,
      "go on with the mission of the folder's journal when its process was killed or lost its power, at sea if the safety record names it; "
      "where it cannot go on, bring the vehicle up; when that was ended in order, or there is none, begin a new one; without it: begin "
      "a new one");
  line.option("--safety-copy", &o.safety_copies,
              "folder for another copy of the safety record, best on another disk; may be given again; default: as a service its state "
              "folder (STATE_DIRECTORY)");
  line.option(
          "--journal-survives", &o.journal_survives,
          "what a record in the journal survives: power-cut: it is brought to the disk within milliseconds; process: the kernel writes it "
          "when it likes; default: power-cut at sea, process in simulation")
      .one_of({"power-cut", "process"});
  line.option("--journal-part-mb", &o.journal_part_mb,
              "begin another file of the journal (journal.part2.lcmlog and so on) once one has grown to so many megabytes; default: when "
              "SIGHUP asks for it")
      .from(1, 1'000'000);
  line.option(
          "--journal-budget-mb", &o.journal_budget_mb,
          "keep all journals in the folder together below so many megabytes: those of earlier flights are deleted, the oldest first, with "
          "their policies; where none is left it is as if the disk were full; default: as the disk gives")
      .from(1, 100'000'000);
  line.option("--log", &o.log,
              "how lines on standard error are written: text, for people; journal, with their severity, for systemd's journal; json, an "
              "object a line; default: journal where standard error leads there, else text")
      .one_of({kLogFormats[0].data(), kLogFormats[1].data(), kLogFormats[2].data()});
  line.option("--vehicle", &o.vehicle,
              std::string("the vehicle's configuration (TOML): whose missions and policies it flies; default: ") + host::kVehicleFile +
                  " if there is one, in simulation none");
  line.option("--policy", &o.policy, "policy file instead of the mission's");
  line.option("--tables", &o.tables, "ocean tables instead of the mission's: a file, or a folder of which one covers the mission");
  line.option("--public-key", &o.public_key, "file of the trusted public key instead of the mission's");
  line.option("--seed", &o.seed, "seed of a policy that draws its actions, instead of the mission's")
      .from(0, std::numeric_limits<std::int64_t>::max());
  line.option(
          "--bus", &o.ports.bus,
          "instead of the mission's ports: all over LCM, all over CAN, or navigation over CAN and the rest over LCM; not a hydrophone's")
      .one_of({"lcm", "can", "mixed"});
  line.option("--lcm-url", &o.ports.lcm_url, "address of every LCM port but a hydrophone's instead of the mission's");
  line.option("--hydrophone-url", &o.ports.hydrophone_url, "address of the hydrophone's port instead of the mission's");
  line.option("--can-interface", &o.ports.can_interface, "interface of every CAN port instead of the mission's");
  line.option("--speed", &o.speed, "mission seconds per second of this host's clock, for a rehearsal ashore; not with --simulation")
      .between(0.01, 100.0)
      .shows_default();
  line.option(
          "--speed-since", &o.speed_since,
          "seconds since 1970, UTC, from which --speed counts; default: when this program starts; a rehearsal that goes on with --resume "
          "is given the same again")
      .between(0.0, 4e9);
  line.option("--simulation", &o.simulation,
              "fly in lock-step with a simulator in this DDS domain; without it: at sea, on this host's clock")
      .from(0, 230);
  line.option("--run", &o.run, "in simulation: number of the run whose simulator is waited for; 0: of the first that knocks")
      .from(0, std::numeric_limits<std::int64_t>::max())
      .shows_default();
  line.option("--wait", &o.wait_s, "in simulation: how many seconds to wait for the simulator").from(1, 86'400).shows_default();
  line.option(
      "--board", &o.board,
      "let a microcontroller decide (firmware/boards/cortex_m7), at the other end of this serial line: a device, or the Unix socket "
      "of an emulator");
  line.flag(
      "--hear", &o.hear,
      "in simulation: measure the SNR in the sound that the simulator puts on the hydrophone's bus, instead of being given it; at sea "
      "the hydrophone is heard in any case");
  line.flag("--snr-from-bus", &o.snr_from_bus,
            "in simulation: take the SNR off the vehicle's bus, as at sea, instead of being given it by the simulator");
  line.flag("--prove-no-alloc", &o.prove_no_alloc,
            "show that no thread asks for memory from the first turn to the last, and print what memory is spent on; at sea only");
  line.flag("--check", &o.check, "do not fly: judge the mission and all its files, and print the checklist before a dive; opens no bus");
  line.option("--chart", &o.chart, "with --check: draw area, fence, zones and safe point into this SVG file")
      .checked([](const std::string& file) {
        return file.ends_with(".svg") ? "" : "the chart is an SVG picture: name a file that ends with .svg";
      });
}

LogFormat Options::log_format() const {
  if (!log) return log_format_of_standard_error();
  return static_cast<LogFormat>(std::ranges::find(kLogFormats, *log) - std::begin(kLogFormats));
}

void require_possible(const Options& o) {
  require_check_possible(o);
  require_hearing_possible(o);
  require_resuming_possible(o);
  require_rehearsal_possible(o);
  require_proof_possible(o);
  require_budget_possible(o);
  require_copies_possible(o);
}

}  // namespace earshot::board
