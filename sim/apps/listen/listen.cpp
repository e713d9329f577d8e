// earshot-listen: hears calls in recordings with the vehicle's own detector.

#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/talk.hpp"
#include "sim/annotation/selection_table.hpp"
#include "sim/apps/listen/outputs.hpp"
#include "sim/listening/truth.hpp"
#include "sim/recording/clock_text.hpp"

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
int warn(const listening::Plan& plan, const listening::Heard& heard, const std::vector<std::string>& remarks) {
  const bool is_incomplete = heard.missing_frames > 0 || !plan.sequence.is_whole();
  for (const std::string& remark : remarks) std::cerr << "earshot listen: " << host::printable(remark) << '\n';
  if (heard.missing_frames > 0) std::cerr << "earshot listen: " << missing_to_string(heard) << '\n';
  return is_incomplete ? program::kIncomplete : program::kDone;
}

recording::StatedTimes stated_times(const Arguments& arguments) {
  recording::StatedTimes stated{.name_format = arguments.time_format};
  if (!arguments.begin.empty()) stated.begin = recording::read_iso(arguments.begin)->utc;
  return stated;
}

listening::Plan plan_for(const Arguments& arguments) {
  const std::vector<std::filesystem::path> paths(arguments.files.begin(), arguments.files.end());
  recording::Sequence sequence(paths, stated_times(arguments));
  return listening::plan_for(std::move(sequence), request_of(arguments));
}

/// With --score.
listening::Truth truth_for(const listening::Plan& plan, const Arguments& arguments) {
  const listening::Listened listened{.sequence = plan.sequence, .channel = arguments.channel, .band = plan.settings.band};
  listening::Truth truth = truth_of(annotation::read_selection_table(arguments.truth), arguments.truth, listened);
  if (!arguments.roc.empty() && truth.intervals.empty())
    throw host::BadInput(arguments.truth + ": holds no selection, so that --roc has no recall to draw");
  return truth;
}

void add_score(listen::Result& result, const std::vector<annotation::Interval>& truth, double tolerance_s) {
  const listening::Heard& heard = result.heard;
  result.score = listening::score_of(heard.rows, truth, tolerance_s, heard.listened_s);
  for (const listening::AtThreshold& other : heard.others)
    result.curve.push_back(
        {.threshold_db = other.threshold_db, .score = listening::score_of(other.rows, truth, tolerance_s, heard.listened_s)});
}

listening::Heard listen_to(listening::Plan& plan, const Arguments& arguments) {
  listening::Wanted wanted{.every_threshold = !arguments.roc.empty(), .spectrogram = !arguments.spectrogram.empty()};
  if (!arguments.levels.empty()) wanted.levels_interval_s = arguments.levels_interval_s;
  plan.chain.divisor = listening::divisor_for(listening::largest_magnitude(plan.sequence, [] {}));
  program::ProgressBar bar("listening");
  return listening::listen_to(plan, wanted, [&bar](double share) { bar.update(share); });
}

int run(Arguments& arguments) {
  open_folders(arguments);
  require_writable(arguments);
  listening::Plan plan = plan_for(arguments);
  listening::Truth truth;
  if (!arguments.truth.empty()) truth = truth_for(plan, arguments);
  const listening::Heard heard = listen_to(plan, arguments);
  listen::Result result{.plan = plan, .heard = heard, .score = {}, .curve = {}};
  if (!arguments.truth.empty()) add_score(result, truth.intervals, arguments.tolerance_s);
  write_outputs(result, arguments);
  program::print() << summary_of(result, arguments);
  std::vector<std::string> remarks = plan.remarks;
  remarks.insert(remarks.end(), truth.remarks.begin(), truth.remarks.end());
  return warn(plan, heard, remarks);
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
