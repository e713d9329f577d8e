#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/core/units.hpp"
#include "policy/description/search_choices.hpp"
#include "policy/description/trained_task.hpp"
#include "policy/evaluate/candidates.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/search/settings.hpp"

namespace earshot::evaluate {

/// The candidate whose training says what is searched where nobody else does: the first learned one whose provenance names its source, else
/// the first learned one; null when none is learned.
[[nodiscard]] const Candidate* leading(std::span<const Candidate> candidates);

/// What a candidate was trained for, as far as its file says; nothing of one that is not learned.
[[nodiscard]] description::TrainedTask trained_task(const Candidate& candidate);

/// Throws host::BadInput, naming two, when learned candidates were trained with both kinds of source: whichever were searched for, the rows
/// of some would be of a task they never learned.
void check_same_source(std::span<const Candidate> candidates);

/// The search that is flown, and who said so.
struct Task {
  description::SearchChoices choices;  ///< given, or as the leading candidate was trained
  search::SearchSettings settings;     ///< the learned candidates' own: area, step, threshold; the choices are not applied yet
  Meters depth;
  std::string trained_by;  ///< name of the candidate whose training holds where nothing else is given; empty: nobody's
  std::string as_trained;  ///< " (as fixed.policy was trained)"; of a policy without a network, which nobody trains, "is made for"
};

/// @param leading  the candidate whose training counts; null: none
[[nodiscard]] Task task_of(const description::SearchChoices& given, std::span<const Candidate> candidates, const Candidate* leading);

/// A fixed source stands where the environment that is given puts it; where none is, as it was trained, if that is known.
[[nodiscard]] NorthEast source_of(const Candidate* leading, const ocean::Environment& environment, bool is_given);

/// What candidates are tested in, as far as a training may have been of another kind.
struct TestedTask {
  const search::SearchSettings& settings;
  Meters vehicle_depth;
  std::string_view environment_crc32;  ///< of the environment that puts a fixed source where a policy does not say where it was
};

/// A sentence for everything that is tested in another way than the candidate was trained for, and one if its file does not say which
/// source that was. Of one without a network, whose belief advises it, the kind of source alone counts: nothing in it was trained, and
/// depth and frequency are its tables'. Nothing of a candidate that is not learned. Oracle: Task.*
[[nodiscard]] std::vector<std::string> differences(const Candidate& candidate, const TestedTask& tested);

}  // namespace earshot::evaluate
