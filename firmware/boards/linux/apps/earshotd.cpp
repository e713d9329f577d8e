// earshotd: the process that flies the vehicle.

#include <algorithm>
#include <span>
#include <string_view>

#include "firmware/boards/linux/apps/earshotd_options.hpp"
#include "firmware/boards/linux/apps/fly_or_come_up.hpp"
#include "firmware/boards/linux/apps/run_modes.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/standard_streams.hpp"

namespace {

using namespace earshot;

using board::Options;

int run(const Options& o) {
  if (!o.check && !o.simulation) return board::fly_at_sea(o);
  board::require_possible(o);
  return o.check ? board::check(o) : board::fly_in_simulation(o);
}

}  // namespace

int main(int argc, char** argv) {
  program::NonBlockingStdio streams;  // a vehicle waits for nobody who reads, and does not end with him
  program::CommandLine line("earshotd",
                            "earshotd flies one mission: navigation and SNR in, frozen policy, set-points out.\n"
                            "Exit status: 0 the search ended DONE, or none was under way; 1 --prove-no-alloc found an allocation;\n"
                            "2 bad input (with --resume: and nothing was under way); 3 the simulator, the bus or the journal was\n"
                            "lost (with --resume also: another process flies here, or no port opens to bring the vehicle up by);\n"
                            "4 the search ended in ABORT: a rule, an operator, a memory that failed, or an outage after which it\n"
                            "could not go on; 5 a signal stopped a search under way; 130 stopped before the simulator came.");
  Options options;
  board::declare(line, options);
  bool has_begun = false;
  const int status = program::run(line, argc, argv, [&] {
    has_begun = true;
    streams.set_error_format([format = options.log_format()](std::string_view plain_line, std::span<char> into) {
      return board::formatted(plain_line, format, into);
    });
    options.names_out = std::ranges::count(line.given(), "--out") > 0;
    return run(options);
  });
  // A command line that this program does not know (of another version) is no reason to leave a vehicle alone.
  return status == program::kBadInput && !has_begun ? board::come_up_by(argc, argv).value_or(status) : status;
}
