#pragma once

#include <sys/types.h>

namespace earshot::host {

/// "a folder", "a pipe", "a socket", "a device" or "a regular file", by the mode that stat() gives.
[[nodiscard]] const char* type_name(mode_t mode);

}  // namespace earshot::host
