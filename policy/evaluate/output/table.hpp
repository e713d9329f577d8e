#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "policy/evaluate/bootstrap.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/interval.hpp"
#include "policy/evaluate/time_to_find.hpp"

namespace earshot::evaluate {

/// How one policy did in one world.
struct Row {
  std::string world;
  std::string policy;
  Summary summary;
  Interval found_fraction_95;
  TimeToFind time_to_find;
  Pace pace;
  Intervals intervals;
  double path_over_straight = 0.0;
  Mismatches mismatches;
  double decision_s = 0.0;
  double refinement_s = 0.0;
  std::optional<DeclarationShares> declarations = std::nullopt;  ///< of a searcher that says itself whether the source is found
};

/// @param flights  at least one
/// @param between  as of bootstrap(), which takes nearly all of the time
[[nodiscard]] Row row_of(const std::string& world, const std::string& policy, std::span<const Flight> flights, const Pace& pace,
                         std::uint64_t seed, const std::function<void()>& between = {});

/// A time in steps as hours. Infinite stays infinite.
[[nodiscard]] double hours(double steps, const Pace& pace);

/// The rows of one world as three tables under one another, each at most 100 columns wide and with units in its header, for people to
/// read: found and time to find, then the reward, then way and decisions. A name longer than 28 characters stands on a line of its own.
/// "-" is a time that never comes, or a ratio that nobody knows. A fourth has those that declare the source found themselves, and how often
/// they were wrong. README.md of this folder lists every column.
[[nodiscard]] std::string as_text(std::span<const Row> rows);

enum class Timing : bool { kLeftOut, kIncluded };

/// One line for each row, after a header line. Numbers as short as they read back the same; an unknown ratio is empty, a time that never
/// comes inf.
[[nodiscard]] std::string as_csv(std::span<const Row> rows, Timing timing);

}  // namespace earshot::evaluate
