#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace earshot::report {

/// What a vehicle said of its search: how surprised it was, whether it swept the area, and whether it declared the source found.
struct SearchAccount {
  bool believes = false;  ///< false: the policy holds no belief, and is never surprised
  double surprise_bits = 0.0;
  std::optional<std::uint32_t> surprised_step = std::nullopt;  ///< the first
  std::optional<std::uint32_t> sweep_step = std::nullopt;      ///< the first
  std::optional<std::uint32_t> max_steps = std::nullopt;
  std::optional<std::uint32_t> declared_step = std::nullopt;  ///< the first
  std::optional<double> declared_range_m = std::nullopt;      ///< to the source, where a simulator knows it
  std::optional<double> step_length_m = std::nullopt;
  bool is_found_undeclared = false;  ///< a simulator ended the search near the source, which the vehicle had not declared found

  /// Whether it swept because it had heard nothing for long: nothing had surprised it by then.
  [[nodiscard]] bool swept_in_silence() const { return sweep_step && (!surprised_step || *surprised_step > *sweep_step); }
};

/// Of a summary that is checked; one of an earlier version says nothing.
[[nodiscard]] SearchAccount account_in(const nlohmann::json& summary);

/// What is wrong with a summary's account, as "KEY: must be ..."; "" when nothing is.
[[nodiscard]] std::string fault_in_account(const nlohmann::json& summary);

/// "From step 9 on what it heard was unlikely in every ocean of its tables (surprise 13.2 bits at the end, which counts from 6.75 on).
/// Swept from step 11 of 100 on: what it heard fitted none of them. Declared found at step 34, wrongly: 1021 m from the source."; without a
/// surprise "Nothing unexpected: the oceans of its tables explain what it heard (...)"; "" when there is nothing to say
[[nodiscard]] std::string to_string(const SearchAccount& account);

/// ", wrongly: 1021 m from the source", ": 640 m from the source" or, where that is not known, "".
[[nodiscard]] std::string declared_where(const SearchAccount& account);

}  // namespace earshot::report
