#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/setpoint.hpp"
#include "policy/report/document/decision_explainer.hpp"

namespace earshot::report {

/// A row for every turn of a flight: where the vehicle was, what it was asked to do, and what it heard (`Strips` of the page).
class TurnRows {
 public:
  explicit TurnRows(Time began = {}) : began_(began) {}

  void take(const messages::Input& input);
  void take(const messages::Setpoint& setpoint) { setpoint_ = setpoint; }
  /// Older than that, what came in is not known to be so still.
  void take(const config::Mission& mission);
  /// A turn is over.
  void take(Time time, const messages::Health& health);
  /// What is expected of the turns to come. @param has_belief  else nothing is
  void expect(std::shared_ptr<const Expectation> expectation, bool has_belief);

  [[nodiscard]] std::size_t size() const { return turns_.size(); }
  /// Of the turns from `first` on; of more than `most` every second, third, ..., the last among them.
  [[nodiscard]] nlohmann::ordered_json strips(std::size_t first, std::size_t most);

 private:
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  struct Turn {
    double time_s = 0.0;
    NorthEast place{Meters{kUnknown}, Meters{kUnknown}};
    double depth_m = kUnknown;
    double heading_deg = kUnknown;
    double speed_mps = kUnknown;
    double depth_set_m = kUnknown;
    double heading_set_deg = kUnknown;
    double speed_set_mps = kUnknown;
    NorthEast waypoint{Meters{kUnknown}, Meters{kUnknown}};
    double snr_db = kUnknown;
    double expected_snr_db = kUnknown;
    double mismatch_bits = kUnknown;
    double battery_percent = kUnknown;
    std::size_t expectation = 0;  ///< so many had come
    bool is_expectation_settled = false;
    bool is_too_faint = false;
  };
  void settle_expectation(Turn& turn) const;

  Time began_;
  Duration navigation_timeout_ = Duration::seconds(60);
  Duration snr_timeout_ = Duration::seconds(60);
  std::optional<messages::Navigation> fix_;
  std::optional<messages::SnrMeasurement> snr_;
  std::optional<messages::Setpoint> setpoint_;
  double battery_percent_ = kUnknown;
  bool has_belief_ = false;
  std::vector<std::shared_ptr<const Expectation>> expectations_;
  std::vector<Turn> turns_;
};

}  // namespace earshot::report
