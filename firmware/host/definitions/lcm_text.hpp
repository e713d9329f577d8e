#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace earshot::definitions {

/// The definition of one message in LCM's language.
struct LcmDefinition {
  std::string_view type;  ///< "nav_state_t": its file is nav_state_t.lcm
  std::string text;       ///< of the whole file
};

/// Of every message there is, made of its list in firmware/messages/dictionary.
[[nodiscard]] std::vector<LcmDefinition> lcm_definitions();

}  // namespace earshot::definitions
