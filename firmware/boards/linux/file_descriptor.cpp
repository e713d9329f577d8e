#include "firmware/boards/linux/file_descriptor.hpp"

#include <unistd.h>

namespace earshot::board {

FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) ::close(number_);
}

}  // namespace earshot::board
