#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/messages/vehicle_status.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

inline constexpr host::OutputKind kTurnTableOutput{"a table of a journal's turns", {"turn,time_s,mission_s,", {}}};

/// A CSV table with a row for every turn of the decision loop: the state, the set-point that the turn gave (none: empty), and the newest
/// usable fix, SNR and vehicle status until then, with their ages. What is not known is empty.
class TurnTable final : public Export {
 public:
  /// @param plane  turns the mission's places into latitudes and longitudes; none: these columns stay empty
  TurnTable(const std::filesystem::path& path, const std::optional<n2k::LocalPlane>& plane);
  void take(const Entry& entry, std::span<const Event> events) override;
  void finish(std::span<const Event> /*events*/) override { file_.commit(); }
  [[nodiscard]] std::string what() const override;

 private:
  void note(const messages::Input& input);
  void write_row(Time time, const messages::Health& health);

  PiecewiseFile file_;
  std::optional<n2k::LocalPlane> plane_;
  std::optional<Time> began_;
  std::optional<messages::Navigation> fix_;
  std::optional<messages::SnrMeasurement> snr_;
  std::optional<messages::VehicleStatus> status_;
  std::optional<messages::Setpoint> setpoint_;  ///< of this turn
  std::uint64_t rows_ = 0;
};

}  // namespace earshot::journal
