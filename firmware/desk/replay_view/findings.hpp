#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/core/time.hpp"
#include "firmware/desk/replay_view/field_difference.hpp"

namespace earshot::replay_view {

/// "4123 inputs, 2011 turns and 12 decisions; 2010.0 s of mission in 0.05 s, 40200 times real time"
[[nodiscard]] std::string figures(const board::ReplayResult& result, double took_s);

/// Which fields of the first difference differ; nothing where the journal has another record than the runtime says.
[[nodiscard]] std::vector<FieldDifference> fields_of(const board::Playback::Difference& difference);

/// "record 57, EARSHOT_HEALTH at 12.000 s: state is "SEARCH" in the journal, "ABORT" now"
[[nodiscard]] std::string to_string(const board::Playback::Difference& difference, Time began);

/// What is wrong, a line each: the first difference, what is missing, what is damaged, an end that is not there. Empty: the journal is
/// whole, and every output is the same, byte for byte.
[[nodiscard]] std::vector<std::string> findings(const board::ReplayResult& result);

/// "every output is the same, byte for byte", as far as outputs were compared.
[[nodiscard]] std::string praise(const board::ReplayResult& result, std::uint32_t from_step);

}  // namespace earshot::replay_view
