#include "firmware/host/file/file_descriptor.hpp"

#include <unistd.h>

namespace earshot::host {

FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) ::close(number_);
}

}  // namespace earshot::host
