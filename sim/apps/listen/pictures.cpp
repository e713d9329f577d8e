#include <algorithm>
#include <sstream>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/apps/listen/outputs.hpp"
#include "sim/plot/operating_curve_plot.hpp"
#include "sim/plot/spectrogram_plot.hpp"

namespace earshot::listen {
namespace {

std::string title_of(const listening::Plan& plan) {
  const std::string first = host::printable(plan.sequence.parts().front().path.filename().string());
  const std::size_t more = plan.sequence.files() - 1;
  return more == 0 ? first : first + " and " + std::to_string(more) + " more";
}

std::string settings_text(const listening::Plan& plan, const Arguments& arguments) {
  return arguments.preset + ", " + host::significant(plan.settings.band.low.value, 4) + " to " +
         host::significant(plan.settings.band.high.value, 4) + " Hz";
}

/// "5 min listened to", "27.5 h listened to"
std::string listened_text(double listened_s) {
  if (listened_s < 60.0) return host::significant(listened_s, 3) + " s listened to";
  if (listened_s < 3600.0) return host::significant(listened_s / 60.0, 3) + " min listened to";
  return host::significant(listened_s / 3600.0, 3) + " h listened to";
}

}  // namespace

void draw_spectrogram(const Result& result, const Arguments& arguments) {
  std::vector<plot::Mark> marks;
  for (const listening::Row& row : result.heard.rows)
    marks.push_back({row.begin_s, row.begin_s + row.duration_s, result.plan.settings.band.low, result.plan.settings.band.high});
  std::ostringstream subtitle;
  subtitle << marks.size() << " detections (between bars): " << settings_text(result.plan, arguments) << ", SNR of "
           << result.plan.settings.detection_threshold.value << " dB or more";
  plot::plot_spectrogram(arguments.spectrogram, *result.heard.spectrogram, result.plan.chain.correction(), marks,
                         {.title = title_of(result.plan),
                          .subtitle = subtitle.str(),
                          .level = result.plan.chain.is_calibrated() ? "dB re 1 µPa²/Hz" : "dB re full scale²/Hz",
                          .colours_from = 0.5 * result.plan.settings.band.low});
}

void draw_curve(const Result& result, const Arguments& arguments) {
  std::ostringstream subtitle;
  subtitle << settings_text(result.plan, arguments) << "; " << result.score->truths << " selections, tolerance " << arguments.tolerance_s
           << " s, " << listened_text(result.heard.listened_s);
  plot::plot_operating_curve(arguments.roc, result.curve, title_of(result.plan), subtitle.str());
}

}  // namespace earshot::listen
