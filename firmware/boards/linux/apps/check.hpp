#pragma once

#include "firmware/boards/linux/apps/earshotd_options.hpp"

namespace earshot::board {

/// The checklist before a dive. Nothing is flown.
/// @return exit status
/// @throws host::BadInput when the mission could not be flown
[[nodiscard]] int check(const Options& o);

}  // namespace earshot::board
