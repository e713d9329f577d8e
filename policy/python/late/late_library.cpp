#include "policy/python/late/late_library.hpp"

#include <dlfcn.h>

#include <string>

#include "sim/netcdf/file_error.hpp"

namespace earshot::python {

void* LateLibrary::function(const char* name) const {
  std::string reason;
  for (const char* const library : names_) {
    void* const handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);  // counts how often; what it loads is never let go
    void* const found = handle == nullptr ? nullptr : dlsym(handle, name);
    if (found != nullptr) return found;
    const char* const why = dlerror();
    if (reason.empty() && why != nullptr) reason = why;
  }
  throw netcdf::FileError(std::string(sentence_) + " (" + reason + ")");
}

}  // namespace earshot::python
