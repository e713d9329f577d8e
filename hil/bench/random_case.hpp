#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hil/bench/case.hpp"

namespace earshot::hil {

/// A case of two or three faults of other cases at once, each at a time of its own. It begins within the area near its edge, or so near to
/// the halt polygon, and towards it, that only a vehicle that is steered back stays within. Whatever comes of it, no
/// promise may be broken (broken_promises). The same seed gives the same case.
/// @param pool  whose faults are taken, at least one of which has some
[[nodiscard]] Case random_case(const std::vector<Case>& pool, std::uint64_t seed);

/// The smallest of its parts that still fails: faults are taken out as long as it does.
/// @param fails  flies a case
[[nodiscard]] Case shrunk(Case c, const std::function<bool(const Case&)>& fails);

/// The file of a case, as load_case() reads it again wherever it lies: its mission is named from the root on.
[[nodiscard]] std::string to_toml(const Case& c);

}  // namespace earshot::hil
