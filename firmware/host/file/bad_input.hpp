#pragma once

#include <stdexcept>
#include <string>

namespace earshot::host {

/// Everything that is wrong with what a person gave, one line each: "FILE:LINE: KEY = VALUE: what is allowed". Programs print it and exit
/// with status 2.
///
/// Names and values in it are another's: its lines are made printable(), and one of more than 1000 bytes is shortened, and
/// a message of more than 16 KiB.
/// Oracle: BadInput.*
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(const std::string& message);
};

}  // namespace earshot::host
