#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "policy/explain/decision_account.hpp"
#include "policy/explain/replay.hpp"
#include "policy/report/conditions.hpp"
#include "policy/report/flight_files.hpp"

namespace earshot::report {

/// A journal with the policy that flew it: all that an explanation of its decisions needs.
struct RecordedFlight {
  std::filesystem::path journal_path;
  std::filesystem::path policy_path;
  JournalledSearch journal;
  std::unique_ptr<policy::FrozenPolicy> policy;
  std::unique_ptr<policy::OceanTables> tables;  ///< by which it searched, or the observer would
  NorthEast south_west;                         ///< of the operating area, in the mission's plane
  std::optional<NorthEast> source;              ///< where a simulator put it
  std::optional<Conditions> conditions;         ///< of the search; none: the journal has lost its mission
  std::optional<policy::BeliefModel> observer;  ///< for a policy that holds no belief: what one who knows the ocean would take for granted

  /// The policy's belief, or the observer's.
  [[nodiscard]] const policy::BeliefModel& belief() const { return observer ? *observer : policy->observation.belief; }
  [[nodiscard]] explain::Circumstances circumstances(explain::Baseline baseline) const;
};

/// What one who knows the ocean would take for granted.
struct Observer {
  policy::BeliefModel belief;
  std::unique_ptr<policy::OceanTables> tables;
};
/// For a policy without a belief. @param snr  of the ocean that it flew in, at least two rows
[[nodiscard]] Observer observer_of(const policy::FrozenPolicy& policy, std::span<const SnrRow> snr);

/// How a decision contradicts the policy that is said to have taken it, in words. @param policy_name  for people
[[nodiscard]] std::string to_string(explain::Contradiction contradiction, const explain::RecordedDecision& decision,
                                    const policy::FrozenPolicy& policy, const std::string& policy_name);

/// What a person may say about a recording; what is not said is looked for beside the journal.
struct RecordingOptions {
  std::optional<std::filesystem::path> policy = std::nullopt;
  std::optional<std::filesystem::path> tables = std::nullopt;
  std::optional<NorthEast> south_west = std::nullopt;
};

/// A flight that there is nothing to explain of, though none of its files is at fault: no decision, or no belief and no ocean to make one
/// of.
struct NothingToExplain : host::BadInput {
  using BadInput::BadInput;
};

/// Opens the folder of a simulated flight, or a journal alone, and holds every decision against the policy, bit for bit.
/// @throws NothingToExplain, or host::BadInput, one line: a gap, no policy, another policy.
[[nodiscard]] RecordedFlight open_recording(const std::filesystem::path& folder_or_journal, const RecordingOptions& options);

/// What flew beside a journal. @param what  "policy"; its files end in "." and that
/// @throws host::BadInput that there is none, and that the option "--" and that names it
[[nodiscard]] std::filesystem::path file_beside(const std::filesystem::path& journal, const std::string& what);

/// Index of the decision of a step. @throws host::BadInput when the flight has no such step.
[[nodiscard]] std::size_t index_of_step(const RecordedFlight& flight, std::uint32_t step);

}  // namespace earshot::report
