// earshot-listen: hears calls in recordings with the vehicle's own detector.

#include <iostream>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/talk.hpp"
#include "sim/apps/listen/outputs.hpp"

namespace {

using namespace earshot;
using listen::Arguments;

void write_outputs(const listen::Result& result, const Arguments& arguments) {
  if (!arguments.csv.empty()) host::write_whole(arguments.csv, csv_of(result));
  if (!arguments.raven.empty()) host::write_whole(arguments.raven, raven_of(result));
  if (!arguments.json.empty()) host::write_whole(arguments.json, json_of(result, arguments));
  if (!arguments.levels.empty()) write_levels(result, arguments);
  if (!arguments.spectrogram.empty()) draw_spectrogram(result, arguments);
  if (!arguments.roc.empty()) draw_curve(result, arguments);
}

/// Says on standard error what somebody must know of the files. @return the exit status
int warn(const listen::Plan& plan, const listen::Heard& heard) {
  const bool is_incomplete = heard.missing_frames > 0 || !plan.sequence.is_whole();
  for (const std::string& remark : plan.remarks) std::cerr << "earshot listen: " << host::printable(remark) << '\n';
  if (heard.missing_frames > 0)
    std::cerr << "earshot listen: " << heard.missing_frames
              << " samples that the headers announce could not be read: a file is cut short or damaged\n";
  return is_incomplete ? program::kIncomplete : program::kDone;
}

int run(Arguments& arguments) {
  open_folders(arguments);
  require_writable(arguments);
  const listen::Plan plan = plan_for(arguments);
  if (!arguments.roc.empty() && plan.truth.empty())
    throw host::BadInput(arguments.truth + ": holds no selection, so that --roc has no recall to draw");
  const listen::Heard heard = listen_to(plan, arguments);
  listen::Result result{.plan = plan, .heard = heard, .score = {}};
  if (!arguments.truth.empty()) result.score = score_of(heard.rows, plan, arguments.tolerance_s, heard.listened_s);
  write_outputs(result, arguments);
  program::print() << summary_of(result, arguments);
  return warn(plan, heard);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  program::CommandLine line(
      "earshot listen",
      "Hears calls in recordings with the detector that flies on the vehicle, and prints each with its time, level and SNR.\n"
      "Without any option it listens from 15 to 30 Hz for pulses of a second, which finds fin whales, and most that is loud there longer.\n"
      "Exit status: 0 listened to all, 1 listened to what there is of files that are cut short, unreadable or of a length that their "
      "header does not give "
      "right, 2 something cannot be listened to.");
  describe(line, arguments);
  return program::run(line, argc, argv, [&] {
    arguments.history = program::as_typed(argc, argv);
    return run(arguments);
  });
}
