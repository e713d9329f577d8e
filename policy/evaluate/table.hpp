#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "policy/evaluate/bootstrap.hpp"
#include "policy/evaluate/evaluation.hpp"

namespace earshot::evaluate {

/// How one policy did in one world.
struct Row {
  std::string world;
  std::string policy;
  Summary summary;
  Intervals intervals;
  double path_over_straight = 0.0;
  double decision_s = 0.0;
};

/// @param flights  at least one
[[nodiscard]] Row row_of(const std::string& world, const std::string& policy, std::span<const Flight> flights, std::uint64_t seed);

/// The rows of one world as a table with a header line, for people to read.
[[nodiscard]] std::string as_text(std::span<const Row> rows);

enum class Timing : bool { kLeftOut, kIncluded };

/// One line for each row, after a header line. Numbers as short as they read back the same; an unknown ratio is empty.
[[nodiscard]] std::string as_csv(std::span<const Row> rows, Timing timing);

/// gnuplot's commands: mean reward and share found with their intervals, side by side for every policy, world by world.
[[nodiscard]] std::string as_plot(std::span<const Row> rows, const std::string& title);

}  // namespace earshot::evaluate
