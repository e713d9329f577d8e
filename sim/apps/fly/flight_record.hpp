#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/detector/snr_window.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "sim/search/settings.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::fly {

/// What one tick was like.
struct TrackPoint {
  Time time;
  vehicle::State vehicle;
  policy::Reception reception;  ///< modelled
  Meters range;                 ///< horizontal, to the source
  messages::MissionState state = messages::MissionState::kStandby;
  std::uint32_t steps_taken = 0;  ///< actions completed
};

/// track.csv: one row per tick, the same bytes for the same flight. Written under another name and renamed by finish(), so that no half of
/// it is ever taken for the whole.
class TrackFile {
 public:
  /// @throws std::system_error naming the file.
  explicit TrackFile(const std::filesystem::path& path);
  /// @throws std::system_error naming the file when it cannot be written.
  void add(const TrackPoint& point);
  /// Keeps every row that could be written whole. @throws std::system_error naming the file when the last ones could not.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };
  std::filesystem::path path_;
  std::filesystem::path partial_;
  bool is_cut_ = false;  ///< a row could not be written
  std::unique_ptr<std::FILE, Close> file_;
};

/// The score of a flight, added up tick by tick. The reception of a step is made of the measurements on its leg in the way in which the
/// runtime makes it of them.
class Score {
 public:
  explicit Score(const search::SearchSettings& settings) : settings_(settings) {}

  /// What the vehicle heard since the last tick, before that tick is added.
  void hear(const messages::SnrMeasurement& measurement) { snr_window_.take(measurement); }
  void add(const TrackPoint& point);

  [[nodiscard]] double reward() const { return reward_; }
  [[nodiscard]] std::uint32_t steps() const { return steps_; }            ///< as the runtime counts them
  [[nodiscard]] std::uint32_t detections() const { return detections_; }  ///< steps that ended with SNR >= DT
  [[nodiscard]] Meters distance() const { return distance_; }

 private:
  void end_step(const TrackPoint& point);

  search::SearchSettings settings_;
  std::optional<NorthEast> last_position_;
  bool is_searching_ = false;
  detector::SnrWindow snr_window_;
  std::uint32_t steps_taken_ = 0;
  double reward_ = 0.0;
  std::uint32_t steps_ = 0;
  std::uint32_t detections_ = 0;
  Meters distance_;
};

/// Removes what an earlier flight left in its folder and a new one does not replace at once: no half-flown search may look finished.
void remove_results(const std::filesystem::path& folder);

}  // namespace earshot::fly
