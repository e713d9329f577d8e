#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/toml/range.hpp"

namespace earshot::python {

/// What is wrong with one argument. Python sees it as BadInput with the argument's name as `key`, whatever the text looks like.
class BadArgument : public host::BadInput {
 public:
  /// @param value  empty: of another kind than a number
  BadArgument(std::string name, std::optional<double> value, const std::string& text)
      : host::BadInput(text), name_(std::move(name)), value_(value) {}
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::optional<double> value() const { return value_; }

 private:
  std::string name_;
  std::optional<double> value_;
};

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
