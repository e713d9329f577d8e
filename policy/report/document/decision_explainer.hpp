#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "firmware/host/journal/reading/entry.hpp"
#include "policy/explain/decision_follower.hpp"
#include "policy/report/recorded_flight.hpp"

namespace earshot::report {

/// What was believed when a decision was taken, and what is expected to be heard by that.
struct Expectation {
  NorthEast south_west;  ///< of the area, from which places of the belief count
  explain::BelievedPlace place;
  explain::ExpectedSound sound;
};

/// Explains the decisions of a flight as they come, with the policy and the tables that its journal holds, that lie beside it, or that a
/// person names.
class DecisionExplainer {
 public:
  /// @param journal  "": nothing lies beside it
  /// @param snr      of the ocean that a simulator flew in, for a policy that holds no belief; empty: not known
  /// @throws host::BadInput when what `options` names cannot be read
  DecisionExplainer(std::filesystem::path journal, const RecordingOptions& options, explain::Baseline baseline,
                    std::span<const SnrRow> snr);

  void take(const journal::PolicyBytes& policy);
  void take(const journal::TablesBytes& tables);
  /// Corner of the mission's area.
  void set_south_west(NorthEast south_west);

  /// The next decision. Nothing: why_not() tells.
  [[nodiscard]] std::optional<explain::DecisionAccount> explain(const explain::RecordedDecision& decision);
  /// By the decision that was explained last. Nothing: it was not.
  [[nodiscard]] std::shared_ptr<const Expectation> expectation() const { return expectation_; }

  [[nodiscard]] const std::string& why_not() const { return why_not_; }
  /// Something is at fault with what was there to explain with.
  [[nodiscard]] bool is_at_fault() const { return is_at_fault_; }
  [[nodiscard]] bool uses_measurements() const;

 private:
  void find_policy();
  void find_tables();
  void prepare();
  [[nodiscard]] explain::DecisionAccount explained(const explain::RecordedDecision& decision);

  std::filesystem::path journal_;
  explain::Baseline baseline_;
  std::span<const SnrRow> snr_;
  std::string policy_name_;
  bool is_policy_named_ = false;  ///< by a person
  bool are_tables_named_ = false;
  std::unique_ptr<policy::FrozenPolicy> policy_;
  std::unique_ptr<policy::OceanTables> tables_;
  std::optional<Observer> observer_;
  NorthEast south_west_;
  bool is_south_west_named_ = false;
  std::unique_ptr<explain::DecisionFollower> follower_;
  bool is_lost_ = false;                    ///< until the next search begins nothing can be explained
  std::optional<std::uint32_t> next_step_;  ///< that follows what was explained
  std::shared_ptr<const Expectation> expectation_;
  std::string why_not_;
  bool is_at_fault_ = false;
};

}  // namespace earshot::report
