#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"
#include "policy/baselines/searcher.hpp"
#include "sim/search/settings.hpp"

namespace earshot::evaluate {

/// A searcher that is to be evaluated: a learned policy, what `make` makes, or else the baseline of that name.
struct Candidate {
  std::string name;
  std::unique_ptr<policy::FrozenPolicy> learned;
  std::filesystem::path file = {};  ///< that it was read from; of a learned one
  /// Makes a searcher that is no part of Earshot; empty: it is one of Earshot's.
  std::function<std::unique_ptr<baselines::Searcher>(const baselines::PriorKnowledge&)> make = {};
};

/// The candidate of a name: a policy that ships ("shipped", "fixed_source"), a baseline's, or the path of a `.policy` file. Throws
/// host::BadInput when it is none of them.
[[nodiscard]] Candidate candidate_named(const std::string& name);

/// Of candidates that are one and the same, under one name or two, the first stays. @return what goes, a sentence each
[[nodiscard]] std::vector<std::string> leave_out_repeated(std::vector<Candidate>& candidates);

/// The search that the learned candidates were trained for; the paper's when there is none. Throws host::BadInput, naming two, when they
/// were trained for different areas, step lengths or detection thresholds.
[[nodiscard]] search::SearchSettings settings_of(std::span<const Candidate> candidates);

/// Throws host::BadInput, naming two, when learned candidates listen over different windows: they can be compared only over a window that
/// is given to all.
void check_same_listening(std::span<const Candidate> candidates);

/// A line about the baselines that are given an ocean which a vehicle would have to find out; empty where there are none.
/// @param is_true  the ocean of the environment is the one that is searched in
[[nodiscard]] std::string given_oceans(std::span<const Candidate> candidates, const std::filesystem::path& environment, bool is_true);

}  // namespace earshot::evaluate
