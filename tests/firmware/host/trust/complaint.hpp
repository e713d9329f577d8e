#pragma once

#include <string>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {

/// What is said against the work; empty when nothing is.
template <class Work>
std::string complaint_of(Work work) {
  try {
    work();
  } catch (const BadInput& e) {
    return e.what();
  }
  return {};
}

}  // namespace earshot::host
