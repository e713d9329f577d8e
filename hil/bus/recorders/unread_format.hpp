#pragma once

#include <string_view>

namespace earshot::hil {

/// What a file is whose recorder is known and not read here, with what makes a log of it: "is ...".
/// @param beginning  of the file; a few hundred bytes will do
/// @return empty: none of these
/// Oracle: UnreadFormat tests
[[nodiscard]] std::string_view unread_format(std::string_view beginning);

}  // namespace earshot::hil
