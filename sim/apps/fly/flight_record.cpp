#include "sim/apps/fly/flight_record.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <numbers>
#include <system_error>

#include "firmware/core/geometry.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "sim/search/reward/step_reward.hpp"

namespace earshot::fly {
namespace {

std::filesystem::path partial_name(const std::filesystem::path& path) {
  return path.string() + ".partial";
}

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

void cut_to_whole_rows(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  std::filesystem::resize_file(path, text.rfind('\n') + 1);
}

}  // namespace

TrackFile::TrackFile(const std::filesystem::path& path)
    : path_(path), partial_(partial_name(path)), file_(std::fopen(partial_.c_str(), "w")) {
  if (!file_) fail(partial_);
  (void)std::fputs("time_s,north_m,east_m,depth_m,heading_deg,speed_mps,snr_db,range_m,state,steps_taken\n", file_.get());
}

void TrackFile::add(const TrackPoint& p) {
  const int written = std::fprintf(file_.get(), "%.3f,%.6f,%.6f,%.6f,%.6f,%.6f,%.4f,%.4f,%s,%u\n", (p.time - Time{}).to_seconds(),
                                   p.vehicle.position.north.value, p.vehicle.position.east.value, p.vehicle.depth.value,
                                   p.vehicle.heading.value * 180.0 / std::numbers::pi, p.vehicle.speed.value, p.reception.snr.value,
                                   p.range.value, messages::key_of(p.state).data(), p.steps_taken);
  if (written >= 0) return;
  is_cut_ = true;
  fail(path_);
}

void TrackFile::finish() {
  const bool is_closed = std::fclose(file_.release()) == 0;
  const int error = errno;
  if (is_cut_ || !is_closed) cut_to_whole_rows(partial_);
  std::filesystem::rename(partial_, path_);
  if (!is_closed && !is_cut_) throw std::system_error(error, std::generic_category(), path_.string());
}

void Score::add(const TrackPoint& point) {
  if (last_position_) distance_ += range_between(*last_position_, point.vehicle.position);
  last_position_ = point.vehicle.position;
  const bool has_begun = !is_searching_ && point.state == messages::MissionState::kSearch;
  const bool has_stepped = point.steps_taken != steps_taken_;
  if (has_stepped) end_step(point);
  if (has_begun || has_stepped) snr_window_.begin_leg(point.time);
  is_searching_ = is_searching_ || has_begun;
  steps_taken_ = point.steps_taken;
}

void Score::end_step(const TrackPoint& point) {
  ++steps_;
  const detector::WindowReception window = snr_window_.reception(settings_.listening, point.time);
  const policy::Reception reception{.snr = window.snr, .too_faint = window.too_faint};
  reward_ += search::step_reward(settings_, point.vehicle.position, reception);
  if (search::is_detection(settings_, reception)) ++detections_;
}

void remove_results(const std::filesystem::path& folder) {
  for (const char* name : {"summary.json", "track.csv", "hearing.csv", "spectrogram.csv", "report.html"})
    std::filesystem::remove(folder / name);
}

}  // namespace earshot::fly
