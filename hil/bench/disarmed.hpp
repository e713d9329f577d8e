#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/config/safety.hpp"
#include "firmware/core/time.hpp"

namespace earshot::hil {

/// The text of a mission without some of its rules: a case that still passes then does not test them. A rule that stands in every mission
/// is put off by its limit (navigation_timeout_s, snr_timeout_s, max_depth_m) as far as a mission may; one that has none stays.
/// @param text  of a mission file in `folder`; the files that it names are named with their whole paths then
[[nodiscard]] std::string disarmed(const std::string& text, const std::vector<config::Condition>& rules,
                                   const std::filesystem::path& folder);

/// Whether disarmed() puts it off, by less than a minute and more than kPutOff.
[[nodiscard]] bool is_put_off(config::Condition rule);
inline constexpr Duration kPutOff = Duration::seconds(40);

/// Whether disarmed() can do without it.
[[nodiscard]] bool can_be_disarmed(config::Condition rule);

}  // namespace earshot::hil
