#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace earshot::search {

/// What a vehicle reported of its search: whether its measurements fitted its ocean tables, whether it swept the area, whether it declared
/// the source found, and which rule sent it home; and, of a simulated flight, how that ended.
struct SearchAccount {
  bool believes = false;  ///< false: the policy holds no belief, and has no model-mismatch score
  double mismatch_bits = 0.0;
  std::optional<std::uint32_t> mismatch_step = std::nullopt;  ///< the first
  std::optional<std::uint32_t> sweep_step = std::nullopt;     ///< the first
  std::optional<std::uint32_t> max_steps = std::nullopt;
  std::optional<std::uint32_t> declared_step = std::nullopt;  ///< the first
  std::optional<double> declared_range_m = std::nullopt;      ///< to the source, where a simulator knows it
  std::optional<double> step_length_m = std::nullopt;
  /// The first rule that sent the vehicle home, or to the surface.
  struct WayHome {
    std::string rule;         ///< in words with its evidence
    std::uint32_t steps = 0;  ///< that it had taken by then
    bool is_to_surface = false;
  };
  std::optional<WayHome> way_home = std::nullopt;
  bool is_found = false;  ///< a simulator ended the search within a step length of the source
  std::uint32_t steps = 0;
  std::string end_reason = "";   ///< the summary's code, of this version; "": none is known
  std::string ending_rule = "";  ///< the safety rule that ended it, in words with its evidence; "": none did

  /// Whether it swept because it had detected nothing for long: no measurement was a mismatch by then.
  [[nodiscard]] bool swept_in_silence() const { return sweep_step && (!mismatch_step || *mismatch_step > *sweep_step); }
  /// Whether it declared the source found further than a step length from it, as far as that is known.
  [[nodiscard]] bool declared_wrongly() const { return declared_range_m && step_length_m && *declared_range_m > *step_length_m; }
};

/// Of a summary.json that is checked; one of an earlier version knows less.
[[nodiscard]] SearchAccount account_in(const nlohmann::json& summary);

/// What is wrong with a summary's account, as "KEY: must be ..."; "" when nothing is.
[[nodiscard]] std::string fault_in_account(const nlohmann::json& summary);

/// How a simulated flight ended, in one sentence without its full stop. Nothing else that terminal or page print contradicts it.
struct Verdict {
  bool is_found = false;  ///< the vehicle came within a step length of the source, or declared it found there
  std::string text;       ///< "Source found after 18 steps: the vehicle came within 1.0 km of it"
};
[[nodiscard]] Verdict verdict_on(const SearchAccount& account);

/// Why the mission of a simulated flight ended: "all 100 steps were taken".
[[nodiscard]] std::string end_to_string(const SearchAccount& account);

/// A sentence about a search, and the one word that names its subject.
struct LabelledSentence {
  std::string label;  ///< "mismatch", "sweep", "declared", "went home", "came up"
  std::string text;
};

/// Whether measurements fitted the ocean tables, whether the vehicle swept the area, whether it declared the source found, which rule sent
/// it home. None where nothing is known of it.
[[nodiscard]] std::vector<LabelledSentence> sentences(const SearchAccount& account);

/// The same as one paragraph.
[[nodiscard]] std::string to_string(const SearchAccount& account);

// What the numbers of a flight mean, in one line each, as terminal and page print it.
inline constexpr const char* kRewardMeans = "0 for each step that ends with a detection, -1 for each other, and less near the area's edge";
/// "its south-west corner lies at 38.500 N, 28.000 W"; "" where a summary of an earlier version has no origin.
/// @param degree  behind each number
[[nodiscard]] std::string place_of_area(const nlohmann::json& summary, const std::string& degree);
/// "a step that ends with an SNR of 10 dB or more"
[[nodiscard]] std::string detection_means(double threshold_db);
/// "the vehicle came within one step length of the source, 1.0 km"
[[nodiscard]] std::string found_means(std::optional<double> step_length_m);
inline constexpr const char* kDeclaredMeans =
    "the vehicle's own rule reports that the source is within one step; it cannot know, and may be wrong";

}  // namespace earshot::search
