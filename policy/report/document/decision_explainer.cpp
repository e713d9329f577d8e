#include "policy/report/document/decision_explainer.hpp"

#include <utility>

#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::report {
namespace {

using explain::RecordedDecision;
using host::BadInput;

std::unique_ptr<policy::OceanTables> load_tables(const std::filesystem::path& path) {
  return host::tables_from(host::read_tables_bytes(path), path);
}

}  // namespace

DecisionExplainer::DecisionExplainer(std::filesystem::path journal, const RecordingOptions& options, explain::Baseline baseline,
                                     std::span<const SnrRow> snr)
    : journal_(std::move(journal)), baseline_(baseline), snr_(snr), policy_name_("the policy in the journal") {
  if (options.policy) {
    policy_ = host::load_unverified_policy(*options.policy);
    policy_name_ = options.policy->string();
    is_policy_named_ = true;
  }
  if (options.tables) {
    tables_ = load_tables(*options.tables);
    are_tables_named_ = true;
  }
  if (options.south_west) {
    south_west_ = *options.south_west;
    is_south_west_named_ = true;
  }
}

void DecisionExplainer::take(const journal::PolicyBytes& policy) try {
  if (!is_policy_named_) policy_ = host::policy_from(policy.bytes, journal_.string() + ": its policy");
} catch (const BadInput& e) {
  why_not_ = e.what();
  is_at_fault_ = true;
}

void DecisionExplainer::take(const journal::TablesBytes& tables) try {
  if (!are_tables_named_ && !tables.bytes.empty()) tables_ = host::tables_from(tables.bytes, journal_.string() + ": its ocean tables");
} catch (const BadInput& e) {
  why_not_ = e.what();
  is_at_fault_ = true;
}

void DecisionExplainer::set_south_west(NorthEast south_west) {
  if (!is_south_west_named_) south_west_ = south_west;
}

bool DecisionExplainer::uses_measurements() const {
  return policy_ == nullptr || explain::uses_measurements(policy_->observation.spec);
}

void DecisionExplainer::find_policy() {
  if (policy_) return;
  const std::filesystem::path beside = file_beside(journal_, "policy");
  policy_ = host::load_unverified_policy(beside);
  policy_name_ = beside.string();
}

void DecisionExplainer::find_tables() {
  if (!tables_) tables_ = load_tables(file_beside(journal_, "tables"));
}

/// What the first decision needs.
void DecisionExplainer::prepare() {
  find_policy();
  const bool has_belief = policy::needs_belief(policy_->observation.spec);
  if (has_belief) {
    find_tables();
  } else {
    if (snr_.empty())
      throw NothingToExplain(
          policy_name_ +
          ": holds no belief, and without the folder of a simulated flight (summary.json, snr.csv) there is no ocean to make one of");
    observer_ = observer_of(*policy_, snr_);
  }
  follower_ = std::make_unique<explain::DecisionFollower>(
      explain::Circumstances{.policy = *policy_,
                             .belief = observer_ ? observer_->belief : policy_->observation.belief,
                             .tables = observer_ ? *observer_->tables : *tables_,
                             .belief_is_the_policys = has_belief,
                             .south_west = south_west_,
                             .baseline = baseline_});
}

explain::DecisionAccount DecisionExplainer::explained(const RecordedDecision& decision) {
  if (decision.step != 0 && next_step_ != decision.step)
    throw BadInput(journal_.string() + ": the decision of step " + std::to_string(next_step_.value_or(0)) +
                   " is missing: what was remembered after it cannot be made again");
  if (!follower_) prepare();
  follower_->follow(decision);
  if (const explain::Contradiction found = follower_->contradiction(decision); found != explain::Contradiction::kNone)
    throw BadInput(journal_.string() + ": " + to_string(found, decision, *policy_, policy_name_));
  next_step_ = decision.step + 1;
  return follower_->account_of(decision);
}

std::optional<explain::DecisionAccount> DecisionExplainer::explain(const RecordedDecision& decision) {
  if (is_lost_ && decision.step != 0) return std::nullopt;
  is_lost_ = true;
  try {
    explain::DecisionAccount account = explained(decision);
    const policy::OceanTables& tables = observer_ ? *observer_->tables : *tables_;
    expectation_ = std::make_shared<Expectation>(south_west_, account.place, explain::ExpectedSound(follower_->belief(), tables));
    is_lost_ = false;
    return account;
  } catch (const NothingToExplain& e) {
    why_not_ = e.what();
  } catch (const BadInput& e) {
    why_not_ = e.what();
    is_at_fault_ = true;
  }
  expectation_ = nullptr;
  return std::nullopt;
}

}  // namespace earshot::report
