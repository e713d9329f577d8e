#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config/safety.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/messages/health.hpp"
#include "hil/bench/fault.hpp"

namespace earshot::hil {

/// What must come of a case, whatever else happens. What no case may bring forth stands in verdict.hpp.
struct Expectation {
  messages::EndReason end = messages::EndReason::kCompleted;  ///< kNone: the search is under way when time is up
  std::vector<config::Condition> rules;                       ///< that must fire, each at least once, after the first fault began
  bool only_these = true;                                     ///< no other rule fires
  std::optional<bool> refuses_navigation = std::nullopt;      ///< at least one fix is refused, or none; nothing: either
  std::optional<bool> refuses_commands = std::nullopt;        ///< likewise of orders
  bool loses_nothing = false;                                 ///< no frame or message is lost that arrived faster than it was read
  std::int64_t decisions = 0;                                 ///< that are taken at least after the first fault began
  bool comes_up = false;                                      ///< the vehicle truly is at the surface when the flight ends
  bool releases_weight = false;                               ///< the vehicle was asked to let its drop weight go
  bool refuses_frames = false;                                ///< the kernel has no room for at least one frame (ENOBUFS), by its counters
  bool refuses_to_fly = false;  ///< earshotd ends with status 2 before a search begins; what is wrong from 0 s on is wrong before it starts
  friend bool operator==(const Expectation&, const Expectation&) = default;
};

/// One flight of the bench: what the vehicle meets, and what must come of it.
struct Case {
  std::string name;  ///< of its file, without .toml
  std::string given;
  std::string when;
  std::string then;
  std::string defence = {};  ///< without which it would not come so, in words
  std::filesystem::path mission;
  host::PortKind bus = host::PortKind::kCan;  ///< of all its ports
  NorthEast start;
  double start_heading_deg = 0.0;  ///< clockwise from north
  NorthEast source;
  Duration at_most;  ///< at sea
  /// Seconds at sea in one of the host's, with the vehicle as a program of its own; nothing: in lock-step.
  std::optional<double> speed = std::nullopt;
  std::uint8_t sound_port = 0;  ///< index of the port that takes a hydrophone's samples; 0: none
  std::vector<TimedFault> faults;
  Expectation expected;

  [[nodiscard]] Radians start_heading() const;  ///< in (-pi, pi]
  [[nodiscard]] bool has(Fault fault) const;
  /// Whether any of its faults hits that.
  [[nodiscard]] bool has(FaultTarget target) const;
  friend bool operator==(const Case&, const Case&) = default;
};

/// Reads the file of a case; README.md says its keys.
/// @param usual_mission  of a case that names none
/// @throws host::BadInput with everything that is wrong with it.
[[nodiscard]] Case load_case(const std::filesystem::path& path, const std::filesystem::path& usual_mission);

/// Those of a folder, by name. @throws as load_case()
[[nodiscard]] std::vector<Case> load_cases(const std::filesystem::path& folder, const std::filesystem::path& usual_mission);

/// The key of a rule in files: "leak".
[[nodiscard]] std::string key_of(config::Condition rule);

}  // namespace earshot::hil
