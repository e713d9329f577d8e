#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/time.hpp"
#include "hil/bench/case.hpp"

namespace earshot::hil {

/// The text of a mission without some of its rules: a case that still passes then does not test them. A rule that stands in every mission
/// is put off by its limit (navigation_timeout_s, snr_timeout_s, max_depth_m) as far as a mission may; one that has none stays.
/// @param text  of a mission file in `folder`; the files that it names are named with their whole paths then
[[nodiscard]] std::string disarmed(const std::string& text, const std::vector<config::Condition>& rules,
                                   const std::filesystem::path& folder);

/// How long behind the end that a case has with its rules it is flown without them: disarmed() puts a rule off by more, and another that
/// would do the same later has not done it yet.
inline constexpr Duration kPutOff = Duration::seconds(40);

/// What a case still expects without `rules`. That one fires is no part of it, for a rule that is not there cannot: what it does for the
/// vehicle is. Only of rules that do nothing but warn it is all there is, and stays.
/// @param mission  with its rules
[[nodiscard]] Expectation expected_without_firing(Expectation expected, const std::vector<config::Condition>& rules,
                                                  const config::Mission& mission);

/// Whether disarmed() can do without it.
[[nodiscard]] bool can_be_disarmed(config::Condition rule);

}  // namespace earshot::hil
