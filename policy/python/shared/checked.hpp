#pragma once

#include <sstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/toml/range.hpp"

namespace earshot::python {

/// "max_range = -1: "
inline std::string named(const char* name, double value) {
  std::ostringstream text;
  text << name << " = " << value << ": ";
  return text.str();
}

/// The value of an argument. Throws host::BadInput, which Python sees as BadInput, where it is not allowed.
inline double checked(const char* name, double value, const host::Range& allowed) {
  if (allowed.allows(value)) return value;
  throw host::BadInput(named(name, value) + to_string(allowed));
}

}  // namespace earshot::python
