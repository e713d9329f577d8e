#pragma once

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::board {

using host::FileDescriptor;  ///< of the bus's sockets and the journal

}  // namespace earshot::board
