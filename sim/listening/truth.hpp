#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware/detector/hydrophone/settings.hpp"
#include "sim/annotation/score.hpp"
#include "sim/annotation/selection_table.hpp"
#include "sim/recording/sequence.hpp"

namespace earshot::listening {

/// What is truly in a recording, from its start.
struct Truth {
  std::vector<annotation::Interval> intervals;
  std::vector<std::string> remarks;  ///< what of the table is not counted, and why
};

/// What is listened to.
struct Listened {
  const recording::Sequence& sequence;
  std::size_t channel = 1;  ///< from 1
  detector::Band band;
};

/// Places the selections of a table in a sequence.
///
/// Where a selection names its file and its place in it, that counts. Where it names the file alone, times count from the start of the
/// sequence, as Raven has them, or from that of each file, as others do: whichever fits all lines. Selections of other files, of other
/// channels and of frequencies outside of the band are not counted, and remarked on.
/// @param name  what messages call the table
/// Throws host::BadInput where the table is not of these files, where none of its selections is listened to, or where it fits in both ways
/// and they differ.   Oracle: Truth.*
[[nodiscard]] Truth truth_of(const annotation::SelectionTable& table, const std::string& name, const Listened& listened);

}  // namespace earshot::listening
